"""Films with roughness, averaged or resolved, and the grids that resolve its waves."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.equilibrium.expected import MIN_FILM_OVER_PEAK, closest_film, expected_film
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.model import MAX_CELLS, smooth_resolutions
from roughfilm.rom.bearing.roughness import RoughSurface, Sinusoid, StoredTable
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.shape import CELLS_PER_FEATURE
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors
from roughfilm.rom.ladder.model import Applicability

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.problem import Problem
    from roughfilm.rom.cavitation.shape import Shape

REFINEMENTS = {True: (1, 2, 4, 8), False: (1, 2, 4)}
"""Multiples of the cells that resolve the waves, for an infinitely wide film (True) and for others."""

REFINED_CELLS = {True: 4_000_000, False: 512}
"""Number of cells along a side up to which refinements above 2 are used, for an infinitely wide film and for others."""


MAX_EXPECTED_RATIO = 3.0
"""The film thickness that is expected for smooth walls over the smallest one with flow factors."""

MIN_FACTOR_RATIO = 1e-6
"""Lower bound on flow factors over those of a smooth film, which keeps the matrix regular where the gap is sealed."""


@dataclass(frozen=True)
class FlooredFlowFactors:
    """Flow factors with a lower bound of ``MIN_FACTOR_RATIO`` times those of a smooth film.

    ``mean_gap`` gives the mean gap over the separation, m; by default the two are equal.
    """

    factors: FactorsOverGap
    mean_gap: Callable[[Array], Array] = np.asarray

    @property
    def origin(self) -> Mapping[str, Any]:
        """The entries for the provenance of a result; empty for factors without a table."""
        return getattr(self.factors, "origin", {})

    @property
    def narrowest(self) -> float:
        """The smallest mean gap whose factors are known, m; 0 if they are known for any."""
        known: float = getattr(self.factors, "narrowest", 0.0)
        return known

    def __call__(self, separation: Array, /) -> GapFactors:
        """The flow factors, each of the shape of ``separation``."""
        factors, h = self.factors(separation), self.mean_gap(separation)
        floor = MIN_FACTOR_RATIO * h**3
        sealed = (factors.along < floor) | (factors.across < floor)
        return replace(
            factors,
            along=np.maximum(factors.along, floor),
            across=np.maximum(factors.across, floor),
            cross=np.where(sealed, 0.0, factors.cross),
            drag=np.maximum(factors.drag, MIN_FACTOR_RATIO * h),
        )


@dataclass(frozen=True, kw_only=True)
class Searched:
    """The films of a model among which the one under a load is sought.

    Attributes
    ----------
    film : film(scene), the problem of a film.
    closest : the smallest film thickness that is tried, m.
    first : the film thickness at which the search begins, m.
    averaged : whether the roughness is averaged.
    known_from : the film thickness from which the flow factors are known, m; None if they are known for any.
    """

    film: "Callable[[Bearing], Problem]"
    closest: float
    first: float
    averaged: bool = False
    known_from: float | None = None


def smooth_films(scene: Bearing, *, film: "Callable[[Bearing], Problem]") -> Searched:
    """The films of a smooth wall."""
    closest = closest_film(scene)
    return Searched(film=film, closest=closest, first=max(expected_film(scene).thickness, closest))


def rough_films(scene: Bearing) -> Searched:
    """The films with all waves of the roughness, whose walls do not touch."""
    assert scene.roughness is not None
    closest = max(closest_film(scene), MIN_FILM_OVER_PEAK * (scene.roughness.peak + scene.geometry.dip))
    return Searched(film=rough_film, closest=closest, first=max(expected_film(scene).thickness, 1.1 * closest))


def averaged_films(scene: Bearing) -> Searched:
    """The films averaged over the roughness, with flow factors down to one film thickness.

    Sinusoidal ridges do not touch; tips of a surface are truncated down to its rms height, or to a third of the
    expected film thickness.
    """
    roughness, expected, smooth = scene.roughness, expected_film(scene).thickness, closest_film(scene)
    assert roughness is not None
    if isinstance(roughness, Sinusoid):
        closest = max(smooth, MIN_FILM_OVER_PEAK * (roughness.peak + scene.geometry.dip))
        first = max(expected, 1.1 * closest)
        return Searched(film=averaged_film, closest=closest, first=first, averaged=True)
    least = max(roughness.rms, expected / MAX_EXPECTED_RATIO, smooth)
    factors = roughness.factors(least)
    least = max(least, factors.narrowest)
    floored = FlooredFlowFactors(factors)

    def film(one: Bearing) -> "Problem":
        problem = one.problem()
        return replace(problem, shape=replace(problem.shape, roughness=floored))

    return Searched(
        film=film,
        closest=least + scene.geometry.dip,
        first=max(expected, 1.1 * (least + scene.geometry.dip)),
        averaged=True,
        known_from=least if isinstance(roughness, RoughSurface) else None,
    )


def averaged_film(scene: Bearing) -> "Problem":
    """The problem of the mean gap with the flow factors of the roughness.

    Raises
    ------
    InputError
        If the roughness seals the film.
    """
    assert scene.roughness is not None
    problem, film = scene.problem(), scene.geometry.thinnest
    factors = scene.roughness.factors(film)
    narrowest = factors(np.array([film]))
    sealed = [
        direction
        for direction, factor in (("along", narrowest.along), ("across", narrowest.across))
        if factor[0] == 0 and not (direction == "across" and scene.wide)
    ]
    if sealed:
        raise InputError(
            f"scene.roughness: blocks the flow {' and '.join(sealed)} the sliding direction in a film of {film:.3g} m; "
            "increase the film thickness or lower the roughness"
        )
    return replace(problem, shape=replace(problem.shape, roughness=factors))


def rough_film(scene: Bearing) -> "Problem":
    """The problem of the film with all waves of the roughness."""
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


def resolving_cells(scene: Bearing) -> int:
    """The number of cells along a side that resolves the shortest waves."""
    assert scene.roughness is not None
    sides = (scene.geometry.length, scene.geometry.width or 0.0)
    return math.ceil(
        max(CELLS_PER_FEATURE * side / wave for side, wave in zip(sides, scene.roughness.finest, strict=True))
    )


def rough_resolutions(scene: Bearing) -> tuple[int, ...]:
    """The numbers of cells from coarse to fine: multiples of those that resolve the waves."""
    smooth = smooth_resolutions(scene)
    if scene.roughness is None or isinstance(scene.roughness, StoredTable):
        return smooth
    least = max(resolving_cells(scene), smooth[-1] // REFINEMENTS[scene.wide][-1])
    refined = [
        least * factor
        for factor in REFINEMENTS[scene.wide]
        if factor <= 2 or least * factor <= REFINED_CELLS[scene.wide]
    ]
    return tuple(dict.fromkeys(min(cells, MAX_CELLS[scene.wide]) for cells in refined))


def averaging_applies(scene: Bearing) -> Applicability:
    """Whether the roughness can be averaged, with the ratio of its period to the length of the bearing."""
    roughness = scene.roughness
    if roughness is None:
        return Applicability(applies=False, reason="the wall is smooth; use reynolds_cavitating")
    reason = f"assumes that the waves of {roughness.label} are infinitely short"
    if math.isfinite(roughness.period):
        reason += f": period over length = {roughness.period / scene.geometry.length:.2g}"
    if isinstance(scene.geometry, Ring):
        reason += "; the lay rotates with the sliding direction"
    return Applicability(applies=True, reason=reason)


def homogenized_applies(scene: Bearing) -> Applicability:
    """Whether the roughness can be averaged without contact of asperities."""
    fits = averaging_applies(scene)
    contact = "" if scene.asperities is None else "; leaves out the contact load of asperities"
    return replace(fits, reason=fits.reason + contact)


def direct_applies(scene: Bearing) -> Applicability:
    """Whether all waves of the roughness can be resolved, with the number of cells."""
    roughness = scene.roughness
    if roughness is None:
        why = "the wall is smooth; use reynolds_cavitating"
    elif isinstance(roughness, StoredTable):
        why = "a table of flow factors has no waves; give the surface itself"
    elif isinstance(scene.geometry, Ring):
        why = "a lay that rotates with the sliding direction cannot be resolved on a ring"
    elif scene.wide and not math.isinf(roughness.finest[1]):
        why = "the roughness varies across the infinitely wide film; give the bearing a width"
    elif scene.load is None and roughness.peak >= scene.geometry.thinnest:
        why = (
            f"the walls touch: the roughness is {roughness.peak:.3g} m high in a film of "
            f"{scene.geometry.thinnest:.3g} m; this model has no contact"
        )
    elif resolving_cells(scene) > MAX_CELLS[scene.wide]:
        why = f"the waves need {resolving_cells(scene)} cells along a side; at most {MAX_CELLS[scene.wide]} are allowed"
    else:
        cells = "" if scene.wide else f" × {resolving_cells(scene)}"
        resolved = f"resolves all waves with at least {resolving_cells(scene)}{cells} cells"
        return Applicability(applies=True, reason=f"{resolved}; leaves out inertia, heat and deformation")
    return Applicability(applies=False, reason=why)
