"""The Reynolds equation over one period of the gap: its flow factors."""

import numpy as np

from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.rom.rough_gap.flow.suction import suction
from roughfilm.rom.rough_gap.model import GapFlow, gap_model
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.validity import MAX_OMITTED, too_steep
from roughfilm.rom.rough_gap.walls import Walls


def applies(scene: RoughGap) -> Applicability:
    """The neglected slope and inertia; the model applies to every rough gap."""
    excess = scene.slope_excess
    error = "" if excess is None else f", which overestimates the flow by about {100 * excess:.2g} %"
    return Applicability(
        applies=True,
        reason=f"leaves out slope (g' = {scene.rms_slope:.3g}{error}) and inertia (Re g' = "
        f"{scene.reynolds_number * scene.rms_slope:.3g})",
    )


def find(walls: Walls, mean_gap: float) -> GapFlow:
    """The flow factors from the cell problems."""
    from roughfilm.rom.homogenization.flow_factors import flow_factors  # numba is slow to import
    from roughfilm.rom.homogenization.flux import flux
    from roughfilm.rom.rough_gap.flow.corrected import added_dissipation

    film = flow_factors(walls.gap, walls.spacing)
    driven = flux(walls.gap, walls.spacing, film.correctors[0], 0) / mean_gap**3

    def over(factors: FlowFactors) -> RoughGapFactors:
        return of_thin_film(factors, slides=walls.slides).scaled(1 / mean_gap)

    return GapFlow(
        factors=over(film.factors),
        uncertainty=over(film.uncertainty),
        flow=np.hypot(*driven),
        residual=film.unsolved,
        iterations=film.iterations,
        warnings=too_steep(added_dissipation(walls, film), MAX_OMITTED),
        suction=suction(walls.gap, film.correctors[2]),
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
