"""Lund and Thomsen's journal bearings with two axial grooves: static points, stiffness and damping."""

from collections.abc import Mapping
from itertools import groupby
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.dynamics.point import DynamicPoint
from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.validation.published import Answer, Row, Source
from roughfilm.validation.reading import half_digit, published

RELATIVE_BAR, ATTITUDE_BAR = 0.02, 0.5
"""Accuracy of the eccentricity and the coefficients, and that of the attitude angle, degrees."""

NUMBER_DIGIT = 0.0005
"""Half a unit of the third decimal of the Sommerfeld number, up to which it is known."""

PRELOADS = {"two axial grooves": 0.0, "elliptical": 0.5}
"""Preload of each bore of the table."""

RADIUS, CLEARANCE, VISCOSITY, REVOLUTIONS = 0.05, 50e-6, 0.02, 50.0
"""Radius and clearance, m, viscosity, Pa s, and rotational frequency, 1/s; only S depends on them."""

COEFFICIENTS = {
    **{f"K{row}{column}": ("stiffness", row, column) for row in "xy" for column in "xy"},
    **{f"B{row}{column}": ("damping", row, column) for row in "xy" for column in "xy"},
}
"""Matrix and axes of each coefficient of the table."""

AXES: Mapping[str, tuple[str, float]] = {"x": ("y", -1.0), "y": ("x", 1.0)}
"""Our axis, and its sign, of each axis of the table: there x points down, along the load, and y along our x."""

CELLS, FINER = 192, 256


def answer(thorough: bool, progress: Progress) -> Answer:
    """Place of the shaft, stiffness and damping at each Sommerfeld number."""
    rows: list[Row] = []
    table = published("lund_thomsen")
    for bore, lines in ((bore, list(lines)) for bore, lines in groupby(table, key=lambda line: line["bore"])):
        numbers = np.array([float(line["S [1]"]) for line in lines])
        for index, line in enumerate(lines):
            progress(len(rows) / (10 * len(table)), f"{bore}, S = {numbers[index]:g}")
            point = _point(float(numbers[index]), PRELOADS[bore], FINER if thorough else CELLS)
            values = _values(point)
            for column, (value, uncertainty) in values.items():
                printed = line[_heading(column)]
                of_number = NUMBER_DIGIT * abs(_slope(numbers, lines, column)[index])
                bar = ATTITUDE_BAR if column == "attitude" else RELATIVE_BAR * abs(float(printed))
                rows.append(
                    Row(
                        case=f"{bore}, S = {numbers[index]:g}",
                        series=bore,
                        at=float(numbers[index]),
                        quantity=WORDS.get(column, column),
                        unit="deg" if column == "attitude" else "1",
                        published=float(printed),
                        ours=value,
                        uncertainty=uncertainty,
                        bar=bar + half_digit(printed) + of_number,
                    )
                )
    return Answer(rows=tuple(rows), remarks=_REMARKS)


WORDS = {"eccentricity_ratio": "eccentricity ε", "attitude": "attitude angle"}


def _heading(column: str) -> str:
    """The heading of a column in the table, which has one for both damping coefficients across."""
    if column == "attitude":
        return "attitude [deg]"
    return "Bxy=Byx [1]" if column in ("Bxy", "Byx") else f"{column} [1]"


def _slope(numbers: Array, lines: list[dict[str, str]], column: str) -> Array:
    """The slope of a column over the Sommerfeld number, from the table alone."""
    return np.asarray(np.gradient([float(line[_heading(column)]) for line in lines], numbers))


def mean_pressure(number: float) -> float:
    """The load over the nominal area at a Sommerfeld number, Pa."""
    return VISCOSITY * REVOLUTIONS * (RADIUS / CLEARANCE) ** 2 / number


def entries(number: float, preload: float) -> dict[str, Any]:
    """The scene of a bearing as long as its diameter, at a Sommerfeld number ηN/p (R/c)²."""
    return {
        "name": "journal with two axial grooves",
        "kind": "bearing",
        "geometry": {
            "shape": "lobes",
            "radius": f"{RADIUS!r} m",
            "clearance": f"{CLEARANCE!r} m",
            "width": f"{2 * RADIUS!r} m",
            "lobes": 2,
            "arc": "160 deg",
            "preload": preload,
        },
        "lubricant": {"viscosity": f"{VISCOSITY!r} Pa*s"},
        "motion": {"speed": f"{2 * np.pi * REVOLUTIONS * RADIUS!r} m/s"},
        "load": {"pressure": f"{mean_pressure(number)!r} Pa"},
    }


def _point(number: float, preload: float, cells: int) -> DynamicPoint:
    """The point at a Sommerfeld number."""
    scene = read_scene(entries(number, preload))
    assert isinstance(scene, Bearing)
    (curve,) = dynamics(scene, [scene.motion.speed], [mean_pressure(number)], resolution=cells)
    return curve.points[0]


def _values(point: DynamicPoint) -> dict[str, tuple[float, float]]:
    """Our values and uncertainties, by the columns of the table: K c/W and B c ω/W in its axes."""
    numbers, errors = point.numbers, point.uncertainty
    values = {
        "eccentricity_ratio": (numbers["eccentricity"], errors["eccentricity"]),
        "attitude": (numbers["attitude_angle"], errors["attitude_angle"]),
    }
    for column, (matrix, row, across) in COEFFICIENTS.items():
        (along, sign), (other, turned) = AXES[row], AXES[across]
        scale = CLEARANCE / point.load * (point.rotation if matrix == "damping" else 1.0)
        name = f"{matrix}_{along}{other}"
        values[column] = (sign * turned * scale * numbers[name], scale * errors[name])
    return values


def _method(cells: int) -> str:
    return f"dynamics on {cells} × {cells // 2} cells"


_REMARKS = (
    "The load is given, and the place of the shaft is compared. The grooves are at ambient pressure, which is the "
    "cavitation pressure. Lund and Thomsen's films rupture with p = ∂p/∂n = 0, and ours conserve mass besides: where "
    "a film begins again, it differs. The table has one column for Bxy and Byx, which ours are compared with apart.",
)

SOURCE = Source(
    name="lund_thomsen",
    title="Lund and Thomsen 1978: stiffness and damping of journal bearings with two grooves",
    citation="J. W. Lund, K. K. Thomsen, in Topics in Fluid Film Bearing and Rotor Bearing System Design and "
    "Optimization, ASME 1978, 1-28",
    obtained="Read in the literature tests of ROSS (Apache-2.0), not in the paper.",
    methods=(_method(CELLS), _method(FINER)),
    bar="2 % of eccentricity and coefficients and 0.5 degrees, with half a digit of the value and of S",
    abscissa="Sommerfeld number S",
    cost=(3.0, 8.0),
    answer=answer,
)
