"""The change of a bearing with ridges by the length of their waves, of models that only keep averaged roughness."""

from functools import lru_cache

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.rounding import share
from roughfilm.rom.bearing.effects.viscosity import ON_COARSE_GRID
from roughfilm.rom.bearing.keyed import KeyedScene, keyed
from roughfilm.rom.bearing.models.direct import MODEL as DIRECT
from roughfilm.rom.bearing.models.homogenized import MODEL as HOMOGENIZED
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Omission, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import OF_LUBRICANT, Effect, Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

MAX_CPU_S = 1.0
"""Largest expected CPU time of a film with all waves, s."""


def waves_omitted(scene: Bearing, model: Model[Bearing], quantity: str) -> Omission | None:
    """The relative change of a quantity by the length of ridges, of models with heating or shear thinning.

    It is the difference between ``direct`` and ``homogenized``, both isothermal and on the coarsest grid that resolves
    the waves. None of other models, whose error laws count it, of other roughness, and where it takes more than
    ``MAX_CPU_S``.
    """
    averages = Effect.ROUGHNESS in model.keeps and Effect.FINITE_WAVES not in model.keeps
    if not (averages and model.keeps & OF_LUBRICANT and isinstance(scene.roughness, Sinusoid)):
        return None
    pair = _pair(keyed(scene.without_time().isothermal()))
    if pair is None or any(quantity not in one.quantities for one in pair):
        return None
    resolved, averaged = pair
    size = kind_of(resolved).scale_of(resolved, quantity)
    part = abs(resolved[quantity].value - averaged[quantity].value) / size if size > 0 else 0.0
    title = kind_of_scene(scene).named[quantity]
    return Omission(
        part=part, reason=f"the length of the ridges changes the {title} by about {share(part)}", source=ON_COARSE_GRID
    )


@lru_cache(maxsize=16)
def _pair(question: KeyedScene) -> tuple[Result, Result] | None:
    """The film with all waves and the averaged one, on one grid."""
    scene = question.scene
    if not (DIRECT.applies(scene).applies and HOMOGENIZED.applies(scene).applies):
        return None
    cells = DIRECT.resolutions_of(scene)[0]
    if DIRECT.cost(scene, cells) > MAX_CPU_S:
        return None
    try:
        return (
            DIRECT.solve(scene, Request(resolution=cells)),
            HOMOGENIZED.solve(scene, Request(resolution=cells)),
        )
    except (InputError, ConvergenceError):
        return None
