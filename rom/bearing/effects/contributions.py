"""The contributions of effects: switched on one after the other, and each switched off alone."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.effects.ablation import (
    Amount,
    Variant,
    VariantSolution,
    ablations,
    amount,
    difference,
    effects_of,
    steps,
)
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress, silent

Solve = Callable[[Variant, Progress], VariantSolution]
"""A function that solves a variant, at a film thickness or under a load."""


@dataclass(frozen=True, kw_only=True)
class Contribution:
    """The contribution of one effect, by name of the quantity.

    Attributes
    ----------
    name : name of the effect.
    on : change when the effect is switched on after those before it.
    alone : change when the effect is added to all others.
    after : values with the effect and those before it.
    off : values without this effect alone.
    """

    name: str
    on: Mapping[str, Amount]
    alone: Mapping[str, Amount]
    after: Mapping[str, Amount]
    off: Mapping[str, Amount]


@dataclass(frozen=True, kw_only=True)
class EffectStudy:
    """The contributions of all effects of a bearing.

    Attributes
    ----------
    plain : values without any effect.
    contributions : one for each effect.
    whole : the solution with all effects.
    unsolved : reasons why variants have no solution, by the title of the variant.
    warnings : warnings of all variants.
    residual, balance : largest residual of a film and largest relative error of a load.
    cpu_s : CPU time, s.
    """

    plain: Mapping[str, Amount]
    contributions: tuple[Contribution, ...]
    whole: VariantSolution
    unsolved: Mapping[str, str]
    warnings: tuple[str, ...]
    residual: float
    balance: float
    cpu_s: float

    @property
    def outside(self) -> tuple[str, ...]:
        """The ways in which the film with all effects is outside the range of the model, with each number and limit."""
        return self.whole.outside

    @property
    def full(self) -> Mapping[str, Amount]:
        """The values with all effects."""
        return amounts(self.whole)


def study_effects(scene: Bearing, solve: Solve, progress: Progress = silent) -> EffectStudy:
    """Solve a scene with its effects switched on one after the other, and with each switched off alone.

    The changes ``on`` add up to the difference between the variants with all effects and with none.

    Raises
    ------
    InputError, ConvergenceError
        If the scene with all of its effects has no solution.
    """
    effects, on, off = effects_of(scene), steps(scene), ablations(scene)
    titles = ["the plain film", *(f"with {effect.name}" for effect in effects)]
    tasks = [*zip(titles, on, strict=True), *((f"without {e.name}", c) for e, c in zip(effects, off, strict=True))]
    solved: list[tuple[Variant, VariantSolution | None]] = []
    unsolved: dict[str, str] = {}
    for count, (title, variant) in enumerate(tasks):
        known = [solution for before, solution in solved if before == variant]
        if known:
            solved.append((variant, known[0]))
            continue

        def within(done: float, words: str, count: int = count, title: str = title) -> None:
            progress((count + done) / len(tasks), f"{title}: {words}")

        try:
            solved.append((variant, solve(variant, within)))
        except (InputError, ConvergenceError) as error:
            if variant == on[-1]:
                raise
            unsolved[title] = str(error)
            solved.append((variant, None))
    solutions = [one for _, one in solved]
    ons, offs = solutions[: len(on)], solutions[len(on) :]
    whole = ons[-1]
    assert whole is not None
    contributions = tuple(
        Contribution(
            name=effect.name,
            on=differences(after, before),
            alone=differences(whole, without),
            after=amounts(after),
            off=amounts(without),
        )
        for effect, before, after, without in zip(effects, ons[:-1], ons[1:], offs, strict=True)
    )
    successful = [one for one in solutions if one is not None]
    return EffectStudy(
        plain=amounts(ons[0]),
        contributions=contributions,
        whole=whole,
        unsolved=unsolved,
        warnings=tuple(dict.fromkeys(warning for one in successful for warning in one.warnings)),
        residual=max(one.residual for one in successful),
        balance=max(one.balance for one in successful),
        cpu_s=sum(one.cpu_s for one in {id(one): one for one in successful}.values()),
    )


def amounts(one: VariantSolution | None) -> dict[str, Amount]:
    """All quantities of a variant with their uncertainties; empty without a solution."""
    if one is None:
        return {}
    return {name: value for name in one.units if (value := amount(one, name)) is not None}


def differences(more: VariantSolution | None, less: VariantSolution | None) -> dict[str, Amount]:
    """The differences of two variants in all quantities that both have; empty if one of them has no solution."""
    if more is None or less is None:
        return {}
    return {name: value for name in more.units if (value := difference(more, less, name)) is not None}
