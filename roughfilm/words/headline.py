"""The headline of a page: what the scene asks for, which model, how sure, and what it leaves out, in words."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from roughfilm.rom.advice.stated import BY_ITS_RUN, BY_LAWS, percent, stated_errors
from roughfilm.rom.ladder.kind import Scene, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.result import Result
from roughfilm.words.outside import outside_in_words
from roughfilm.words.scales import Scales

STATED = "stated by the run"
"""Origin of an uncertainty that no grids of a study measure."""

NEGLIGIBLE = 1e-6
"""Uncertainty over the size of a quantity below which it is not given."""


@dataclass(frozen=True, kw_only=True)
class Headline:
    """The answer of a result, and the line that every answer has.

    Attributes
    ----------
    quantity : name of the quantity in the result.
    title : name of the quantity in a sentence.
    value : its value ± uncertainty with the unit.
    model, sure, left_out : which model and what it includes, how sure, and what is left out.
    """

    quantity: str
    title: str
    value: str
    model: str
    sure: str
    left_out: str


def headline(scene: Scene, result: Result, models: Sequence[Model], scales: Scales, origin: str = STATED) -> Headline:
    """The answer of a result to what its scene asks: the film under a load, the leakage of a seal, else the load.

    Parameters
    ----------
    scene : the scene.
    result : its result, with its errors.
    models : all models for this kind of scene.
    scales : the units of the page.
    origin : origin of the numerical uncertainty, in words such as "by three grids".
    """
    name = asked(result)
    model = next(one for one in models if one.name == result.model)
    sealed = result.quantities.get("sealed")
    return Headline(
        quantity=name,
        title=kind_of(result).reported[name],
        value="none: no open path" if sealed and sealed.value else scales.text(name, result.quantities[name]),
        model=included(scene, model, models),
        sure=sureness(result, origin),
        left_out=left_out(scene, model, models),
    )


def asked(result: Result) -> str:
    """The quantity that the scene of a result asks for, of the whole bearing or seal where the result has that."""
    return whole(next(iter(kind_of(result).compared)), result)


def whole(name: str, result: Result) -> str:
    """The quantity of the whole bearing or seal, or in units of a pressure, in the place of a reduced one.

    Examples
    --------
    >>> import roughfilm as rf
    >>> result = rf.solve(rf.load_scene("scripts/examples/scenes/pocket.toml"), model="reynolds")
    >>> whole("load_plus", result)
    'load_per_area'
    """
    base = name.removesuffix("_per_width").removesuffix("_plus")
    return next(one for one in (f"bearing_{base}", base, f"{base}_per_area", name) if one in result.quantities)


def included(scene: Scene, model: Model, models: Sequence[Model]) -> str:
    """The model in words, with the effects that it includes."""
    rank = ", the most complete model for this scene" if not _missing(scene, model, models) else ""
    kept = sorted(model.keeps - kind_of_scene(scene).absent(scene))
    words = f", which includes {listed(kept)}" if kept else f", {model.summary}"
    return f"{model.name}{rank}{words}"


def sureness(result: Result, origin: str = STATED) -> str:
    """The numerical uncertainty of the answer and the error of the model in words, each with its origin."""
    kind = kind_of(result)
    name = next(iter(kind.compared))
    one, size = result.quantities[name], kind.scale_of(result, name)
    if one.uncertainty is None or not math.isfinite(one.uncertainty):
        numerical = "the numerical uncertainty is unknown"
    elif one.uncertainty <= NEGLIGIBLE * size:
        numerical = "the numerical uncertainty is negligible"
    else:
        numerical = f"± is the numerical uncertainty, {percent(one.uncertainty / size)} ({origin})"
    if result.outside:
        return f"{outside_in_words(result.outside)}; {numerical}"
    error = stated_errors(result).get(name)
    if error is None or not math.isfinite(error.error) or error.source == BY_ITS_RUN:
        return f"{numerical}; effects that the model leaves out are not in it"
    if error.source == BY_LAWS:
        return f"{numerical}; the error of the model is expected to be at most {error.amount} by the fitted laws"
    return f"{numerical}; the error of the model is {error.words}"


def left_out(scene: Scene, model: Model, models: Sequence[Model]) -> str:
    """The effects that a model leaves out in words: those of other models, and those that no model keeps."""
    missing = _missing(scene, model, models)
    kind = kind_of_scene(scene)
    omission = kind.omitted(scene, model, next(iter(kind.compared)))
    parts = [
        listed(missing) if missing else "",
        "" if model.complete else "the higher orders of its effects in a small parameter",
        f"{kind.excluded_from(scene)}, which no model of this kind includes",
        omission.reason if omission else "",
    ]
    return "; ".join(filter(None, parts))


def _missing(scene: Scene, model: Model, models: Sequence[Model]) -> list[str]:
    """The effects that other models for a scene keep and this one leaves out."""
    applying = (one for one in models if one.applies(scene).applies)
    kept = frozenset[str]().union(*(one.keeps for one in applying))
    return sorted(kept - model.keeps - kind_of_scene(scene).absent(scene))


def listed(names: Sequence[str]) -> str:
    """The names in a sentence.

    >>> listed(["load", "friction", "film"])
    'load, friction and film'
    """
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
