"""The quantities of a pocket whose error by a model its results bound by the correction that they make."""

from typing import Any

from roughfilm.rom.pocket.scene import Pocket

MAX_JUDGED_DEPTH, MAX_JUDGED_SLOPE = 1.0, 0.6
"""Largest depth of dimples over the film, and slope, at which the correction by slope is a measure of its error."""

MIN_JUDGED_DEPTH, MIN_JUDGED_REYNOLDS = 0.25, 40.0
"""Smallest depth over the film, and Reynolds number, at which it is: the load without inertia is a small difference."""


def bounded(scene: Pocket, model: Any) -> frozenset[str]:
    """The load of a cell in plan by ``film_slope``, which its correction by slope bounds where that was judged."""
    judged = (
        scene.in_plan
        and MIN_JUDGED_DEPTH <= scene.depth <= MAX_JUDGED_DEPTH
        and scene.slope <= MAX_JUDGED_SLOPE
        and scene.reynolds_number >= MIN_JUDGED_REYNOLDS
    )
    return frozenset({"load_plus"}) if judged and model.name == "film_slope" else frozenset()
