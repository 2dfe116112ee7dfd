"""Journals in a march: their shaft in coordinates that are fixed to the bore, with the line at their inlet."""

import math
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.lobes import DOWN
from roughfilm.rom.bearing.geometry.open_bore import OpenBore
from roughfilm.rom.bearing.march.course import Duty, film_at
from roughfilm.rom.bearing.march.rough_walls import walls_of
from roughfilm.rom.bearing.scene import Bearing, Outlet
from roughfilm.rom.cavitation.motion.coupled import Instant

RESIDUAL = 1e-11
"""Residual at which the film is solved that the line at the inlet is opposite to."""

ALIGNED, MAX_TURNS = 1e-8, 20
"""Angle, rad, between the eccentricity and the middle of the bore at which the search ends, and its largest number."""

MOST_TURN = 1.0
"""Largest turn of the inlet in a step, rad: where a supply outweighs the load, the eccentricity turns with it."""


def opened(scene: Bearing, first: float = DOWN) -> Bearing:
    """The scene of a journal with the coordinates of a shaft, whose inlet lies opposite to an angle, rad.

    Scenes of other shapes are unchanged. Supplies stay at their distance from the inlet.
    """
    journal = scene.geometry
    if not isinstance(journal, Journal):
        return scene
    bore, boundary = OpenBore.of(journal, first), scene.boundary
    outlet, inlet = boundary.outlet, boundary.inlet.pressure
    if outlet == Outlet() and inlet is not None:  # the line at the inlet has one pressure
        outlet = Outlet.model_construct(pressure=inlet)
    supply = tuple(one.model_copy(update={"angle": (one.angle or 0.0) + bore.start}) for one in scene.supply)
    return scene.model_copy(
        update={"geometry": bore, "boundary": boundary.model_copy(update={"outlet": outlet}), "supply": supply}
    )


def with_coordinates(scene: Bearing, cells: tuple[int, int]) -> Bearing:
    """The scene of a journal with the coordinates of a shaft, whose inlet lies where its film is widest at first.

    That is opposite to the eccentricity in equilibrium with the first load, as in a steady journal, or opposite to the
    first load where that has no equilibrium, for example at rest; of a given path opposite to its first position. The
    line then stays in the bore. Scenes of other shapes are unchanged.

    Parameters
    ----------
    cells : cells along and across of the grid on which the equilibrium is sought.
    """
    if not isinstance(scene.geometry, Journal):
        return scene
    return opened(scene, _first(scene, cells))


def _first(scene: Bearing, cells: tuple[int, int]) -> float:
    """The angle of the eccentricity to which the inlet is opposite, rad."""
    duty = Duty(scene=opened(scene))
    if "eccentricity_x" in duty.curves:
        return _angle(np.array([duty.curves[name](duty.begin) for name in ("eccentricity_x", "eccentricity_y")]))
    if duty.given_path:
        return DOWN
    load = duty.load(duty.begin)
    along = _angle(load)
    if duty.speed(duty.begin) == 0 or not load.any():
        return along
    try:
        return _aligned(scene, cells, load, along)
    except (InputError, ConvergenceError):
        return along


def _angle(vector: Array) -> float:
    """The angle of a vector in the plane of the shaft, rad; that downwards of none."""
    return math.atan2(vector[1], vector[0]) if vector[:2].any() else DOWN


def _aligned(scene: Bearing, cells: tuple[int, int], load: Array, first: float) -> float:
    """The angle of the eccentricity in equilibrium with a load if the inlet is opposite to it, by the secant method."""
    walls, near = walls_of(scene), None
    last, apart = first, 0.0
    for number in range(MAX_TURNS):
        film = film_at(Duty(scene=opened(scene, first)), cells, walls)
        start = None if near is None else _turned(film, near, first - last)
        near = equilibrium(film, start, tolerance=RESIDUAL, load=load)
        away = math.remainder(_angle(near.place) - first, 2 * math.pi)
        if abs(away) <= ALIGNED:
            return first
        step = away * (first - last) / (apart - away) if number and apart != away else away
        last, apart, first = first, away, first + max(-MOST_TURN, min(step, MOST_TURN))
    raise ConvergenceError("boundary.inlet: the place of the inlet opposite to the eccentricity does not converge")


def _turned(film: FreeFilm, near: Instant, angle: float) -> Instant:
    """An instant whose shaft and bore are turned by an angle, rad."""
    along, up = math.cos(angle), math.sin(angle)
    place = np.array([[along, -up], [up, along]]) @ near.place
    return replace(near, place=place, faces=film.solved.faces(place))
