"""The errors of the models of a pocket that the fitted laws promise for a scene, in words."""

from collections.abc import Mapping
from dataclasses import dataclass

from roughfilm.rom.advice.estimates import near, percent
from roughfilm.rom.advice.laws import table
from roughfilm.rom.ladder.model import Applicability
from roughfilm.rom.pocket.scene import TITLES, Pocket
from roughfilm.rom.pocket.validity.numbers import SYMBOLS, numbers

MAX_ERROR_WITHOUT_WARNING = 0.1
"""Promised relative error above which a result has a warning."""

WARNED = ("load_plus", "friction_plus", "pressure_max_plus")
"""The quantities of which a large promised error is a warning."""


@dataclass(frozen=True, kw_only=True)
class Promised:
    """The promise of a model for a scene.

    Attributes
    ----------
    errors : by quantity, the error over its size that 95 of 100 scenes do not exceed; empty without a law.
    beyond : the number outside of the range of the fit in words; "" inside.
    """

    errors: Mapping[str, float]
    beyond: str

    @property
    def words(self) -> str:
        """The promise as the end of a sentence."""
        if self.beyond:
            return f"errors unknown, {self.beyond}"
        errors = ", ".join(f"{TITLES[quantity]} {near(error)}" for quantity, error in self.errors.items())
        return errors and f"compared with navier_stokes {errors}"


def promised(scene: Pocket, model: str) -> Promised:
    """The promise of a model for a scene, from the laws in ``rom/advice/laws.toml``."""
    laws, own = table().promise("pocket", model).laws, numbers(scene)
    for law in laws.values():
        if (name := law.beyond(own)) is not None:
            least, most = law.reach[name]
            return Promised(
                errors={},
                beyond=f"as {SYMBOLS[name]} = {own[name]:.3g} is outside the fitted range of {least:.3g} to {most:.3g}",
            )
    return Promised(errors={quantity: law.error(own) for quantity, law in laws.items()}, beyond="")


def applicability(scene: Pocket, model: str, effects: str) -> Applicability:
    """The applicability of a model that includes these effects, with its promise."""
    words = promised(scene, model).words
    return Applicability(applies=True, reason=f"{effects}; {words}" if words else effects)


def promise_warnings(scene: Pocket, model: str) -> tuple[str, ...]:
    """The warnings where a model promises no error, or a large one."""
    promise = promised(scene, model)
    if promise.beyond:
        return (f"{model}: {promise.words}",)
    large = {
        quantity: error
        for quantity, error in promise.errors.items()
        if quantity in WARNED and error > MAX_ERROR_WITHOUT_WARNING
    }
    if not large:
        return ()
    parts = " and ".join(f"{percent(error)} in {TITLES[quantity]}" for quantity, error in large.items())
    return (f"{model} leaves out effects that matter here: its error may reach {parts}",)
