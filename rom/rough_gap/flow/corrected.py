"""Factors of a rough gap in Stokes flow from thin-film theory with a correction for slope, bounds and uncertainty."""

from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.flow_factors import Estimated, flow_factors
from roughfilm.rom.homogenization.grids import MIN_COARSENED_NODES
from roughfilm.rom.homogenization.richardson import off
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.rom.rough_gap.flow.slope import local_fluxes, second_order_dissipation, slope_dissipation
from roughfilm.rom.rough_gap.flow.suction import suction
from roughfilm.rom.rough_gap.walls import Walls

SAFETY_FACTOR = 0.25
"""Ratio of the relative uncertainty of the theory to x √y, with x the relative dissipation that slope adds under a
drive, and y the largest x of all drives.

It covers the error of 95 of 100 factors of random ridges with exact solutions; half of the errors are below a third of
the uncertainty, and none is above 1.5 times it. The ridges are sinusoids, sums of up to six waves, deep valleys and
plateaus on one or both walls, with amplitudes of 0.05 to 0.85 of the gap and periods of 1.5 to 40 mean gaps; the
factors are those across and along them and of sliding.
"""


@dataclass(frozen=True, kw_only=True)
class SlopeCorrected:
    """Factors of a gap in Stokes flow by the theory for small slopes.

    Attributes
    ----------
    thin : factors of thin-film theory: an upper bound of A (as a quadratic form) and a lower bound of friction.
    corrected : best estimate.
    bound : lower bound of A (as a quadratic form) and upper bound of friction, apart from discretisation errors.
    uncertainty : uncertainty of ``corrected`` from the neglected terms and the grid.
    added : relative dissipation that slope adds under mean gradients along x and y and under sliding, shape (2,) or
        (3,); 0 where the gap is sealed.
    flow : magnitude of the thin-film flow under a gradient of 12η along x, shape (nx, ny), m³.
    contact, unsolved, iterations : those of the thin-film solution.
    suction : mean pressure of the thin film under sliding less the lowest one, over 6ηu, 1/m.
    """

    thin: RoughGapFactors
    corrected: RoughGapFactors
    bound: RoughGapFactors
    uncertainty: RoughGapFactors
    added: Array
    flow: Array
    contact: float
    unsolved: float
    iterations: int
    suction: float

    @property
    def left_out(self) -> Array:
        """The relative uncertainty of A along x and y from the neglected terms, shape (2,)."""
        return _neglected(self.added)[:2]

    @property
    def excess(self) -> Array:
        """The relative error of thin-film theory along x and y compared with Stokes flow, shape (2,)."""
        return _excess(self.thin, self.corrected)

    @property
    def greatest_excess(self) -> Array:
        """The upper bound of ``excess``, apart from discretisation errors; its lower bound is 0."""
        return _excess(self.thin, self.bound)


def slope_corrected(walls: Walls, *, tolerance: float | None = None) -> SlopeCorrected:
    """Compute the factors of a gap in Stokes flow from thin-film theory and the slope of its walls.

    K = diag(12 A, f) is the thin-film dissipation and E the dissipation that slope adds, over η and the three drives of
    :mod:`rom.rough_gap.flow.slope`. The flow of least dissipation with the same flux and sliding speed has

        A' = A (A + E_pp/12)⁻¹ A,    B' = B - 2A (12 A + E_pp)⁻¹ E_pu,    f' = f + E_uu - E_up (12 A + E_pp)⁻¹ E_pu.

    Each wave of E has the magnitude of Stokes flow over low roughness. The result is therefore exact to second order in
    slope for any height, and to second order in height for any wavelength; without this attenuation, errors of the
    ridges of ``SAFETY_FACTOR`` are 1.5 times as large across and 5 times along. For ridges long compared with the gap,
    under a flat wall, 1/A' = <h⁻³ (1 + 4/5 h'²)> across and A' = <h³>²/<h³ (1 + h'²)> along. With contact A' converges
    as A does, with the square of the spacing where the gap closes smoothly; f diverges as d does.

    Parameters
    ----------
    walls : both walls, m.
    tolerance : tolerance of the cell problems, as in :func:`rom.homogenization.flow_factors.flow_factors`, whose errors
        are raised.
    """
    film = flow_factors(walls.gap, walls.spacing, tolerance=tolerance)
    mean = walls.mean_gap
    thin = of_thin_film(film.factors.relative, slides=walls.slides)
    unit, fluxes = _in_mean_gaps(walls, film)
    added = [slope_dissipation(*grid) for grid in _coarser(unit, fluxes)]
    rows = [_values(with_dissipation(thin, one.attenuated)) for one in added]
    corrected, finest = with_dissipation(thin, added[-1].attenuated), added[-1]
    bound = with_dissipation(thin, finest.second + finest.fourth)
    ratio = _relative(thin, finest.second)
    of_film = of_thin_film(film.uncertainty.scaled(1 / mean), slides=walls.slides)
    uncertainty = _sum(_left_out(thin, corrected, bound, ratio), _of(off(rows), corrected), of_film)
    return SlopeCorrected(
        thin=thin.scaled(mean),
        corrected=corrected.scaled(mean),
        bound=bound.scaled(mean),
        uncertainty=uncertainty.scaled(mean),
        added=ratio,
        flow=np.hypot(*fluxes[0]) * mean**3,
        contact=film.contact,
        unsolved=film.unsolved,
        iterations=film.iterations,
        suction=suction(walls.gap, film.correctors[2]),
    )


def added_dissipation(walls: Walls, film: Estimated) -> Array:
    """The relative dissipation that slope adds to a thin film, :attr:`SlopeCorrected.added`, from its cell problems."""
    unit, fluxes = _in_mean_gaps(walls, film)
    thin = of_thin_film(film.factors.relative, slides=walls.slides)
    return _relative(thin, second_order_dissipation(unit, fluxes))


def _in_mean_gaps(walls: Walls, film: Estimated) -> tuple[Walls, Array]:
    """The walls and the fluxes of the drives with lengths over the mean gap."""
    mean = walls.mean_gap
    correctors = film.correctors / np.array([mean, mean, 1 / mean])[:, None, None]
    dx, dy = walls.spacing
    unit = Walls(lower=walls.lower / mean, upper=walls.upper / mean, spacing=(dx / mean, dy / mean))
    return unit, local_fluxes(unit.gap, unit.spacing, correctors, 3 if walls.slides else 2)


def _relative(thin: RoughGapFactors, added: Array) -> Array:
    """The added dissipation of each drive over that of the thin film, 0 where the gap is sealed, shape (drives,)."""
    own = np.array([*(12 * np.diag(thin.pressure)), thin.friction])[: len(added)]
    return np.asarray(np.divide(np.diag(added), own, out=np.zeros(len(added)), where=own > 0))


def with_dissipation(thin: RoughGapFactors, added: Array) -> RoughGapFactors:
    """The factors A', B' and f' of :func:`slope_corrected` for an added dissipation.

    Parameters
    ----------
    thin : factors of thin-film theory for a mean gap of 1.
    added : added dissipation E over η and the drives, shape (drives, drives).
    """
    a = thin.pressure
    free = np.ix_(*[np.flatnonzero(np.diag(a) > 0)] * 2)
    inverse = np.zeros((2, 2))
    inverse[free] = np.linalg.inv(12 * a[free] + added[:2, :2][free])
    pressure = 12 * a @ inverse @ a
    if len(added) < 3:
        return replace(thin, pressure=pressure)
    cross = added[:2, 2]
    return replace(
        thin,
        pressure=pressure,
        shear=thin.shear - 2 * a @ inverse @ cross,
        friction=float(thin.friction + added[2, 2] - cross @ inverse @ cross),
    )


def _excess(thin: RoughGapFactors, other: RoughGapFactors) -> Array:
    own, less = np.diag(thin.pressure), np.diag(other.pressure)
    return np.divide(own - less, less, out=np.zeros(2), where=less > 0)


def _coarser(walls: Walls, fluxes: Array) -> list[tuple[Walls, Array]]:
    """The walls and fluxes on up to three grids, each of every second node of the next, the coarsest first."""
    grids = [(walls, fluxes)]
    while len(grids) < 3:
        finer, flow = grids[0]
        steps = [2 if n % 2 == 0 and n >= MIN_COARSENED_NODES else 1 for n in finer.lower.shape]
        if max(steps) == 1:
            break
        every = (slice(None, None, steps[0]), slice(None, None, steps[1]))
        spacing = (finer.spacing[0] * steps[0], finer.spacing[1] * steps[1])
        coarse = replace(finer, lower=finer.lower[every], upper=finer.upper[every], spacing=spacing)
        grids.insert(0, (coarse, flow[(..., *every)]))
    return grids


def _values(factors: RoughGapFactors) -> Array:
    return np.array([*factors.pressure.ravel(), *factors.shear, factors.friction])


def _of(values: Array, factors: RoughGapFactors) -> RoughGapFactors:
    return replace(factors, pressure=values[:4].reshape(2, 2), shear=values[4:6], friction=float(values[6]))


def _sum(*parts: RoughGapFactors) -> RoughGapFactors:
    return _of(np.sum([_values(part) for part in parts], axis=0), parts[0])


def _neglected(added: Array) -> Array:
    return np.asarray(SAFETY_FACTOR * added * np.sqrt(added.max()))


def _left_out(
    thin: RoughGapFactors, corrected: RoughGapFactors, bound: RoughGapFactors, added: Array
) -> RoughGapFactors:
    """The uncertainty from the neglected terms, at most the distance to the farther bound."""
    a = np.minimum(
        np.diag(corrected.pressure) * _neglected(added)[:2],
        np.maximum(np.diag(thin.pressure - corrected.pressure), np.diag(corrected.pressure - bound.pressure)),
    )
    shear, friction = np.full(2, np.nan), np.nan
    if len(added) > 2:
        relative = float(_neglected(added)[2])
        largest = max(corrected.friction - thin.friction, bound.friction - corrected.friction)
        friction = min(relative * corrected.friction, largest)
        shear = np.full(2, relative * np.hypot(*corrected.shear))
    return replace(thin, pressure=np.sqrt(np.outer(a, a)), shear=shear, friction=friction)
