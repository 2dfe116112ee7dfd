"""All that a bearing's effects do: switched on one after the other, and each switched off alone."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.effects.ablation import (
    Amount,
    Composed,
    Composition,
    ablations,
    added,
    amount,
    effects_of,
    steps,
)
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress, silent

Solve = Callable[[Composition, Progress], Composed]
"""At a film, or under a load."""


@dataclass(frozen=True, kw_only=True)
class Contribution:
    """What one effect adds, by name of the quantity: switched on as the next one, and to all the others.

    The two differ by what it does together with those that come after it. ``off`` is the bearing without it alone.
    """

    name: str
    on: Mapping[str, Amount]
    alone: Mapping[str, Amount]
    after: Mapping[str, Amount]
    off: Mapping[str, Amount]


@dataclass(frozen=True, kw_only=True)
class Study:
    """The plain bearing, what each of its effects adds, and all of it.

    ``untold`` says, by the name of a bearing, why there are no numbers of it: some of its effects alone may carry
    nothing.
    """

    plain: Mapping[str, Amount]
    contributions: tuple[Contribution, ...]
    whole: Composed
    untold: Mapping[str, str]
    warnings: tuple[str, ...]
    residual: float
    balance: float
    cpu_s: float

    @property
    def full(self) -> Mapping[str, Amount]:
        """Of the bearing with all its effects."""
        return amounts(self.whole)


def study(scene: Bearing, solve: Solve, progress: Progress = silent) -> Study:
    """Switch the effects of a scene on one after the other, and each off alone.

    Contributions by steps add up to the difference between all of it and the plain bearing, wherever all are told.

    Raises
    ------
    InputError, ConvergenceError
        If the scene with all of its effects has no solution; what some of them alone cannot do is told as such.
    """
    effects, on, off = effects_of(scene), steps(scene), ablations(scene)
    titles = ["the plain film", *(f"with {effect.name}" for effect in effects)]
    tasks = [*zip(titles, on, strict=True), *((f"without {e.name}", c) for e, c in zip(effects, off, strict=True))]
    solved: list[tuple[Composition, Composed | None]] = []
    untold: dict[str, str] = {}
    for count, (title, taken) in enumerate(tasks):
        known = [found for before, found in solved if before == taken]
        if known:
            solved.append((taken, known[0]))
            continue

        def within(done: float, words: str, count: int = count, title: str = title) -> None:
            progress((count + done) / len(tasks), f"{title}: {words}")

        try:
            solved.append((taken, solve(taken, within)))
        except (InputError, ConvergenceError) as error:
            if taken == on[-1]:
                raise
            untold[title] = str(error)
            solved.append((taken, None))
    found = [one for _, one in solved]
    ons, offs = found[: len(on)], found[len(on) :]
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
    told = [one for one in found if one is not None]
    return Study(
        plain=amounts(ons[0]),
        contributions=contributions,
        whole=whole,
        untold=untold,
        warnings=tuple(dict.fromkeys(warning for one in told for warning in one.warnings)),
        residual=max(one.residual for one in told),
        balance=max(one.balance for one in told),
        cpu_s=sum(one.cpu_s for one in {id(one): one for one in told}.values()),
    )


def amounts(one: Composed | None) -> dict[str, Amount]:
    """All values with their errors; none of a bearing without numbers."""
    if one is None:
        return {}
    return {name: told for name in one.units if (told := amount(one, name)) is not None}


def differences(more: Composed | None, less: Composed | None) -> dict[str, Amount]:
    """What one has more than the other, of all that both tell."""
    if more is None or less is None:
        return {}
    return {name: told for name in more.units if (told := added(more, less, name)) is not None}
