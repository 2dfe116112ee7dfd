"""Laws of sealing load and leakage for groups of families: constants with intervals, and the scatter of surfaces."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.paper_f.data import MODULUS, Pressed
from scripts.studies.paper_f.scatter import Scatter
from scripts.studies.paper_f.sizes import Sizes
from scripts.studies.paper_f.surfaces import HEIGHTS

SLOPE = "g′"
"""Name of the rms slope as a scale of loads: W/(E* g′) does not change if lengths or heights are scaled."""

RESAMPLES = 1000
"""Number of resamples of a bootstrap."""

CONFIDENCE = (2.5, 97.5)
"""Percentiles of the ends of a 95 % interval."""

LOAD_FRACTIONS = (0.003, 0.03, 0.3)
"""Fractions of the median sealing load at which leakages of surfaces are compared."""

LIGHT_LOAD_FRACTION = 0.1
"""Fraction of the sealing load below which a load counts as light."""

Sample = Sequence[Pressed]
Places = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Constant:
    """A fitted number with its intervals.

    Attributes
    ----------
    value : fitted number.
    by_surface : 95 % interval from surfaces drawn with replacement, both directions together.
    by_family : 95 % interval from families drawn first, then surfaces; it shows the effect of the choice of families.
    """

    value: float
    by_surface: tuple[float, float]
    by_family: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class SealingLaw:
    """The law W = c E* s of the load at the threshold, where s is a height or the rms slope.

    Attributes
    ----------
    scale : name of s.
    constant : c, the geometric mean of W/(E* s), 1/m or dimensionless.
    spread : standard deviation of ln(W/(E* s)), as a factor.
    explained : R² of ln W, which grows with the range of Sa of the surfaces.
    explained_alike : R² of ln W after all surfaces are scaled to the same Sq, which removes the effect of the height.
    """

    scale: str
    constant: Constant
    spread: float
    explained: float
    explained_alike: float


def scale_of(one: Pressed, name: str) -> float:
    """Return the height of a given name, m, or the rms slope."""
    return one.numbers.slope if name == SLOPE else one.numbers.heights[name]


def ratios(sample: Sample, name: str) -> Array:
    """Return W/(E* s) at the thresholds, shape (surfaces, 2)."""
    return np.array([one.threshold / (MODULUS * scale_of(one, name)) for one in sample])


def sealing_law(sample: Sample, name: str) -> SealingLaw:
    """Fit the sealing law to the thresholds of both directions of all surfaces."""
    logs, bare = np.log(ratios(sample, name)), np.log([one.threshold / MODULUS for one in sample])
    same = np.log(ratios(sample, "Sq"))
    return SealingLaw(
        scale=name,
        constant=bootstrapped(sample, lambda drawn: np.exp([logs[drawn].mean()]))[0],
        spread=float(np.exp(logs.std())),
        explained=float(1 - logs.var() / bare.var()),
        explained_alike=float(1 - logs.var() / same.var()),
    )


def bootstrapped(sample: Sample, statistic: Callable[[Places], Array]) -> list[Constant]:
    """Return the numbers of a statistic with their bootstrap intervals.

    ``statistic`` computes the numbers from the surfaces at the given places of the sample.
    """
    families = [np.array(rows) for rows in _families(sample)]
    draw = np.random.default_rng(90731)
    everyone = np.arange(len(sample))
    once = [statistic(draw.choice(everyone, everyone.size)) for _ in range(RESAMPLES)]
    twice = []
    for _ in range(RESAMPLES):
        drawn = draw.integers(len(families), size=len(families))
        twice.append(statistic(np.concatenate([draw.choice(families[one], families[one].size) for one in drawn])))
    low, high = np.percentile(once, CONFIDENCE, axis=0)
    lower, higher = np.percentile(twice, CONFIDENCE, axis=0)
    return [
        Constant(
            value=float(value),
            by_surface=(float(low[k]), float(high[k])),
            by_family=(float(lower[k]), float(higher[k])),
        )
        for k, value in enumerate(statistic(everyone))
    ]


def _families(sample: Sample) -> list[list[int]]:
    rows: dict[str, list[int]] = {}
    for number, one in enumerate(sample):
        rows.setdefault(one.family, []).append(number)
    return list(rows.values())


@dataclass(frozen=True, kw_only=True)
class SkewedLaw:
    """The law W = c E* g′ exp(s Ssk) at the threshold: surfaces with valleys have flatter tops than g′ suggests.

    Attributes
    ----------
    constant, skewness : c and s.
    spread, explained_alike : those of :class:`SealingLaw`.
    """

    constant: Constant
    skewness: Constant
    spread: float
    explained_alike: float


def skewed_law(sample: Sample) -> SkewedLaw:
    """Fit the law with the skewness by least squares of ln W."""
    logs, skewness = np.log(ratios(sample, SLOPE)).mean(axis=1), np.array([one.numbers.skewness for one in sample])

    def line(drawn: Places) -> Array:
        s, c = np.polyfit(skewness[drawn], logs[drawn], 1) if np.ptp(skewness[drawn]) > 0 else (0.0, logs[drawn].mean())
        return np.array([np.exp(c), s])

    c, s = bootstrapped(sample, line)
    left = np.log(ratios(sample, SLOPE)) - np.log(c.value) - s.value * skewness[:, None]
    return SkewedLaw(
        constant=c,
        skewness=s,
        spread=float(np.exp(left.std())),
        explained_alike=float(1 - left.var() / np.log(ratios(sample, "Sq")).var()),
    )


@dataclass(frozen=True, kw_only=True)
class Collapse:
    """The scatter of leakages after heights are scaled to the same s, at loads that are scaled accordingly.

    Attributes
    ----------
    scale : names of the scales of heights and of loads.
    apart : standard deviation of log10 K over surfaces and directions, for each of ``LOAD_FRACTIONS``.
    sealed : fraction of surfaces and directions that are sealed at these loads and are left out.
    """

    scale: tuple[str, str]
    apart: tuple[float, ...]
    sealed: tuple[float, ...]


def collapse(sample: Sample, height: str, load: str) -> Collapse:
    """Return the collapse of direct solutions; ``height`` and ``load`` are names of scales, "" leaves them unscaled."""
    middle = (
        float(np.median(ratios(sample, load))) if load else float(np.median([o.threshold for o in sample])) / MODULUS
    )
    apart, shut = [], []
    for fraction in LOAD_FRACTIONS:
        logs = np.array([leakage_at(one, fraction * middle, height, load) for one in sample])
        shut.append(float(np.isnan(logs).mean()))
        apart.append(float(np.std(logs[~np.isnan(logs)])) if not np.isnan(logs).all() else float("nan"))
    return Collapse(scale=(height, load), apart=tuple(apart), sealed=tuple(shut))


def leakage_at(one: Pressed, load: float, height: str, unit: str) -> Array:
    """Return log10(K/s³) at a reduced load W/(E* r) in x and in y; nan where the gap is sealed.

    ``height`` and ``unit`` are the names of s and r; "" leaves K and W/E* unscaled.
    """
    place = load * MODULUS * (scale_of(one, unit) if unit else 1.0)
    with np.errstate(divide="ignore"):
        logs = np.log10(one.direct / (scale_of(one, height) if height else 1.0) ** 3)
    found = np.array([np.interp(np.log(place), np.log(one.loads), logs[:, i]) for i in (0, 1)])
    return np.where((place < one.threshold) & np.isfinite(found), found, np.nan)


@dataclass(frozen=True, kw_only=True)
class LeakageLaw:
    """The law K = s³ (a − b (W/(E* r))^(1/3))⁹ of positive leakage, fitted as a straight line in (K/s³)^(1/9).

    With s = r = Svm this is F.17 and F.18 of the source, read as Svm_d = (−0.023 (W/E)^(1/3) + 1.1 Svm^(1/3))³.

    Attributes
    ----------
    scale : names of s and r.
    a, b : constants; b is in m^(1/3) if r is a height.
    apart : rms of log10(K/K of the law) for open gaps that are open by the law.
    missed : fraction of the open gaps that are sealed by the law.
    explained : R² of the straight line.
    """

    scale: tuple[str, str]
    a: Constant
    b: Constant
    apart: float
    missed: float
    explained: float


def leakage_law(sample: Sample, height: str, load: str) -> LeakageLaw:
    """Fit the leakage law to the open gaps at all loads in both directions."""
    points = [_points(one, height, load) for one in sample]
    sums = np.array([[x.size, x.sum(), y.sum(), (x * x).sum(), (x * y).sum()] for x, y in points])

    def line(drawn: Places) -> Array:
        n, x, y, xx, xy = sums[drawn].sum(axis=0)
        falling = (x * y - n * xy) / (n * xx - x * x)
        return np.array([(y + falling * x) / n, falling])

    a, b = bootstrapped(sample, line)
    x, y = np.concatenate(points, axis=1)
    expected = a.value - b.value * x
    apart, missed = misfit(expected**9 * np.sign(expected), y**9)
    return LeakageLaw(
        scale=(height, load),
        a=a,
        b=b,
        apart=apart,
        missed=missed,
        explained=float(1 - np.var(y - expected) / np.var(y)),
    )


def _points(one: Pressed, height: str, load: str) -> Array:
    """Return (W/(E* r))^(1/3) and (K/s³)^(1/9) of the open gaps, shape (2, points)."""
    x = np.cbrt(one.loads / (MODULUS * scale_of(one, load)))
    y = (one.direct / scale_of(one, height) ** 3) ** (1 / 9)
    return np.concatenate([[x[y[:, i] > 0], y[y[:, i] > 0, i]] for i in (0, 1)], axis=1)


def misfit(expected: Array, found: Array) -> tuple[float, float]:
    """Return the rms of log10(found/expected) where ``expected`` is above 0, and the fraction where it is not."""
    known = expected > 0
    logs = np.log10(found[known] / expected[known])
    return float(np.sqrt(np.mean(logs**2))) if known.any() else float("nan"), float(1 - known.mean())


READINGS: dict[str, Callable[[Array, Array], Array]] = {
    "Svm_d = (−0.023 (W/E)^⅓ + 1.1 Svm^⅓)³": lambda load, valley: (-0.023 * np.cbrt(load) + 1.1 * np.cbrt(valley)) ** 3,
    "Svm_d = (−0.023 (W/E)^⅓ + 1.1) Svm": lambda load, valley: (-0.023 * np.cbrt(load) + 1.1) * valley,
    "Svm_d = −0.023 m (W/E)³ + 1.1 Svm": lambda load, valley: -0.023 * load**3 + 1.1 * valley,
}
"""Possible readings of the printed F.17, as functions of W/E* and Svm in m."""


@dataclass(frozen=True, kw_only=True)
class FormulaReading:
    """The comparison of one reading of F.17 with the surfaces.

    Attributes
    ----------
    formula : text of the reading.
    valley, leakage : rms of log10 of Svm under load and of K, over the values of the formula (its cube for K, F.18).
    light : rms of log10 for K at loads up to a tenth of the sealing load.
    missed : fraction of the open gaps for which the formula gives no valley.
    scales : whether the formula scales like linear elasticity: twice the height under twice the load.
    """

    formula: str
    valley: float
    leakage: float
    light: float
    missed: float
    scales: bool


def read_formulas(sample: Sample) -> list[FormulaReading]:
    """Judge all of ``READINGS`` with the constants of the source."""
    return [_read(formula, law, sample) for formula, law in READINGS.items()]


def _read(formula: str, law: Callable[[Array, Array], Array], sample: Sample) -> FormulaReading:
    rows = []
    for one in sample:
        expected = law(one.loads / MODULUS, np.full(one.loads.shape, one.numbers.heights["Svm"]))
        for i in (0, 1):
            is_open = one.direct[:, i] > 0
            part = one.loads / one.threshold[i]
            rows.append(np.stack([expected, one.valley, one.direct[:, i], part])[:, is_open])
    expected, valley, flow, part = np.concatenate(rows, axis=1)
    twice = law(np.array([0.02]), np.array([2e-6])) / law(np.array([0.01]), np.array([1e-6]))
    cube = np.sign(expected) * np.abs(expected) ** 3
    leaks, missed = misfit(cube, flow)
    return FormulaReading(
        formula=formula,
        valley=misfit(expected, valley)[0],
        leakage=leaks,
        light=misfit(cube[part < LIGHT_LOAD_FRACTION], flow[part < LIGHT_LOAD_FRACTION])[0],
        missed=missed,
        scales=bool(abs(twice[0] - 2) < 1e-9),
    )


DIRECTED, SKEWED = ("striated", "oblique"), ("peaky", "valley-rich", "plateau")
GROUPS: Mapping[str, Callable[[Pressed], bool]] = {
    "all": lambda _: True,
    "isotropic": lambda one: one.family not in DIRECTED,
    "isotropic, symmetric heights": lambda one: one.family not in DIRECTED + SKEWED,
}
"""Groups of the families: functions that select the surfaces, by name."""


@dataclass(frozen=True, kw_only=True)
class GroupLaws:
    """Laws fitted to one group of surfaces.

    Attributes
    ----------
    count : number of surfaces.
    sealing : sealing laws by scale, for the eight heights and the rms slope.
    skewed : sealing law with the rms slope and the skewness.
    collapses : scatter of leakages by the eight heights, unscaled (""), and by a height with loads over the slope.
    leakage : leakage laws of the form of F.18, by Svm as in the source, and by Sp and the slope.
    readings : comparisons of the readings of F.17.
    """

    count: int
    sealing: Mapping[str, SealingLaw]
    skewed: SkewedLaw
    collapses: Sequence[Collapse]
    leakage: Mapping[tuple[str, str], LeakageLaw]
    readings: Sequence[FormulaReading]


@dataclass(frozen=True, kw_only=True)
class SealStudy:
    """All data that are judged and drawn; ``measured`` is empty if the instrument files are absent.

    Attributes
    ----------
    sample : independent synthetic surfaces.
    finer : first surface of each family on twice as many nodes along each side.
    scatter : scatter of the sealing load by group, of surfaces of other sizes and spectra.
    laws : laws by the names of ``GROUPS``.
    """

    sample: Sequence[Pressed]
    finer: Sequence[Pressed]
    measured: Sequence[Pressed]
    sizes: Sizes
    scatter: Mapping[str, Scatter]
    laws: Mapping[str, GroupLaws]


def fit(sample: Sequence[Pressed]) -> GroupLaws:
    """Fit all laws to one group of surfaces."""
    return GroupLaws(
        count=len(sample),
        sealing={name: sealing_law(sample, name) for name in (*HEIGHTS, SLOPE)},
        skewed=skewed_law(sample),
        collapses=[collapse(sample, name, name) for name in ("", *HEIGHTS)]
        + [collapse(sample, name, SLOPE) for name in ("Sq", "Sp", "Spm")],
        leakage={pair: leakage_law(sample, *pair) for pair in (("Svm", "Svm"), ("Sp", "Sp"), ("Sp", SLOPE))},
        readings=read_formulas(sample),
    )


def fit_groups(sample: Sequence[Pressed]) -> dict[str, GroupLaws]:
    """Return the laws of each group that has surfaces."""
    groups = {name: [one for one in sample if counts(one)] for name, counts in GROUPS.items()}
    return {name: fit(members) for name, members in groups.items() if members}
