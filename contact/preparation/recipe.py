"""The recipe: every step of a preparation with its numbers, as a TOML file holds it."""

import copy
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError

from roughfilm.contact.foundation.entries import Coordinate, Length, Part
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import Location, in_one_line, known_keys, read_toml, set_entry, unknown_key
from roughfilm.contact.preparation.edges import Direction
from roughfilm.contact.preparation.form import Form
from roughfilm.contact.preparation.grid import Method

EXAMPLE = 'form = "quadratic"'

Count = Annotated[int, Field(strict=True, ge=2, le=100_000)]


class Reading(Part):
    """What the file does not say, or says wrongly: channel, pixel spacing (m), unit of heights."""

    channel: str | None = None
    spacing: tuple[Length, Length] | None = None
    height_unit: Annotated[str, Field(min_length=1, max_length=20)] | None = None


class Outliers(Part):
    """Cut at the first of ``bins`` bins that holds at least ``points`` points; 0 points cut nothing."""

    bins: Annotated[int, Field(strict=True, ge=1, le=1_000_000)] = 1000
    points: Annotated[int, Field(strict=True, ge=0)] = 10


class Sampling(Part):
    """A window of a size from a start (m); without a start, the one of at least that size that repeats best."""

    size: tuple[Length, Length]
    start: tuple[Coordinate, Coordinate] | None = None


class Grid(Part):
    """Pixels along x and y, or the least powers of two that are not fewer than there are, or as many as there are."""

    points: tuple[Count, Count] | Literal["powers of two", "kept"] = "powers of two"
    method: Method = "linear"


class Edges(Part):
    """Which edges are made to meet, and the standard deviation of the filter (m), by default half of Sal.

    ``"auto"`` joins along a strong lay only, and otherwise in both directions.
    """

    direction: Direction | Literal["auto"] = "auto"
    width: Length | None = None


class Recipe(Part):
    """All steps, in the order in which they are taken."""

    read: Reading = Reading()
    form: Form = "quadratic"
    outliers: Outliers = Outliers()
    window: Sampling | None = None
    grid: Grid = Grid()
    edges: Edges = Edges()
    smoothing: Annotated[int, Field(strict=True, ge=1, le=101)] = 3


AS_IT_IS: Mapping[str, Any] = {
    "form": "none",
    "outliers": {"points": 0},
    "grid": {"points": "kept"},
    "edges": {"direction": "none"},
    "smoothing": 1,
}
"""What a surface that is periodic already needs."""


def load_recipe(
    path: Path | None = None, overrides: Iterable[str] = (), usual: Mapping[str, Any] | None = None
) -> Recipe:
    """Read a recipe file, or else take the ``usual`` entries, and apply overrides such as ``edges.direction=x``.

    Raises
    ------
    InputError
        One line that names the key, what was got there and what to write instead.
    """
    entries = read_toml(path, EXAMPLE) if path is not None else copy.deepcopy(dict(usual or {}))
    for override in overrides:
        set_entry(entries, override, "edges.direction=x")
    return read_recipe(entries)


def read_recipe(entries: Mapping[str, Any]) -> Recipe:
    """A recipe from nested entries as a TOML file holds them; raises InputError as :func:`load_recipe` does."""
    try:
        return Recipe.model_validate(entries)
    except ValidationError as error:
        raise InputError(in_one_line(error, "recipe", _unknown)) from None


def recipe_entries(recipe: Recipe) -> dict[str, Any]:
    """The complete recipe, defaults written out, units as text; ``read_recipe`` reads it back unchanged."""
    return recipe.model_dump(mode="json", exclude_none=True)


def _unknown(location: Location) -> str:
    *path, key = location
    return unknown_key(key, known_keys(Recipe, path))
