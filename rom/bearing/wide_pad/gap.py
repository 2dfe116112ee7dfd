"""The gap of an infinitely wide pad along the motion of its sliding wall, and the pads that have one."""

from collections.abc import Callable

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.pad import Pad
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.viscosity import ConstantViscosity
from roughfilm.rom.thin_film.gap import Gap

MAX_STEP = 1e-4
"""Jump of the film thickness over the film above which a wall has a step."""

BESIDE = 1e-12
"""Distance from a break over the length of the pad at which a step is sought."""

SLOPE_STEP = 1e-5
"""Distance over the shorter piece beside a break over which its slopes are taken."""

MIN_CORNER = 1e-3
"""Jump of the slope above which a break is a corner, over the largest of both slopes and of film over length."""


def film_obstacle(scene: Bearing) -> str | None:
    """The reason for which the flow across the film of a bearing is not resolved; None for a pad where it is.

    It is resolved in infinitely wide pads with a smooth wall, of a given film, with a flooded inlet, without supplies,
    and with a liquid of constant density and viscosity.
    """
    geometry, lubricant, theta = scene.geometry, scene.lubricant, scene.boundary.inlet.theta
    if not isinstance(geometry, Pad):
        named = "a shaft in lobes" if geometry.shape == "lobes" else f"a {geometry.shape}"
        return f"the flow is resolved across the film of pads only, not of {named}"
    if not scene.wide:
        return "the flow is resolved across the film of infinitely wide pads only; leave out geometry.width for one"
    if scene.load is not None:
        return "the film is sought under a load; give geometry.film without [load]"
    if scene.roughness is not None:
        return "the wall is rough; take homogenized or direct"
    if not isinstance(lubricant.compressibility, Incompressible):
        return f"the density changes with pressure ({lubricant.compressibility.law}), which needs reynolds_cavitating"
    if not isinstance(lubricant.piezoviscosity, ConstantViscosity):
        return f"the viscosity changes with pressure ({lubricant.piezoviscosity.law}), which needs reynolds_cavitating"
    if theta is not None and theta < 1:
        return f"the inlet is starved (theta = {theta:g}), which needs a model with cavitation"
    if scene.motion.approach != 0:
        return "the walls approach each other, which needs a model of the Reynolds equation"
    if scene.supply:
        return "lubricant is supplied inside of the film"
    if scene.motion.speed == 0:
        return "the wall does not slide"
    return None


def pad_obstacle(scene: Bearing) -> str | None:
    """The reason for which the equations of a thin film do not hold in a bearing; None for a pad where they do.

    They hold where :func:`film_obstacle` finds nothing and the wall has no steps.
    """
    obstacle = film_obstacle(scene)
    if obstacle is not None:
        return obstacle
    for place, _ in steps(pad_gap(scene)):
        at = place if scene.motion.speed > 0 else scene.geometry.length - place
        return f"the wall has a step at x = {at:.4g} m, and a thin film needs walls of finite slope"
    return None


def thin_film_obstacle(scene: Bearing) -> str | None:
    """The reason for which inertia in the film of a bearing is not resolved; None for a pad where it is."""
    if scene.lubricant.density is None:
        return "the scene has no lubricant.density, on which inertia depends"
    return pad_obstacle(scene)


def pad_gap(scene: Bearing) -> Gap:
    """The gap of an infinitely wide pad; x is the distance from the end where the sliding wall enters, m."""
    shape, length, film = scene.geometry.film_shape(), scene.geometry.length, scene.geometry.thinnest
    backwards = scene.motion.speed < 0

    def thickness(x: Array) -> Array:
        return _thickness(shape, length - x if backwards else x)

    breaks = tuple(sorted(length - place for place in shape.breaks)) if backwards else tuple(shape.breaks)
    corners = [
        place
        for before, place, behind in zip(breaks[:-2], breaks[1:-1], breaks[2:], strict=True)
        if _slope_jump(thickness, place, SLOPE_STEP * min(place - before, behind - place), film / length) > MIN_CORNER
    ]
    return Gap(film=film, breaks=breaks, corners=tuple(corners), thickness=thickness)


def steps(gap: Gap) -> tuple[tuple[float, float], ...]:
    """The steps of the wall of a pad: places and jumps of the film thickness along the motion, m."""
    found = []
    for place in gap.breaks[1:-1]:
        before, behind = gap.thickness(place + BESIDE * gap.length * np.array([-1.0, 1.0]))
        if abs(behind - before) > MAX_STEP * gap.film:
            found.append((place, float(behind - before)))
    return tuple(found)


def _thickness(shape: Shape, x: Array) -> Array:
    return shape.thickness(x, np.full_like(x, shape.across[0]))


def _slope_jump(thickness: Callable[[Array], Array], place: float, step: float, least: float) -> float:
    """The jump of the slope at a place over the largest of both slopes and ``least``.

    The slopes are one-sided differences of second order over steps of this length, m.
    """
    one, other = (
        float(np.array([-1.5, 2.0, -0.5]) @ thickness(place + side * np.array([0.0, 1.0, 2.0]))) / side
        for side in (-step, step)
    )
    return abs(one - other) / max(abs(one), abs(other), least)
