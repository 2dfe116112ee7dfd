"""The claims of Paper A, judged by the sweep."""

from collections.abc import Callable
from itertools import product

import numpy as np

from scripts.studies.paper_a.data import DEPTHS, NUMBERS, SHAPES, WIDTHS, PaperA, highest
from scripts.studies.study import Claim, Judgement, claims_of, verdict

CYLINDRICAL, AHEAD, LEVEL, BEHIND = SHAPES.values()
NEGLIGIBLE = 0.01
DEPTH = np.array(DEPTHS)


def judge(paper: PaperA, onsets: dict[tuple[str, float, float], float]) -> list[Claim]:
    """Judge claims 1 to 7; ``onsets`` gives the depth d+ at which back-flow begins, by shape, w+ and Re."""
    return claims_of(
        __file__,
        {
            1: inertia_carries(paper),
            2: load_grows(paper),
            3: optimum_depth(paper),
            4: optimum_at_onset(paper, onsets),
            5: friction_falls(paper),
            6: splined_against_cylindrical(paper),
            7: cylindrical_has_less_friction(paper),
        },
    )


def _verdict(part: float, *, whole: float = 0.99, some: float = 0.5) -> str:
    return verdict(part >= whole, partly=part >= some)


def inertia_carries(paper: PaperA) -> Judgement:
    """Judge claim 1."""
    worst = {}
    for name, shape in SHAPES.items():
        rows = paper.rows(shape)
        loads, stokes = paper.of("load_plus", rows), paper.of("load_plus", rows, paper.stokes)
        worst[name] = float(np.nanmax(np.abs(stokes) / np.abs(loads)))
    level = max(worst["cylindrical"], worst["splined, xd+ = 0"])
    shifted = max(worst["splined, xd+ = -0.3"], worst["splined, xd+ = 0.3"])
    return (
        verdict(max(level, shifted) <= NEGLIGIBLE, partly=level <= NEGLIGIBLE),
        f"symmetric grooves: Stokes load at most {level:.1e} of the Navier-Stokes load "
        "(the small positive load in Fig. A.4 is a discretisation error: creeping flow is reversible); grooves "
        f"with their lowest point off centre carry or lose load without inertia too, up to {shifted:.2g} times the "
        f"load with it",
    )


def load_grows(paper: PaperA) -> Judgement:
    """Judge claim 2."""
    grows_with_number, grows_with_width, exceptions = [], [], set()
    for name, shape in SHAPES.items():
        loads = np.array([paper.table(shape, "load_plus", number) for number in NUMBERS])
        grows_with_number.append(np.diff(loads, axis=0).ravel() > 0)
        with_width = np.diff(loads, axis=1) > 0
        grows_with_width.append(with_width.ravel())
        if not with_width.all():
            exceptions.add(name)
    by_number, by_width = (float(np.concatenate(kept).mean()) for kept in (grows_with_number, grows_with_width))
    return (
        _verdict(min(by_number, by_width)),
        f"the load grows in {by_number:.1%} of the steps of Re and in {by_width:.1%} of the steps of width"
        + ("; not always with width: " + ", ".join(sorted(exceptions)) if exceptions else ""),
    )


def _with_upwind(paper: PaperA, part: Callable[[str], float]) -> str:
    return "" if paper.upwind is None else f"; with first-order upwind {part(paper.upwind):.0%}"


def _optima(paper: PaperA, setting: str) -> dict[tuple[str, float, float], float]:
    return {
        (name, width, number): highest(DEPTH, loads)
        for (name, shape), number in product(SHAPES.items(), NUMBERS)
        for width, loads in zip(WIDTHS, paper.table(shape, "load_plus", number, setting), strict=True)
    }


def optimum_depth(paper: PaperA) -> Judgement:
    """Judge claim 3."""

    def inside(setting: str) -> float:
        values = np.array(list(_optima(paper, setting).values()))
        return float(((values > 0.5) & (values < 0.75)).mean())

    best, part = _optima(paper, paper.best), inside(paper.best)
    by_shape = ", ".join(
        f"{name}: {min(v):.2f} to {max(v):.2f}"
        for name in SHAPES
        if (v := [depth for key, depth in best.items() if key[0] == name])
    )
    return (
        _verdict(part, whole=0.9, some=0.4),
        f"{part:.0%} of the {len(best)} curves have their optimum there; {by_shape}{_with_upwind(paper, inside)}",
    )


def optimum_at_onset(paper: PaperA, onsets: dict[tuple[str, float, float], float]) -> Judgement:
    """Judge claim 4."""
    best = _optima(paper, paper.best)
    inner = [key for key in best if 0 < onsets[key] < DEPTHS[-1] and best[key] < DEPTHS[-1]]
    if not inner:
        return "false", "no curve has both an optimum and a vortex"
    optimum, onset = (np.array([depths[key] for key in inner]) for depths in (best, onsets))
    falls, turned = [], []
    for (name, shape), number in product(SHAPES.items(), NUMBERS):
        loads, back = (paper.table(shape, quantity, number) for quantity in ("load_plus", "backflow"))
        for width, load, back_flow in zip(WIDTHS, loads, back, strict=True):
            falls += list(np.diff(load)[DEPTH[:-1] >= onsets[name, width, number]] < 0)
            turned.append(np.interp(best[name, width, number], DEPTH, back_flow))
    ratio = optimum / onset
    near = float((np.abs(ratio - 1) < 0.2).mean())
    order_of_optima, order_of_onsets = (np.argsort(np.argsort(depths)) for depths in (optimum, onset))
    together = float(np.corrcoef(order_of_optima, order_of_onsets)[0, 1])
    return (
        verdict(near >= 0.9, partly=together > 0.6),
        f"both depths shrink with Re and grow with width (rank correlation {together:.2f}), but the depth "
        f"of the greatest load is {np.median(ratio):.2f} times that of the first back-flow (from {ratio.min():.2f} to "
        f"{ratio.max():.2f}; within 20 % of each other in {near:.0%} of {len(inner)} curves), where the reverse flow "
        f"has {np.median(turned):.1%} of the sliding speed; {np.mean(falls):.0%} of the steps in depth beyond the "
        f"onset lower the load",
    )


def friction_falls(paper: PaperA) -> Judgement:
    """Judge claim 5."""

    def exceptions(setting: str) -> list[tuple[float, float, float]]:
        """Width, depth and Re of the steps in depth over which friction does not fall."""
        return [
            (WIDTHS[i], DEPTHS[j], number)
            for shape, number in product(SHAPES.values(), NUMBERS)
            for i, j in np.argwhere(np.diff(paper.table(shape, "friction_plus", number, setting), axis=1) >= 0)
        ]

    def in_words(found: list[tuple[float, float, float]]) -> str:
        if not found:
            return "friction falls in every step of depth"
        width, number = max(width for width, _, _ in found), min(number for *_, number in found)
        return f"friction rises in {len(found)} steps of depth, all at w+ <= {width:g} and Re >= {number:g}"

    tables = [paper.table(shape, "friction_plus", number) for shape, number in product(SHAPES.values(), NUMBERS)]
    by_width = float(np.mean([np.diff(table, axis=0) < 0 for table in tables]))
    found = exceptions(paper.best)
    narrow_only = bool(found) and max(width for width, _, _ in found) < 0.35
    upwind = "" if paper.upwind is None else f"; with first-order upwind {in_words(exceptions(paper.upwind))}"
    falls = by_width > 0.99 and (narrow_only or not found)
    return (
        verdict(falls and narrow_only, partly=falls),
        f"{in_words(found)} and in {by_width:.0%} of the steps of width{upwind}",
    )


def splined_against_cylindrical(paper: PaperA) -> Judgement:
    """Judge claim 6."""

    def share(setting: str, number: float) -> float:
        """Return the fraction of widths at which the splined groove carries more, each shape at its best depth."""
        ahead, cylindrical = (paper.table(shape, "load_plus", number, setting) for shape in (AHEAD, CYLINDRICAL))
        return float((ahead.max(axis=1) > cylindrical.max(axis=1)).mean())

    low, high = share(paper.best, 40.0), share(paper.best, 160.0)
    upwind = ""
    if paper.upwind is not None:
        upwind = f"; with first-order upwind {share(paper.upwind, 40.0):.0%} and {share(paper.upwind, 160.0):.0%}"
    return (
        _verdict(min(low, 1 - high)),
        f"each at its best depth, the splined one carries more in {low:.0%} of the widths at Re = 40 and in "
        f"{high:.0%} at Re = 160{upwind}",
    )


def cylindrical_has_less_friction(paper: PaperA) -> Judgement:
    """Judge claim 7."""
    less = [
        (paper.table(CYLINDRICAL, "friction_plus", number) < paper.table(shape, "friction_plus", number)).ravel()
        for number in NUMBERS
        for shape in (AHEAD, LEVEL, BEHIND)
    ]
    part = float(np.concatenate(less).mean())
    return (
        _verdict(part),
        f"true in {part:.1%} of the pairs of equal width, depth and Re",
    )
