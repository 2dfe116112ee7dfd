"""The Reynolds equation over one period of the gap with a correction for the slope of the walls."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.rough_gap.flow.range_of_validity import MAX_ADDED_DISSIPATION
from roughfilm.rom.rough_gap.model import GapFlow, gap_model
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.validity import too_steep
from roughfilm.rom.rough_gap.walls import Walls


def applies(scene: RoughGap) -> Applicability:
    """The slope of the walls, and whether it is within range; the model applies to every rough gap."""
    excess = scene.slope_excess
    reason = f"keeps slope to second order (g' = {scene.rms_slope:.3g})"
    if excess is not None and excess > MAX_ADDED_DISSIPATION:
        reason += f", which is expected to reduce the flow by {100 * excess:.2g} %: out of its range, take stokes"
    return Applicability(
        applies=True, reason=f"{reason}; leaves out inertia (Re g' = {scene.reynolds_number * scene.rms_slope:.3g})"
    )


def find(walls: Walls, mean_gap: float) -> GapFlow:
    """The corrected flow factors of the thin film."""
    from roughfilm.rom.rough_gap.flow.corrected import slope_corrected  # numba is slow to import

    theory = slope_corrected(walls)
    return GapFlow(
        factors=theory.corrected.scaled(1 / mean_gap),
        uncertainty=theory.uncertainty.scaled(1 / mean_gap),
        flow=theory.flow / mean_gap**3,
        residual=theory.unsolved,
        iterations=theory.iterations,
        suction=theory.suction,
        warnings=too_steep(theory.added, MAX_ADDED_DISSIPATION),
    )


MODEL = gap_model(
    name="slope_corrected",
    summary="Reynolds equation over one period, corrected for the slope of its walls",
    keeps=frozenset({Effect.ROUGHNESS, Effect.SLOPE}),
    complete=False,
    sources=("10.1098/rstl.1886.0005", "10.1016/j.jmaa.2005.09.036"),
    applies=applies,
    find=find,
    cost=lambda nodes: 5e-3 + 8e-6 * nodes,
)
