"""Laws of sealing load and leakage: constants with intervals, and the scatter of surfaces, by groups of families."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.paper_f.data import MODULUS, Pressed
from scripts.studies.paper_f.sizes import Sizes
from scripts.studies.paper_f.surfaces import HEIGHTS

SLOPE = "g′"
"""The rms slope as a scale of loads: W/(E* g′) is a pure number, and the same for a surface stretched along or up."""

RESAMPLES = 1000
"""Resamples of a bootstrap."""

CONFIDENCE = (2.5, 97.5)
"""Per cent."""

LOAD_FRACTIONS = (0.003, 0.03, 0.3)
"""Fractions of the median sealing load at which leakages of surfaces are compared."""

LIGHT_LOAD_FRACTION = 0.1
"""Fraction of the sealing load below which a load counts as light."""

Sample = Sequence[Pressed]
Places = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Constant:
    """A fitted number.

    Attributes
    ----------
    by_surface : 95 % interval, surfaces drawn with replacement, both directions together.
    by_family : the same with families drawn first: what another choice of families would do.
    """

    value: float
    by_surface: tuple[float, float]
    by_family: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class SealingLaw:
    """W = c E* s at the threshold, s a height or the rms slope; a straight line of slope 1 in logarithms.

    Attributes
    ----------
    scale : s by name.
    constant : c, the geometric mean, 1/m or a pure number.
    spread : the standard deviation of ln(W/(E* s)), as a factor.
    explained : R² of ln W. It grows with the range of Sa that the surfaces are given.
    explained_alike : R² of ln W once all surfaces are scaled to the same Sq: what s says beside the height.
    """

    scale: str
    constant: Constant
    spread: float
    explained: float
    explained_alike: float


def scale_of(one: Pressed, name: str) -> float:
    """A height by name, m, or the rms slope."""
    return one.numbers.slope if name == SLOPE else one.numbers.heights[name]


def ratios(sample: Sample, name: str) -> Array:
    """W/(E* s) at the thresholds, shape (surfaces, 2)."""
    return np.array([one.threshold / (MODULUS * scale_of(one, name)) for one in sample])


def sealing_law(sample: Sample, name: str) -> SealingLaw:
    """Fitted to the thresholds of both directions of all surfaces."""
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
    """Numbers that are expected from the surfaces whose places are given, each with its intervals."""
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
    """W = c E* g′ exp(s Ssk) at the threshold: valleys leave tops that are flatter than the rms slope says.

    Attributes
    ----------
    constant, skewness : c and s.
    spread, explained_alike : as of :class:`SealingLaw`.
    """

    constant: Constant
    skewness: Constant
    spread: float
    explained_alike: float


def skewed_law(sample: Sample) -> SkewedLaw:
    """Least squares of ln W."""
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
    """How far leakages lie apart once heights are scaled to the same s, at loads that are scaled with them.

    Attributes
    ----------
    scale : names of the scales of heights and of loads.
    apart : standard deviation of log10 K over surfaces and directions, for each of ``LOAD_FRACTIONS``.
    sealed : fraction of them that are sealed there and do not count.
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
    """log10 of K over the cube of a height by name, at W/(E* unit), in x and in y; nan where it is sealed."""
    place = load * MODULUS * (scale_of(one, unit) if unit else 1.0)
    with np.errstate(divide="ignore"):
        logs = np.log10(one.direct / (scale_of(one, height) if height else 1.0) ** 3)
    found = np.array([np.interp(np.log(place), np.log(one.loads), logs[:, i]) for i in (0, 1)])
    return np.where((place < one.threshold) & np.isfinite(found), found, np.nan)


@dataclass(frozen=True, kw_only=True)
class LeakageLaw:
    """K = s³ (a − b (W/(E* r))^(1/3))⁹, where it is above 0: a straight line in (K/s³)^(1/9), least squares.

    With s = r = Svm it is F.17 and F.18 of the source, read as Svm_d = (−0.023 (W/E)^(1/3) + 1.1 Svm^(1/3))³.

    Attributes
    ----------
    scale : s and r by name.
    a, b : b in m^(1/3) if r is a height.
    apart : rms of log10 of K over the law's, of open gaps that the law has open.
    missed : part of the open gaps that the law has sealed.
    explained : R² of the straight line.
    """

    scale: tuple[str, str]
    a: Constant
    b: Constant
    apart: float
    missed: float
    explained: float


def leakage_law(sample: Sample, height: str, load: str) -> LeakageLaw:
    """Fitted to the open gaps of all loads, both directions."""
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
    """(W/(E* r))^(1/3) and (K/s³)^(1/9) of the open gaps, shape (2, points)."""
    x = np.cbrt(one.loads / (MODULUS * scale_of(one, load)))
    y = (one.direct / scale_of(one, height) ** 3) ** (1 / 9)
    return np.concatenate([[x[y[:, i] > 0], y[y[:, i] > 0, i]] for i in (0, 1)], axis=1)


def misfit(expected: Array, found: Array) -> tuple[float, float]:
    """The rms of log10(found/expected) where expected is above 0, and the part where it is not."""
    known = expected > 0
    logs = np.log10(found[known] / expected[known])
    return float(np.sqrt(np.mean(logs**2))) if known.any() else float("nan"), float(1 - known.mean())


READINGS: dict[str, Callable[[Array, Array], Array]] = {
    "Svm_d = (−0.023 (W/E)^⅓ + 1.1 Svm^⅓)³": lambda load, valley: (-0.023 * np.cbrt(load) + 1.1 * np.cbrt(valley)) ** 3,
    "Svm_d = (−0.023 (W/E)^⅓ + 1.1) Svm": lambda load, valley: (-0.023 * np.cbrt(load) + 1.1) * valley,
    "Svm_d = −0.023 m (W/E)³ + 1.1 Svm": lambda load, valley: -0.023 * load**3 + 1.1 * valley,
}
"""F.17 as its extracted text can be read, of W/E* and Svm in m."""


@dataclass(frozen=True, kw_only=True)
class FormulaReading:
    """One reading of F.17 beside the surfaces.

    Attributes
    ----------
    valley, leakage : rms of log10 of Svm under load, and of K, over what is read and its cube (F.18).
    light : that of K up to a tenth of the load that seals.
    missed : part of the open gaps where it says that there is no valley left.
    scales : whether it is the same for a surface twice as high under twice the load, as elasticity has it.
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
"""Groups of the families."""


@dataclass(frozen=True, kw_only=True)
class GroupLaws:
    """Laws fitted to one group of surfaces.

    Attributes
    ----------
    sealing : by scale, the eight heights and the rms slope.
    skewed : with the skewness beside the slope.
    collapses : of leakage by the eight heights, as they are (""), and by a height with loads over the slope.
    leakage : of F.18's form: by Svm, as the source has it, and by Sp and the slope.
    readings : of F.17.
    """

    count: int
    sealing: Mapping[str, SealingLaw]
    skewed: SkewedLaw
    collapses: Sequence[Collapse]
    leakage: Mapping[tuple[str, str], LeakageLaw]
    readings: Sequence[FormulaReading]


@dataclass(frozen=True, kw_only=True)
class SealStudy:
    """Everything that is judged and drawn; ``measured`` is empty where the instrument files are absent.

    Attributes
    ----------
    sample : independent made surfaces.
    finer : the first of each family again on twice as many nodes a side.
    laws : by ``GROUPS``.
    """

    sample: Sequence[Pressed]
    finer: Sequence[Pressed]
    measured: Sequence[Pressed]
    sizes: Sizes
    laws: Mapping[str, GroupLaws]


def fit(sample: Sequence[Pressed]) -> GroupLaws:
    """Fit all laws of a group."""
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
    """The laws of each group that has surfaces."""
    groups = {name: [one for one in sample if counts(one)] for name, counts in GROUPS.items()}
    return {name: fit(members) for name, members in groups.items() if members}
