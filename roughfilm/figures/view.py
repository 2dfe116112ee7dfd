"""The view of a kind of scene in pages and figures, as data."""

import importlib
import pkgutil
from collections.abc import Callable, Mapping, Sequence
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
class Plot:
    """A figure as SVG text, and sentences on what it does not draw."""

    svg: str
    words: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class View:
    """The words, figures and styles of a kind of scene; every file under ``figures/views/`` ends with ``VIEW``.

    Attributes
    ----------
    page : template of a comparison, which extends comparison.html.j2.
    styles : style of each model.
    cards : quantities at the top of a comparison beside the one that the scene asks for, those of the whole first.
    rows : quantities in the table of the models.
    plots : plots(scene, results, reference), figures of the kind by name, with the fields of the model ``reference``.
    line : name of the figure with the pressure along the film; empty if there is none.
    groups : groups(given), masks of the cases of a sweep that share a marker, by name.
    drawing : module that draws a result which resolves the film, in space; empty where there is none.
    maps : maps(sweep, setting, reference, quantity), errors over the varied entries, SVG; None where there is no map.
    grids : origin of the uncertainty by grids, in words.
    errors : quantities whose errors a sweep gives, in words.
    ordering : features of a sweep, in words.
    left_out : cases of a sweep that its numbers leave out, in words, after a space; empty if none.
    """

    page: str
    styles: Mapping[str, Style]
    cards: Sequence[str]
    rows: Sequence[str]
    plots: Callable[[Any, Mapping[str, Result], str], Mapping[str, Plot]]
    groups: Callable[[Columns], Mapping[str, NDArray[Any]]]
    line: str = ""
    drawing: str = ""
    maps: Callable[[Sweep, str, Reference, str], str] | None = None
    grids: str = "grid convergence index"
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
