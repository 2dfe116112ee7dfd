"""Judgement of claims 19, 21 and 22 of the source by windows of a milled surface and by a thrust washer."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.words.numbers import with_error
from scripts.studies.paper_e.data import LOADS, SEEDS, Washer
from scripts.studies.paper_e.windows import LOAD, PARTS, Leak
from scripts.studies.study import Claim, Judgement, claims_of, verdict

FEW_PER_CENT = 0.05
"""Relative difference below which two leakages count as equal."""

EQUAL_LIFT_OFF, DIFFERENT_LIFT_OFF = 0.02, 0.1
"""Largest relative difference of lift-off speeds that are equal, and least one of those that differ."""

STRAIGHT_LAYS, CROSSED_LAY = ("surface 1", "surface 3"), "surface 2"
MEASURED = ("milled", "ground")
AXES = "xy"


@dataclass(frozen=True, kw_only=True)
class PaperE:
    """All data that are judged and drawn; ``windows`` is empty if the instrument files are absent.

    Attributes
    ----------
    windows : leaks through the windows.
    rows : number of periods in a row of the window with the largest end effect, and relative excess of the direct flow.
    washers : washers by surface, with both methods.
    lays : washers by lay and seed, with the names of :func:`scripts.studies.paper_e.data.lays`.
    """

    windows: Sequence[Leak]
    rows: Sequence[tuple[int, float]]
    washers: Mapping[str, Washer]
    lays: Mapping[str, Washer]


def judge(paper: PaperE) -> list[Claim]:
    """Judge claims 21 and 22, and claim 19 if the milled surface is available."""
    direct = {19: direct_is_homogenized(paper.windows, paper.rows)} if paper.windows else {}
    return claims_of(__file__, direct | {21: methods_agree(paper.washers), 22: lift_off(paper)})


def direct_is_homogenized(windows: Sequence[Leak], rows: Sequence[tuple[int, float]]) -> Judgement:
    """Judge claim 19, on direct and homogenized leakage."""
    usual = [one for one in windows if one.resolution == 1.0]
    parts = {
        window: np.array([[one.apart(axis) for axis in (0, 1)] for one in usual if _is(one, window, LOAD)])
        for window in PARTS
    }
    crushed = max(one.load for one in usual)
    hard = np.array([[one.apart(axis) for axis in (0, 1)] for one in usual if _is(one, "a", crushed)])
    within = float(np.mean(np.concatenate([found.ravel() for found in parts.values()]) < FEW_PER_CENT))
    shown = "; ".join(
        f"window {window} ({PARTS[window]:.2g} of the sides, {found.shape[0]} place{'s' * (len(found) > 1)}) "
        f"{_share(float(np.median(found)))}, {_share(found.min())} to {_share(found.max())}"
        for window, found in parts.items()
    )
    longer = ", ".join(_share(part) for _, part in rows)
    return (
        verdict(within > 0.95, partly=within > 0.3),
        "the flow through one window between two reservoirs is always larger than through the window repeated "
        f"without end, because flow also enters valleys that do not continue: at {LOAD / 1e6:g} MPa by (median and "
        f"range) {shown}; {_share(within)} of all within {_share(FEW_PER_CENT)}. The largest difference falls with "
        f"the number of windows in a row, not with their size alone: {longer} over "
        f"{', '.join(str(count) for count, _ in rows)} of them. Under load few channels remain and one window is less "
        f"representative: window a "
        + ", ".join(f"{_share(hard[0, axis])} along {AXES[axis]}" for axis in (0, 1))
        + f" at {crushed / 1e6:g} MPa",
    )


def worst_cell(windows: Sequence[Leak]) -> tuple[Leak, int]:
    """Return the cell and the direction with the largest effect of the ends of one window, under the usual load."""
    usual = [(one, axis) for one in windows if one.resolution == 1.0 and one.load == LOAD for axis in (0, 1)]
    return max(usual, key=lambda pair: pair[0].apart(pair[1]))


def _is(one: Leak, window: str, load: float) -> bool:
    return one.window == window and one.load == load


def parted(washer: Washer) -> Array:
    """Return the relative excess of Patir and Cheng's lift-off speed over the homogenized one, shape (loads,)."""
    return np.asarray(washer.lift(boxed=True)[:, 0] / washer.lift()[:, 0] - 1)


def methods_agree(washers: Mapping[str, Washer]) -> Judgement:
    """Judge claim 21, by lift-off speeds."""
    straight = max(float(np.abs(parted(washers[name])).max()) for name in STRAIGHT_LAYS)
    crossed = parted(washers[CROSSED_LAY])
    least = float(np.abs(crossed).min())
    bars = washers[CROSSED_LAY].lift()
    uncertainty = float((bars[:, 1] / bars[:, 0]).max())
    there = [name for name in MEASURED if name in washers]
    said = "".join(
        f"; {name}, measured, {' / '.join(_signed(part) for part in parted(washers[name]))}" for name in there
    )
    holds = straight < EQUAL_LIFT_OFF and least > max(DIFFERENT_LIFT_OFF, uncertainty)
    return (
        verdict(holds, partly=straight < EQUAL_LIFT_OFF or least > DIFFERENT_LIFT_OFF),
        f"lift-off speeds by Patir and Cheng over the homogenized ones, at "
        f"{', '.join(f'{load / 1e6:g}' for load in LOADS)} MPa: straight lays within {_share(straight)}; marks that "
        f"cross obliquely, one of them deeper, {' / '.join(_signed(part) for part in crossed)} (± "
        f"{_share(uncertainty)} by grids and tables), films differ by up to "
        f"{_share(washers[CROSSED_LAY].apart())}{said}. "
        f"The method lacks A₁₂ and B₂: such a lay pumps sideways. Marks that cross symmetrically about the sliding "
        f"have neither, and both methods agree (scripts.studies.lay)",
    )


def lay_lifts(lays: Mapping[str, Washer], lay: str) -> Array:
    """Return the lift-off speeds of surface 3 with a lay, revolutions per minute, shape (seeds, loads)."""
    return np.array([lays[f"{lay}, {seed}"].lift()[:, 0] for seed in SEEDS])


def lift_off(paper: PaperE) -> Judgement:
    """Judge claim 22, on lift-off by load and lay."""
    found = {name: one.lift() for name, one in (*paper.washers.items(), *paper.lays.items())}
    rises = all((np.diff(lift[:, 0]) > lift[:-1, 1] + lift[1:, 1]).all() for lift in found.values())
    along, across = lay_lifts(paper.lays, "along"), lay_lifts(paper.lays, "across")
    outwards, inwards = lay_lifts(paper.lays, "+45°"), lay_lifts(paper.lays, "-45°")
    bar = float(np.mean([found[f"along, {seed}"][:, 1] / found[f"along, {seed}"][:, 0] for seed in SEEDS]))
    first = paper.washers["surface 1"].lift()[:, 0] / paper.lays["surface 1, across"].lift()[:, 0] - 1
    changes = np.concatenate([(along / across - 1).ravel(), first])
    lowers, raises = bool((changes < -bar).all()), bool((changes > bar).all())
    names = list(paper.washers)
    order = " < ".join(sorted(names, key=lambda name: found[name][1, 0]))
    one = f"{LOADS[1] / 1e6:g} MPa"
    helps = (
        "they lower the speed" if lowers else "they raise the speed" if raises else "which is within the uncertainty"
    )
    return (
        verdict(rises and lowers, partly=rises or lowers),
        f"at {', '.join(f'{load / 1e6:g}' for load in LOADS)} MPa walls lift off at "
        + "; ".join(f"{name} {_speeds(found[name])}" for name in names)
        + f" rpm: {'always later' if rises else 'not always later'} under more load ({order} at {one}). Ridges across "
        "the leakage against the same ridges along it: surface 3 "
        + ", ".join(_signed(float(change)) for change in (along / across - 1).mean(axis=1))
        + f" ({len(SEEDS)} samples), surface 1 {_signed(float(first.mean()))}, {helps} (± {_share(bar)}): they "
        "hold back flow across and pass more along the sliding. An oblique lay matters: at "
        f"{one} lift-off over ridges that lead outwards with the sliding wall (+45°) is at "
        f"{outwards.mean(axis=0)[1]:.3g} rpm, inwards (−45°) at {inwards.mean(axis=0)[1]:.3g}, along the sliding at "
        f"{along.mean(axis=0)[1]:.3g}. So the late lift-off over marks that cross comes from their sideways pumping, "
        f"not from more leakage",
    )


def _speeds(lift: Array) -> str:
    return " / ".join(with_error(*row) for row in lift)


def _share(part: float) -> str:
    return f"{100 * part:.2g} %"


def _signed(part: float) -> str:
    return f"{100 * part:+.2g} %"
