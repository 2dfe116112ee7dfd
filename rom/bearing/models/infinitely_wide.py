"""A bearing of finite width as if nothing flowed out at its sides: one line of the film stands for all."""

from dataclasses import replace
from typing import TYPE_CHECKING

from roughfilm.rom.bearing.model import SOURCES, bearing_model, line_resolutions
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.problem import Problem


def one_line(scene: Bearing) -> "Problem":
    """The film along its middle, infinitely wide."""
    problem = scene.problem()
    return replace(problem, shape=replace(problem.shape, wide=True), ends=replace(problem.ends, sides=None))


def applies(scene: Bearing) -> Applicability:
    """Where there are sides; says how far they are."""
    width = scene.geometry.width
    if width is None:
        return Applicability(applies=False, reason="the bearing is infinitely wide: reynolds_cavitating solves a line")
    if isinstance(scene.geometry, Ring) and scene.geometry.endless:
        return Applicability(applies=False, reason="joined pads are fed through their sides, which one line has not")
    texture = getattr(scene.geometry, "texture", None)
    if texture is not None and texture.width is not None:
        return Applicability(applies=False, reason="the pockets have a width, and one line would hit or miss them")
    ratio = width / scene.geometry.length
    return Applicability(applies=True, reason=f"leaves out flow through the sides: width over length = {ratio:.3g}")


MODEL = bearing_model(
    name="infinitely_wide",
    summary="one line of the film, with cavitation and any compressibility, without flow through the sides",
    keeps=frozenset({Effect.CAVITATION, Effect.PRESSURE_DEPENDENCE}),
    sources=SOURCES,
    applies=applies,
    film=one_line,
    resolutions=line_resolutions,
    wide=True,
)
