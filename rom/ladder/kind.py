"""A kind of scene as data: the class of its scenes, its compared quantities, and other data that commands use."""

import importlib
import importlib.util
import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import Annotated, Any

from pydantic import Field, ValidationError

from roughfilm import rom
from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.faults import EntriesFile, Fault, faults_of, in_lines, known_keys, unknown_key
from roughfilm.contact.foundation.line_numbers import Location
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Sweeping


class Scene(Part):
    """The scene that is solved: geometry, materials, motion and loads, in SI units; each kind adds its own tables.

    Attributes
    ----------
    name : name of the scene, 1 to 200 characters.
    kind : name of the kind of scene.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> isinstance(scene, rf.Scene), scene.name, scene.kind
    (True, 'pocket', 'pocket')
    """

    name: Annotated[str, Field(min_length=1, max_length=200)]
    kind: str


def plain_faults(error: ValidationError, _entries: Mapping[str, Any], *, scene: type[Scene]) -> Sequence[Fault]:
    """The faults of a scene whose tables are all pydantic models."""

    def unknown(location: Location) -> tuple[str, str]:
        *path, key = location
        return unknown_key(key, known_keys(scene, path))

    return faults_of(error, unknown)


def nothing_omitted(_scene: Any, _model: Any, _quantity: str) -> None:
    """Return no omission, for kinds whose most complete model keeps every relevant effect."""


def nothing_missing(_scene: Any, _model: Any) -> float:
    """Return 0, for kinds whose model that keeps the most effects is the most complete one for every scene."""
    return 0.0


def within_laws(_scene: Any, _result: Any, _quantity: str) -> str:
    """Return no reason, for kinds whose results do not show whether the error laws hold."""
    return ""


def within_range(_scene: Any, _model: Any, _result: Result | None) -> tuple[str, ...]:
    """Return no reasons, for kinds whose models hold for all of their scenes, or state their range themselves."""
    return ()


def nothing_of_input(_scene: Any, _quantity: str) -> None:
    """Return nothing, for kinds whose inputs have no error of their own."""
    return


def nothing_bounded(_scene: Any, _model: Any) -> frozenset[str]:
    """Return no quantities, for kinds none of whose results bounds the error of its model."""
    return frozenset()


def nothing_absent(_scene: Any) -> frozenset[str]:
    """Return no effects, for kinds whose models keep no effect that one of their scenes lacks."""
    return frozenset()


def nothing_composed(_scene: Any) -> tuple[str, ...]:
    """Return no lines, for kinds whose scenes are not composed of effects."""
    return ()


def no_surface(_scene: Any) -> None:
    """Return no surface, for kinds whose scenes have none that is one window of a larger surface."""
    return


def from_zero(_entries: Mapping[str, Any], _quantity: str) -> float:
    """Return 0, for kinds whose quantities are measured from zero."""
    return 0.0


def always_lawful(_entries: Mapping[str, Any]) -> bool:
    """Return False, for kinds whose error laws hold for all of their scenes."""
    return False


def nothing_remarked(_entries: Mapping[str, Any], _quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """Return no sentences, for kinds whose quantities need none."""
    return ()


@dataclass(frozen=True, kw_only=True)
class Omission:
    """An effect that a model leaves out and that the error laws do not count.

    Attributes
    ----------
    part : relative change of a quantity by the effect; infinite if it is unknown.
    reason : the effect and its size, in words.
    source : origin of the part in words, for an error that consists mostly of it; "" if the part does not change the
        origin of the error.
    """

    part: float
    reason: str
    source: str = ""


@dataclass(frozen=True, kw_only=True)
class InTime:
    """What a motion in time means for a scene.

    Attributes
    ----------
    lines : sentences on the change in time.
    entries : the same as entries for JSON.
    """

    lines: tuple[str, ...]
    entries: Mapping[str, Any]


def as_given(scene: Any) -> Any:
    """Return the scene, for kinds whose scenes do not change in time."""
    return scene


def unchanging(_scene: Any, _within: float) -> None:
    """Return nothing, for kinds whose scenes do not change in time."""
    return


@dataclass(frozen=True, kw_only=True)
class Kind:
    """A kind of scene as data; every module ``rom/<kind>/kind.py`` defines one as ``KIND``.

    Attributes
    ----------
    name : name of the kind, as scenes give it in ``kind``.
    scene : the pydantic model of the scenes of this kind.
    summary : a description of these scenes, in words.
    compared : the quantities by which models are compared, with their names in a sentence; the most important is first.
    others : the other quantities that models of the kind report, with their names in a sentence.
    reported : the titles of all quantities in tables and pages, in their order there.
    remarks : remarks(entries, quantities), sentences that belong to the quantities of a result, such as for which part
        of the whole they hold.
    compared_with : the compared quantities of scenes that have a table, by the name of the table; the error laws of the
        kind do not hold for these scenes, those of a variant do.
    lawful : whether the error laws hold; False for a scene with such a table and the laws of the kind, and for one that
        is lawless.
    lawless : lawless(entries), whether the error laws do not hold for a scene with these entries.
    laws : name of the error laws of its scenes in the table of laws; "" for the name of the kind.
    variants : by the name of their error laws, whether entries of a scene have these laws in place of those of the
        kind.
    samples : by the name of a further set of random scenes by which its models are judged, beside those of the kind,
        the models whose laws of the resolution are fitted to them.
    ratios : quantities that are the ratio of two others, with the names of these; their errors follow from those.
    alike : title of a reported quantity, such as a power, that has the relative error of a compared one, by its name.
    origin : origin(entries, quantity), the value from which the size of a quantity is measured, such as the temperature
        of the supplied lubricant of a temperature; 0 by default.
    scale : scale(values, quantity), the size by which an error in a compared quantity is divided. ``values`` are the
        values of the reference by quantity, as numbers or arrays.
    columns : columns(scene), dimensionless numbers and texts of a scene for a table of many cases.
    replaces : keys of the same table that an override of a key removes, or a function of its value that returns them.
    lists : places of lists that are one value. A study sweeps every other list, and lists of such values.
    numbers : numbers(scene), the dimensionless numbers of the error laws, without those that have no meaning.
    symbols : the symbols of these numbers.
    window : window(scene), the rough surface that stands for a larger one; None if a scene has none.
    composed : composed(scene), a line on the model of each effect of a scene, with its reason.
    excluded : the effects that no model of the kind includes, in words, or excluded(scene), which returns them.
    absent : absent(scene), the effects that the scene does not have, although models that solve it keep them.
    steady : steady(scene), the scene at the time by which models are judged, such as that of its largest load.
    without_time : without_time(scene), the scene without what changes in time, which a model solves.
    in_time : in_time(scene, within), what a motion in time means for a tolerance; None for a scene that is steady.
    omitted : omitted(scene, model, quantity), the size of an effect that a model leaves out and that the error laws do
        not count, such as one that no model of the kind includes; None if it is zero or unknown.
    of_input : of_input(scene, quantity), the error by what was done to the input before, such as the preparation of a
        measured surface: it adds to the stated error of every model, and the choice of a model does not depend on it.
    missing : missing(scene, model), the relative size of the effects that a model leaves out in a scene, where no model
        keeps them all: the best model for the scene misses least.
    bounded : bounded(scene, model), the quantities whose error by the model its results bound themselves: as the detail
        ``BOUND`` with the name of the quantity, in its unit.
    outside_laws : outside_laws(scene, result, quantity), the reason for which a result shows that the error laws of a
        quantity do not hold; empty if it does not.
    outside : outside(scene, model, result), one sentence for each way in which a scene is outside the range of a model,
        with the number and its limit. The result is None before the scene is solved: the advice takes no such model.
        Afterwards the sentences join those that the model itself puts into ``Result.outside``. It is cheap and does not
        raise.
    faults : faults(error, entries), the faults of a scene, from pydantic's error; None for ``plain_faults``.
    sweeping : the data for a report over many cases; None if the kind has no such report.
    """

    name: str
    scene: type[Scene]
    summary: str
    compared: Mapping[str, str]
    scale: Callable[[Mapping[str, Any], str], Any]
    columns: Callable[[Any], Mapping[str, Quantity | str]]
    numbers: Callable[[Any], Mapping[str, float]]
    symbols: Mapping[str, str]
    excluded: str | Callable[[Any], str]
    origin: Callable[[Mapping[str, Any], str], float] = from_zero
    others: Mapping[str, str] = field(default_factory=dict)
    reported: Mapping[str, str] = field(default_factory=dict)
    remarks: Callable[[Mapping[str, Any], Mapping[str, Quantity]], Sequence[str]] = nothing_remarked
    compared_with: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    lawful: bool = True
    lawless: Callable[[Mapping[str, Any]], bool] = always_lawful
    laws: str = ""
    variants: Mapping[str, Callable[[Mapping[str, Any]], bool]] = field(default_factory=dict)
    samples: Mapping[str, frozenset[str]] = field(default_factory=dict)
    ratios: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    alike: Mapping[str, str] = field(default_factory=dict)
    window: Callable[[Any], Surface | None] = no_surface
    composed: Callable[[Any], Sequence[str]] = nothing_composed
    steady: Callable[[Any], Any] = as_given
    without_time: Callable[[Any], Any] = as_given
    in_time: Callable[[Any, float], InTime | None] = unchanging
    absent: Callable[[Any], frozenset[str]] = nothing_absent
    omitted: Callable[[Any, Any, str], Omission | None] = nothing_omitted
    of_input: Callable[[Any, str], Omission | None] = nothing_of_input
    missing: Callable[[Any, Any], float] = nothing_missing
    bounded: Callable[[Any, Any], frozenset[str]] = nothing_bounded
    outside_laws: Callable[[Any, Any, str], str] = within_laws
    outside: Callable[[Any, Any, Result | None], Sequence[str]] = within_range
    replaces: Mapping[str, Sequence[str] | Callable[[Any], Sequence[str]]] = field(default_factory=dict)
    lists: frozenset[tuple[str | int, ...]] = frozenset()
    faults: Callable[[ValidationError, Mapping[str, Any]], Sequence[Fault]] | None = None
    sweeping: Sweeping | None = None

    @property
    def titles(self) -> Mapping[str, str]:
        """The names in a sentence of all quantities, the compared ones first."""
        return {**self.compared, **self.others}

    def replaced(self, key: str, value: object) -> Sequence[str]:
        """The keys of the same table that an override of a key by a value removes."""
        keys = self.replaces.get(key, ())
        return keys(value) if callable(keys) else keys

    @property
    def named(self) -> Mapping[str, str]:
        """The names in a sentence of all quantities that a result may show, those in ``titles`` first."""
        return {**self.titles, **{name: title for name, title in self.reported.items() if name not in self.titles}}

    def excluded_from(self, scene: Scene) -> str:
        """The effects that no model of the kind includes for a scene, in words."""
        return self.excluded if isinstance(self.excluded, str) else self.excluded(scene)

    def listed(self, result: Result) -> dict[str, str]:
        """The names and titles of the quantities of a result that people read, in the order in which they read them.

        The first is the one that a scene asks for by a table of its own, such as the film under a load. A quantity per
        width is left out where that of the whole width is there. Quantities without a title have their name as the
        title, and come last.
        """
        entries = result.provenance["scene"]
        seeks = any(entries.get(table) is not None for table in self.compared_with)
        first = tuple(self.of(entries).compared)[:1] if seeks else ()
        names, whole = result.quantities, {f"{name}_per_width" for name in result.quantities}
        ordered = dict.fromkeys((*first, *self.reported, *names))
        return {name: self.reported.get(name, name) for name in ordered if name in names and name not in whole}

    def of(self, entries: Mapping[str, Any]) -> "Kind":
        """The kind with the compared quantities and the laws of a scene, from its entries by the names of tables."""
        own = next((name for name, belongs in self.variants.items() if belongs(entries)), "")
        if own:
            return self.variant(own).of(entries)
        for table, compared in self.compared_with.items():
            if entries.get(table) is not None:
                return self._comparing(compared)
        return replace(self, lawful=False) if self.lawless(entries) else self

    @property
    def name_of_laws(self) -> str:
        """The name of the error laws of its scenes in the table of laws."""
        return self.laws or self.name

    @property
    def names_of_laws(self) -> tuple[str, ...]:
        """The names of the error laws of its scenes, those that are fitted to further sets of scenes too."""
        return self.name_of_laws, *self.samples

    def laws_of_grids(self, model: str) -> str:
        """The name of the laws of the resolution of a model in the table of laws."""
        own = (name for name, models in self.samples.items() if model in models)
        return next(own, self.name_of_laws)

    def variant(self, name: str) -> "Kind":
        """The kind of scenes with laws of their own."""
        return replace(self, laws=name, variants={}, samples={})

    def seeking(self, quantity: str) -> "Kind":
        """The kind of scenes that ask for a quantity by a table of their own, such as the film under a load."""
        own = [compared for compared in self.compared_with.values() if next(iter(compared)) == quantity]
        return self._comparing(own[0]) if own else self

    def _comparing(self, compared: Mapping[str, str]) -> "Kind":
        others = {name: title for name, title in self.titles.items() if name not in compared}
        return replace(self, compared=compared, others=others, lawful=bool(self.laws))

    def read(self, entries: Mapping[str, Any], file: EntriesFile | None = None) -> Scene:
        """Make a scene of this kind from nested entries of a file; InputError with a line for each fault."""
        try:
            with finite_arithmetic("scene" if file is None else str(file.path)):
                return self.scene.model_validate(entries)
        except ValidationError as error:
            faults = (self.faults or partial(plain_faults, scene=self.scene))(error, entries)
            raise InputError(in_lines(faults, "scene", file)) from None
        except ConvergenceError as error:
            raise InputError(str(error)) from error

    def scale_of(self, result: Result, quantity: str) -> float:
        """The size by which an error in a quantity is divided, if this result is the reference."""
        values = {name: one.value for name, one in result.quantities.items()}
        return self.size_of(result.provenance["scene"], values, quantity)

    def size_of(self, entries: Mapping[str, Any], values: Mapping[str, float], quantity: str) -> float:
        """The size by which an error in a quantity is divided, of values for a scene with these entries."""
        from_origin = values[quantity] - self.origin(entries, quantity)
        return float(self.scale({**values, quantity: from_origin}, quantity))

    def shared(self, *results: Result) -> tuple[str, ...]:
        """The names of the compared quantities that all of these results have and whose size in the last is not 0."""
        names = (name for name in self.compared if all(name in result.quantities for result in results))
        return tuple(name for name in names if self.scale_of(results[-1], name) != 0)


@cache
def kind_names() -> tuple[str, ...]:
    """The names of all kinds, which are the folders of ``rom`` with a subfolder ``models``."""
    folders = [folder.name for folder in pkgutil.iter_modules(rom.__path__) if folder.ispkg]
    return tuple(name for name in folders if importlib.util.find_spec(f"{rom.__name__}.{name}.models"))


def kind_of_name(name: str) -> Kind:
    """The kind of a name, for which only its module ``rom/<name>/kind.py`` is imported; KeyError if there is none."""
    if name not in kind_names():
        raise KeyError(name)
    kind: Kind = importlib.import_module(f"{rom.__name__}.{name}.kind").KIND
    return kind


def kind_of_laws(name: str) -> Kind:
    """The kind whose scenes have the error laws, or are a set of random scenes, of a name; KeyError if none is."""
    if name in kind_names():
        return kind_of_name(name)
    for kind in kinds().values():
        if name in kind.variants:
            return kind.variant(name)
        if name in kind.samples:
            return kind
    raise KeyError(name)


def kinds() -> Mapping[str, Kind]:
    """All kinds, by their names."""
    return {name: kind_of_name(name) for name in kind_names()}


def kind_of(result: Result) -> Kind:
    """The kind of scene that a result solves."""
    entries = result.provenance["scene"]
    return kind_of_name(entries["kind"]).of(entries)


def kind_of_scene(scene: Scene) -> Kind:
    """The kind of a scene, with the quantities that are compared for this scene."""
    return kind_of_name(scene.kind).of(dict(scene))
