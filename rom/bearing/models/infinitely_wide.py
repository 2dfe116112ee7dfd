"""The Reynolds equation with cavitation on one line of a bearing of finite width, without side flow."""

from dataclasses import replace
from typing import TYPE_CHECKING

from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.model import SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.problem import Problem


def one_line(scene: Bearing) -> "Problem":
    """The problem of the infinitely wide film with the thickness on the centre line."""
    problem = scene.problem()
    return replace(problem, shape=replace(problem.shape, wide=True), ends=replace(problem.ends, sides=None))


def applies(scene: Bearing) -> Applicability:
    """Whether the bearing has sides and its film does not vary across, with its width over its length."""
    width = scene.geometry.width
    if width is None:
        return Applicability(applies=False, reason="the bearing is infinitely wide; use reynolds_cavitating")
    if scene.supply:
        return Applicability(applies=False, reason="supplies end before the sides, which one line lacks")
    geometry = scene.geometry
    if (isinstance(geometry, Ring) and geometry.endless) or (isinstance(geometry, Lobes) and geometry.joined):
        return Applicability(
            applies=False, reason="joined pads and lobes are fed through their sides, which one line does not have"
        )
    texture = getattr(scene.geometry, "texture", None)
    if texture is not None and texture.width is not None:
        return Applicability(applies=False, reason="the pockets have a width, which one line cannot describe")
    ratio = width / scene.geometry.length
    return Applicability(applies=True, reason=f"leaves out side flow: width over length = {ratio:.3g}")


MODEL = bearing_model(
    name="infinitely_wide",
    summary="one line with cavitation, without side flow",
    keeps=frozenset({Effect.CAVITATION, Effect.PRESSURE_DEPENDENCE}),
    sources=SOURCES,
    applies=applies,
    film=one_line,
    wide=True,
)
