"""The Reynolds equation over every wave of the period, and what the slope of its walls adds, without a mesh across."""

from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.rough_gap.flow.range_of_validity import REACH
from roughfilm.rom.rough_gap.model import Found, gap_model
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls


def applies(scene: RoughGap) -> Applicability:
    """Always; says how steep the walls are, and whether they are expected to be too steep."""
    excess = scene.slope_excess
    reason = f"keeps slope to second order (g' = {scene.rms_slope:.3g})"
    if excess is not None and excess > REACH:
        reason += f", which is expected to take {100 * excess:.2g} % of the flow: out of its range, take stokes"
    return Applicability(
        applies=True, reason=f"{reason}; leaves out inertia (Re g' = {scene.reynolds_number * scene.rms_slope:.3g})"
    )


def find(walls: Walls, mean_gap: float) -> Found:
    """Flow factors of the thin film, corrected."""
    from roughfilm.rom.rough_gap.flow.corrected import slope_corrected  # numba is slow to import

    found = slope_corrected(walls)
    return Found(
        factors=found.corrected.scaled(1 / mean_gap),
        uncertainty=found.uncertainty.scaled(1 / mean_gap),
        flow=found.flow / mean_gap**3,
        residual=found.unsolved,
        iterations=found.iterations,
        warnings=() if found.holds else (_too_steep(float(found.added.max())),),
    )


def _too_steep(added: float) -> str:
    return f"slope adds {added:.2g} of what thin films dissipate, above {REACH:g}: out of its range, take stokes"


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
