"""The truth of a pocket: finite elements on two meshes (``scripts.studies.coverage.finite_elements``)."""

from collections.abc import Callable

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.geometry import AnyGroove, Through
from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.finite_elements.flow import solve
from scripts.studies.coverage.finite_elements.forces import Forces, forces
from scripts.studies.coverage.finite_elements.mesh import fitted_mesh
from scripts.studies.coverage.finite_elements.wall import Groove, Wall
from scripts.studies.coverage.truth import Truth

LEVELS = (0.7, 1.0)
"""Levels of the two meshes."""

FRICTION_FLOOR = 2e-5
"""Uncertainty of friction over friction, besides the difference of the two meshes."""

LOAD_FLOOR = (1e-5, 6e-7)
"""Uncertainty of load over the largest pressure at Re = 0, and its increase with Re, besides that difference."""

PRESSURE_FLOOR = 5e-4
"""Uncertainty of the extreme pressures over the largest one, besides that difference."""


def groove_of(groove: AnyGroove, film: float) -> Groove:
    """Return a groove of a scene in film thicknesses; straight lines connect points."""
    if isinstance(groove, Through):
        places, depths = np.array(groove.points).T / film
        places = places + groove.position / film
        breaks = tuple(map(float, places))
        return Groove(breaks=breaks, corners=breaks, depth=lambda x: np.interp(x, places, depths))
    shape = groove.shape()

    def moved(places: tuple[float, ...]) -> tuple[float, ...]:
        return tuple((place + groove.position) / film for place in places)

    return Groove(breaks=moved(shape.breaks), corners=moved(shape.corners), depth=_depth(shape.depth, groove, film))


def _depth(depth: Callable[[Array], Array], groove: AnyGroove, film: float) -> Callable[[Array], Array]:
    return lambda x: depth(x * film - groove.position) / film


def wall_of(scene: Pocket) -> Wall:
    """Return the fixed wall of a pocket."""
    film = scene.geometry.film
    grooves = sorted((groove_of(one, film) for one in scene.grooves), key=lambda groove: groove.breaks[0])
    return Wall(length=scene.geometry.length / film, grooves=tuple(grooves))


def forces_on(scene: Pocket, level: float) -> Forces:
    """Return the forces on the sliding wall of a pocket, by a mesh of this level."""
    return forces(solve(fitted_mesh(wall_of(scene), level), scene.reynolds_number))


def truth(scene: Pocket) -> Truth:
    """Return load, friction and peak pressures of a pocket by two meshes: p+ = 100 p Ly² / (η u Lx), as the models.

    The uncertainty is the difference of the two meshes, and a floor from comparisons with meshes of level 1.7.
    """
    coarse, fine = (forces_on(scene, level) for level in LEVELS)
    plus = scene.plus_factor
    largest = max(fine.pressure_max, -fine.pressure_min)
    floors = {
        "load": largest * (LOAD_FLOOR[0] + LOAD_FLOOR[1] * scene.reynolds_number),
        "friction": FRICTION_FLOOR * fine.friction,
        "pressure_max": PRESSURE_FLOOR * largest,
        "pressure_min": PRESSURE_FLOOR * largest,
    }
    return Truth(
        values={f"{name}_plus": getattr(fine, name) * plus for name in floors},
        uncertainty={
            f"{name}_plus": (abs(getattr(fine, name) - getattr(coarse, name)) + floor) * plus
            for name, floor in floors.items()
        },
        method=f"finite elements, levels {LEVELS[0]:g} and {LEVELS[1]:g}",
    )
