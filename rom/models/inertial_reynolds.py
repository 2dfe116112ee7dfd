"""The Reynolds equation with first-order inertia by a weighted residual."""

from functools import partial

from rom.ladder import Applicability, Effect, Model
from rom.quadrature import RESIDUAL_MEANING, RESOLUTION, RESOLUTION_MEANING, solve_by_quadrature
from rom.scene import Scene

NAME = "inertial_reynolds"
KEEPS = frozenset({Effect.INERTIA})
SOURCES = ("10.1098/rstl.1886.0005", "10.1115/1.1828067")


def applies(scene: Scene) -> Applicability:
    """Always; says how far from small the reduced Reynolds number is."""
    part = scene.geometry
    return Applicability(
        applies=True,
        reason=f"keeps inertia to first order in Re Ly/w = {scene.reynolds_number * part.film / part.width:.3g}, "
        f"leaves out slope (2d/w = {2 * part.depth / part.width:.3g})",
    )


MODEL = Model(
    name=NAME,
    summary="adds inertia to first order in the Reynolds number",
    keeps=KEEPS,
    sources=SOURCES,
    resolution=RESOLUTION,
    resolutions=(2, 3, 4, 6, 8, 12, 16, 24),
    resolution_meaning=RESOLUTION_MEANING,
    residual_meaning=RESIDUAL_MEANING,
    order=None,
    cost=lambda _scene, resolution: 3e-4 + 1e-7 * resolution**2,
    applies=applies,
    solve=partial(solve_by_quadrature, model=NAME, keeps=KEEPS, sources=SOURCES),
)
