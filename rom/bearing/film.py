"""A bearing's film with its roughness: averaged, or wave by wave; and the cells that the waves need."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.model import MOST, PLANE, RESOLVED, WIDE
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.roughness import StoredTable
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.problem import Problem
    from roughfilm.rom.cavitation.shape import Shape

FINER = {True: (1, 2, 4, 8), False: (1, 2, 4)}
"""Times the cells that resolve the waves, of an infinitely wide film and of others."""

ENOUGH = {True: 4_000_000, False: 512}
"""Cells along a side beyond which twice those that resolve the waves are the finest grid by default."""


def averaged_film(scene: Bearing) -> "Problem":
    """The smooth film's mean gap, with the flow factors of the roughness."""
    assert scene.roughness is not None
    problem, film = scene.problem(), scene.geometry.film
    factors = scene.roughness.factors(film)
    narrowest = factors(np.array([film]))
    shut = [
        way
        for way, factor in (("along", narrowest.along), ("across", narrowest.across))
        if factor[0] == 0 and not (way == "across" and scene.wide)
    ]
    if shut:
        raise InputError(
            f"scene.roughness: seals a film of {film:.3g} m, so that nothing flows {' or '.join(shut)} the sliding; "
            "make the film thicker or the roughness lower"
        )
    return replace(problem, shape=replace(problem.shape, roughness=factors))


def rough_film(scene: Bearing) -> "Problem":
    """The film with every wave of the roughness."""
    problem, roughness = scene.problem(), scene.roughness
    assert roughness is not None
    assert not isinstance(roughness, StoredTable)
    smooth: Shape = problem.shape
    finest = tuple(min(one, other) for one, other in zip(smooth.finest, roughness.finest, strict=True))
    shape = replace(
        smooth,
        thickness=lambda x, y: smooth.thickness(x, y) + roughness.added(x, y),
        finest=(finest[0], finest[1]),
    )
    return replace(problem, shape=shape)


def resolving(scene: Bearing) -> int:
    """Cells along each side that the shortest waves need."""
    assert scene.roughness is not None
    sides = (scene.geometry.length, scene.geometry.width or 0.0)
    return math.ceil(max(RESOLVED * side / wave for side, wave in zip(sides, scene.roughness.finest, strict=True)))


def rough_resolutions(scene: Bearing) -> tuple[int, ...]:
    """Cells from coarse to fine: those that resolve the waves and multiples of them, at least as a smooth film has."""
    smooth = WIDE if scene.wide else PLANE
    if scene.roughness is None or isinstance(scene.roughness, StoredTable):
        return smooth
    least = max(resolving(scene), smooth[-1] // FINER[scene.wide][-1])
    asked = [least * times for times in FINER[scene.wide] if times <= 2 or least * times <= ENOUGH[scene.wide]]
    return tuple(dict.fromkeys(min(cells, MOST[scene.wide]) for cells in asked))


def averages(scene: Bearing) -> Applicability:
    """Whether roughness can be averaged, and how short it is against the bearing."""
    roughness = scene.roughness
    if roughness is None:
        return Applicability(applies=False, reason="there is no roughness to average: reynolds_cavitating is the same")
    told = f"takes {roughness.told} as infinitely short"
    if math.isfinite(roughness.period):
        told += f": period over length = {roughness.period / scene.geometry.length:.2g}"
    if isinstance(scene.geometry, Ring):
        told += "; the lay turns with the direction of sliding"
    return Applicability(applies=True, reason=told)


def averages_film(scene: Bearing) -> Applicability:
    """The same, without contact."""
    fits = averages(scene)
    told = "" if scene.asperities is None else "; leaves out what asperities carry where walls touch"
    return replace(fits, reason=fits.reason + told)


def follows(scene: Bearing) -> Applicability:
    """Whether every wave of the roughness can be followed, in how many cells."""
    roughness = scene.roughness
    if roughness is None:
        why = "there is no roughness to follow: reynolds_cavitating is the same"
    elif isinstance(roughness, StoredTable):
        why = "a table of flow factors has no waves that could be followed; give the surface itself"
    elif isinstance(scene.geometry, Ring):
        why = "a lay that turns with the direction of sliding has no waves that could be laid over a sector"
    elif scene.wide and not math.isinf(roughness.finest[1]):
        why = "the roughness varies across an infinitely wide film; give the bearing a width"
    elif roughness.peak >= scene.geometry.film:
        why = (
            f"the roughness is {roughness.peak:.3g} m high where the film is {scene.geometry.film:.3g} m thick: the "
            "walls would touch, and nothing here presses them"
        )
    elif resolving(scene) > MOST[scene.wide]:
        why = f"its waves need {resolving(scene)} cells along a side, more than the {MOST[scene.wide]} that are taken"
    else:
        cells = "" if scene.wide else f" × {resolving(scene)}"
        told = f"follows every wave: at least {resolving(scene)}{cells} cells; leaves out inertia, heat and deformation"
        return Applicability(applies=True, reason=told)
    return Applicability(applies=False, reason=why)
