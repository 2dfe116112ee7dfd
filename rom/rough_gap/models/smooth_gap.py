"""A smooth gap with the thickness of the mean gap."""

import numpy as np

from roughfilm.rom.ladder.model import Applicability
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.model import GapFlow, gap_model
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.validity import too_rough
from roughfilm.rom.rough_gap.walls import Walls


def applies(scene: RoughGap) -> Applicability:
    """The neglected roughness; the model applies to every rough gap."""
    reason = f"leaves out roughness (Sq/h̄ = {scene.rms_height / scene.mean_gap:.3g}), slope and inertia"
    return Applicability(applies=True, reason=reason)


def find(walls: Walls, _mean_gap: float) -> GapFlow:
    """The factors of a smooth gap."""
    return GapFlow(
        factors=RoughGapFactors(
            mean_gap=1.0,
            pressure=np.eye(2),
            shear=np.array([1.0, 0.0]) if walls.slides else np.full(2, np.nan),
            friction=1.0 if walls.slides else np.nan,
        ),
        uncertainty=None,
        flow=np.ones(walls.lower.shape),
        residual=0.0,
        iterations=1,
        warnings=too_rough(walls),
    )


MODEL = gap_model(
    name="smooth_gap",
    summary="a smooth gap with the thickness of the mean gap",
    keeps=frozenset(),
    sources=("10.1098/rstl.1886.0005",),
    applies=applies,
    find=find,
    cost=lambda nodes: 1e-4 + 4e-7 * nodes,
)
