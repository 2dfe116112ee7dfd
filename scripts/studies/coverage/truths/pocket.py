"""The truth of a pocket: finite elements on two meshes (``scripts.studies.coverage.finite_elements``)."""

from roughfilm.rom.pocket.geometry import AnyGroove
from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.finite_elements.flow import solve
from scripts.studies.coverage.finite_elements.forces import Forces, forces
from scripts.studies.coverage.finite_elements.mesh import fitted_mesh
from scripts.studies.coverage.finite_elements.wall import Groove, Wall
from scripts.studies.coverage.truth import Truth

LEVELS: tuple[float, ...] = (0.7, 1.0, 1.4)
"""Levels of the meshes; the last one is taken where the first two differ by more than ``TARGET``."""

TARGET = 3e-3
"""Difference of the loads of two meshes over the load that is good enough."""

LEAST_LOAD = 0.05
"""Load over the largest pressure below which that difference is taken over this share of the pressure."""

FRICTION_FLOOR = 4e-6
"""Uncertainty of friction over friction, besides the difference of the two meshes."""

LOAD_FLOOR = 3e-6
"""Uncertainty of load over the largest pressure at Re = 0 and a small slope, besides the difference of the meshes."""

LOAD_FLOOR_BY_INERTIA = 6e-7
"""Increase of that floor with Re."""

LOAD_FLOOR_BY_SLOPE = 3e-4
"""Increase of that floor with the squared mean slope of the steepest groove, up to a slope of 1."""

PRESSURE_FLOOR = 1e-3
"""Uncertainty of the extreme pressures over the largest one, besides that difference."""


def groove_of(groove: AnyGroove, film: float) -> Groove:
    """Return a groove of a scene in film thicknesses."""
    shape = groove.shape()

    def moved(places: tuple[float, ...]) -> tuple[float, ...]:
        return tuple((place + groove.position) / film for place in places)

    return Groove(
        breaks=moved(shape.breaks),
        corners=moved(shape.corners),
        depth=lambda x: shape.depth(x * film - groove.position) / film,
    )


def wall_of(scene: Pocket) -> Wall:
    """Return the fixed wall of a pocket."""
    film = scene.geometry.film
    grooves = sorted((groove_of(one, film) for one in scene.grooves), key=lambda groove: groove.breaks[0])
    return Wall(length=scene.geometry.length / film, grooves=tuple(grooves))


def forces_on(scene: Pocket, level: float) -> Forces:
    """Return the forces on the sliding wall of a pocket, with p = 0 at the ends of its period, by a mesh of a level."""
    wall, ends = wall_of(scene).begun_on_land()
    return forces(solve(fitted_mesh(wall, level), scene.reynolds_number), ends)


def truth(scene: Pocket) -> Truth:
    """Return load, friction and peak pressures of a pocket by two or three meshes: p+ = 100 p Ly² / (η u Lx).

    The uncertainty is the difference of the two finest meshes, and a floor from comparisons with meshes of level 2.
    """
    coarse, fine = (forces_on(scene, level) for level in LEVELS[:2])
    levels = LEVELS[:2]
    if abs(fine.load - coarse.load) > TARGET * max(abs(fine.load), LEAST_LOAD * fine.largest_pressure):
        coarse, fine, levels = fine, forces_on(scene, LEVELS[2]), LEVELS
    uncertainty, plus = uncertainties(scene, coarse, fine), scene.plus_factor
    return Truth(
        values={f"{name}_plus": getattr(fine, name) * plus for name in uncertainty},
        uncertainty={f"{name}_plus": one * plus for name, one in uncertainty.items()},
        method=f"finite elements, levels {', '.join(f'{level:g}' for level in levels)}",
    )


def uncertainties(scene: Pocket, coarse: Forces, fine: Forces) -> dict[str, float]:
    """Return the uncertainty of each force of the finer of two meshes, in η u / Ly."""
    load = LOAD_FLOOR + LOAD_FLOOR_BY_INERTIA * scene.reynolds_number + LOAD_FLOOR_BY_SLOPE * min(scene.slope, 1.0) ** 2
    floors = {
        "load": fine.largest_pressure * load,
        "friction": FRICTION_FLOOR * fine.friction,
        "pressure_max": PRESSURE_FLOOR * fine.largest_pressure,
        "pressure_min": PRESSURE_FLOOR * fine.largest_pressure,
    }
    return {name: abs(getattr(fine, name) - getattr(coarse, name)) + floor for name, floor in floors.items()}
