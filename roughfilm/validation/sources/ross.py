"""ROSS, another program: a partial arc between walls that take no heat, whose lubricant heats."""

import math
from collections.abc import Mapping

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.validation.hot_pad import HotPad, force, hot_film
from roughfilm.validation.published import Answer, Row, Source
from roughfilm.validation.reading import published

RADIUS, WIDTH, CLEARANCE = 0.05, 0.08, 60e-6
"""Radius, width and clearance, m."""

FROM, ARC = math.radians(210), math.radians(120)
"""Angle at which the arc begins, and its own angle."""

PLACE = (0.4330127, -0.25)
"""Eccentricity of the shaft towards the end of the arc, where the film is thinnest."""

REVOLUTIONS, VISCOSITY, DENSITY, CAPACITY, SUPPLIED = 50.0, 0.03, 860.0, 2000.0, 40.0
"""Rotational frequency, 1/s, viscosity, Pa s, density, kg/m³, and heat capacity, J/(kg K), at the supply, °C."""

SPEED = 2 * math.pi * REVOLUTIONS * RADIUS

QUANTITIES: Mapping[str, tuple[str, str, str]] = {
    "load [N]": ("load", "load", "N"),
    "power loss [W]": ("power_loss", "power loss", "W"),
    "temperature_max [degC]": ("temperature_max", "highest temperature", "degC"),
}
"""Quantity, its words and its unit, of each column of the table."""

RELATIVE_BAR = 0.005
"""Accuracy that is asked of load and power, and of the rise of the temperature, beside the change between meshes."""

CELLS, FINER = 96, 192
"""Cells along."""

POINTS = 16
"""Points along and across of the second method."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """Load, power and highest temperature for each fall of the viscosity over temperature."""
    lines = published("ross")
    rows: list[Row] = []
    for number, (coarse, fine) in enumerate(zip(lines[::2], lines[1::2], strict=True)):
        thinning = float(fine["thinning [1/K]"])
        progress(number / (len(lines) / 2), f"{thinning:g} 1/K")
        ours, second = _solved(thinning, FINER if thorough else CELLS), _second(thinning)
        for column, (name, words, unit) in QUANTITIES.items():
            values = [float(line[column]) for line in (coarse, fine)]
            if math.isnan(values[-1]):
                continue
            change = values[1] - values[0]
            limit = values[1] + change / 3
            size = abs(limit - (SUPPLIED if unit == "degC" else 0.0))
            rows.append(
                Row(
                    case=f"viscosity falls by {100 * thinning:g} % a kelvin",
                    series=words,
                    at=thinning,
                    quantity=words,
                    unit=unit,
                    published=limit,
                    ours=ours[name].value,
                    uncertainty=ours[name].uncertainty,
                    bar=RELATIVE_BAR * size + abs(change),
                    evidence=f"spectral collocation without common code gives {second[column]:.6g}",
                )
            )
    return Answer(rows=tuple(rows), remarks=_REMARKS)


def _solved(thinning: float, cells: int) -> Result:
    scene = read_scene(
        {
            "name": "arc whose oil heats",
            "kind": "bearing",
            "geometry": {
                "shape": "lobes",
                "lobes": 1,
                "arc": f"{ARC!r} rad",
                "radius": f"{RADIUS!r} m",
                "width": f"{WIDTH!r} m",
                "clearance": f"{CLEARANCE!r} m",
                "eccentricity": list(PLACE),
            },
            "lubricant": {
                "viscosity": f"{VISCOSITY!r} Pa*s",
                "temperature": f"{SUPPLIED!r} degC",
                "density": f"{DENSITY!r} kg/m^3",
                "heat_capacity": f"{CAPACITY!r} J/(kg*K)",
                "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{thinning!r} 1/K"},
            },
            "motion": {"speed": f"{SPEED!r} m/s"},
            "heat": {"carried_over": 0},
        }
    )
    return find("bearing", "adiabatic").solve(scene, Request(resolution=cells))


def _second(thinning: float) -> dict[str, float]:
    """The columns of the table by the second method."""

    def angle(x: Array) -> Array:
        return np.asarray(FROM + x / RADIUS)

    pad = HotPad(
        length=RADIUS * ARC,
        width=WIDTH,
        film=lambda x: CLEARANCE * (1 - PLACE[0] * np.cos(angle(x)) - PLACE[1] * np.sin(angle(x))),
        speed=SPEED,
        viscosity=VISCOSITY,
        thinning=thinning,
        capacity=DENSITY * CAPACITY,
    )
    film = hot_film(pad, POINTS)
    sides = [force(film, pad, lambda x, part=part: part(angle(x))) for part in (np.cos, np.sin)]  # type: ignore[misc]
    return dict(zip(QUANTITIES, (math.hypot(*sides), film.friction * SPEED, SUPPLIED + film.rise), strict=True))


_REMARKS = (
    "An arc of 120° about the lowest place, in which the shaft lies towards the end, so that the film is full: radius "
    "50 mm, width 80 mm, clearance 60 µm, eccentricity 0.5 towards the end of the arc, 3000 rpm, 30 mPa s, 860 kg/m³ "
    "and 2000 J/(kg K) at 40 °C, new oil at the inlet. Both programs take the mean temperature across the film. Loads "
    "of ROSS are about 1 % higher, without heating too; power and temperature agree.",
)


def _method(cells: int) -> str:
    return f"adiabatic on {cells} cells along"


SOURCE = Source(
    name="ross",
    title="ROSS: an arc whose oil heats, by another program",
    citation="R. Timbó et al., ROSS: Rotordynamic Open Source Software, J. Open Source Softw. 5 (2020) 2120, "
    "doi:10.21105/joss.02120; commit 631a249a of August 2026",
    obtained="Computed with its PartialArcBearing (finite elements, thermal_type adiabatic) on 32 × 20 and 64 × 32 "
    "elements, and extrapolated with the second order.",
    methods=(_method(CELLS), _method(FINER)),
    bar="0.5 % of load and power and of the rise of the temperature, and the change between the meshes of ROSS",
    abscissa="fall of the viscosity, 1/K",
    cost=(5.0, 10.0),
    answer=answer,
)
