"""The ladder: models as data, which are listed from their packages and ordered by the effects that they keep."""

import importlib
import importlib.util
import pkgutil
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from enum import StrEnum
from numbers import Integral, Real
from types import ModuleType
from typing import Any, Generic, NotRequired, TypedDict

from typing_extensions import TypeVar

from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.errors import InputError, UnavailableError
from roughfilm.contact.foundation.timing import claimed_costs, imports_apart
from roughfilm.rom.ladder.kind import Scene, kind_of_scene
from roughfilm.rom.ladder.request import CheckedRequest, Request
from roughfilm.rom.ladder.result import Result, with_finite_numbers


class Effect(StrEnum):
    """A piece of physics that a model may keep or leave out."""

    SLOPE = "slope"
    INERTIA = "inertia"
    DEFORMATION = "deformation"
    """Elastic deformation of the whole solid."""
    PLASTICITY = "plasticity"
    """Contact pressure limited by the hardness."""
    SIDE_FLOW = "side flow"
    """Flow across the sliding direction and through the sides of a film."""
    CAVITATION = "cavitation"
    """Films that rupture at the cavitation pressure, with conservation of mass."""
    PRESSURE_DEPENDENCE = "pressure dependence"
    """Density and viscosity that grow with pressure."""
    ROUGHNESS = "roughness"
    """Roughness averaged over its waves, as if these were infinitely short."""
    FINITE_WAVES = "finite waves"
    """Roughness with every wave resolved."""
    SHEAR_THINNING = "shear thinning"
    """Viscosity that falls with the shear rate."""
    HEATING = "heating"
    """Viscosity at the temperature to which friction heats the film, as one number."""
    TEMPERATURE_FIELD = "temperature field"
    """Temperature that varies over the film, as the mean across it."""
    TEMPERATURE_ACROSS = "temperature across"
    """Temperature that varies across the film, from wall to wall."""


OF_LUBRICANT = frozenset({Effect.SHEAR_THINNING, Effect.HEATING, Effect.TEMPERATURE_FIELD, Effect.TEMPERATURE_ACROSS})
"""The effects on the viscosity, which only some lubricants have."""


@dataclass(frozen=True, kw_only=True)
class Applicability:
    """Whether a model applies to a scene, with the reason, or the effects that it leaves out, in words."""

    applies: bool
    reason: str


@dataclass(frozen=True, kw_only=True)
class Availability:
    """Whether the programs that a model needs are on this machine, with their version, or the remedy, in words."""

    available: bool
    detail: str = ""


MAX_COST_S = 1e9
"""Expected CPU time, s, above which a scene is refused: 30 years, or 11 days on 1000 cores."""


def _between(least: float, value: Any, most: float, numbers: Any) -> bool:
    return isinstance(value, numbers) and bool(least <= value <= most)


def always() -> Availability:
    """The availability of models that need no program other than this package."""
    return Availability(available=True, detail="built in")


Progress = Callable[[float, str], None]
"""Function that is called with the done fraction (0 to 1) and a few words."""


def silent(fraction: float, words: str) -> None:
    """Report no progress."""


_reported: ContextVar[Progress] = ContextVar("_reported", default=silent)


@contextmanager
def reported_to(progress: Progress) -> Iterator[None]:
    """Let :func:`report` call this function in the block, for work that is not handed a progress."""
    before = _reported.set(progress)
    try:
        yield
    finally:
        _reported.reset(before)


def report(fraction: float, words: str) -> None:
    """Report progress to the function of the innermost :func:`reported_to`; a progress of its own."""
    _reported.get()(fraction, words)


SceneT = TypeVar("SceneT", bound=Scene, default=Any)


@dataclass(frozen=True, kw_only=True)
class Resolutions:
    """The resolutions of a model.

    Attributes
    ----------
    least, most : least and greatest resolution allowed.
    default : resolution of a request without one.
    series : resolutions from coarse to fine, for studies and charts.
    """

    least: int
    most: int
    default: int
    series: tuple[int, ...]


class About(TypedDict):
    """The entries of a model that a family's function passes on to ``Model``, which explains them."""

    name: str
    summary: str
    keeps: frozenset[Effect]
    complete: NotRequired[bool]
    sources: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Model(Generic[SceneT]):
    """A model of one kind of scene, as data: the effects that it keeps, its range and cost, and its solver.

    Parameters
    ----------
    name : name of its module, ``<kind>/models/<name>.py``.
    kind : kind of the scenes that it solves.
    summary : its description in half a line.
    keeps : the physical effects that it keeps.
    complete : whether it keeps these effects in full; False if it keeps them to some order in a small parameter.
    sources : DOIs of its equations and method.
    resolutions : allowed and default resolutions, or a function of the scene that returns them.
    resolution_meaning : the things that the resolution counts, in words.
    residual_meaning : the error that the residual measures, in words.
    order : order of load and friction in the resolution; None for a spectral method; or a function of the scene that
        returns it.
    tolerance : default residual at which its solver stops.
    tolerances : least and greatest tolerance allowed.
    schemes : advection schemes that it offers, the default first; empty where there is no choice.
    most_processes : most_processes(scene, resolution), the largest number of processes; None for a model that runs in
        this process.
    cost : cost(scene, resolution), expected CPU seconds.
    applies : applies(scene), whether the model can solve the scene, and which effects it leaves out.
    outside : whether another program solves the scene, in a directory.
    available : whether the programs that it needs are on this machine.
    compute : compute(model, scene, request, progress), its solver, which is called with a checked request.
    """

    name: str
    kind: str
    summary: str
    keeps: frozenset[Effect]
    complete: bool = True
    sources: tuple[str, ...]
    resolutions: Resolutions | Callable[[SceneT], Resolutions]
    resolution_meaning: str
    residual_meaning: str
    order: int | Callable[[SceneT], int | None] | None
    tolerance: float
    tolerances: tuple[float, float] = (1e-13, 1.0)
    schemes: tuple[str, ...] = ()
    most_processes: Callable[[SceneT, int], int] | None = None
    cost: Callable[[SceneT, int], float]
    applies: Callable[[SceneT], Applicability]
    outside: bool = False
    available: Callable[[], Availability] = always
    compute: "Callable[[Model[SceneT], SceneT, CheckedRequest, Progress], Result]"

    def __repr__(self) -> str:
        return f"Model(name={self.name!r}, kind={self.kind!r}, summary={self.summary!r})"

    def solve(self, scene: SceneT, request: Request = Request(), progress: Progress = silent) -> Result:
        """Solve a scene with the numerical options of a request, and the model's defaults where the request has None.

        Parameters
        ----------
        scene : scene of this model's kind.
        request : numerical options.
        progress : called with the done fraction and a few words.

        Returns
        -------
        Result
            Quantities and fields of the scene, with a residual that is recomputed from the solution. Its numerics hold
            the one-time costs of this process since the result before, such as a table or the surface of the scene.
            ``outside`` says where the scene or its solution is outside the range of the model.

        Raises
        ------
        InputError
            If an option is outside the range that the model allows, the model cannot solve the scene, or it would take
            more than ``MAX_COST_S``.
        ConvergenceError
            If the solver does not reach the tolerance, or its numbers overflow.
        UnavailableError
            If a program that the model needs is not on this machine.
        """
        here = self.available()
        if not here.available:
            raise UnavailableError(f"{self.name}: {here.detail}")
        with reported_to(progress), finite_arithmetic(self.name), imports_apart():
            checked, started = self.checked(scene, request), time.perf_counter()
            if not (fits := self.applies(scene)).applies:
                raise InputError(f"model: got {self.name!r}; {fits.reason}")
            if not self.cost(scene, checked.resolution) <= MAX_COST_S:
                raise InputError(
                    f"resolution: {checked.resolution} {self.resolution_meaning} would take {self.name} more than "
                    f"{MAX_COST_S:g} s of CPU; take fewer"
                )
            result = with_finite_numbers(self.compute(self, scene, checked, progress))
        waited = max(time.perf_counter() - started, result.numerics.wall_s)
        spent = max(0.0, result.numerics.cpu_s)  # below 0 by round-off where all of it is one-time
        numerics = replace(result.numerics, cpu_s=spent, wall_s=waited, one_time=claimed_costs())
        return self.bounded(scene, replace(result, numerics=numerics))

    def bounded(self, scene: SceneT, result: Result) -> Result:
        """The result of a scene with all ways in which the scene or its solution is outside the range of the model."""
        found = dict.fromkeys((*result.outside, *kind_of_scene(scene).outside(scene, self, result)))
        return replace(result, outside=tuple(found))

    def checked(self, scene: SceneT, request: Request) -> CheckedRequest:
        """The request with the model's defaults filled in; InputError for an option that the model does not allow."""
        offered = self.offered(scene)
        resolution = offered.default if request.resolution is None else request.resolution
        if not _between(offered.least, resolution, offered.most, Integral):
            raise InputError(
                f"resolution: got {resolution!r}; {self.name} takes {offered.least} to {offered.most} "
                f"{self.resolution_meaning}"
            )
        tolerance = self.tolerance if request.tolerance is None else request.tolerance
        least, most = self.tolerances
        if not _between(least, tolerance, most, Real):
            raise InputError(f"tolerance: got {tolerance!r}; {self.name} takes {least:g} to {most:g}")
        return CheckedRequest(
            resolution=resolution,
            tolerance=tolerance,
            scheme=self.checked_scheme(request.scheme),
            processes=self._checked_processes(scene, resolution, request.processes),
            asked=request,
        )

    def checked_scheme(self, scheme: str | None) -> str:
        """The advection scheme, or the model's first one for None; InputError for a scheme that it does not offer."""
        if scheme is None:
            return self.schemes[0] if self.schemes else ""
        if scheme not in self.schemes:
            names = ", ".join(self.schemes)
            remedy = f"it must be one of {names}" if names else "it offers no choice, leave it out"
            raise InputError(f"scheme: got {scheme!r} for {self.name}; {remedy}")
        return scheme

    def _checked_processes(self, scene: SceneT, resolution: int, processes: int) -> int:
        most = 1 if self.most_processes is None else self.most_processes(scene, resolution)
        if not _between(1, processes, most, Integral):
            alone = f"{self.name} runs in one process, leave it out"
            remedy = alone if self.most_processes is None else f"it must be 1 to {most}, two columns for each"
            raise InputError(f"processes: got {processes!r}; {remedy}")
        return processes

    def offered(self, scene: SceneT) -> Resolutions:
        """The allowed and default resolutions for a scene."""
        return self.resolutions if isinstance(self.resolutions, Resolutions) else self.resolutions(scene)

    def order_of(self, scene: SceneT) -> int | None:
        """The order of load and friction in the resolution for a scene; None for a spectral method."""
        return self.order(scene) if callable(self.order) else self.order

    def resolutions_of(self, scene: SceneT) -> tuple[int, ...]:
        """The resolutions for charts and studies of a scene, from coarse to fine."""
        return self.offered(scene).series

    def resolution_of(self, scene: SceneT) -> int:
        """The default resolution for a scene."""
        return self.offered(scene).default


def model_modules(*packages: ModuleType, kind: str | None = None) -> Mapping[tuple[str, str], str]:
    """The names of the modules ``<package>/<kind>/models/*.py``, by kind and model name, as the folders list them.

    Only the packages ``models`` are imported, whose ``__path__`` may name more folders; the modules in them are not.

    Parameters
    ----------
    *packages : the packages with the folders of kinds, such as ``rom``.
    kind : kind of scene to which the list is limited; None for all kinds.
    """
    modules = {}
    for package in packages:
        for folder in pkgutil.iter_modules(package.__path__):
            name = f"{package.__name__}.{folder.name}.models"
            if folder.ispkg and kind in (None, folder.name) and importlib.util.find_spec(name):
                for module in pkgutil.iter_modules(importlib.import_module(name).__path__):
                    modules[folder.name, module.name] = f"{name}.{module.name}"
    return modules


def ladder(*packages: ModuleType, kind: str | None = None) -> tuple[Model, ...]:
    """The models of packages: the ``MODEL`` of every module ``<package>/<kind>/models/*.py``.

    They are ordered by kind, and within a kind from the fewest to the most effects kept.

    Parameters
    ----------
    *packages : the packages with the folders of kinds, such as ``rom``.
    kind : kind of scene to which the list is limited; only its models are imported. None for all kinds.
    """
    modules = model_modules(*packages, kind=kind).values()
    models: list[Model] = [importlib.import_module(module).MODEL for module in modules]

    def place(model: Model) -> tuple[Any, ...]:
        return model.kind, len(model.keeps), sorted(model.keeps), model.complete, model.name

    return tuple(sorted(models, key=place))


def of_kind(models: Sequence[Model], kind: str) -> tuple[Model, ...]:
    """The models that solve scenes of a kind, in the order of ``models``."""
    return tuple(model for model in models if model.kind == kind)


def find(models: Sequence[Model], kind: str, name: str) -> Model:
    """The model with a name among those for a kind of scene; InputError if there is none."""
    named = {model.name: model for model in of_kind(models, kind)}
    if not isinstance(name, str) or name not in named:
        raise InputError(f"model: got {repr(name)[:60]}; it must be one of {', '.join(named)}")
    return named[name]


def best(models: Sequence[Model]) -> Model:
    """The model that keeps the most effects, in full if there is one: the reference for errors of the others."""
    return max(models, key=lambda model: (len(model.keeps), model.complete))


def best_for(scene: Scene, models: Sequence[Model]) -> Model:
    """The best model for a scene: the one that misses least of its effects, and of equal ones that which keeps most."""
    kind = kind_of_scene(scene)
    absent = kind.absent(scene)
    return max(models, key=lambda model: (-kind.missing(scene, model), len(model.keeps - absent), model.complete))


def one_effect_away(
    model: Model, models: Sequence[Model], absent: frozenset[str] = frozenset()
) -> tuple[tuple[Model, Effect], ...]:
    """The models that keep all effects of ``model`` and one more, each with that effect; all are complete models.

    Effects that are ``absent`` from a scene do not count.
    """
    pairs = []
    for other in models:
        extra = other.keeps - model.keeps - absent
        if model.complete and other.complete and model.keeps - absent < other.keeps and len(extra) == 1:
            pairs.append((other, next(iter(extra))))
    return tuple(pairs)
