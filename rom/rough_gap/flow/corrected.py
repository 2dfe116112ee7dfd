"""A rough gap in Stokes flow at the cost of thin-film theory: corrected for slope, between bounds, with error bars."""

from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.grids import MIN_COARSENED_NODES
from roughfilm.rom.homogenization.richardson import off
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.rom.rough_gap.flow.range_of_validity import REACH
from roughfilm.rom.rough_gap.flow.slope import local_fluxes, slope_dissipation
from roughfilm.rom.rough_gap.walls import Walls

SAFETY = 2.5
"""Of x²/(1 + x), with x what slope adds to a dissipation, over it, as the error of what is left out, over the factor.

On 65 ridges (sinusoids of amplitude 0.1 to 0.8 and 1.25 to 20 mean gaps long, sums of up to six waves with rms slopes
of 0.1 to 0.8) solved exactly, across, along and sliding, all of 390 factors were within, the nearest at half of it; of
236 factors of profiles with deep valleys or plateaus all were where x is below ``REACH``, the nearest at 0.72, and all
but one (1.02) beyond; in 8 cells of random waves on one or both walls, rms slope 0.2 to 0.8, all were.
"""


@dataclass(frozen=True, kw_only=True)
class SlopeCorrected:
    """What Stokes flow in a gap is, by theory for small slopes.

    Attributes
    ----------
    thin : thin-film theory, which has the largest A (as a quadratic form) and the least friction possible.
    corrected : the best estimate.
    bound : Stokes flow has no smaller A (as a quadratic form) and no more friction than this, but for the grid.
    uncertainty : of ``corrected``: what is left out of the theory, and the grid.
    added : what slope adds to the dissipation of mean gradients along x and y and of sliding, over it, shape (2,) or
        (3,); 0 where nothing gets through. Below 0.1 theory is good to 1.5 %.
    flow : size of the thin films' flow under a gradient along x of 12η, shape (nx, ny), m³.
    contact, unsolved, iterations : of the thin-film solution.
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

    @property
    def holds(self) -> bool:
        """Whether slope adds little enough, at most 0.25 of what thin films dissipate, for the theory to be used."""
        return bool(self.added.max() <= REACH)

    @property
    def left_out(self) -> Array:
        """By what part of themselves theory may have A along x and y wrong, on any grid, shape (2,)."""
        return _rest(self.added[:2])

    @property
    def excess(self) -> Array:
        """What thin-film theory lets too much through along x and y, over Stokes flow, shape (2,): the estimate."""
        return _excess(self.thin, self.corrected)

    @property
    def greatest_excess(self) -> Array:
        """More than that it cannot be, but for the grid; and not less than 0."""
        return _excess(self.thin, self.bound)


def slope_corrected(walls: Walls, *, tolerance: float | None = None) -> SlopeCorrected:
    """Factors of a gap in Stokes flow from thin-film theory and the slope of its walls.

    With K = diag(12 A, f) what thin films dissipate and E what slope adds, over η and the three drives of
    :mod:`rom.rough_gap.flow.slope`, the flow that takes least to carry the same flux past the same sliding wall has

        A' = A (A + E_pp/12)⁻¹ A,    B' = B - 2A (12 A + E_pp)⁻¹ E_pu,    f' = f + E_uu - E_up (12 A + E_pp)⁻¹ E_pu.

    E is taken wave by wave as Stokes flow has it over low roughness, so that this is right to second order in slope
    whatever the height, and to second order in height whatever the wavelength; without that, errors over the ridges of
    ``SAFETY`` are 1.5 times as large across and 5 times along. For ridges long against the gap, under a flat wall,
    1/A' = <h⁻³ (1 + 4/5 h'²)> across and A' = <h³>²/<h³ (1 + h'²)> along. Around contact A' converges as A does, with
    the square of the spacing where the gap closes smoothly; f has no limit there, as d has none.

    Parameters
    ----------
    walls : as they are, m.
    tolerance : of the cell problems, as :func:`rom.homogenization.flow_factors.flow_factors` takes it, which says what
        is raised.
    """
    found = flow_factors(walls.gap, walls.spacing, tolerance=tolerance)
    mean, drives = walls.mean_gap, 3 if walls.slides else 2
    correctors = found.correctors / np.array([mean, mean, 1 / mean])[:, None, None]
    dx, dy = walls.spacing
    unit = Walls(lower=walls.lower / mean, upper=walls.upper / mean, spacing=(dx / mean, dy / mean))
    thin = of_thin_film(found.factors.relative, slides=walls.slides)
    fluxes = local_fluxes(unit.gap, unit.spacing, correctors, drives)
    added = [slope_dissipation(*grid) for grid in _coarser(unit, fluxes)]
    rows = [_values(with_dissipation(thin, one.attenuated)) for one in added]
    corrected, finest = with_dissipation(thin, added[-1].attenuated), added[-1]
    bound = with_dissipation(thin, finest.second + finest.fourth)
    own = np.array([*(12 * np.diag(thin.pressure)), thin.friction])[:drives]
    part = np.divide(np.diag(finest.second), own, out=np.zeros(drives), where=own > 0)
    doubt = of_thin_film(found.uncertainty.scaled(1 / mean), slides=walls.slides)
    uncertainty = _sum(_left_out(thin, corrected, bound, part), _of(off(rows), corrected), doubt)
    return SlopeCorrected(
        thin=thin.scaled(mean),
        corrected=corrected.scaled(mean),
        bound=bound.scaled(mean),
        uncertainty=uncertainty.scaled(mean),
        added=part,
        flow=np.hypot(*fluxes[0]) * mean**3,
        contact=found.contact,
        unsolved=found.unsolved,
        iterations=found.iterations,
    )


def with_dissipation(thin: RoughGapFactors, added: Array) -> RoughGapFactors:
    """Factors if the thin films' flow dissipates that much more, as :func:`slope_corrected` says.

    Parameters
    ----------
    thin : of a mean gap of 1.
    added : over η and the drives, shape (drives, drives).
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
    """Walls and fluxes on every fourth, second and each node, as far as that is possible."""
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


def _rest(part: Array) -> Array:
    return np.asarray(SAFETY * part**2 / (1 + part))


def _left_out(
    thin: RoughGapFactors, corrected: RoughGapFactors, bound: RoughGapFactors, part: Array
) -> RoughGapFactors:
    rest = _rest(part)
    a = np.minimum(
        np.diag(corrected.pressure) * rest[:2],
        np.maximum(np.diag(thin.pressure - corrected.pressure), np.diag(corrected.pressure - bound.pressure)),
    )
    shear, friction = np.full(2, np.nan), np.nan
    if len(part) > 2:
        doubt = float(SAFETY * part[2] * part.max() / (1 + part.max()))
        most = max(corrected.friction - thin.friction, bound.friction - corrected.friction)
        friction = min(doubt * corrected.friction, most)
        shear = np.full(2, doubt * np.hypot(*corrected.shear))
    return replace(thin, pressure=np.sqrt(np.outer(a, a)), shear=shear, friction=friction)
