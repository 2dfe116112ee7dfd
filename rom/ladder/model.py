"""The ladder: models as data, found in their packages, ordered by what they keep."""

import importlib
import importlib.util
import pkgutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.result import Result


class Effect(StrEnum):
    """A piece of physics that a model may keep or leave out."""

    SLOPE = "slope"
    INERTIA = "inertia"
    DEFORMATION = "deformation"
    """Elastic, of the whole solid: where it is pressed, and around."""
    PLASTICITY = "plasticity"
    """Pressure that the hardness bounds."""
    SIDE_FLOW = "side flow"
    """Across the sliding, and through the sides of a film."""
    CAVITATION = "cavitation"
    """Films that rupture where pressure would fall below what the liquid bears, mass kept."""
    PRESSURE_DEPENDENCE = "pressure dependence"
    """Density and viscosity that grow with pressure."""
    ROUGHNESS = "roughness"
    """Averaged over its waves, as if these were infinitely short."""
    FINITE_WAVES = "finite waves"
    """Of roughness: each is there, as long as it is and where it is."""


@dataclass(frozen=True, kw_only=True)
class Applicability:
    """Whether a model can say something of a scene, and why or with what left out, in words."""

    applies: bool
    reason: str


@dataclass(frozen=True, kw_only=True)
class Availability:
    """Whether what a model needs is on this machine: which version, or what to do."""

    available: bool
    detail: str = ""


def always() -> Availability:
    """For models that need nothing but this package."""
    return Availability(available=True, detail="built in")


Progress = Callable[[float, str], None]
"""Called with the done fraction (0 to 1) and a few words."""


def silent(fraction: float, words: str) -> None:
    """Progress that nobody looks at."""


class Solve(Protocol):
    """solve(scene, resolution=None, tolerance=None, scheme=None, processes=1, progress=silent) → Result.

    None means the model's default. Raises InputError, ConvergenceError or UnavailableError, only.
    """

    def __call__(
        self,
        scene: Any,
        *,
        resolution: int | None = None,
        tolerance: float | None = None,
        scheme: str | None = None,
        processes: int = 1,
        progress: Progress = silent,
    ) -> Result:
        """Solve one scene."""
        ...


class Write(Protocol):
    """write(scene, directory, resolution=None, tolerance=None, scheme=None, processes=1): an outside solver's case."""

    def __call__(
        self,
        scene: Any,
        directory: Path,
        *,
        resolution: int | None = None,
        tolerance: float | None = None,
        scheme: str | None = None,
        processes: int = 1,
    ) -> None:
        """Write one case."""
        ...


@dataclass(frozen=True, kw_only=True)
class Model:
    """One rung: which kind of scene it solves, what it keeps, what it costs, where it applies, and how to solve it.

    ``resolutions`` go from coarse to fine, for charts; ``resolution`` is the default one, and
    ``resolution_meaning`` and ``residual_meaning`` say in words what the numbers count. Where the scene decides,
    ``resolution`` is None, ``own_resolutions`` gives them, and the finest is the default.
    ``complete`` says that the effects it keeps are kept in full, not to some order of smallness.
    ``order`` is that of load and friction in the resolution, None for a spectral method.
    ``schemes`` names the advection schemes it offers, the default first; empty where there is no choice.
    """

    name: str
    kind: str
    summary: str
    keeps: frozenset[Effect]
    complete: bool = True
    sources: tuple[str, ...]
    resolution: int | None
    resolutions: tuple[int, ...]
    resolution_meaning: str
    residual_meaning: str
    order: int | None
    cost: Callable[[Any, int], float]
    applies: Callable[[Any], Applicability]
    solve: Solve
    available: Callable[[], Availability] = always
    write: Write | None = None
    schemes: tuple[str, ...] = ()
    own_resolutions: Callable[[Any], tuple[int, ...]] | None = None

    def resolutions_of(self, scene: Scene) -> tuple[int, ...]:
        """Those for charts of a scene, from coarse to fine."""
        return self.resolutions if self.own_resolutions is None else self.own_resolutions(scene)

    def resolution_of(self, scene: Scene) -> int:
        """The default one on a scene."""
        return self.resolutions_of(scene)[-1] if self.resolution is None else self.resolution


def ladder(*packages: ModuleType, kind: str | None = None) -> tuple[Model, ...]:
    """The ``MODEL`` of every ``<package>/<kind>/models/*.py``, by kind from what keeps least to what keeps most.

    With ``kind`` given, only the models of that kind of scene are imported.
    """
    folders = [
        f"{folder.name}.models"
        for package in packages
        for folder in pkgutil.iter_modules(package.__path__, f"{package.__name__}.")
        if folder.ispkg and kind in (None, folder.name.rpartition(".")[2])
    ]
    rooms = [importlib.import_module(folder) for folder in folders if importlib.util.find_spec(folder)]
    names = [module.name for room in rooms for module in pkgutil.iter_modules(room.__path__, f"{room.__name__}.")]
    models: list[Model] = [importlib.import_module(name).MODEL for name in names]

    def place(model: Model) -> tuple[Any, ...]:
        return model.kind, len(model.keeps), sorted(model.keeps), model.complete, model.name

    return tuple(sorted(models, key=place))


def of_kind(models: Sequence[Model], kind: str) -> tuple[Model, ...]:
    """The models that solve scenes of that kind, in their order."""
    return tuple(model for model in models if model.kind == kind)


def find(models: Sequence[Model], name: str) -> Model:
    """The model of that name; InputError if there is none."""
    for model in models:
        if model.name == name:
            return model
    raise InputError(f"--model: got {name!r}; it must be one of {', '.join(model.name for model in models)}")


def chosen_scheme(model: str, schemes: Sequence[str], scheme: str | None) -> str:
    """The advection scheme asked of a model that offers these: the first for None, "" where there is no choice.

    Raises InputError for a name that is not offered.
    """
    if scheme is None:
        return schemes[0] if schemes else ""
    if scheme not in schemes:
        remedy = f"it must be one of {', '.join(schemes)}" if schemes else "it offers no choice, leave the option out"
        raise InputError(f"--scheme: got {scheme!r} for {model}; {remedy}")
    return scheme


def chosen_tolerance(tolerance: float | None, default: float) -> float:
    """The tolerance asked for, the default for None; InputError outside 1e-13..1."""
    tolerance = default if tolerance is None else tolerance
    if not 1e-13 <= tolerance < 1:
        raise InputError(f"--tolerance: got {tolerance}; it must be 1e-13 to 1")
    return tolerance


def one_process(model: str, processes: int) -> None:
    """InputError if a model that computes in this process is asked for more of them."""
    if processes != 1:
        raise InputError(f"--processes: got {processes}; {model} runs in one process, leave the option out")


def best(models: Sequence[Model]) -> Model:
    """The rung of one kind that keeps the most, and in full; every other model's error is measured against it."""
    return max(models, key=lambda model: (len(model.keeps), model.complete))


def one_effect_away(model: Model, models: Sequence[Model]) -> tuple[tuple[Model, Effect], ...]:
    """The models that keep exactly one effect more than ``model``, both in full, each with that effect."""
    pairs = []
    for other in models:
        extra = other.keeps - model.keeps
        if model.complete and other.complete and model.keeps < other.keeps and len(extra) == 1:
            pairs.append((other, next(iter(extra))))
    return tuple(pairs)
