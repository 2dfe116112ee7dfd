"""The Reynolds equation over every wave of the period: the flow factors of the gap."""

import numpy as np

from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.rom.rough_gap.model import Found, gap_model
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls


def applies(scene: RoughGap) -> Applicability:
    """Always; says how much slope and inertia it leaves out."""
    excess = scene.slope_excess
    lets = "" if excess is None else f", by which it lets about {100 * excess:.2g} % too much through"
    return Applicability(
        applies=True,
        reason=f"leaves out slope (g' = {scene.rms_slope:.3g}{lets}) and inertia (Re g' = "
        f"{scene.reynolds_number * scene.rms_slope:.3g})",
    )


def find(walls: Walls, mean_gap: float) -> Found:
    """Flow factors by the cell problems."""
    from roughfilm.rom.homogenization.flow_factors import flow_factors  # numba is slow to import
    from roughfilm.rom.homogenization.flux import flux

    found = flow_factors(walls.gap, walls.spacing)
    driven = flux(walls.gap, walls.spacing, found.correctors[0], 0) / mean_gap**3

    def over(factors: FlowFactors) -> RoughGapFactors:
        return of_thin_film(factors, slides=walls.slides).scaled(1 / mean_gap)

    return Found(
        factors=over(found.factors),
        uncertainty=over(found.uncertainty),
        flow=np.hypot(*driven),
        residual=found.unsolved,
        iterations=found.iterations,
    )


MODEL = gap_model(
    name="homogenized",
    summary="Reynolds equation over one period: its flow factors",
    keeps=frozenset({Effect.ROUGHNESS}),
    sources=("10.1098/rstl.1886.0005", "10.1016/j.jmaa.2005.09.036"),
    applies=applies,
    find=find,
    cost=lambda nodes: 3e-3 + 4e-6 * nodes,
)
