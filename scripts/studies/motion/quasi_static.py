"""Compare what is stated of loads over time with marches: python -m scripts.studies.motion.quasi_static --out OUT.

`advise` and `effects` state by how much squeeze changes the least film of a bearing whose load changes, by a coarse
march, and to first order in the rate of change where that stops. Random journals are marched on a finer grid with
shorter steps.
"""

import json
import math
import time
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.quasi_static import CELLS, marched_change, quasi_static
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, output, print_json, run_alone
from scripts.studies.study import Out, counted, plain

ROWS = 25
"""Rows of the table of a period."""

FINE_ERROR = 5e-4
"""Error of a step of the march that counts as true."""


@dataclass(frozen=True, kw_only=True)
class Compared:
    """The changes of the least film by squeeze of one journal; None where a march stops, with the reason.

    Attributes
    ----------
    period : time in which the load repeats, s.
    part : change of the load over its mean.
    squeeze_number : largest ratio of the forces by motion to the load.
    linear, coarse, true : the change to first order, by a coarse march, and by the march that counts as true.
    linear_s, coarse_s : CPU times, s.
    """

    seed: int
    period: float
    part: float
    squeeze_number: float
    linear: float
    coarse: float | None
    true: float | None
    linear_s: float
    coarse_s: float
    reason: str = ""


def drawn(seed: int) -> tuple[Bearing, float, float]:
    """Return the random journal of a seed, its period, s, and the change of its load over the mean."""
    rng = np.random.default_rng(seed)
    period, part = float(10 ** rng.uniform(math.log10(0.02), math.log10(2))), float(rng.uniform(0.16, 0.58))
    pressure, turns = 10 ** rng.uniform(5.6, 6.5), rng.uniform(0, 0.3)
    lobes = int(rng.integers(1, 4))
    phases = np.linspace(0, 1, ROWS)
    width = float(rng.uniform(0.5, 1.2)) * 0.1
    loads = pressure * 0.1 * width * (1 + part * np.sin(2 * math.pi * phases))
    angles = -math.pi / 2 + turns * np.sin(2 * math.pi * (phases - rng.uniform()))
    angles[-1], loads[-1] = angles[0], loads[0]
    entries: dict[str, Any] = {
        "name": f"journal {seed}",
        "kind": "bearing",
        "geometry": {
            "shape": "lobes",
            "radius": "50 mm",
            "clearance": f"{rng.uniform(40, 100)!r} um",
            "width": f"{width!r} m",
            "lobes": lobes,
            "arc": f"{360 / lobes - rng.uniform(10, 40)!r} deg",
        },
        "lubricant": {"viscosity": f"{rng.uniform(10, 60)!r} mPa*s", "cavitation_pressure": "-0.1 MPa"},
        "motion": {
            "speed": f"{rng.uniform(1000, 6000)!r} rpm",
            "over_time": {
                "time": [f"{phase * period!r} s" for phase in phases.tolist()],
                "load": [f"{load!r} N" for load in loads.tolist()],
                "angle": [f"{angle!r} rad" for angle in angles.tolist()],
                "period": f"{period!r} s",
            },
        },
        "boundary": {"inlet": {"pressure": "0.1 MPa"}},
    }
    bearing = read_scene(entries)
    assert isinstance(bearing, Bearing)
    return bearing, period, part


def compared(seed: int) -> Compared:
    """Return the changes of the least film of the journal of a seed."""
    bearing, period, part = drawn(seed)
    duty, started = Duty(scene=bearing), time.process_time()
    found = quasi_static(duty)
    linear_s, started = time.process_time() - started, time.process_time()
    coarse = true = None
    reason, coarse_s = "", 0.0
    try:
        coarse = marched_change(duty)
        coarse_s = time.process_time() - started
        true = marched_change(duty, cells=CELLS, error=FINE_ERROR)
    except (InputError, ConvergenceError) as error:
        reason = str(error)
    return Compared(
        seed=seed,
        period=period,
        part=part,
        squeeze_number=found.squeeze_number,
        linear=found.change,
        coarse=coarse,
        true=true,
        linear_s=linear_s,
        coarse_s=coarse_s,
        reason=reason,
    )


def table(rows: list[Compared]) -> Table:
    """Return the changes of the journals for the terminal."""
    shown = Table()
    for name in ("seed", "period", "load", "squeeze number", "first order", "coarse march", "march", "CPU times"):
        shown.add_column(name, justify="right")
    for row in rows:
        coarse, true = (row.reason[:40] if one is None else f"{100 * one:.2f} %" for one in (row.coarse, row.true))
        shown.add_row(
            str(row.seed),
            f"{1e3 * row.period:.3g} ms",
            f"± {100 * row.part:.0f} %",
            f"{row.squeeze_number:.2g}",
            f"{100 * row.linear:.2f} %",
            coarse,
            true,
            f"{row.linear_s:.1f}, {row.coarse_s:.1f} s",
        )
    return shown


@in_one_line
def command(
    out: Out,
    journals: Annotated[int, typer.Option(min=1, help="Number of random journals.")] = 14,
    first: Annotated[int, typer.Option(min=0, help="First seed.")] = 0,
    as_json: AsJson = False,
) -> None:
    """Compare the stated changes of the least film by squeeze with marches."""
    make_directory(out)
    rows = []
    with counted(journals) as advance:
        for seed in range(first, first + journals):
            advance(f"journal {seed}")
            rows.append(compared(seed))
    numbers = plain({"journals": rows, "provenance": circumstances()})
    with replacing(out / "quasi_static.json", JSON) as scratch:
        scratch.write_text(json.dumps(numbers, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    if as_json:
        print_json(numbers)
        return
    output.print(table(rows))


if __name__ == "__main__":
    run_alone(command)
