"""Judgement of the claims of Paper C on flow factors and films, by synthetic profiles with the numbers of its table."""

from itertools import pairwise

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.node_sums import Rule
from scripts.studies.paper_c.data import ALPHAS, BESIDE, POINTS, RANGE, TABLE, WAYS, PaperC
from scripts.studies.paper_c.films import LOADS, MODULUS, SMOOTH, SPAN, Curve
from scripts.studies.study import Claim, Judgement, claims_of, verdict

EQUAL_FACTORS = 1e-10
"""Relative difference below which factors count as equal."""

FACTOR_ERROR = 1e-3
"""Relative error of the factors to which the required nodes are counted."""

JUDGED_LOADS = (1e5, 1e6)
"""Least and greatest load of Fig. C.13 at which the order of the films is judged, N/m."""

ORDERED_FRACTION = 0.95
"""Least fraction of the pairs of profiles that a roughness parameter must order to count as ordering their films."""


def judge(paper: PaperC) -> list[Claim]:
    """Judge claims 11, 12 and 14."""
    return claims_of(__file__, {11: same_bearing_curve(paper), 12: fewer_nodes(paper), 14: ordered_by_roughness(paper)})


def apart(values: Array) -> Array:
    """Return the largest relative difference between rearrangements of a profile, shape (α, 2)."""
    return np.asarray(np.ptp(values, axis=0) / values[0])


def same_bearing_curve(paper: PaperC) -> Judgement:
    """Judge claim 11, on profiles with the same bearing curve."""
    near = int(np.argmin(np.abs(RANGE - ALPHAS[0])))
    worst = {way: max(float(apart(paper.shuffled[name, way]).max()) for name in TABLE) for way in WAYS}
    thick = {way: max(float(apart(paper.shuffled[name, way])[near].max()) for name in TABLE) for way in WAYS}
    sums, lines, refined = WAYS
    said = "; ".join(f"{way}: {thick[way]:.1e} at α = {RANGE[near]:.2f}, {worst[way]:.1e} at most" for way in WAYS)
    return (
        "true" if worst[sums] < EQUAL_FACTORS and worst[refined] < worst[lines] else "false",
        f"six rearrangements and the profile itself differ by: {said}. The claim is a theorem for flow across "
        f"the ridges, and exact where only the heights are summed. Straight lines between rearranged points have "
        f"another bearing curve: {POINTS} heights do not determine the factors near contact, where the lines next to "
        f"the highest point decide",
    )


def fewer_nodes(paper: PaperC) -> Judgement:
    """Judge claim 12, on the number of nodes that each rule needs."""
    near = ALPHAS[-1]

    def needed(name: str, rule: Rule, left_out: int) -> float:
        study = paper.convergence[name, near]
        return float(np.median(np.nan_to_num(study.needed(rule, left_out, FACTOR_ERROR), nan=2 * study.nodes[-1])))

    def ratios(left_out: int) -> list[float]:
        return [
            needed(name, rule, left_out) / needed(name, Rule.SIMPSON, left_out)
            for name in TABLE
            for rule in (Rule.TRAPEZOID, Rule.DIFFERENCES)
        ]

    def in_words(left_out: int) -> str:
        return ", ".join(
            f"{rule} {min(counts):,.0f} to {max(counts):,.0f} (order "
            f"{np.median([paper.convergence[name, near].order(rule, left_out) for name in TABLE]):.1f})"
            for rule in Rule
            for counts in [[needed(name, rule, left_out) for name in TABLE]]
        )

    on, beside = min(ratios(0)) >= 2, min(ratios(BESIDE)) >= 2
    return (
        verdict(on and beside, partly=on or beside),
        f"nodes for {100 * FACTOR_ERROR:g} % at α = {near}, where N is a multiple of {POINTS} and every "
        f"point is a node: {in_words(0)}; with {BESIDE} nodes fewer, most of them beside the points: "
        f"{in_words(BESIDE)}: corners inside its pairs of steps reduce the order of Simpson's rule. At α = "
        f"{ALPHAS[0]} all rules are within {_worst_at_first(paper):.0e} on "
        f"{paper.convergence['A', ALPHAS[0]].nodes[0]:.0f} nodes. In fact no nodes are needed: the integrals of "
        f"straight lines have closed forms. The differential equation by differences is the midpoint rule",
    )


def _worst_at_first(paper: PaperC) -> float:
    studies = [paper.convergence[name, ALPHAS[0]] for name in TABLE]
    return max(float(study.errors(rule, left_out)[:, 0].max()) for study in studies for rule, left_out in study.found)


def ordered_by_roughness(paper: PaperC) -> Judgement:
    """Judge claim 14, on the order of films by roughness."""
    loads = [k for k, load in enumerate(LOADS) if JUDGED_LOADS[0] <= load <= JUDGED_LOADS[1]]
    until = order_holds_to(paper.curves)
    random, alike = paper.orderings["random"], paper.orderings["of one Ra"]
    by = {number: [random.concordance(number, k) for k in loads] for number in random.numbers}
    four = until >= JUDGED_LOADS[1]
    general = min(by["Ra"]) >= ORDERED_FRACTION
    counter = against(random.numbers["Ra"], random.clearance[:, loads[-1]])
    said = ", ".join(f"{number} {100 * min(parts):.1f} to {100 * max(parts):.1f} %" for number, parts in by.items())
    within = [alike.concordance("rmax", k) for k in loads]
    spread = np.ptp(alike.clearance[:, loads[-1]])
    return (
        verdict(four and general, partly=four or general),
        f"the four profiles, smooth first, keep the order of Ra for every seed up to {until / 1e6:.3g} MN/m "
        f"(mean pressure {until / SPAN / 1e6:.3g} MPa, {until / SPAN / MODULUS:.2g} of β). Their rmax has the same "
        f"order, and it decides: of the pairs of {random.clearance.shape[0]} random profiles at "
        f"{JUDGED_LOADS[0] / 1e6:g} to {JUDGED_LOADS[1] / 1e6:g} MN/m the rougher has the thinner film in: {said}; in "
        f"one pair the rougher has {counter:.2g} times the Ra and the thicker film. Of {alike.clearance.shape[0]} "
        f"profiles with the same Ra, films at {JUDGED_LOADS[1] / 1e6:g} MN/m differ by {1e6 * spread:.2g} µm, in the "
        f"order of rmax in {100 * min(within):.1f} % of the pairs. A load fixes the mean film except for terms of "
        f"second order in Rq over it, and min h0 is the mean film minus rmax",
    )


def order_holds_to(curves: dict[str, list[Curve]]) -> float:
    """Return the greatest load, N/m, up to which min h0 falls as Ra grows, for every seed; 0 if there is none."""
    rough = [SMOOTH, *sorted(TABLE, key=lambda name: TABLE[name].average)]
    loads: Array = np.geomspace(LOADS[0], 1e9, 400)
    at = {name: [one.at(loads) for one in curves[name]] for name in rough}
    held = np.ones(loads.size, dtype=bool)
    for smoother, rougher in pairwise(rough):
        held &= np.min(at[smoother], axis=0) > np.max(at[rougher], axis=0)
    broken = np.flatnonzero(~held)
    return 0.0 if broken.size and broken[0] == 0 else float(loads[broken[0] - 1] if broken.size else loads[-1])


def against(rough: Array, clearance: Array) -> float:
    """Return the greatest ratio of the roughness of two profiles of which the rougher one has the thicker film.

    It is 1 if there are no such profiles. Both arrays have the shape (profiles,).
    """
    ratio = rough[:, None] / rough
    return float(ratio[clearance[:, None] > clearance].max(initial=1.0))
