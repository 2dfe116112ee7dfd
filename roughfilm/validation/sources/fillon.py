"""Fillon's bearing with four tilting pads: the highest temperature of its pads, measured and by the paper's theory."""

from collections.abc import Mapping
from typing import Any

from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.validation.published import Answer, Row, Source, Study
from roughfilm.validation.reading import published

BARS = {"measured": 8.0, "theory": 4.0}
"""Bar of each column of the table, K."""

WORDS = {"measured": "highest pad temperature, measured", "theory": "highest pad temperature, theory of the paper"}

PADS = {
    "kind": "conducting",
    "thickness": "20 mm",
    "conductivity": "50 W/(m*K)",
    "heat_transfer": "73.59 W/(m^2*K)",
}
"""Steel pads whose back gives heat to oil at the temperature of the supply."""

HEAT: Mapping[str, Any] = {"sliding_wall": "turning", "fixed_wall": PADS}
"""The walls of the comparison: a shaft that takes no heat in sum."""

VARIED: tuple[tuple[str, str, Mapping[str, Any]], ...] = (
    ("across, pads that take no heat", "across", {"sliding_wall": "turning"}),
    ("across, shaft at 49 °C", "across", {**HEAT, "sliding_wall": {"kind": "turning", "temperature": "49 degC"}}),
    (
        "across, backs of the pads at 40 °C",
        "across",
        {**HEAT, "fixed_wall": {key: PADS[key] for key in ("kind", "thickness", "conductivity")}},
    ),
    ("across, shaft and pads that take no heat", "across", {}),
    ("adiabatic", "adiabatic", {}),
    ("adiabatic, 80 % of the hot oil carried over", "adiabatic", {"carried_over": 0.8}),
)
"""Other walls and models: words, model and table [heat]."""

CELLS, FINER, COARSE = 96, 288, 96
"""Cells along of the comparison, of it with the finest grids, and of the other walls and models."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """The highest temperature of the pads at each speed."""
    table = published("fillon")
    rows: list[Row] = []
    ours: list[str] = []
    for number, line in enumerate(table):
        speed = float(line["speed [rpm]"])
        progress(number / (2 * len(table)), f"{speed:g} rpm")
        hottest = hottest_pad(solved(speed, "across", HEAT, FINER if thorough else CELLS))
        ours.append(f"{hottest.value:.1f} ± {hottest.uncertainty:.1f}")
        rows += [
            Row(
                case=f"{speed:g} rpm",
                series=column,
                at=speed,
                quantity=WORDS[column],
                unit="degC",
                published=float(line[f"{column} [degC]"]),
                ours=hottest.value,
                uncertainty=hottest.uncertainty,
                bar=bar,
            )
            for column, bar in BARS.items()
        ]
    studies = (_other_walls(table, ours, progress),) if thorough else ()
    return Answer(rows=tuple(rows), remarks=_REMARKS, studies=studies)


def solved(speed: float, model: str, heat: Mapping[str, Any], cells: int) -> Result:
    """The bearing at 10 kN between two pads, at a speed, rpm, by a model with the table [heat]."""
    scene = read_scene(
        {
            "name": "four tilting pads",
            "kind": "bearing",
            "geometry": {
                "shape": "lobes",
                "radius": "50 mm",
                "clearance": "148 um",
                "width": "70 mm",
                "lobes": 4,
                "arc": "75 deg",
                "first": "-45 deg",
                "preload": 0.47,
                "pivot": 0.5,
            },
            "lubricant": {
                "viscosity": "27.7 mPa*s",
                "temperature": "40 degC",
                "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.0341 1/K"},
                "density": "860 kg/m^3",
                "heat_capacity": "1951.8 J/(kg*K)",
                "conductivity": "0.149 W/(m*K)",
            },
            "motion": {"speed": f"{speed!r} rpm"},
            "load": {"force": "10 kN"},
            "heat": dict(heat),
        }
    )
    return find("bearing", model).solve(scene, Request(resolution=cells))


def hottest_pad(result: Result) -> Quantity:
    """The highest temperature of the pads, with the uncertainty of the highest one in the film, °C."""
    in_film = result["temperature_max"]
    if "fixed_wall_temperature" not in result.fields:
        return in_film
    pads = float(result.fields["fixed_wall_temperature"].values.max())
    return Quantity(value=pads, unit=in_film.unit, uncertainty=in_film.uncertainty)


def _other_walls(table: list[dict[str, str]], ours: list[str], progress: Progress) -> Study:
    """The highest temperature of the pads with other walls, by other models, and by the heat balance of the film."""
    speeds = [float(line["speed [rpm]"]) for line in table]
    cells = [("compared", *ours)]
    for number, (words, model, heat) in enumerate(VARIED):
        progress(0.5 + number / (2 * len(VARIED) + 2), words)
        hottest = [hottest_pad(solved(speed, model, heat, COARSE)) for speed in speeds]
        cells.append((words, *(f"{one.value:.1f} ± {one.uncertainty:.1f}" for one in hottest)))
    leaving = [solved(speed, "heat_balance", {}, COARSE)["outlet_temperature"].value for speed in speeds]
    cells.append(("heat_balance, oil that leaves", *(f"{one:.1f}" for one in leaving)))
    return Study(
        title="Highest temperature of the pads, °C, with other walls and models",
        columns=("model and walls", *(f"{speed:g} rpm" for speed in speeds)),
        cells=tuple(cells),
    )


_REMARKS = (
    "Compared is the surface of the pads, at 10 kN. The pads are rigid; the grooves are full of oil. The shaft carries "
    "the profile of temperature across the film through them, with as much new oil as the next pad takes besides. It "
    "takes no heat in sum, and its temperature follows. The thickness and conductivity of the pads, the heat transfer "
    "at their backs, and density, heat capacity and conductivity of the oil are those of the ROSS test, not all of "
    "them of the paper. Nothing was fitted.",
)


def _method(cells: int) -> str:
    return f"across on {cells} cells along"


SOURCE = Source(
    name="fillon",
    title="Fillon 1992: highest temperature of tilting pads",
    citation="M. Fillon, J.-C. Bligoud, J. Frêne, ASME J. Tribology 114 (1992) 579-588",
    obtained="Digitised to 1 K by the literature tests of ROSS (Apache-2.0) from Fig. 20 of Kim, Palazzolo, Gadangi, "
    "Tribology Trans. 37 (1994); neither paper was read.",
    methods=(_method(CELLS), _method(FINER)),
    bar="8 K of the measurement and 4 K of the paper's theory, which stays 3.6 to 6.1 K below the measurement",
    abscissa="speed, rpm",
    cost=(7.0, 70.0),
    answer=answer,
)
