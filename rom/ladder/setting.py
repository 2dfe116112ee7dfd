"""Settings: models with a resolution and an advection scheme, as a study lists them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from roughfilm.contact.foundation.errors import InputError, UnavailableError
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, Progress, silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result


@dataclass(frozen=True, kw_only=True)
class Setting:
    """A model with a resolution and an advection scheme; None for the model's default of either."""

    model: Model
    resolution: int | None = None
    scheme: str | None = None

    @property
    def name(self) -> str:
        """The names of model, resolution and scheme as given, for a file name, such as navier_stokes-240-upwind."""
        return "-".join(str(part) for part in (self.model.name, self.resolution, self.scheme) if part is not None)

    def cost(self, scene: Scene) -> float:
        """The expected CPU time for a scene, s."""
        return self.model.cost(scene, self.resolution or self.model.resolution_of(scene))

    def solve(self, scene: Scene, progress: Progress = silent) -> Result:
        """Solve a scene with this setting; errors as in the model's ``solve``."""
        return self.model.solve(scene, Request(resolution=self.resolution, scheme=self.scheme), progress)


def read_settings(table: object, models: Sequence[Model]) -> tuple[Setting, ...]:
    """The settings of a study's table ``[study]``, in the order of ``models``.

    Parameters
    ----------
    table : the entries of the table: ``models``, and ``resolution`` and ``scheme`` by model. Without ``models``, it
        lists all models that are available.
    models : the models of the kind of scene.

    Raises
    ------
    InputError
        If an entry is unknown or has a value that is not allowed.
    UnavailableError
        If a program that a listed model needs is not on this machine.
    """
    if not isinstance(table, dict):
        raise InputError("study: is not a table; write [study]")
    for key in table:
        if key not in ("models", "resolution", "scheme"):
            raise InputError(f"study.{key}: unknown key; known here: models, resolution, scheme")
    names = list(dict.fromkeys(model.name for model in models))
    wanted = table.get("models", names)
    if not isinstance(wanted, list) or not wanted or len(set(map(str, wanted))) < len(wanted):
        raise InputError(f"study.models: got {wanted!r:.80}; list different ones of {', '.join(names)}")
    for name in wanted:
        if name not in names:
            raise InputError(f"study.models: got {name!r}; it must be one of {', '.join(names)}")
    resolutions = _by_model(table, "resolution", wanted)
    schemes = _by_model(table, "scheme", wanted)
    for name, values in resolutions.items():
        for value in values:
            if isinstance(value, bool) or not isinstance(value, int) or value < 1:
                raise InputError(f"study.resolution.{name}: got {value!r}; write a whole number above zero")
    for model in models:
        for value in schemes.get(model.name, ()):
            if value not in model.schemes:
                remedy = f"it must be one of {', '.join(model.schemes)}" if model.schemes else "it offers no choice"
                raise InputError(f"study.scheme.{model.name}: got {value!r}; {remedy}")
    chosen = [model for model in models if model.name in wanted]
    absent = [model for model in chosen if not model.available().available]
    if absent and "models" in table:
        raise UnavailableError(f"study.models: {absent[0].name}: {absent[0].available().detail}")
    chosen = [model for model in chosen if model not in absent]
    return tuple(
        Setting(model=model, resolution=resolution, scheme=scheme)
        for model in chosen
        for resolution in resolutions.get(model.name, [None])
        for scheme in schemes.get(model.name, [None])
    )


def _by_model(table: Mapping[str, Any], key: str, names: Sequence[str]) -> dict[str, list[Any]]:
    """The values of ``resolution`` or ``scheme`` in a table ``[study]``, as a list for each model that has an entry."""
    entries = table.get(key, {})
    if not isinstance(entries, dict):
        raise InputError(f"study.{key}: got {entries!r}; write {{ MODEL = VALUE }}")
    chosen = {}
    for name, value in entries.items():
        if name not in names:
            raise InputError(f"study.{key}.{name}: is no model of this study; it must be one of {', '.join(names)}")
        chosen[name] = value if isinstance(value, list) else [value]
        if not chosen[name] or len(set(map(repr, chosen[name]))) < len(chosen[name]):
            raise InputError(f"study.{key}.{name}: got {value!r}; write one value or a list of different ones")
    return chosen
