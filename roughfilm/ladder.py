"""The models of every kind of scene, those that run OpenFOAM among them."""

import importlib
from functools import cache

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.model import Model, ladder, model_modules


@cache
def models(kind: str | None = None) -> tuple[Model, ...]:
    """All models, or those of one kind of scene, each kind's from the plainest to the one that keeps most.

    Examples
    --------
    >>> [model.name for model in models("seal")]
    ['effective_medium', 'homogenized_leakage', 'direct_leakage']
    """
    return ladder(rom, foamcases, kind=kind)


def find(kind: str, name: str) -> Model:
    """The model of that kind of scene and name; no other model is imported.

    Raises
    ------
    InputError
        If there is no such model, with the names of those that there are.

    Examples
    --------
    >>> find("pocket", "film").summary
    'thin-film Navier-Stokes: inertia in full'
    """
    modules = model_modules(rom, foamcases, kind=kind)
    if not isinstance(name, str) or (kind, name) not in modules:
        raise InputError(f"model: got {name!r}; it must be one of {', '.join(model.name for model in models(kind))}")
    model: Model = importlib.import_module(modules[kind, name]).MODEL
    return model
