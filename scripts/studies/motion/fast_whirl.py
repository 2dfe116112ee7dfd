"""Critical masses of twelve bores, linearised at the frequency of their whirl, against marches on the same cells.

Small motions about the equilibrium are marched with two masses near the critical one. Their rates of growth follow from
the recursion that equally spaced positions of a growing oscillation obey, and the mass without growth from both rates.

.venv/bin/python -m scripts.studies.motion.fast_whirl --out runs/motion    # about two CPU minutes
"""

import argparse
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.files import write_json
from roughfilm.rom.bearing.dynamics.balance import Equilibrium, balanced_equilibrium, point_of
from roughfilm.rom.bearing.march.rough_walls import walls_of
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.motion.march import Course, begun, march
from roughfilm.rom.ladder.scene import read_scene

CELLS = (64, 32)
MASSES = (0.93, 1.08)
"""Masses that are marched, over the critical one."""

STEPS, PERIODS, KEPT = 64, 10, 0.6
"""Steps in a period of the whirl, periods, and the part of them at the end that is fitted."""

AMPLITUDE = 1e-3
"""Size of the first velocity over the clearance and the frequency."""

HALVES = {"lobes": 2, "arc": "160 deg"}
THIRDS = {"lobes": 3, "arc": "100 deg", "preload": 0.5}
BORES: tuple[tuple[str, Mapping[str, object], str, str], ...] = (
    ("full", {}, "525 N", "-0.05 MPa"),
    ("full", {}, "525 N", "-0.1 MPa"),
    ("full", {}, "5 kN", "-0.1 MPa"),
    ("full", {}, "5 kN", "-0.2 MPa"),
    ("full", {}, "3 kN", "-0.5 MPa"),
    ("two grooves", HALVES, "2 kN", "0 Pa"),
    ("two grooves", HALVES, "2 kN", "-0.1 MPa"),
    ("two grooves", HALVES, "2 kN", "-0.5 MPa"),
    ("one groove", {"arc": "300 deg"}, "4 kN", "-0.1 MPa"),
    ("three lobes", THIRDS, "3 kN", "0 Pa"),
    ("three lobes", THIRDS, "3 kN", "-0.1 MPa"),
    ("lemon bore", HALVES | {"preload": 0.4}, "1 kN", "-0.2 MPa"),
)
"""Name, geometry, load and cavitation pressure above ambient of each bore."""


def bore(geometry: Mapping[str, object], load: str, cavitation: str) -> Bearing:
    """A bore of 50 mm radius and 30 mm width with a clearance of 0.1 mm, at 1500 rpm with oil of 0.1 Pa s."""
    scene = read_scene(
        {
            "name": "bore",
            "kind": "bearing",
            "geometry": {"shape": "lobes", "radius": "50 mm", "width": "30 mm", "clearance": "100 um"} | dict(geometry),
            "lubricant": {"viscosity": "0.1 Pa*s", "cavitation_pressure": cavitation},
            "motion": {"speed": "157.1 rad/s"},
            "load": {"force": load},
        }
    )
    assert isinstance(scene, Bearing)
    return scene


def growth(found: Equilibrium, mass: float, frequency: float, clearance: float) -> float:
    """The rate of growth of small motions of a mass, 1/s, that oscillate near a frequency, rad/s."""
    film, at, step = found.film, found.instant, 2 * math.pi / frequency / STEPS
    count = at.place.size
    course = Course(
        free=np.ones(count, dtype=bool),
        place=lambda _time: at.place,
        speed=lambda _time: film.solved.problem.speed,
        force=lambda _time: film.load,
        mass=mass * np.eye(count),
        stiffness=np.zeros((count, count)),
        velocity_scale=np.full(count, clearance * frequency),
    )
    start = begun(film.solved, at, velocity=AMPLITUDE * clearance * frequency * np.eye(count)[0])
    moved = march(film.solved, course, start, PERIODS * STEPS * step, largest_step=step, error=None)
    places = np.array([one.now.place - at.place for one in moved])[round((1 - KEPT) * PERIODS * STEPS) :]
    apart = STEPS // 6
    before = np.stack([places[apart:-apart].ravel(), places[: -2 * apart].ravel()], axis=1)
    first, second = np.linalg.lstsq(before, places[2 * apart :].ravel(), rcond=None)[0]
    return float(np.log(np.abs(np.roots([1, -first, -second]))).max()) / (apart * step)


def both(scene: Bearing) -> tuple[float, float, float]:
    """The critical mass by linearisation and by marches, kg, and the whirl ratio."""
    found = balanced_equilibrium(scene, walls_of(scene), CELLS)
    whirl = point_of(found, 1.0).whirl
    assert whirl is not None
    mass, frequency = 1 / whirl.inverse_mass, math.sqrt(whirl.frequency_squared)
    assert scene.turning_radius is not None
    clearance = float(found.film.wall.unit[0])
    below, above = (growth(found, part * mass, frequency, clearance) for part in MASSES)
    part = MASSES[0] * (MASSES[1] / MASSES[0]) ** (below / (below - above))
    return mass, part * mass, frequency * scene.turning_radius / abs(scene.motion.speed)


def main() -> None:
    """Print a row for each bore and write ``fast_whirl.json``."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    rows = []
    for name, geometry, load, cavitation in BORES:
        linear, marched, ratio = both(bore(geometry, load, cavitation))
        rows.append({"bore": name, "load": load, "cavitation": cavitation, "linear": linear, "march": marched})
        error = linear / marched - 1
        print(
            f"| {name} | {load} | {cavitation} | {ratio:.3f} | {linear:.0f} | {marched:.0f} | {error:+.1%} |",
            flush=True,
        )
    write_json({"bores": rows}, out / "fast_whirl.json")


if __name__ == "__main__":
    main()
