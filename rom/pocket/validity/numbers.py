"""The dimensionless numbers of a pocket on which the errors of its models depend."""

from collections.abc import Mapping
from functools import lru_cache
from itertools import pairwise
from types import MappingProxyType

from roughfilm.rom.pocket.groove import SAME_PLACE
from roughfilm.rom.pocket.pressure import load_over_pressure
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.thin_film.gap import Gap

SYMBOLS = {
    "reynolds_number": "Re",
    "reduced_reynolds_number": "Re·h/w",
    "film": "h/L",
    "depth": "d/h",
    "aspect": "2d/w",
    "slope": "slope",
    "asymmetry": "2|s|/w",
    "loaded": "load/p_max",
    "shortness": "h/l",
    "covered": "covered part",
    "cell_breadth": "B/L",
}
"""Symbols of the numbers: h is the film, L its period, l the shortest piece of the wall, B the breadth of a cell; w, d
and s are width, depth and shift of a groove. In plan w is the least extent of a dimple, and l that of a dimple or of
the ramp or rounding at its rim."""

COLUMNS = 64
"""Number of columns along a cell in plan by which its load is computed."""

MIN_ASYMMETRY = 1e-3
"""The asymmetry of a symmetric groove."""

MIN_LOAD_SCALE = 1e-3
"""Load over the largest pressure below which errors are relative to the pressure."""

MAX_SHORTNESS = 20.0
"""Film over the shortest piece of the wall above which a piece is too short to matter more."""


@lru_cache(maxsize=8)
def numbers(scene: Pocket) -> Mapping[str, float]:
    """The dimensionless numbers of the deepest, narrowest and steepest grooves or dimples.

    They contain the load to first order in Re; those of a cell in plan also the covered part of it.
    """
    common = {
        "reynolds_number": scene.reynolds_number,
        "reduced_reynolds_number": scene.reduced_reynolds_number,
        "film": scene.geometry.film / scene.geometry.length,
        "depth": scene.depth,
        "aspect": scene.aspect,
        "slope": scene.slope,
    }
    if scene.in_plan:
        from roughfilm.rom.pocket.plan.level import load_over_pressure as load_in_plan  # slow to import

        plan = scene.plan()
        in_plan = {
            "loaded": max(load_in_plan(scene, COLUMNS), MIN_LOAD_SCALE),
            "shortness": min(plan.film / plan.smallest, MAX_SHORTNESS),
            "covered": scene.covered,
            "cell_breadth": plan.breadth / plan.length,
        }
        return MappingProxyType({**common, **in_plan})
    gap = scene.gap()
    found = {
        **common,
        "asymmetry": max(1 - scene.aspect / scene.slope, MIN_ASYMMETRY),
        "loaded": max(load_over_pressure(gap, scene.reynolds_number), MIN_LOAD_SCALE),
        "shortness": min(gap.film / shortest_piece(scene, gap), MAX_SHORTNESS),
    }
    return MappingProxyType(found)


def shortest_piece(scene: Pocket, gap: Gap) -> float:
    """The shortest length over which the wall is smooth, m.

    It is the least distance between neighbouring corners, edges of grooves and the ends of the period, where pressure
    is ambient, or between the lowest point of a groove and its nearer edge. The flow is disturbed near the ends of each
    piece over about a film thickness: thin-film models leave this out, and meshes must resolve it.
    """
    half = gap.length / 2
    ends = sorted({-half, half, *gap.corners, *(edge for groove in scene.grooves for edge in groove.span)})
    between = (right - left for left, right in pairwise(ends) if right - left > SAME_PLACE * gap.length)
    return min(*between, *(groove.depth / groove.slope for groove in scene.grooves))
