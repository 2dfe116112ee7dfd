"""The recipe of a preparation: the parameters of every step, as tables of a TOML file."""

import copy
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, ValidationError, model_validator

from roughfilm.contact.foundation.entries import Coordinate, Length, LengthPair, Part, plain_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.faults import faults_of, in_lines, known_keys, unknown_key
from roughfilm.contact.foundation.line_numbers import Location
from roughfilm.contact.foundation.toml import read_toml, set_entry
from roughfilm.contact.preparation.edges.blending import Direction
from roughfilm.contact.preparation.form import Form
from roughfilm.contact.preparation.grid import Method

EXAMPLE_LINE = 'form = "quadratic"'
"""A correct line of a recipe, for messages."""

MAX_QUANTILE = 0.1
"""Largest fraction of the points that may be clipped at each end; a larger one leaves no surface."""

Count = Annotated[int, Field(strict=True, ge=2, le=100_000)]


def _listed(given: object) -> object:
    """A single value as a list."""
    return given if isinstance(given, list | tuple) else [given]


class Reading(Part):
    """Channel, pixel spacing (m) and unit of heights, where the file of the surface lacks them or is wrong.

    ``invalid`` are heights that mark missing points, in the unit of the file.
    """

    channel: str | None = None
    spacing: LengthPair | None = None
    height_unit: Annotated[str, Field(min_length=1, max_length=20)] | None = None
    invalid: Annotated[tuple[Annotated[float, BeforeValidator(plain_number)], ...], BeforeValidator(_listed)] = ()


class Outliers(Part):
    """Limit of spikes and rims, in spreads of the heights, and fraction of the points clipped at each end.

    With a limit of 0 no spikes are sought, with a quantile of 0 nothing is clipped.
    """

    limit: Annotated[float, Field(ge=0, le=1e6)] = 4.0
    quantile: Annotated[float, Field(ge=0, le=MAX_QUANTILE)] = 0.0


class Sampling(Part):
    """Size and start of the window (m); without a start, the window of at least this size whose edges match best."""

    size: LengthPair
    start: tuple[Coordinate, Coordinate] | None = None


class Grid(Part):
    """Number of pixels along x and y, or the pixels of the measurement ("kept"), or the next powers of two."""

    points: tuple[Count, Count] | Literal["powers of two", "kept"] = "kept"
    method: Method = "linear"


class Edges(Part):
    """How edges are joined, in which direction, and the width of the joint (m), by default half of Sal.

    ``"seams"`` joins along seams through an overlap, where the heights fit; ``"blended"`` blends the margin with a
    low-pass filtered copy, as in the source. ``"auto"`` joins in both directions; blended edges are joined along a
    strong lay only.
    """

    method: Literal["seams", "blended"] = "seams"
    direction: Literal[Direction, "auto"] = "auto"
    width: Length | None = None


class Recipe(Part):
    """Parameters of all steps, in their order; ``s_filter`` and ``l_filter`` are nesting indices, m.

    The moving average of ``smoothing`` has 3 points by default, without an S-filter, and 1 point with one.
    """

    read: Reading = Reading()
    form: Form = "quadratic"
    outliers: Outliers = Outliers()
    s_filter: Length | None = None
    l_filter: Length | None = None
    window: Sampling | None = None
    grid: Grid = Grid()
    edges: Edges = Edges()
    smoothing: Annotated[int, Field(strict=True, ge=1, le=101)] = 3

    @model_validator(mode="before")
    @classmethod
    def _smooth_once(cls, entries: Any) -> Any:
        if isinstance(entries, Mapping) and entries.get("s_filter") is not None:
            return {"smoothing": 1, **entries}
        return entries

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        short, long = self.s_filter, self.l_filter
        if short is not None and long is not None and long <= short:
            raise ValueError(
                f"got l_filter {long * 1e6:.4g} um and s_filter {short * 1e6:.4g} um; the L-filter removes longer "
                "waves than the S-filter: give l_filter the larger nesting index"
            )
        return self


AS_IT_IS: Mapping[str, Any] = {
    "form": "none",
    "outliers": {"limit": 0.0},
    "edges": {"direction": "none"},
    "smoothing": 1,
}
"""Entries of a recipe that changes nothing, for surfaces that are periodic already."""


def load_recipe(
    path: Path | None = None, overrides: Iterable[str] = (), usual: Mapping[str, Any] | None = None
) -> Recipe:
    """Read a recipe from a file and apply overrides.

    Parameters
    ----------
    path : TOML file; without one, the ``usual`` entries are taken.
    overrides : assignments such as ``edges.direction=x``.
    usual : nested entries.

    Raises
    ------
    InputError
        If the file cannot be read, or an entry is unknown or out of range; the message names the key.
    """
    entries = read_toml(path, EXAMPLE_LINE) if path is not None else copy.deepcopy(dict(usual or {}))
    for override in overrides:
        set_entry(entries, override, "edges.direction=x")
    return read_recipe(entries)


def read_recipe(entries: Mapping[str, Any]) -> Recipe:
    """The recipe from nested entries of a TOML file; raises InputError as :func:`load_recipe` does."""
    try:
        return Recipe.model_validate(entries)
    except ValidationError as error:
        raise InputError(in_lines(faults_of(error, _unknown, _named), "recipe")) from None


def recipe_entries(recipe: Recipe) -> dict[str, Any]:
    """The complete recipe as nested entries, with defaults, units as text; `read_recipe` reads it back unchanged."""
    return recipe.model_dump(mode="json", exclude_none=True)


def _named(location: Location) -> Location:
    """The keys and indices of a location, without the types that pydantic tries for one entry, such as tuple[int]."""
    return [part for part in location if not (isinstance(part, str) and "[" in part)]


def _unknown(location: Location) -> tuple[str, str]:
    *path, key = location
    return unknown_key(key, known_keys(Recipe, path))
