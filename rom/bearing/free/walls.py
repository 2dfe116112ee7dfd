"""The walls of bearings as rigid bodies: a shaft in lobes, or a wall that moves along its normal."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.rigid import RigidWall
from roughfilm.rom.bearing.scene import Bearing


def wall_of(scene: Bearing, film: float | None = None) -> RigidWall:
    """The coordinates of the wall: those of a shaft and of pads in lobes, or the least film thickness of other shapes.

    Parameters
    ----------
    film : the least film thickness of other shapes, m; by default that of the scene, or that expected under its load.

    Raises
    ------
    InputError
        For shape = "journal", whose load has no direction.
    """
    geometry = scene.geometry
    if isinstance(geometry, Lobes):
        return geometry.wall
    if isinstance(geometry, Journal):
        raise InputError("geometry.shape: got 'journal', whose shaft has no coordinates; take shape = 'lobes'")
    if film is None:
        film = geometry.film if geometry.film is not None else expected_scene(scene).geometry.thinnest
    return RigidWall(
        names=("film",),
        normals=(lambda x, y: np.ones(np.broadcast_shapes(x.shape, y.shape)),),
        unit=np.array([film]),
        place=np.array([film]),
        turns=np.array([False]),
    )


def bearing_at(scene: Bearing, place: Array) -> Bearing:
    """The bearing without a load, with its wall at its coordinates."""
    geometry = scene.geometry
    return scene.moved(geometry.at(place)) if isinstance(geometry, Lobes) else scene.at_film(float(place[0]))
