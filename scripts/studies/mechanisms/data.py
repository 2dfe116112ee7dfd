"""Load of a parallel film over a textured wall by inertia and by cavitation, each from a model that has it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import with_unit
from roughfilm.ladder import find
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene

FILM, LENGTH, WIDTH, DEPTH = 30e-6, 1e-3, 0.3e-3, 22.5e-6
"""Lengths of a period, m. The groove has w+ = 0.3 and d+ = 0.75, as in Paper A; the waves have its depth."""

GAPS = {"waves": "waves, cos²", "groove": "a groove between flat lands"}
"""Without inertia and cavitation neither carries load."""

VISCOSITY, DENSITY = 0.01, 1000.0
TENSIONS = (0.0, 20e3, 100e3)
"""Ambient pressure less the pressure of cavitation, Pa: a liquid full of air, one with some, one with none."""

DRAWN_TENSION = 20e3
"""Tension of the pressures that are drawn, Pa."""

LEAST_LOAD_PER_SPEED = 1e-6
"""Mean pressure divided by speed, Pa s/m, below which a load counts as zero."""

SPEEDS = tuple(np.geomspace(0.3, 60, 24).tolist())
DRAWN_SPEEDS = (5.0, 20.0, 53.333)
"""Speeds of the pressures that are drawn, m/s."""

REYNOLDS_NUMBERS = tuple(np.geomspace(0.1, 400, 14).tolist())
"""Reynolds numbers ρ u h/η; the load by inertia depends on nothing else."""

CAVITATION_NUMBERS = tuple(np.geomspace(1e-4, 0.2, 24).tolist())
"""Δp h²/(η u L); the load by cavitation depends on nothing else."""


@dataclass(frozen=True, kw_only=True)
class LoadLaws:
    """Mean pressure in units of η u L/h²: by inertia over Re, by cavitation over Δp h²/(η u L)."""

    reynolds_numbers: Array
    by_inertia: Array
    tensions: Array
    by_cavitation: Array

    def inertia(self, speed: Array, film: Array, density: float = DENSITY) -> Array:
        """Return the mean pressure by inertia, Pa, of a film of any thickness with the same proportions."""
        number = density * speed * film / VISCOSITY
        rise = np.interp(number, self.reynolds_numbers, self.by_inertia / self.reynolds_numbers)
        return np.asarray(rise * number * _unit(speed, film))

    def cavitation(self, speed: Array, film: Array, tension: float) -> Array:
        """Return the mean pressure by cavitation, Pa, where the film ruptures at ``tension``, Pa, below ambient."""
        unit = _unit(speed, film)
        number = np.maximum(tension / unit, self.tensions[0])
        load = np.interp(np.log(number), np.log(self.tensions), self.by_cavitation, right=0.0)
        return np.asarray(load * unit)


def _unit(speed: Array, film: Array) -> Array:
    """Return η u L/h² for constant L/h."""
    return np.asarray(VISCOSITY * speed * (LENGTH / FILM) / film)


def pocket(gap: str, speed: float) -> Any:
    """Return one period of a gap as a pocket."""
    places = np.linspace(-0.4995 * LENGTH, 0.4995 * LENGTH, 201)
    depths = DEPTH * np.cos(np.pi / 2 * places / places[-1]) ** 2
    depths[[0, -1]] = 0.0
    points = np.column_stack([places, depths]).tolist()
    waves = {"profile": "points", "interpolation": "monotone", "points": points}
    groove = {"profile": "cylindrical", "width": with_unit(WIDTH, "m"), "depth": with_unit(DEPTH, "m")}
    return read_scene(
        {
            "name": f"{GAPS[gap]}, by inertia",
            "kind": "pocket",
            "geometry": {
                "length": with_unit(LENGTH, "m"),
                "film": with_unit(FILM, "m"),
                **(waves if gap == "waves" else groove),
            },
            "lubricant": {"viscosity": with_unit(VISCOSITY, "Pa*s"), "density": with_unit(DENSITY, "kg/m^3")},
            "motion": {"speed": with_unit(speed, "m/s")},
        }
    )


def slider(gap: str, speed: float, tension: float) -> Any:
    """Return one period of a gap as a bearing at ambient pressure; waves begin where the gap is widest."""
    length, film, depth = (with_unit(value, "m") for value in (LENGTH, FILM, DEPTH))
    waves = {"shape": "squared_cosine_inlet", "amplitude": depth, "wavelength": length, "extent": length}
    texture = {"length": with_unit(WIDTH, "m"), "depth": depth, "start": with_unit((LENGTH - WIDTH) / 2, "m")}
    groove = {"shape": "parallel", "texture": {"profile": "cylindrical", **texture}}
    return read_scene(
        {
            "name": f"{GAPS[gap]}, by cavitation",
            "kind": "bearing",
            "geometry": {"length": length, "film": film, **(waves if gap == "waves" else groove)},
            "lubricant": {
                "viscosity": with_unit(VISCOSITY, "Pa*s"),
                "cavitation_pressure": with_unit(-tension, "Pa"),
            },
            "motion": {"speed": with_unit(speed, "m/s")},
        }
    )


def solve(scene: Any, model: str) -> Result:
    """Solve a scene by a model of its kind."""
    return find(scene.kind, model).solve(scene)


def by_inertia(gap: str, speed: float) -> float:
    """Return the mean pressure by inertia above that of the ends of the bearing, Pa."""
    pressure = periodic_pressure(gap, solve(pocket(gap, speed), "film"))[1]
    return float(pressure.mean())


def periodic_pressure(gap: str, found: Result) -> tuple[Array, Array]:
    """Return positions from the inlet of the bearing, m, and the pressure by inertia above that of the inlet, Pa.

    Waves begin where the gap is widest, in the middle of the pocket; the groove begins on its land.
    """
    x, pressure = (found.fields[name].values for name in ("position", "pressure"))
    place = np.linspace(0, LENGTH, 4000, endpoint=False)
    shifted = place if gap == "waves" else place - LENGTH / 2
    there = np.interp(shifted, x, pressure, period=LENGTH)
    return place, there - there[0]


def by_cavitation(gap: str, speed: float, tension: float) -> float:
    """Return the mean pressure by cavitation above ambient, Pa."""
    return solve(slider(gap, speed, tension), "reynolds_cavitating").quantities["load_per_width"].value / LENGTH


def laws(gap: str, advance: Callable[[str], None]) -> LoadLaws:
    """Return both loads of a gap, dimensionless, each as a function of its one number."""
    inertia, cavitation = [], []
    for number in REYNOLDS_NUMBERS:
        speed = number * VISCOSITY / (DENSITY * FILM)
        advance(f"{gap}, inertia, Re = {number:.3g}")
        inertia.append(by_inertia(gap, speed) / (VISCOSITY * speed * LENGTH / FILM**2))
    for number in CAVITATION_NUMBERS:
        advance(f"{gap}, cavitation, {number:.3g}")
        unit = VISCOSITY * LENGTH / FILM**2
        cavitation.append(by_cavitation(gap, 1.0, number * unit) / unit)
    return LoadLaws(
        reynolds_numbers=np.array(REYNOLDS_NUMBERS),
        by_inertia=np.array(inertia),
        tensions=np.array(CAVITATION_NUMBERS),
        by_cavitation=np.array(cavitation),
    )


def loads_of(gap: str, advance: Callable[[str], None]) -> dict[str, list[float]]:
    """Return mean pressures at the speeds, Pa, by inertia and at each tension; round-off is set to zero."""
    found: dict[str, list[float]] = {"inertia": [], **{f"{tension:g}": [] for tension in TENSIONS}}
    for speed in SPEEDS:
        advance(f"{gap}, {speed:.3g} m/s")
        found["inertia"].append(by_inertia(gap, speed))
        for tension in TENSIONS:
            load = by_cavitation(gap, speed, tension)
            found[f"{tension:g}"].append(load if abs(load) > LEAST_LOAD_PER_SPEED * speed else 0.0)
    return found
