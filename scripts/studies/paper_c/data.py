"""Synthetic profiles with the numbers of Table C.2, their flow factors by every rule, and films under a flat slider."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.synthetic.four_moments import FourMoments
from roughfilm.contact.synthetic.profile import ground_profile
from roughfilm.contact.synthetic.rearrangement import rearranged
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.grids import sampled
from roughfilm.rom.homogenization.line import line_factors, profile_over_gap
from roughfilm.rom.homogenization.node_sums import Rule, line_factors_on
from scripts.studies.paper_c.films import (
    Curve,
    FilmOrdering,
    HomogenizedFilm,
    films,
    load_curves,
    loads_by_nodes,
    peaks,
    random_ordering,
)
from scripts.studies.study import Advance

TABLE = {
    "A": FourMoments(average=0.93e-6, rms=1.2e-6, skewness=-0.99, kurtosis=4.3, peak=2.2e-6),
    "B": FourMoments(average=0.29e-6, rms=0.37e-6, skewness=-0.49, kurtosis=3.3, peak=1.0e-6),
    "C": FourMoments(average=0.13e-6, rms=0.17e-6, skewness=-0.010, kurtosis=3.6, peak=0.57e-6),
    "D": FourMoments(average=0.37e-6, rms=0.47e-6, skewness=0.032, kurtosis=3.0, peak=1.4e-6),
}
"""Numbers of Table C.2; rmax is the height of the highest point above the mean, because contact begins at α = 1."""

LENGTH = 0.42e-3
POINTS = 512
ROLL_OFF = LENGTH / 4
SEEDS = tuple(range(201, 209))
ALPHAS = (0.49, 0.98)
POWERS = tuple(range(10, 18))
BESIDE = 4
"""Number of nodes left out of a power of two, so that few nodes coincide with points of the profile."""

RANGE = np.sort(np.concatenate([np.linspace(0.02, 0.9, 45), 1 - np.geomspace(0.09, 1e-3, 25), ALPHAS]))
SHUFFLES = tuple(range(301, 307))
REFINED = 2**14
WAYS = ("sums over the 512 heights", "lines between the 512 points", f"lines, refined to {REFINED} points first")


PARTS = 7
"""Number of steps of the work: four profiles, loads by nodes, films, random profiles."""


@dataclass(frozen=True, kw_only=True)
class RuleConvergence:
    """The flow factors φx and φs of profiles on rising numbers of nodes.

    Attributes
    ----------
    nodes : numbers of nodes N, shape (N,).
    exact : exact factors of the straight lines between the points, shape (seeds, 2).
    found : factors by rule and number of nodes left out, shape (seeds, N, 2).
    """

    nodes: Array
    exact: Array
    found: dict[tuple[Rule, int], Array]

    def errors(self, rule: Rule, left_out: int) -> Array:
        """Return the relative errors of the factors, shape (seeds, N, 2)."""
        return np.abs(self.found[rule, left_out] / self.exact[:, None] - 1)

    def changes(self, rule: Rule, left_out: int) -> Array:
        """Return the change of the factors from N/2 to N nodes over their mean (Eq. C.21), shape (seeds, N - 1, 2)."""
        values = self.found[rule, left_out]
        return np.abs(2 * np.diff(values, axis=1) / (values[:, 1:] + values[:, :-1]))

    def needed(self, rule: Rule, left_out: int, error: float) -> Array:
        """Return the least number of nodes from which on the errors of φx and φs stay within ``error``, shape (seeds,).

        The number is interpolated; it is NaN where the error on the most nodes is larger.
        """
        worst = self.errors(rule, left_out).max(axis=2)
        found = np.full(worst.shape[0], np.nan)
        for i, errors in enumerate(worst):
            above = np.flatnonzero(errors > error)
            if not above.size:
                found[i] = self.nodes[0]
            elif above[-1] + 1 < errors.size:
                pair = slice(above[-1], above[-1] + 2)
                found[i] = np.exp(np.interp(-np.log(error), -np.log(errors[pair]), np.log(self.nodes[pair])))
        return found

    def order(self, rule: Rule, left_out: int) -> float:
        """Return the order of the error of φx over the last four doublings above round-off, the median over seeds."""
        errors = self.errors(rule, left_out)[:, :, 0]
        slopes = []
        for one in errors:
            kept = np.flatnonzero(one > 1e-12)[-5:]
            slopes.append(-np.polyfit(np.log(self.nodes[kept]), np.log(one[kept]), 1)[0])
        return float(np.median(slopes))


@dataclass(frozen=True, kw_only=True)
class PaperC:
    """All data of the page.

    Attributes
    ----------
    factors : φx and φs over ``RANGE`` by profile, shape (seeds, α, 2).
    shuffled : φx and φs of the first seed and of its rearrangements, by profile and way, shape (1 + number, α, 2).
    """

    profiles: dict[str, list[Array]]
    convergence: dict[tuple[str, float], RuleConvergence]
    factors: dict[str, Array]
    shuffled: dict[tuple[str, str], Array]
    loads: dict[tuple[str, Rule, int], Array]
    powers: tuple[int, ...]
    films: dict[str, dict[str, HomogenizedFilm]]
    peaks: dict[float, tuple[float, float]]
    curves: dict[str, list[Curve]]
    orderings: dict[str, FilmOrdering]


def make(name: str, seed: int) -> Array:
    """Return the heights of a profile of Table C.2, m, shape (``POINTS``,)."""
    return ground_profile(TABLE[name], length=LENGTH, points=POINTS, seed=seed, roll_off=ROLL_OFF)


def gap(heights: Array, alpha: float) -> Array:
    """Return the gap H = 1 - α r/rmax over its mean (Eq. C.12); the heights r must have a mean of 0."""
    return np.asarray(1 - alpha * heights / heights.max())


def both(factors: FlowFactors) -> tuple[float, float]:
    """Return φx and φs."""
    relative = factors.relative
    return float(relative.pressure[0, 0]), float(relative.shear[0])


def convergence(profiles: Sequence[Array], alpha: float, powers: Sequence[int]) -> RuleConvergence:
    """Compute the factors by every rule on 2ᵏ nodes and on 2ᵏ − ``BESIDE`` nodes, for k in ``powers``."""
    gaps = [gap(heights, alpha) for heights in profiles]
    return RuleConvergence(
        nodes=2.0 ** np.array(powers),
        exact=np.array([both(line_factors(h).factors) for h in gaps]),
        found={
            (rule, left_out): np.array(
                [[both(line_factors_on(h, 2**power - left_out, rule=rule).factors) for power in powers] for h in gaps]
            )
            for rule in Rule
            for left_out in (0, BESIDE)
        },
    )


def by_lines(heights: Array) -> Array:
    """Return φx and φs over ``RANGE`` for straight lines between the heights, shape (α, 2)."""
    mean_gap = heights.max() / RANGE
    found = profile_over_gap(heights)(mean_gap)
    return np.stack([found.along / mean_gap**3, found.drag / mean_gap], axis=1)


def by_heights(heights: Array) -> Array:
    """Return φx and φs over ``RANGE`` by sums over the heights, shape (α, 2)."""
    found = [line_factors_on(gap(heights, alpha), heights.size, rule=Rule.TRAPEZOID) for alpha in RANGE]
    return np.array([both(one.factors) for one in found])


def shuffled(heights: Array, seeds: Sequence[int], refined: int) -> dict[str, Array]:
    """Return φx and φs of a profile and of its rearrangements by each of ``WAYS``, shape (1 + seeds, α, 2)."""
    orders = [heights, *(rearranged(heights, seed=seed) for seed in seeds)]
    fine = sampled(heights[:, None], refined, 0)[:, 0]
    finer = [fine, *(rearranged(fine, seed=seed, folds=0) for seed in seeds)]
    ways = zip(WAYS, (orders, orders, finer), (by_heights, by_lines, by_lines), strict=True)
    return {way: np.array([take(r) for r in rows]) for way, rows, take in ways}


def compute(
    advance: Advance,
    *,
    seeds: Sequence[int] = SEEDS,
    powers: Sequence[int] = POWERS,
    refined: int = REFINED,
    shuffles: Sequence[int] = SHUFFLES,
    random: int = 100,
) -> PaperC:
    """Compute all data of the page; ``advance`` is called ``PARTS`` times."""
    profiles = {name: [make(name, seed) for seed in seeds] for name in TABLE}
    study, factors, orders = {}, {}, {}
    for name, made in profiles.items():
        advance(f"integrating over profile {name}")
        for alpha in ALPHAS:
            study[name, alpha] = convergence(made, alpha, powers)
        factors[name] = np.array([by_lines(heights) for heights in made])
        for way, values in shuffled(made[0], shuffles, refined).items():
            orders[name, way] = values
    first = {name: made[0] for name, made in profiles.items()}
    advance("loads by the number of nodes")
    loads = {
        (name, rule, left_out): loads_by_nodes(heights, [2**power - left_out for power in powers], rule)
        for name, heights in first.items()
        for rule in (Rule.SIMPSON, Rule.TRAPEZOID)
        for left_out in (0, BESIDE)
    }
    advance("films")
    shown, by_modulus = films(first), peaks(first)
    curves = load_curves(profiles)
    advance("films of random profiles")
    return PaperC(
        profiles=profiles,
        convergence=study,
        factors=factors,
        shuffled=orders,
        loads=loads,
        powers=tuple(powers),
        films=shown,
        peaks=by_modulus,
        curves=curves,
        orderings=random_ordering(random),
    )
