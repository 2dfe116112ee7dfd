"""The Reynolds equation: viscous film flow, no inertia, lowest order in slope."""

from functools import partial

from rom.ladder import Applicability, Model
from rom.quadrature import RESIDUAL_MEANING, RESOLUTION, RESOLUTION_MEANING, solve_by_quadrature
from rom.scene import Scene

NAME = "reynolds"
SOURCES = ("10.1098/rstl.1886.0005",)


def applies(scene: Scene) -> Applicability:
    """Always; says how much inertia and slope it leaves out."""
    part = scene.geometry
    return Applicability(
        applies=True,
        reason=f"leaves out inertia (Re Ly/w = {scene.reynolds_number * part.film / part.width:.3g}) "
        f"and slope (2d/w = {2 * part.depth / part.width:.3g})",
    )


MODEL = Model(
    name=NAME,
    summary="Reynolds equation, exact quadrature: the plainest film",
    keeps=frozenset(),
    sources=SOURCES,
    resolution=RESOLUTION,
    resolutions=(2, 3, 4, 6, 8, 12, 16, 24),
    resolution_meaning=RESOLUTION_MEANING,
    residual_meaning=RESIDUAL_MEANING,
    order=None,
    cost=lambda _scene, resolution: 2e-4 + 1e-7 * resolution**2,
    applies=applies,
    solve=partial(solve_by_quadrature, model=NAME, keeps=frozenset(), sources=SOURCES),
)
