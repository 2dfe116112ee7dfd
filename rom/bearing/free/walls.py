"""Walls that move along their normal."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.geometry.rigid import MovingWall, RigidWall
from roughfilm.rom.bearing.scene import Bearing


def wall_of(scene: Bearing, film: float | None = None) -> RigidWall:
    """The coordinate of a wall that moves along its normal: the least film thickness.

    Parameters
    ----------
    film : the least film thickness, m; by default that of the scene, or that expected under its load.
    """
    geometry = scene.geometry
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
    return scene.moved(geometry.at(place)) if isinstance(geometry, MovingWall) else scene.at_film(float(place[0]))
