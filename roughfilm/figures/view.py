"""How pages and figures show a kind of scene, as data."""

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
from roughfilm.rom.studies.sweep import Sweep


@dataclass(frozen=True, kw_only=True)
class Style:
    """How matplotlib draws a model."""

    colour: str | None = None
    line: str | tuple[int, tuple[int, ...]] = "-"
    marker: str = "o"


@dataclass(frozen=True, kw_only=True)
class View:
    """How one kind of scene is shown; every file under ``figures/views/`` ends with ``VIEW``.

    Attributes
    ----------
    page : the template of its comparisons, which extends comparison.html.j2.
    styles : how each model is drawn.
    labels : a compared quantity as tables name it.
    headings : the quantities in the table of the ladder, with their headings (HTML).
    plots : plots(scene, results): figures of its own, SVG by name.
    groups : groups(given): which cases of a sweep share a marker, masks by name.
    drawing : the module that draws a result which resolves the film, in space; empty where there is none.
    maps : maps(sweep, setting, reference, quantity): errors over what was varied, SVG; None where there is no such map.
    errors : of what a sweep gives errors, in words.
    ordering : what the features of its sweeps are, in words.
    left_out : which cases of a sweep are left out of its numbers, in words, after a space; empty if none.
    """

    page: str
    styles: Mapping[str, Style]
    labels: Mapping[str, str]
    headings: Mapping[str, str]
    plots: Callable[[Any, Mapping[str, Result]], Mapping[str, str]]
    groups: Callable[[Columns], Mapping[str, NDArray[Any]]]
    drawing: str = ""
    maps: Callable[[Sweep, str, str, str], str] | None = None
    errors: str = ""
    ordering: str = ""
    left_out: str = ""

    def style(self, model: str) -> Style:
        """How a model is drawn, a plain way if nobody said."""
        return self.styles.get(model, Style())

    def style_of(self, setting: str) -> Style:
        """How a setting is drawn: as the model that its name begins with, by a cross if more was chosen."""
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
