"""Warnings where no fitted law gives the error of a model of a pocket."""

from roughfilm.rom.advice.laws import table
from roughfilm.rom.pocket.scene import LAWS_IN_PLAN, Pocket
from roughfilm.rom.pocket.validity.numbers import SYMBOLS, numbers


def promise_warnings(scene: Pocket, model: str) -> tuple[str, ...]:
    """The warning where a number of a scene is outside the range to which the laws of a model were fitted."""
    own, laws = numbers(scene), LAWS_IN_PLAN if scene.in_plan else scene.kind
    for law in table().promise(laws, model).laws.values():
        if (name := law.beyond(own)) is not None:
            least, most = law.reach[name]
            return (
                f"{model}: no law gives its error, as {SYMBOLS[name]} = {own[name]:.3g} is outside the fitted range of "
                f"{least:.3g} to {most:.3g}",
            )
    return ()
