"""A fitted description and its judgement in words and numbers."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from typing import Any

from roughfilm.contact.synthetic.description import description_entries
from roughfilm.fitting.quantities import NAMES
from roughfilm.fitting.run import Fit
from roughfilm.words.numbers import finite_entries
from roughfilm.words.scales import Scale, scale_for

UNITS = ("Pa", "m", "m^3", "m^3")
"""Unit of each quantity."""

HEADS = ("quantity", "windows, median", "seeds, median", "seeds, 95 %", "held-out windows inside", "below", "above")
"""Heads of the table of quantities."""


def headline(fit: Fit) -> str:
    """The judgement in one sentence, without a full stop."""
    first, *others = fit.held.items()
    parts = [f"{held.inside} of {held.count} in {name}" for name, held in others]
    name, held = first
    begin = f"{fit.name}: inside the intervals of seeds are {held.inside} of {held.count} held-out windows in {name}"
    return f"{begin}, {', '.join(parts[:-1])} and {parts[-1]}"


def rows(fit: Fit) -> Sequence[tuple[str, ...]]:
    """The rows of the table of quantities."""
    found = []
    for k, name in enumerate(NAMES):
        held = fit.held[name]
        windows, seeds = (middle(values[:, k]) for values in (fit.windows, fit.seeds))
        low, high = (text(end, k) for end in held.interval)
        found.append(
            (
                titled(name),
                text(windows, k),
                text(seeds, k),
                f"{low} to {high}",
                f"{held.inside} of {held.count} ({100 * held.inside / held.count:.0f} %)",
                str(held.below),
                str(held.above),
            )
        )
    return found


def titled(name: str) -> str:
    """The name of a quantity with its unit in the table."""
    return {"contact pressure": "contact pressure over E*", "mean gap": "mean gap, µm"}.get(name, f"{name}, µm³")


def text(value: float, number: int) -> str:
    """A value of the quantity of a number in the unit of its title."""
    if math.isnan(value):
        return "unknown"
    factor = {"Pa": 1.0, "m": 1e6, "m^3": 1e18}[UNITS[number]]
    return "sealed" if value == 0 and number > 1 else f"{factor * value:.3g}"


def middle(values: Iterable[float]) -> float:
    """The median of the values that are known; NaN without one."""
    known = sorted(float(value) for value in values if not math.isnan(value))
    if not known:
        return math.nan
    return (known[(len(known) - 1) // 2] + known[len(known) // 2]) / 2


def length(value: float) -> str:
    """A length in the unit that its size chooses."""
    scale: Scale = scale_for("m", value)
    return scale.text(value)


def notes(fit: Fit) -> tuple[str, ...]:
    """The notes at the beginning of the file of a description."""
    return (
        f"Surface: {fit.name}; {len(fit.windows)} windows of {length(fit.group.size)}, worth "
        f"{fit.description.population.windows:.3g} independent ones.",
        f"{headline(fit)}.",
        *(f"Lacks: {one.text}." for one in fit.findings if one.lacking),
        "Another seed is another window; see roughfilm.contact.synthetic.random_field.",
    )


def entries_of(fit: Fit) -> dict[str, Any]:
    """The fit as entries that JSON can hold, in SI units; permeabilities are in m³, pressures over E*."""
    entries: dict[str, Any] = finite_entries(
        {
            "surface": fit.name,
            "size": fit.group.size,
            "independent": fit.description.population.windows,
            "area": fit.area,
            "load": fit.load,
            "held": {
                name: {**asdict(one), "fails": one.fails, "windows": windows.tolist(), "seeds": seeds.tolist()}
                for (name, one), windows, seeds in zip(fit.held.items(), fit.windows.T, fit.seeds.T, strict=True)
            },
            "findings": [asdict(one) for one in fit.findings],
            "description": description_entries(fit.description),
        }
    )
    return entries
