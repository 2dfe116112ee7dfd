"""The pad with one pocket that cavitates at its upstream edge, in closed form."""

from collections.abc import Mapping

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.quantities import boundary_flows
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.pads import film_of, pocketed_pad
from roughfilm.validation.published import Answer, Row, Source, against_closed_form
from roughfilm.validation.reading import published

BAR = 1e-4
"""Relative accuracy that is asked of the solver; the closed form is exact."""

CELLS, FINER = 4000, 16000

COLUMNS = {
    "flow_per_width [m2/s]": ("flow per width", 1e-6, "mm²/s"),
    "film_reforms_at [mm]": ("position where the film reforms", 1.0, "mm"),
    "pressure_at_pocket_end [Pa]": ("pressure at the end of the pocket", 1e6, "MPa"),
    "load_above_ambient_per_width [N/m]": ("load above ambient per width", 1e3, "kN/m"),
    "pressure_at_quarter_of_inlet_land [Pa]": ("pressure at a quarter of the inlet land", 1e6, "MPa"),
    "pressure_midway_reformed_pocket [Pa]": ("pressure midway in the reformed pocket", 1e6, "MPa"),
    "pressure_mid_outlet_land [Pa]": ("pressure midway on the outlet land", 1e6, "MPa"),
}
"""Names in words, the unit of the page in that of the table, and its name, by column."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """Every number of the three cases."""
    rows: list[Row] = []
    table = published("fowell")
    for number, printed in enumerate(table):
        progress(number / len(table), f"pad with a pocket, case {printed['case']}")
        ours, coarser = (_numbers(printed, cells) for cells in (FINER if thorough else CELLS, 1000))
        compared = [
            (
                words,
                unit,
                float(printed[column]) / size,
                ours[column] / size,
                abs(ours[column] - coarser[column]) / size,
            )
            for column, (words, size, unit) in COLUMNS.items()
        ]
        rows += against_closed_form(f"case {printed['case']}", float(printed["case"]), compared, BAR)
    return Answer(rows=tuple(rows))


def _numbers(printed: Mapping[str, str], cells: int) -> dict[str, float]:
    """Our numbers by column, in its unit; pressures are absolute."""
    number = {name.partition(" [")[0]: float(text) for name, text in printed.items()}
    ambient = number["ambient"]
    film = film_of(
        pocketed_pad(
            length=number["length"] * 1e-3,
            inlet=number["film_inlet"] * 1e-6,
            outlet=number["film_outlet"] * 1e-6,
            start=number["pocket_start"] * 1e-3,
            pocket=number["pocket_length"] * 1e-3,
            depth=number["pocket_depth"] * 1e-6,
            speed=number["speed"],
            lubricant={
                "viscosity": f"{number['viscosity']!r} Pa*s",
                "cavitation_pressure": f"{number['cavitation'] - ambient!r} Pa",
            },
        ),
        (cells, 1),
    )
    x, pressure = film.grid.x * 1e3, film.state.pressure[:, 0] + number["cavitation"]
    start, end = number["pocket_start"], number["pocket_start"] + number["pocket_length"]
    reforms = _reforms(x, pressure - number["cavitation"], start, end)

    def at(place: float) -> float:
        return float(np.interp(place, x, pressure))

    return {
        "flow_per_width [m2/s]": _inflow(film),
        "film_reforms_at [mm]": reforms,
        "pressure_at_pocket_end [Pa]": at(end),
        "load_above_ambient_per_width [N/m]": float((film.grid.volume_x * (pressure - ambient)).sum()),
        "pressure_at_quarter_of_inlet_land [Pa]": at(start / 4),
        "pressure_midway_reformed_pocket [Pa]": at((number["film_reforms_at"] + end) / 2),
        "pressure_mid_outlet_land [Pa]": at((end + number["length"]) / 2),
    }


def _inflow(film: Solution) -> float:
    flow = boundary_flows(film).inlet
    assert flow is not None
    return flow


def _reforms(x: Array, pressure: Array, start: float, end: float) -> float:
    """Where the film reforms in the pocket: its pressure, nearly linear there, extrapolated to that of the cavity."""
    inside = (x >= start) & (x <= end)
    last = int(np.flatnonzero(inside & (pressure <= 0))[-1])
    first, final = last + 2, int(np.flatnonzero(inside)[-1])
    slope = (pressure[final] - pressure[first]) / (x[final] - x[first])
    return float(x[first] - pressure[first] / slope)


def _method(cells: int) -> str:
    return f"reynolds_incompressible without side flow on {cells} cells"


SOURCE = Source(
    name="fowell",
    title="Fowell 2007: pad with a pocket, closed form",
    citation="M. Fowell, A. V. Olver, A. D. Gosman, H. A. Spikes, I. Pegg, J. Tribology 129 (2007) 336-347",
    obtained="The formula, as the tests of mboct-mbdyn-pkg state it, evaluated for three cases and confirmed by "
    "quadrature of the Reynolds equation to 1e-13.",
    methods=(_method(CELLS), _method(FINER)),
    bar="0.01 %, asked of the solver; the closed form is exact",
    abscissa="case",
    cost=(1.0, 2.0),
    answer=answer,
)
