"""Lund and Thomsen's journal bearing with two axial grooves: its static points."""

import math

import numpy as np

from roughfilm.ladder import find
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.validation.published import Answer, Row, Source
from roughfilm.validation.reading import half_digit, published

ECCENTRICITY_BAR, ATTITUDE_BAR = 0.01, 0.5
"""Accuracy of the eccentricity and of the attitude angle, degrees."""

RADIUS, CLEARANCE, VISCOSITY = 0.05, 50e-6, 0.2
"""Radius and clearance, m, and viscosity, Pa s."""

SPEED = 100.0
"""Speed, m/s, at which the film's pressure far exceeds the 1 bar between ambient and cavitation pressure."""

GROOVE = math.radians(20)
"""Extent of a groove, rad: the pads between have 160 degrees."""

DEPTH, DEEPER = 50.0, 100.0
"""Depth of the grooves over the clearance, in which the pressure is then nearly ambient; the second is a check."""

TURNS = 3
"""Number of films after which the grooves stand at right angles to the load."""

CELLS, FINER = 180, 360


def answer(thorough: bool, progress: Progress) -> Answer:
    """Sommerfeld number and attitude angle at each eccentricity."""
    table = published("lund_thomsen")
    eccentricities = np.array([float(one["eccentricity_ratio [1]"]) for one in table])
    numbers = np.array([float(one["S [1]"]) for one in table])
    slopes = np.abs(np.gradient(np.log(numbers), eccentricities)) * numbers
    rows: list[Row] = []
    for index, printed in enumerate(table):
        progress(index / len(table), f"journal with grooves, eccentricity {eccentricities[index]:g}")
        ours, deeper = (
            _film(float(eccentricities[index]), float(printed["attitude [deg]"]), depth, FINER if thorough else CELLS)
            for depth in (DEPTH, DEEPER)
        )
        for name, words, unit, column, bar in (
            ("sommerfeld_number", "Sommerfeld number S", "1", "S [1]", ECCENTRICITY_BAR * float(slopes[index])),
            ("attitude_angle", "attitude angle", "deg", "attitude [deg]", ATTITUDE_BAR),
        ):
            rows.append(
                Row(
                    case=f"ε = {eccentricities[index]:g}",
                    series="two axial grooves",
                    at=float(eccentricities[index]),
                    quantity=words,
                    unit=unit,
                    published=float(printed[column]),
                    ours=ours[name].value,
                    uncertainty=math.hypot(ours[name].uncertainty or 0.0, ours[name].value - deeper[name].value),
                    bar=bar + half_digit(printed[column]),
                )
            )
    return Answer(rows=tuple(rows), remarks=_REMARKS)


def _film(eccentricity: float, attitude: float, depth: float, cells: int) -> Result:
    """The film whose grooves are at right angles to its load, from a first value of the attitude angle, degrees."""
    for _ in range(TURNS):
        result = _grooved(eccentricity, attitude, depth, cells)
        attitude = result["attitude_angle"].value
    return result


def _grooved(eccentricity: float, attitude: float, depth: float, cells: int) -> Result:
    """The film with grooves at right angles to a load at this angle from the line of centres.

    From the widest gap the load is at π less the attitude angle, and the first groove a quarter of a turn before it.
    """
    middle = math.pi / 2 - math.radians(attitude)
    scene = read_scene(
        {
            "name": "journal with two axial grooves",
            "kind": "bearing",
            "geometry": {
                "shape": "journal",
                "radius": f"{RADIUS!r} m",
                "clearance": f"{CLEARANCE!r} m",
                "eccentricity": eccentricity,
                "width": f"{2 * RADIUS!r} m",
                "texture": {
                    "profile": "box",
                    "start": f"{RADIUS * (middle - GROOVE / 2)!r} m",
                    "length": f"{RADIUS * GROOVE!r} m",
                    "depth": f"{depth * CLEARANCE!r} m",
                    "columns": 2,
                    "pitch": f"{RADIUS * math.pi!r} m",
                },
            },
            "lubricant": {"viscosity": f"{VISCOSITY!r} Pa*s", "cavitation_pressure": "-1 bar"},
            "motion": {"speed": f"{SPEED!r} m/s"},
        }
    )
    return find("bearing", "reynolds_incompressible").solve(scene, Request(resolution=cells))


def _method(cells: int) -> str:
    return (
        f"reynolds_incompressible on {cells} × {cells} cells, grooves turned until they are at right angles to the load"
    )


_REMARKS = (
    f"A groove is a pocket over the whole width, {DEPTH:g} clearances deep, whose pressure the open sides hold near "
    "ambient; twice the depth enters the uncertainty. Stiffness and damping are not computed yet.",
)

SOURCE = Source(
    name="lund_thomsen",
    title="Lund and Thomsen 1978: journal with two grooves",
    citation="J. W. Lund, K. K. Thomsen, in Topics in Fluid Film Bearing and Rotor Bearing System Design and "
    "Optimization, ASME 1978, 1-28",
    obtained="Read in the literature tests of ROSS (Apache-2.0), not in the paper.",
    methods=(_method(CELLS), _method(FINER)),
    bar="that of the literature tests of ROSS: 0.01 in eccentricity, converted to S by the slope of the table, and 0.5 "
    "degrees",
    abscissa="eccentricity ε",
    cost=(3.0, 8.0),
    answer=answer,
)
