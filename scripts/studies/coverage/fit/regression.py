"""Fit of the bound of an error as a sum of powers of dimensionless numbers, by quantile regression."""

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.optimize import minimize
from scipy.special import expit

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.advice.laws import RESOLVING, Law, Numbers, Term
from roughfilm.rom.studies.ordering import CERTAINTY

MIN_ERROR = 1e-7
"""Relative error below which an error is round-off; smaller errors are raised to it."""

RIDGE = 1e-3
"""Weight of the squared powers, scaled by the spread of their numbers, in the function that is minimised."""

SMOOTHING = 0.05
"""Width in ln(error) over which the corner of the pinball loss is rounded."""

POWER_STEP = 0.05
"""Step of the powers, which are its multiples."""

MAX_POWER = 4.0
"""Largest magnitude of a power."""

NOT_FALLING = frozenset(
    {
        "reynolds_number",
        "roughness_reynolds_number",
        "pressure_dependence",
        "suction",
        "roughness_ratio",
        "peak_ratio",
        "roughness_period",
    }
)
"""Numbers whose powers are at least 0: the error stays finite as they go to 0."""

LEAST_PART = 0.01
"""Largest part of the bound of any scene below which a term is dropped."""

FOLDS = 5
"""Number of parts of the scenes, each of which judges a law that is fitted to the others."""

LEVELS = (0.01, 0.02, 0.05, 0.1, 0.2)
"""Tolerances that ``CERTAINTY`` of the scenes must keep whose bound is at most the tolerance."""

MIN_SCENES_AT_LEVEL = 20
"""Smallest number of scenes at a level that may raise the coefficients."""


def fitted(
    rows: Sequence[tuple[Numbers, float]],
    terms: Sequence[Sequence[str]],
    within: Sequence[str] = (),
) -> Law:
    """Fit the law E = Σ_j C_j Π_k n_k^b_jk, such that 95 of 100 errors of other scenes are below it.

    The logarithms minimise the mean pinball loss of ln(error) - ln E at the quantile ``CERTAINTY`` (Koenker and Bassett
    1978, doi:10.2307/1913643) with a ridge on the powers. The powers are rounded to ``POWER_STEP``. All coefficients
    are then multiplied by a factor, see :func:`calibration`, for which each bound is that of a law fitted to the other
    four fifths of the scenes. All resolutions of a scene are in the same fifth.

    Parameters
    ----------
    rows : numbers of each scene, which are positive, with the relative error of a model.
    terms : the names of the numbers in each term.
    within : the names of further numbers, above whose range the law is not known.
    """
    errors = np.maximum([error for _, error in rows], MIN_ERROR)
    names = tuple(dict.fromkeys(name for term in terms for name in term))
    x = {name: np.log([numbers[name] for numbers, _ in rows]) for name in names}
    others, folds = np.empty(errors.size), _folds(rows)
    for fold in range(FOLDS):
        left = folds == fold
        own = {name: values[~left] for name, values in x.items()}
        powers, weights = _law(own, errors[~left], terms)
        others[left] = weights @ _shapes({name: values[left] for name, values in x.items()}, powers)
    powers, weights = _law(x, errors, terms)
    shapes = _shapes(x, powers)
    bound = weights @ shapes
    factor = calibration(errors, others)
    return Law(
        terms=tuple(
            Term(coefficient=_rounded(factor * weight), powers=own)
            for weight, own, shape in zip(weights, powers, shapes, strict=True)
            if (weight * shape > LEAST_PART * bound).any()
        ),
        reach={
            name: (_rounded(min(values)), _rounded(max(values)))
            for name in dict.fromkeys((*names, *within))
            for values in [[numbers[name] for numbers, _ in rows]]
        },
        scenes=len(rows),
        spread=_rounded(float(np.median(factor * bound / errors))),
        within=tuple(within),
    )


def _folds(rows: Sequence[tuple[Numbers, float]]) -> Array:
    """The part of the scenes that each row belongs to; rows of one scene, which differ by its grid, are in one part."""
    scenes: dict[tuple[float, ...], int] = {}
    return (
        np.array(
            [
                scenes.setdefault(tuple(value for name, value in numbers.items() if name not in RESOLVING), len(scenes))
                for numbers, _ in rows
            ]
        )
        % FOLDS
    )


def _law(x: Mapping[str, Array], errors: Array, terms: Sequence[Sequence[str]]) -> tuple[list[dict[str, float]], Array]:
    """The powers and the coefficients of all terms before calibration."""
    powers = _powers(x, np.log(errors), terms)
    return powers, _weights(_shapes(x, powers), errors)


def _shapes(x: Mapping[str, Array], powers: Sequence[Mapping[str, float]]) -> Array:
    """The products of powers of each term, shape (terms, scenes); ``x`` holds the logarithms of the numbers."""
    size = next(iter(x.values())).size
    return np.exp([sum((power * x[name] for name, power in own.items()), np.zeros(size)) for own in powers])


def calibration(errors: Array, bound: Array) -> float:
    """The smallest factor of the bounds with which 95 of 100 errors are below them, at every level too.

    The quantile of n scenes is (n + 1)/n · ``CERTAINTY``, with which a further scene is covered in 95 of 100 cases
    (Vovk et al. 2005, doi:10.1007/b106715). A level is kept if ``CERTAINTY`` of the scenes whose bound is at most the
    level have an error of at most the level.
    """
    enough = min(CERTAINTY * (1 + 1 / errors.size), 1.0)
    factor = float(np.quantile(errors / bound, enough, method="higher"))
    for level in LEVELS:
        candidates = np.sort(level / bound[(errors > level) & (factor * bound <= level)])
        for candidate in (factor, *candidates * (1 + 1e-9)):
            own = errors[candidate * bound <= level]
            if own.size < MIN_SCENES_AT_LEVEL or (own <= level).mean() >= CERTAINTY:
                factor = max(factor, float(candidate))
                break
    return factor


def _powers(x: Mapping[str, Array], y: Array, terms: Sequence[Sequence[str]]) -> list[dict[str, float]]:
    """The rounded powers of each term."""
    designs = [np.array([x[name] - x[name].mean() for name in term]).reshape(len(term), y.size) for term in terms]
    spreads = [design.std(axis=1) for design in designs]
    ends = np.cumsum([0, *(1 + len(term) for term in terms)])

    def loss(parameters: Array) -> tuple[float, Array]:
        logs, penalty, slope = [], 0.0, np.zeros_like(parameters)
        for j, (design, spread) in enumerate(zip(designs, spreads, strict=True)):
            own = parameters[ends[j] : ends[j + 1]]
            logs.append(own[0] + own[1:] @ design)
            penalty += RIDGE * float(((own[1:] * spread) ** 2).sum())
            slope[ends[j] + 1 : ends[j + 1]] = 2 * RIDGE * own[1:] * spread**2
        total = np.logaddexp.reduce(logs, axis=0)
        left = y - total
        value = np.mean(CERTAINTY * left + SMOOTHING * np.logaddexp(0, -left / SMOOTHING))
        pull = -(CERTAINTY - expit(-left / SMOOTHING)) / y.size
        for j, design in enumerate(designs):
            share = pull * np.exp(logs[j] - total)
            slope[ends[j]] += share.sum()
            slope[ends[j] + 1 : ends[j + 1]] += design @ share
        return float(value + penalty), slope

    limits: list[tuple[float | None, float | None]] = []
    for term in terms:
        limits += [(None, None), *((0.0 if name in NOT_FALLING else -MAX_POWER, MAX_POWER) for name in term)]
    starts = []
    for favoured in range(len(terms)):
        start = np.zeros(ends[-1])
        start[ends[:-1]] = y.mean() - 2.0
        start[ends[favoured]] = y.mean()
        starts.append(start)
    best = min((minimize(loss, start, jac=True, bounds=limits) for start in starts), key=lambda one: one.fun).x
    rounded = np.round(best / POWER_STEP) * POWER_STEP
    return [
        {
            name: round(float(power), 2)
            for name, power in zip(term, rounded[ends[j] + 1 : ends[j + 1]], strict=True)
            if power
        }
        for j, term in enumerate(terms)
    ]


def _weights(shapes: Array, errors: Array) -> Array:
    """The coefficients of terms with given powers that minimise the pinball loss, shape (terms,)."""
    y = np.log(errors)

    def loss(logs: Array) -> float:
        left = y - np.log(np.exp(logs) @ shapes)
        return float(np.mean(np.maximum(CERTAINTY * left, (CERTAINTY - 1) * left)))

    start = np.log(np.quantile(errors / shapes, 0.5, axis=1))
    found = minimize(loss, start, method="Nelder-Mead", options={"maxiter": 2000, "xatol": 1e-3, "fatol": 1e-6})
    return np.asarray(np.exp(found.x))


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
