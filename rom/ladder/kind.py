"""A kind of scene, as data: what is in it, what is compared in it, and all else that no command knows by itself."""

import importlib
import importlib.util
import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from typing import Annotated, Any

from pydantic import Field, ValidationError

from roughfilm import rom
from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import Location, in_one_line, known_keys, unknown_key
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Sweeping


class Scene(Part):
    """What is solved: geometry, materials, motion and loads, frozen, in SI units; each kind adds its own tables.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> isinstance(scene, rf.Scene), scene.name, scene.kind
    (True, 'pocket', 'pocket')
    """

    name: Annotated[str, Field(min_length=1, max_length=200)]
    kind: str


def plain_fault(error: ValidationError, _entries: Mapping[str, Any], *, scene: type[Scene]) -> str:
    """The first fault of a scene whose tables are models all the way down, in one line."""

    def unknown(location: Location) -> str:
        *path, key = location
        return unknown_key(key, known_keys(scene, path))

    return in_one_line(error, "scene", unknown)


def nothing_omitted(_scene: Any, _quantity: str) -> None:
    """For kinds whose best rung keeps all that is of interest."""


def nothing_composed(_scene: Any) -> tuple[str, ...]:
    """For kinds whose scenes are not put together of effects."""
    return ()


@dataclass(frozen=True, kw_only=True)
class Omission:
    """What every rung of a kind leaves out: by which part of its size that changes a quantity, and why, in words."""

    part: float
    reason: str


@dataclass(frozen=True, kw_only=True)
class Kind:
    """One kind of scene; every ``rom/<kind>/kind.py`` ends with ``KIND``.

    Attributes
    ----------
    scene : the model of its scenes, whose ``kind`` is ``name``.
    summary : what its scenes are, in words.
    compared : the quantities by which models are judged, with their names in a sentence, the first one first.
    scale : scale(values, quantity): what an error in a compared quantity is divided by, from the reference's values by
        quantity, numbers or arrays alike.
    columns : what a table of many cases tells of a scene, beside what varies: dimensionless numbers, texts.
    files : keys whose texts name files, which are sought beside the scene.
    no_files : texts in their place that name none.
    replaces : keys that an override makes meaningless: it takes them away from the same table.
    lists : where lists stand that are one value; a study sweeps every other list, and lists of these.
    numbers : the dimensionless numbers that tell how far its rungs may be off; those without meaning are left out.
    symbols : how people write them.
    composed : composed(scene): how each of several effects of a scene is told, and why so, a line each.
    omitted : omitted(scene, quantity): what none of its rungs keeps, None where that is nothing or cannot be told.
    told : the first fault of a scene in one line, from pydantic's error and the entries; by default by the models.
    sweeping : how a report over many cases judges them; None if there is none.
    """

    name: str
    scene: type[Scene]
    summary: str
    compared: Mapping[str, str]
    scale: Callable[[Mapping[str, Any], str], Any]
    columns: Callable[[Any], Mapping[str, Quantity | str]]
    numbers: Callable[[Any], Mapping[str, float]]
    symbols: Mapping[str, str]
    composed: Callable[[Any], Sequence[str]] = nothing_composed
    omitted: Callable[[Any, str], Omission | None] = nothing_omitted
    files: frozenset[str] = frozenset()
    no_files: frozenset[str] = frozenset()
    replaces: Mapping[str, Sequence[str]] = field(default_factory=dict)
    lists: frozenset[tuple[str | int, ...]] = frozenset()
    told: Callable[[ValidationError, Mapping[str, Any]], str] | None = None
    sweeping: Sweeping | None = None

    def read(self, entries: Mapping[str, Any]) -> Scene:
        """A scene of this kind; InputError in one line for the first fault."""
        try:
            return self.scene.model_validate(entries)
        except ValidationError as error:
            raise InputError((self.told or partial(plain_fault, scene=self.scene))(error, entries)) from None

    def scale_of(self, result: Result, quantity: str) -> float:
        """What an error in a quantity is divided by where this result is the reference."""
        return float(self.scale({name: found.value for name, found in result.quantities.items()}, quantity))

    def shared(self, *results: Result) -> tuple[str, ...]:
        """The compared quantities that all of these results give."""
        return tuple(name for name in self.compared if all(name in result.quantities for result in results))


@cache
def kind_names() -> tuple[str, ...]:
    """The names of all kinds: the folders of ``rom`` that have models."""
    folders = [folder.name for folder in pkgutil.iter_modules(rom.__path__) if folder.ispkg]
    return tuple(name for name in folders if importlib.util.find_spec(f"{rom.__name__}.{name}.models"))


def kind_of_name(name: str) -> Kind:
    """The ``KIND`` of ``rom/<name>/kind.py``, whose module alone is imported; KeyError if there is none."""
    if name not in kind_names():
        raise KeyError(name)
    kind: Kind = importlib.import_module(f"{rom.__name__}.{name}.kind").KIND
    return kind


def kinds() -> Mapping[str, Kind]:
    """All kinds by their names."""
    return {name: kind_of_name(name) for name in kind_names()}


def kind_of(result: Result) -> Kind:
    """The kind of scene that a result solves."""
    return kind_of_name(result.provenance["scene"]["kind"])
