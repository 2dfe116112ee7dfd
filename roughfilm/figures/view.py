"""The view of a kind of scene in pages and figures, as data."""

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughfilm.figures.views
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns
from roughfilm.rom.studies.reference import Reference
from roughfilm.rom.studies.sweep import Sweep


@dataclass(frozen=True, kw_only=True)
class Style:
    """Colour, line and marker of a model."""

    colour: str | None = None
    line: str | tuple[int, tuple[int, ...]] = "-"
    marker: str = "o"


@dataclass(frozen=True, kw_only=True)
class View:
    """The words, figures and styles of a kind of scene; every file under ``figures/views/`` ends with ``VIEW``.

    Attributes
    ----------
    page : template of a comparison, which extends comparison.html.j2.
    styles : style of each model.
    labels : names of the compared quantities in tables.
    headings : quantities in the table of the models, with their headings (HTML).
    plots : plots(scene, results), figures of the kind, SVG by name.
    groups : groups(given), masks of the cases of a sweep that share a marker, by name.
    drawing : module that draws a result which resolves the film, in space; empty where there is none.
    maps : maps(sweep, setting, reference, quantity), errors over the varied entries, SVG; None where there is no map.
    errors : quantities whose errors a sweep gives, in words.
    ordering : features of a sweep, in words.
    left_out : cases of a sweep that its numbers leave out, in words, after a space; empty if none.
    """

    page: str
    styles: Mapping[str, Style]
    labels: Mapping[str, str]
    headings: Mapping[str, str]
    plots: Callable[[Any, Mapping[str, Result]], Mapping[str, str]]
    groups: Callable[[Columns], Mapping[str, NDArray[Any]]]
    drawing: str = ""
    maps: Callable[[Sweep, str, Reference, str], str] | None = None
    errors: str = ""
    ordering: str = ""
    left_out: str = ""

    def style(self, model: str) -> Style:
        """The style of a model."""
        return self.styles.get(model, Style())

    def style_of(self, setting: str) -> Style:
        """The style of a setting: that of its model, with a cross if the setting chooses more than the model."""
        name, *chosen = setting.split("-")
        style = self.style(name)
        return Style(colour=style.colour, line=style.line, marker="X") if chosen else style


def groups_by(column: str) -> Callable[[Columns], dict[str, NDArray[Any]]]:
    """The groups of cases by the names in one column of a sweep."""
    return lambda given: {str(name): given[column] == name for name in np.unique(given[column])}


@cache
def views() -> Mapping[str, View]:
    """The ``VIEW`` of every module in ``roughfilm/figures/views``, by the kind of scene the module is named after."""
    names = [module.name for module in pkgutil.iter_modules(roughfilm.figures.views.__path__)]
    return {name: importlib.import_module(f"roughfilm.figures.views.{name}").VIEW for name in names}
