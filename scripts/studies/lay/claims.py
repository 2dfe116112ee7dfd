"""Claims 20, 21 and 26 of the source judged: bad joints, Patir and Cheng, and an offset at contact."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import spearmanr

from scripts.studies.lay.data import THICKNESSES, FactorPair, Turned, angle
from scripts.studies.lay.joint import Joint, Joints, lowest
from scripts.studies.lay.measured import OBLIQUE, MeasuredLay
from scripts.studies.lay.offset import MADE, OFFSET, Offset
from scripts.studies.study import Claim, Judgement, claims_of, verdict

EQUAL_FACTORS, BOX_SCATTER, FAILED_DIFFERENCE = 0.02, 0.1, 0.2
"""Differences relative to A: of equal factors, by the scatter of one finite box, and of a failed method."""

OPEN_GAP_FACTOR = 0.1
"""Flow factor A/ĥ³ above which a gap counts as open."""

HARMLESS_INCREASE = 0.05
"""Largest relative increase of A by a harmless offset."""

GOOD_JOINT = 0.1
"""Periodicity mismatch below which there is no warning."""


@dataclass(frozen=True, kw_only=True)
class Lay:
    """Everything that is judged and drawn; ``measured`` is empty where the instrument files are absent."""

    turned: Turned
    measured: Mapping[str, MeasuredLay]
    joints: Joints
    offsets: Mapping[str, Sequence[Offset]]


def judge(lay: Lay) -> list[Claim]:
    """Judge claims 20, 21 and 26."""
    judgements = {20: joint_throttles(lay.joints), 21: box_equals_cell(lay), 26: offset_is_harmless(lay.offsets)}
    return claims_of(__file__, judgements)


def joint_throttles(joints: Joints) -> Judgement:
    """Judge claim 20."""
    cut = [one for row in joints.cut.values() for one in row]
    measured = {name: row for name, row in joints.measured.items() if name != OBLIQUE}
    bad = [one for one in cut + list(joints.windows) if one.mismatch[0] > GOOD_JOINT]
    good = [one for one in cut if one.mismatch[0] < GOOD_JOINT]
    lost = [1 - one.passed[0] for one in bad]
    harm = min(lost) > 0 and max(lost) > 0.1
    clean = max(abs(1 - one.passed[0]) for one in good) < EQUAL_FACTORS
    order = [_order([one for one in cut if one.thickness == thickness]) for thickness in THICKNESSES]
    rows = {
        "grooves that end between two others": (lowest, cut),
        "random striated windows on average": (_mean, joints.windows),
        "the worst of them": (lowest, joints.windows),
    } | {name: (lowest, row) for name, row in measured.items()}
    said = "; ".join(
        f"{name} {_all([of(row, thickness)[0] for thickness in THICKNESSES])}"
        f" (edges blended: {_all([of(row, thickness)[1] for thickness in THICKNESSES])})"
        for name, (of, row) in rows.items()
    )
    return (
        verdict(harm and clean, partly=max(lost) > 0.1),
        f"flow along the lay over that without a joint, at {', '.join(f'{t:g}' for t in THICKNESSES)} Sq: "
        f"{said}. Windows whose grooves meet pass at least {_share(min(one.passed[0] for one in good))}. The loss of "
        f"cut grooves is ordered by periodicity_mismatch (rank correlation at least {min(order):.2f}); its size "
        f"depends on the thickness of the film more than on the mismatch. Blended edges restore a small part of the "
        f"flow, a window that fits restores all",
    )


def _order(joints: Sequence[Joint]) -> float:
    lost, mismatch = np.transpose([(1 - one.passed[0], one.mismatch[0]) for one in joints])
    rounded = np.round(lost, 3)
    return float(spearmanr(rounded, np.round(mismatch, 3)).statistic) if np.ptp(rounded) > 0 else 0.0


def _all(parts: Sequence[float]) -> str:
    return ", ".join(f"{100 * part:.3g}" for part in parts) + " %"


def _mean(joints: Sequence[Joint], thickness: float) -> tuple[float, float]:
    raw, after = np.nanmean([one.passed for one in joints if one.thickness == thickness], axis=0)
    return float(raw), float(after)


def _share(part: float) -> str:
    return f"{100 * part:.3g} %"


def worst(found: Sequence[FactorPair]) -> float:
    """The largest |φ/A − 1| of both directions."""
    return float(np.nanmax(np.abs([one.short for one in found])))


def box_equals_cell(lay: Lay) -> Judgement:
    """Judge claim 21."""
    turned = lay.turned

    def of(texture: str, *, straight: bool) -> list[FactorPair]:
        return [
            one
            for (name, _, turn), one in turned.found.items()
            if name == texture and (straight == (min(turn) == 0)) and (straight or angle(turn) == np.pi / 4)
        ]

    straight, oblique = worst(of("grooves", straight=True)), of("grooves", straight=False)
    crossed, crossed_oblique = worst(of("crossed grooves", straight=True)), of("crossed grooves", straight=False)
    scatter = [float(np.sqrt(np.nanmean(np.square([o.short for o in row])))) for row in turned.isotropic.values()]
    random = [worst([o]) for o in of("random lay", straight=True)]
    as_said = straight < EQUAL_FACTORS and max(scatter) < BOX_SCATTER and worst(oblique) > FAILED_DIFFERENCE
    across = max(one.cell.pressure[0, 1] / one.cell.pressure[0, 0] for one in crossed_oblique)
    said = "".join(
        f"; {one.name} where it touches: φ₁ {row.box.pressure[0]:.3g} and φ₂ {row.box.pressure[1]:.3g}, A₁₁ "
        f"{row.cell.pressure[0, 0]:.3g}, A₂₂ {row.cell.pressure[1, 1]:.3g}, A₁₂ {row.cell.pressure[0, 1]:.3g}"
        for one in lay.measured.values()
        if (row := one.found.get(1)) is not None
    )
    return (
        verdict(as_said and min(crossed, worst(crossed_oblique)) > FAILED_DIFFERENCE, partly=as_said),
        f"at {', '.join(f'{t:g}' for t in THICKNESSES)} Sq: straight grooves within {straight:.0e}, "
        f"isotropic surfaces equal within the scatter of one box (rms {', '.join(map(_share, scatter))}), straight "
        f"random lay too (largest {_share(max(random))}); grooves at 45° "
        + ", ".join(f"{100 * one.short[0]:+.3g} %" for one in oblique)
        + f". Crossed grooves as such do not fail: they are equal within {_share(crossed)} where their bisector lies "
        f"along or across the flow; turned by 45° φ₁ is {100 * min(one.short[0] for one in crossed_oblique):+.2g} % at "
        f"worst, although A₁₂, which the method lacks, is up to {across:.2g} A₁₁. The method fails because of "
        f"A₁₂, not of crossing: φ₁φ₂ = A₁₁A₂₂ − A₁₂² in any large box{said}",
    )


def offset_is_harmless(offsets: Mapping[str, Sequence[Offset]]) -> Judgement:
    """Judge claim 26."""
    added = {name: max(_added(one) for one in row) for name, row in offsets.items()}
    coarse = next(iter(MADE))
    leaks = {
        name: [one.slit[one.closed == 0] for one in row if (one.closed == 0).any()] for name, row in offsets.items()
    }
    invented = {name: np.nanmax(np.concatenate(values)) for name, values in leaks.items() if values}
    gave_up = sum(bool(np.isnan(one.offset).any()) for row in offsets.values() for one in row)
    questions = sum(len(row) for row in offsets.values())
    harmless = added[coarse] < HARMLESS_INCREASE
    return (
        verdict(not invented and max(added.values()) < HARMLESS_INCREASE, partly=harmless),
        f"undeformed contact; while A > {OPEN_GAP_FACTOR:g} ĥ³ it adds at most "
        + ", ".join(f"{_share(part)} ({name})" for name, part in added.items())
        + f", about 3 · {1e9 * OFFSET:g} nm over the channels' height. Near sealing the increase has no bound, and "
        "a sealed gap leaks like a smooth slit of "
        + ", ".join(f"{1e9 * slit:.2g} nm ({name})" for name, slit in invented.items())
        + f": nothing is ever sealed. The solver failed for {gave_up} of {questions} gaps with the offset, and "
        "for none with closed contact",
    )


def _added(one: Offset) -> float:
    """Return the largest relative increase in an open gap; 0 where there is none."""
    return float(np.nanmax(np.where(one.relative > OPEN_GAP_FACTOR, one.added, 0.0), initial=0.0))
