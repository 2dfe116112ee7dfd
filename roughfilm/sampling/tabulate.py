"""The table of all windows: a row for each, with its place or seed, its quantities and their uncertainties."""

import math

from roughfilm.rom.studies.table import Column
from roughfilm.sampling.plan import Plan
from roughfilm.sampling.run import Rows

FIRST_COLUMN = "window"
"""The first column, by which a file is recognised: numbers of the windows of each size."""


def table_of(plan: Plan, rows: Rows) -> dict[str, Column]:
    """The columns by name, in SI units; numbers that are missing are NaN."""
    ordered = [row for own in rows.by_group for row in own]
    sizes = [group.size for group in plan.groups for _ in group.cells]
    numbers = [float(number + 1) for group in plan.groups for number in range(len(group.cells))]
    table = {FIRST_COLUMN: Column(values=numbers, unit="1"), "size": Column(values=sizes, unit="m")}
    if plan.surface is None:
        seeds = [float(seed) for group in plan.groups for seed in group.seeds]
        table["seed"] = Column(values=seeds, unit="1")
    else:
        for axis, name in enumerate(("start_x", "start_y")):
            step = plan.surface.spacing[axis]
            starts = [step * window.start[axis] for group in plan.groups for window in group.windows]
            table[name] = Column(values=starts, unit="m")
    units = {name: one.unit for row in ordered for name, one in row.quantities.items()}
    for name, unit in units.items():
        some = [row.quantities.get(name) for row in ordered]
        table[name] = Column(values=[math.nan if one is None else one.value for one in some], unit=unit)
        half = [math.nan if one is None or one.uncertainty is None else one.uncertainty for one in some]
        table[f"{name}_uncertainty"] = Column(values=half, unit=unit)
    table["cpu_s"] = Column(values=[row.cpu_s for row in ordered], unit="s")
    failures = ["" if row.failure is None else row.failure.message for row in ordered]
    table["failure"] = Column(values=failures, unit="")
    return table
