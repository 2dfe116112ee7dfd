"""What Paper A claims, judged by the sweep: each with a verdict and the numbers it rests on."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from scripts.paper_a_data import DEPTHS, NUMBERS, SHAPES, WIDTHS, Paper, highest

CYLINDRICAL, AHEAD, LEVEL, BEHIND = SHAPES.values()
NEGLIGIBLE = 0.01
DEPTH = np.array(DEPTHS)


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One claim, whether it holds, and the evidence."""

    number: int
    text: str
    verdict: str
    evidence: str


def judge(paper: Paper, onsets: dict[tuple[str, float, float], float]) -> list[Claim]:
    """Claims 1 to 7; ``onsets`` gives the depth d+ at which the flow first turns back, by shape, w+ and Re."""
    return [
        inertia_carries(paper),
        load_grows(paper),
        optimum_depth(paper),
        optimum_at_onset(paper, onsets),
        friction_falls(paper),
        splined_against_cylindrical(paper),
        cylindrical_rubs_less(paper),
    ]


def _verdict(part: float, *, whole: float = 0.99, some: float = 0.5) -> str:
    return "true" if part >= whole else "partly" if part >= some else "false"


def inertia_carries(paper: Paper) -> Claim:
    """Claim 1."""
    worst = {}
    for name, shape in SHAPES.items():
        rows = paper.rows(shape)
        loads, stokes = paper.of("load_plus", rows), paper.of("load_plus", rows, paper.stokes)
        worst[name] = float(np.nanmax(np.abs(stokes) / np.abs(loads)))
    level = max(worst["cylindrical"], worst["splined, xd+ = 0"])
    shifted = max(worst["splined, xd+ = -0.3"], worst["splined, xd+ = 0.3"])
    verdict = "false" if level > NEGLIGIBLE else "true" if shifted <= NEGLIGIBLE else "partly"
    return Claim(
        number=1,
        text="Parallel textured surfaces carry load by inertia; Stokes gives (almost) none",
        verdict=verdict,
        evidence=f"symmetric grooves: Stokes load at most {level:.1e} of the Navier-Stokes load "
        "(the small positive one of Fig. A.4 is a discretisation error: creeping flow is reversible); grooves with "
        f"their lowest point aside carry or lose load without inertia too, up to {shifted:.2g} times the load with it",
    )


def load_grows(paper: Paper) -> Claim:
    """Claim 2."""
    grows_with_number, grows_with_width, exceptions = [], [], set()
    for name, shape in SHAPES.items():
        loads = np.array([paper.table(shape, "load_plus", number) for number in NUMBERS])
        grows_with_number.append(np.diff(loads, axis=0).ravel() > 0)
        with_width = np.diff(loads, axis=1) > 0
        grows_with_width.append(with_width.ravel())
        if not with_width.all():
            exceptions.add(name)
    by_number, by_width = (float(np.concatenate(kept).mean()) for kept in (grows_with_number, grows_with_width))
    return Claim(
        number=2,
        text="Load grows with Re and with groove width",
        verdict=_verdict(min(by_number, by_width)),
        evidence=f"from one Re to the next it grows in {by_number:.1%} of the steps, from one width to the next in "
        f"{by_width:.1%}" + ("; not always with width: " + ", ".join(sorted(exceptions)) if exceptions else ""),
    )


def _optima(paper: Paper, setting: str | None = None) -> dict[tuple[str, float, float], float]:
    return {
        (name, width, number): highest(DEPTH, loads)
        for (name, shape), number in product(SHAPES.items(), NUMBERS)
        for width, loads in zip(WIDTHS, paper.table(shape, "load_plus", number, setting), strict=True)
    }


def optimum_depth(paper: Paper) -> Claim:
    """Claim 3."""
    best = _optima(paper)
    values = np.array(list(best.values()))
    part = float(((values > 0.5) & (values < 0.75)).mean())
    by_shape = ", ".join(
        f"{name}: {min(v):.2f} to {max(v):.2f}"
        for name in SHAPES
        if (v := [depth for key, depth in best.items() if key[0] == name])
    )
    return Claim(
        number=3,
        text="Load has an optimum depth, in general at 0.5 < d+ < 0.75",
        verdict=_verdict(part, whole=0.9),
        evidence=f"{part:.0%} of the {values.size} curves have it there; {by_shape}",
    )


def optimum_at_onset(paper: Paper, onsets: dict[tuple[str, float, float], float]) -> Claim:
    """Claim 4."""
    best = _optima(paper)
    ratio = np.array([best[key] / onsets[key] for key in best if 0 < onsets[key] < DEPTHS[-1]])
    falls = []
    for (name, shape), number in product(SHAPES.items(), NUMBERS):
        loads = paper.table(shape, "load_plus", number)
        for width, line in zip(WIDTHS, loads, strict=True):
            turned = DEPTH[:-1] >= onsets[name, width, number]
            falls += list(np.diff(line)[turned] < 0)
    near = float((np.abs(ratio - 1) < 0.2).mean())
    return Claim(
        number=4,
        text="The optimum lies where a vortex begins to form; the vortex harms load",
        verdict=_verdict(near, whole=0.9, some=0.4),
        evidence=f"optimum depth / depth of the first back-flow: median {np.median(ratio):.2f}, "
        f"from {ratio.min():.2f} to {ratio.max():.2f} over {ratio.size} curves; within 20 % of each other in "
        f"{near:.0%}; beyond the onset a deeper groove carries less in {np.mean(falls):.0%} of the steps",
    )


def friction_falls(paper: Paper) -> Claim:
    """Claim 5."""
    with_depth, with_width, rising = [], [], []
    for (name, shape), number in product(SHAPES.items(), NUMBERS):
        friction = paper.table(shape, "friction_plus", number)
        with_depth.append((np.diff(friction, axis=1) < 0).ravel())
        with_width.append((np.diff(friction, axis=0) < 0).ravel())
        rising += [(name, WIDTHS[i], number) for i, _ in np.argwhere(np.diff(friction, axis=1) >= 0)]
    by_depth, by_width = (float(np.concatenate(kept).mean()) for kept in (with_depth, with_width))
    where = ""
    if rising:
        widest, least = max(width for _, width, _ in rising), min(number for *_, number in rising)
        where = f"; it rises with depth only for w+ <= {widest:g} and Re >= {least:g}"
    return Claim(
        number=5,
        text="Friction falls with depth and width, except for narrow deep grooves at high Re",
        verdict="true" if rising and by_width > 0.99 and max(w for _, w, _ in rising) < 0.4 else _verdict(by_depth),
        evidence=f"it falls in {by_depth:.1%} of the steps in depth and {by_width:.1%} of those in width{where}",
    )


def splined_against_cylindrical(paper: Paper) -> Claim:
    """Claim 6."""
    share = {}
    for number in (40.0, 160.0):
        ahead, cylindrical = (paper.table(shape, "load_plus", number) for shape in (AHEAD, CYLINDRICAL))
        share[number] = float((ahead > cylindrical).mean()), float((ahead.max(axis=1) > cylindrical.max(axis=1)).mean())
    holds = min(share[40.0][1], 1 - share[160.0][1])
    return Claim(
        number=6,
        text="Splined with xd+ = -0.3 beats cylindrical in load at Re = 40, the reverse at Re = 160",
        verdict=_verdict(holds),
        evidence="; ".join(
            f"Re = {number:g}: splined carries more in {cases:.0%} of the cases, "
            f"at its best depth in {best:.0%} of the widths"
            for number, (cases, best) in share.items()
        ),
    )


def cylindrical_rubs_less(paper: Paper) -> Claim:
    """Claim 7."""
    less = [
        (paper.table(CYLINDRICAL, "friction_plus", number) < paper.table(shape, "friction_plus", number)).ravel()
        for number in NUMBERS
        for shape in (AHEAD, LEVEL, BEHIND)
    ]
    part = float(np.concatenate(less).mean())
    return Claim(
        number=7,
        text="Cylindrical grooves rub less than splined",
        verdict=_verdict(part),
        evidence=f"in {part:.1%} of the pairs of equal width, depth and Re",
    )
