"""The recipe of a preparation as an argument."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.recipe import Recipe, load_recipe, read_recipe


def steps_of(recipe: object, usual: Mapping[str, Any] | None = None) -> Recipe:
    """The recipe from nested entries or a TOML file; from ``usual`` entries for None; InputError for anything else."""
    if isinstance(recipe, Mapping):
        return read_recipe(recipe)
    if recipe is not None and not isinstance(recipe, str | os.PathLike):
        raise InputError(f"recipe: got {type(recipe).__name__}; give the name of a TOML file, or a dictionary")
    return load_recipe(None if recipe is None else Path(recipe), usual=usual)
