"""The quantities of a cell in plan whose error by a model its results bound by the corrections that they make."""

from typing import Any

from roughfilm.rom.pocket.plan.quantities import EXTREMES, FRICTION, LOADS
from roughfilm.rom.pocket.scene import Pocket

MAX_JUDGED_DEPTH, MAX_JUDGED_SLOPE = 1.0, 1.0
"""Largest depth of dimples over the film, and slope, at which these bounds were compared with Navier-Stokes flow."""

MIN_JUDGED_DEPTH, MIN_JUDGED_REYNOLDS = 0.25, 5.0
"""Smallest depth over the film, and Reynolds number, at which they were."""

BY_MODEL = {
    "inertial_reynolds": frozenset((*LOADS, *EXTREMES)),
    **dict.fromkeys(("film", "film_slope"), frozenset((*LOADS, *EXTREMES, FRICTION))),
}
"""The quantities that the results of a model bound."""


def bounded(scene: Pocket, model: Any) -> frozenset[str]:
    """The quantities of a cell in plan that the results of a model bound, where the bounds were judged."""
    judged = (
        scene.in_plan
        and MIN_JUDGED_DEPTH <= scene.depth <= MAX_JUDGED_DEPTH
        and scene.slope <= MAX_JUDGED_SLOPE
        and scene.reynolds_number >= MIN_JUDGED_REYNOLDS
    )
    return BY_MODEL.get(model.name, frozenset()) if judged else frozenset()
