"""The laws that are fitted, read from terms.toml: their models and the numbers in each of their terms."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

Terms = tuple[tuple[str, ...], ...]
"""The names of the numbers in each term of a law."""


@dataclass(frozen=True, kw_only=True)
class PlannedStep:
    """A step without its laws; names as in :class:`roughfilm.rom.advice.laws.Step`.

    Without terms the step has no law: a promise of the model contains it. ``rows`` is the function in rows.py that
    gives the errors.
    """

    kind: str
    model: str
    towards: str
    adds: str
    measure: str
    terms: Terms = ()
    rows: str = "between_limits"


@dataclass(frozen=True, kw_only=True)
class PlannedPromise:
    """Promises of some models without their laws, towards the same model; see ``roughfilm.rom.advice.laws.Promise``.

    Attributes
    ----------
    within : numbers that are in no term, above whose range the laws are not known.
    above : numbers with a limit; scenes below it are left out of the fit.
    """

    kind: str
    models: tuple[str, ...]
    terms: Terms
    towards: str = ""
    within: tuple[str, ...] = ()
    above: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class PlannedResolution:
    """The laws of the resolutions of some models; ``rows`` is the function in rows.py that gives the errors."""

    kind: str
    models: tuple[str, ...]
    terms: Terms
    rows: str = "refinement"


def _plan(entries: Mapping[str, Any]) -> dict[str, Any]:
    terms = tuple(tuple(term) for term in entries.get("terms", ()))
    lists = {name: tuple(entries[name]) for name in ("models", "within") if name in entries}
    return {**entries, **lists, "terms": terms}


_TABLE: Mapping[str, Sequence[Mapping[str, Any]]] = tomllib.loads(
    Path(__file__).with_name("terms.toml").read_text(encoding="utf-8")
)

STEPS: tuple[PlannedStep, ...] = tuple(PlannedStep(**_plan(one)) for one in _TABLE["step"])
PROMISES: tuple[PlannedPromise, ...] = tuple(PlannedPromise(**_plan(one)) for one in _TABLE["promise"])
RESOLUTIONS: tuple[PlannedResolution, ...] = tuple(PlannedResolution(**_plan(one)) for one in _TABLE["resolution"])
