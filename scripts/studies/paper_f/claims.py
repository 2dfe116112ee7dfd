"""Judgement of claims 16, 19 and 23 to 26 of Paper F."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.paper_f.data import MODULUS, Pressed
from scripts.studies.paper_f.fits import DIRECTED, LOAD_FRACTIONS, SLOPE, Constant, GroupLaws, SealStudy
from scripts.studies.paper_f.surfaces import HEIGHTS
from scripts.studies.study import Claim, Judgement, claims_of, verdict

COMPARED_LOAD, COMPARED_REDUCED_LOAD = 1e5, 0.1
"""Load W, Pa, and reduced load W/(E* g′) at which areas are compared."""

RANGE = (0.33, 0.55)
"""Range of the real area of contact at the threshold in the source."""

SEALING = 3.6e4
"""Constant k of Eq. F.14 in the source, 1/m."""

LEAKAGE = (1.1, 0.023)
"""Constants a and b, m^(1/3), of Eq. F.18 in the source."""

FEW_PER_CENT = 0.05
"""The few per cent of the claims, as a fraction."""

BINS = ((0.0, 0.1), (0.1, 0.5), (0.5, 0.9), (0.9, 1.0))
"""Fractions of the sealing load between which DNS and HNS, and the offset, are compared."""

ROUNDING = 1e-9
"""Relative tolerance of the ends of an interval."""

VALLEYS, PEAKS = ("Sv", "Svm"), ("Sp", "Spm")


def judge(study: SealStudy) -> list[Claim]:
    """Judge claims 16, 19, 23, 24, 25 and 26."""
    return claims_of(
        __file__,
        {
            16: areas_differ(study),
            19: cell_equals_direct(study.sample),
            23: lost_between(study),
            24: peaks_rule_sealing(study.laws),
            25: valleys_rule_leakage(study),
            26: offset_is_harmless(study.sample),
        },
    )


def area_at(one: Pressed, load: float) -> float:
    """Return the area fraction under a load, Pa; nan outside of the computed loads."""
    return float(np.interp(load, one.loads, one.area, left=np.nan, right=np.nan))


def areas_differ(study: SealStudy) -> Judgement:
    """Judge the part of claim 16 on surfaces in three dimensions."""
    same_load = np.array([area_at(one, COMPARED_LOAD) for one in study.sample])
    alike = np.array([area_at(one, COMPARED_REDUCED_LOAD * MODULUS * one.numbers.slope) for one in study.sample])
    same_load, alike = same_load[np.isfinite(same_load)], alike[np.isfinite(alike)]
    apart, left = float(same_load.max() / same_load.min()), float(alike.std() / alike.mean())
    return (
        verdict(apart > 2, partly=apart > 1.25),
        f"at {COMPARED_LOAD / 1e6:g} MPa the area is {_share(same_load.min())} to {_share(same_load.max())} "
        f"({apart:.2g} times). The rms slope makes the difference: at W/(E* g′) = {COMPARED_REDUCED_LOAD:g} all have "
        f"{_share(float(alike.mean()))} ± {_share(float(alike.std()))}, a relative spread of {_share(left)}. The "
        "profiles that hardly differ (study paper_d) are of steel and mostly plastic, with an area of W/H "
        "for every roughness; an elastomer has no such bound, in the plane or in space",
    )


def above_the_cell(sample: Sequence[Pressed]) -> tuple[Array, Array]:
    """Return the loads over the sealing load of the cell, and K/A − 1, for all open gaps."""
    rows = []
    for one in sample:
        for i in (0, 1):
            is_open = (one.flow[:, i] > 0) & (one.loads < one.round_threshold[i])
            parts = one.loads[is_open] / one.round_threshold[i]
            rows.append(np.stack([parts, one.direct[is_open, i] / one.flow[is_open, i] - 1]))
    parts, more = np.concatenate(rows, axis=1)
    return parts, more


def cell_equals_direct(sample: Sequence[Pressed]) -> Judgement:
    """Judge claim 19, on homogenized and direct leakage."""
    parts, more = above_the_cell(sample)
    said, within = [], []
    for low, high in BINS:
        chosen = 1 + more[(parts >= low) & (parts < high)]
        if chosen.size:
            within.append(float((np.abs(chosen - 1) < FEW_PER_CENT).mean()))
            said.append(
                f"{low:g} to {high:g}: median {np.median(chosen):.3g}, a tenth above {np.percentile(chosen, 90):.3g}, "
                f"{_share(within[-1])} within {_share(FEW_PER_CENT)}"
            )
    earlier = np.array([one.round_threshold < one.threshold / 1.01 for one in sample])
    return (
        verdict(min(within) > 0.9, partly=within[0] > 0.5),
        "DNS of one period between two reservoirs is never below HNS. DNS/HNS at fractions of the "
        f"sealing load: {'; '.join(said)}. A path between ends need not end where it began: "
        f"{_share(float(earlier.mean()))} of the directions are sealed by HNS at a load at which DNS still leaks. "
        "The cell assumes many waves in a period, and these surfaces have few; over the six decades of Fig. F.9 both "
        "agree at light loads",
    )


def lost_between(study: SealStudy) -> Judgement:
    """Judge claim 23, on the contact area at the threshold."""
    area = np.array([one.sealed_area for one in study.sample])
    inside = (area >= RANGE[0]) & (area <= RANGE[1])
    directed = np.array([one.family in DIRECTED for one in study.sample])
    part = float(inside.mean())
    plain = area[~directed]
    said = f"area at the threshold {_share(float(area.min()))} to {_share(float(area.max()))}, {_share(part)} inside"
    if directed.any() and plain.size:
        lay = area[directed]
        said += (
            f"; without a lay {_share(float(plain.min()))} to {_share(float(plain.max()))}, mean "
            f"{_share(float(plain.mean()))} ± {_share(float(plain.std()))}, {_share(float(inside[~directed].mean()))} "
            f"inside; with one {_share(float(lay.min()))} (across) to {_share(float(lay.max()))} (along)"
        )
    sizes = "; ".join(
        f"{lengths:.3g} correlation lengths a side: {_share(float(one[:, :2].mean()))} ± "
        f"{_share(float(one[:, :2].std()))}"
        for lengths, one in study.sizes.area.items()
    )
    return (
        verdict(inside.all(), partly=bool(plain.size) and inside[~directed].mean() > 0.5),
        f"{said}. The range is that of small surfaces, not a law: for one kind of random surface, {sizes}",
    )


def peaks_rule_sealing(laws: Mapping[str, GroupLaws]) -> Judgement:
    """Judge claim 24, on the sealing load and the heights of peaks."""
    every = laws["all"]
    spreads = {name: every.sealing[name].spread for name in HEIGHTS}
    first, last = min(spreads, key=spreads.__getitem__), max(spreads, key=spreads.__getitem__)
    rule, k = first in PEAKS, every.sealing["Spm"].constant
    holds = _inside(SEALING, k.by_family)
    slope = every.sealing[SLOPE]
    others = "; ".join(
        f"{name}: k = {_digits(one.sealing['Spm'].constant.value, 3)}/m, spread {one.sealing['Spm'].spread:.3g}, "
        f"{SLOPE} {one.sealing[SLOPE].spread:.3g}"
        for name, one in laws.items()
        if name != "all"
    )
    return (
        verdict(rule and holds, partly=rule or holds),
        f"of the eight heights {first} orders the loads best (standard deviation of the ratio: a factor of "
        f"{spreads[first]:.3g}; Spm {spreads['Spm']:.3g}, Sq {spreads['Sq']:.3g}, {last} {spreads[last]:.3g}, the "
        f"worst). k, 1/m: {_constant(k, 3)}; the source's {SEALING:g} is "
        f"{'inside' if holds else 'outside'}, and k contains a wavelength: it is half as large for a surface twice as "
        f"long. The dimensionless law is W = {slope.constant.value:.3g} E* {SLOPE} "
        f"({_interval(slope.constant.by_surface, 3)}), spread {slope.spread:.3g}, with "
        f"exp({every.skewed.skewness.value:.2g} Ssk) beside it {every.skewed.spread:.3g}. R² at equal Sq: Spm "
        f"{every.sealing['Spm'].explained_alike:.2f}, {SLOPE} {slope.explained_alike:.2f}, with Ssk "
        f"{every.skewed.explained_alike:.2f} (the range of Sa, 0.06 to 0.48 µm, raises R² for every height: "
        f"{every.sealing['Spm'].explained:.2f} and {slope.explained:.2f}). {others}",
    )


def valleys_rule_leakage(study: SealStudy) -> Judgement:
    """Judge claim 25, on the leakage and the depths of valleys."""
    every = study.laws["all"]
    apart = {one.scale[0]: one.apart for one in every.collapses if one.scale[0] and one.scale[0] == one.scale[1]}
    best = [min((values[k], name) for name, values in apart.items())[1] for k in (0, 1)]
    rule = all(name in VALLEYS for name in best)
    law = every.leakage["Svm", "Svm"]
    holds = [_inside(said, one.by_family) for said, one in zip(LEAKAGE, (law.a, law.b), strict=True)]
    spread = "; ".join(
        f"{name} {', '.join(f'{10**value:.3g}' for value in apart[name])}" for name in ("Svm", "Sq", "Spm", "Sp")
    )
    better = every.leakage["Sp", SLOPE]
    reading = every.readings[0]
    others = "".join(
        f"; {name}: {10 ** one.readings[0].light:.2g} and {10 ** one.readings[0].leakage:.2g}"
        for name, one in study.laws.items()
        if name != "all"
    )
    return (
        verdict(rule and all(holds), partly=rule or all(holds)),
        "standard deviation of the leakage of surfaces scaled to the same height, as a factor, at "
        f"{', '.join(f'{part:g}' for part in LOAD_FRACTIONS)} of the load that seals: {spread}; best "
        f"{' and '.join(best)} at the lighter loads. This must be so: "
        "at the first touch the mean gap is Sp, hence Q̃ → φ (Sp/Svm)³. "
        f"F.18 read as K = (1.1 Svm^⅓ − 0.023 (W/E*)^⅓)⁹: fitted a = {_constant(law.a, 3)}, b = "
        f"{_constant(law.b, 3)} m^⅓; the constants of the source {'lie' if all(holds) else 'do not both lie'} within "
        f"the intervals over families, "
        f"with an error of K by a factor of {10**reading.light:.2g} (rms) below a tenth of the load that seals and "
        f"{10**reading.leakage:.2g} over all{others}. b, like k, contains a wavelength. K = Sp³ ({better.a.value:.3g} "
        f"− {better.b.value:.3g} (W/(E* {SLOPE}))^⅓)⁹ has R² {better.explained:.2f} instead of {law.explained:.2f}",
    )


@dataclass(frozen=True, kw_only=True)
class Subtracted:
    """The leakage by the method of the source: with an offset of 10 nm, minus the leakage at the threshold.

    Attributes
    ----------
    part : load over the sealing load of the cell.
    average : Sa, m.
    added : leakage added by the offset alone, over the leakage with closed contact.
    error : relative error after the subtraction.
    """

    part: Array
    average: Array
    added: Array
    error: Array


def subtracted(sample: Sequence[Pressed]) -> Subtracted:
    """Return the values of all open gaps of cells for which the solver converged."""
    rows = []
    for one in sample:
        for i in (0, 1):
            chosen = (one.flow[:, i] > 0) & (one.loads < one.round_threshold[i]) & np.isfinite(one.offset[:, i])
            flow, raised = one.flow[chosen, i], one.offset[chosen, i]
            average = np.full(flow.shape, one.numbers.heights["Sa"])
            rows.append(
                np.stack(
                    [
                        one.loads[chosen] / one.round_threshold[i],
                        average,
                        raised / flow - 1,
                        (raised - one.sealed_offset[i]) / flow - 1,
                    ]
                )
            )
    part, average, added, error = np.concatenate(rows, axis=1)
    return Subtracted(part=part, average=average, added=added, error=error)


def offset_is_harmless(sample: Sequence[Pressed]) -> Judgement:
    """Judge claim 26, on the offset, by the synthetic surfaces."""
    found = subtracted(sample)
    middle = float(np.sqrt(found.average.min() * found.average.max()))
    said, medians = [], []
    for low, high in BINS:
        chosen = (found.part >= low) & (found.part < high)
        if chosen.any():
            medians.append(float(np.median(found.error[chosen])))
            sides = [chosen & side for side in (found.average >= middle, found.average < middle)]
            both = [
                f"{1 + float(np.median(found.added[side])):.3g} ({1 + float(np.median(found.error[side])):.3g})"
                for side in sides
                if side.any()
            ]
            said.append(f"{low:g} to {high:g}: {' and '.join(both)}")
    slit = np.array([np.cbrt(one.sealed_offset) for one in sample])
    return (
        verdict(max(map(abs, medians)) < FEW_PER_CENT, partly=abs(medians[0]) < 2 * FEW_PER_CENT),
        "leakage over that with closed contact (and after the subtraction), medians of surfaces rougher and "
        f"smoother than Sa {1e6 * middle:.2g} µm, at fractions of the sealing load: {'; '.join(said)}. At the "
        f"threshold the 10 nm alone leak like a slit of {1e9 * np.nanmin(slit):.2g} to {1e9 * np.nanmax(slit):.2g} nm; "
        "subtracting this is right at one load only, and the decrease over decades becomes a gentle one",
    )


def _inside(value: float, interval: tuple[float, float]) -> bool:
    return interval[0] * (1 - ROUNDING) <= value <= interval[1] * (1 + ROUNDING)


def _constant(one: Constant, digits: int) -> str:
    return (
        f"{_digits(one.value, digits)} (95 %: {_interval(one.by_surface, digits)} over surfaces, "
        f"{_interval(one.by_family, digits)} over families)"
    )


def _interval(interval: tuple[float, float], digits: int) -> str:
    return " to ".join(_digits(value, digits) for value in interval)


def _digits(value: float, digits: int) -> str:
    """Return a number with ``digits`` significant digits, without an exponent."""
    return f"{float(f'{value:.{digits}g}'):.10g}"


def _share(part: float) -> str:
    return f"{100 * part:.3g} %"
