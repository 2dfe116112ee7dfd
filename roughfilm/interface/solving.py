"""Solution of a scene by one model, by the cheapest model that is accurate enough, or by all that apply."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from roughfilm import ladder
from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.interface.scenes import checked_scene
from roughfilm.rom.advice import advise as advice
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.advice.measured import with_measured_errors
from roughfilm.rom.ladder.kind import Scene, kind_names, kind_of_scene
from roughfilm.rom.ladder.model import Model, Progress, best_for, silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.studies.comparison import scale, to_best, undecided, with_uncertainty


def models(kind: str | None = None) -> tuple[Model, ...]:
    """List the models of one kind of scene, or of all kinds, from the simplest to the one with the most effects.

    Parameters
    ----------
    kind : "pocket", "bearing", "dry_contact", "seal" or "rough_gap"; by default all kinds.

    Returns
    -------
    tuple of Model
        Each model has ``name``, ``summary``, ``keeps`` (the effects that it includes), ``sources``, ``available()`` on
        this machine, ``applies(scene)`` and ``cost(scene, resolution)`` in CPU seconds.

    Raises
    ------
    InputError
        If there is no such kind.

    Examples
    --------
    >>> import roughfilm as rf
    >>> [model.name for model in rf.models("pocket")]
    ['reynolds', 'reynolds_cavitating', 'inertial_reynolds', 'film', 'stokes', 'film_slope', 'navier_stokes']
    """
    if kind is not None and (not isinstance(kind, str) or kind not in kind_names()):
        raise InputError(f"kind: got {repr(kind)[:60]}; it must be one of {', '.join(kind_names())}")
    return ladder.models(kind)


def advise(
    scene: Scene, *, within: float = advice.DEFAULT_TOLERANCE, quantity: str | None = None, progress: Progress = silent
) -> advice.Advice:
    """Choose the cheapest model, at the coarsest resolution, whose error in a quantity stays within a tolerance.

    The error of each model is estimated by laws C Π number^power in the dimensionless numbers of the scene, which were
    fitted to random scenes. Cheap models are also run and compared with the next model. An error is a bound that 95 of
    100 scenes do not exceed.

    Parameters
    ----------
    scene : the scene.
    within : tolerated error over the size of the quantity, above 0 and below 1; by default 5 %.
    quantity : name such as "load" or "load_plus"; by default the first quantity that the kind of scene compares.
    progress : called with the done fraction and a few words.

    Returns
    -------
    Advice
        ``chosen`` holds ``model``, ``resolution``, ``error`` and ``reason``; it is None if no model is known to be
        accurate enough. ``considered`` holds the verdict on every model.

    Raises
    ------
    InputError
        For a tolerance out of range, a quantity that the scene does not have, or a scene to which no model applies.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml", set={"motion.reynolds_number": 1})
    >>> rf.advise(scene, quantity="friction", within=0.05).chosen.model
    'inertial_reynolds'
    """
    kind = checked_scene(scene).kind
    if isinstance(within, bool) or not isinstance(within, int | float) or not 0 < within < 1:
        raise InputError(f"within: got {within!r}; give a number above 0 and below 1, for example 0.05")
    wanted = advice.wanted(scene, quantity)
    with finite_arithmetic("advise"):
        return advice.advise(scene, ladder.models(kind), quantity=wanted, within=within, progress=progress)


def solve(
    scene: Scene,
    *,
    model: str | None = None,
    within: float | None = None,
    quantity: str | None = None,
    resolution: int | None = None,
    tolerance: float | None = None,
    scheme: str | None = None,
    processes: int = 1,
    progress: Progress = silent,
) -> Result:
    """Solve a scene by one model, or by the cheapest whose error in a quantity stays within a tolerance.

    Without ``model`` and ``within`` the scene is solved by the cheapest model within 5 %, or by the most accurate one
    that is known if none is; a warning of the result then says so.

    Parameters
    ----------
    scene : the scene.
    model : name of a model for this kind of scene, see :func:`roughfilm.models`; give either this or ``within``.
    within : tolerated error over the size of the quantity, above 0 and below 1, as :func:`roughfilm.advise` takes it;
        no model within it is an error.
    quantity : the quantity to which the tolerance applies, such as "load"; by default the first of the kind.
    resolution : number of cells, points or nodes, see ``resolution_meaning`` of the model; the model has a default.
        This and the next three options need ``model``.
    tolerance : residual at which the solver stops, see ``residual_meaning`` of the model; the model has a default.
    scheme : advection scheme, one of ``schemes`` of the model.
    processes : number of MPI processes of an OpenFOAM run.
    progress : called with the done fraction and a few words.

    Returns
    -------
    Result
        ``result["load"]`` has ``value``, ``unit`` and ``uncertainty`` (numerical, None if unknown). ``expected_error``
        holds the error of the model over the size of the quantity, if the scene is in the range of a fitted law.
        ``outside`` holds a sentence for each way in which the scene is outside the range of the model.
        ``fields["pressure"].values`` is an array; ``warnings`` holds sentences.

    Raises
    ------
    InputError
        For an unknown model, an option that the model does not offer, or a value out of range.
    ConvergenceError
        If the solver stops above its tolerance, or no model is known to be accurate enough.
    UnavailableError
        If a program that the model needs is not installed.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> result = rf.solve(scene, model="film_slope")
    >>> result["load"].unit, result.fields["pressure"].unit, sorted(result.expected_error)
    ('Pa', 'Pa', ['friction_plus', 'load_plus', 'pressure_max_plus', 'pressure_min_plus'])
    """
    kind = checked_scene(scene).kind
    if model is None:
        own = {"resolution": resolution, "tolerance": tolerance, "scheme": scheme}
        own["processes"] = None if isinstance(processes, int) and processes == 1 else processes
        for name in (name for name, value in own.items() if value is not None):
            raise InputError(f"{name}: got {own[name]!r} without a model; name one of models(scene.kind)")
        return solve_as_advised(scene, within=within, quantity=quantity, progress=progress)[0]
    for name, value in {"within": within, "quantity": quantity}.items():
        if value is not None:
            raise InputError(f"{name}: got {value!r}, but model names how to solve; leave one of them out")
    by = ladder.find(kind, model)
    request = Request(resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
    return with_errors(by.solve(scene, request, progress), scene, by, ladder.models(kind))


def solve_as_advised(
    scene: Scene, *, within: float | None = None, quantity: str | None = None, progress: Progress = silent
) -> tuple[Result, advice.Advice]:
    """Solve a scene by the advised model and return the result and the advice; a run of the advice is not repeated.

    Parameters
    ----------
    scene : the scene.
    within : tolerated error over the size of the quantity; None means 5 %, and the most accurate model if none is
        known to be within it.
    quantity : the quantity to which the tolerance applies; by default the first of the kind.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        For a tolerance out of range, a quantity that the scene does not have, or a scene to which no model applies.
    ConvergenceError
        If no model is known to be within the given tolerance, or the solver stops above its own.
    UnavailableError
        If a program that the model needs is not installed.
    """
    tolerance = advice.DEFAULT_TOLERANCE if within is None else within
    scene = kind_of_scene(scene).without_time(scene)
    advised = advise(scene, within=tolerance, quantity=quantity, progress=progress)
    taken = advised.chosen or (advised.fallback if within is None else None)
    if taken is None:
        raise ConvergenceError(f"within: {advice.shortfall(advised)}")
    by = ladder.find(scene.kind, taken.model)
    result = advised.result or by.solve(scene, Request(resolution=taken.resolution), progress)
    if advised.chosen is None:
        result = replace(result, warnings=(*result.warnings, advice.shortfall(advised)))
    known = {} if taken.stated is None else {advised.quantity: taken.stated}
    return with_errors(result, scene, by, ladder.models(scene.kind), known=known), advised


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """The results of several models on one scene.

    Attributes
    ----------
    results : results by the name of the model, from the simplest model to the one with the most effects; their expected
        errors are measured against the best model, in the quantities that are compared.
    best : name of the solved model that leaves out least.
    errors : by model and quantity, the signed difference from the best model over the size of the quantity.
    uncertainty : by quantity, the uncertainty of these differences, which is that of the best model: its numerical one,
        or its expected error where that is unknown.
    undecided : by quantity, the pairs of models that this uncertainty does not distinguish; they are not to be ranked.
    left_out : by model, the reason for a missing result.
    """

    results: Mapping[str, Result]
    best: str
    errors: Mapping[str, Mapping[str, float]]
    uncertainty: Mapping[str, float]
    undecided: Mapping[str, tuple[tuple[str, str], ...]]
    left_out: Mapping[str, str]

    __repr__ = brief


def compare(scene: Scene, *, models: Sequence[str] | None = None, progress: Progress = silent) -> Comparison:
    """Solve a scene by every model that applies, each at its default resolution, and compare with the best.

    Parameters
    ----------
    scene : the scene.
    models : names of the models; by default all that apply and are available on this machine.
    progress : called with the done fraction and a few words.

    Returns
    -------
    Comparison
        ``results`` by model, ``errors`` against the ``best`` of them, and the models that were ``left_out`` with the
        reason.

    Raises
    ------
    InputError
        For an unknown model.
    ConvergenceError
        If no model solves the scene.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> both = rf.compare(scene, models=["inertial_reynolds", "film_slope"])
    >>> both.best, list(both.errors)
    ('film_slope', ['inertial_reynolds'])
    """
    known = chosen_models(checked_scene(scene).kind, models)
    results: dict[str, Result] = {}
    left_out: dict[str, str] = {}
    for number, model in enumerate(known):
        progress(number / len(known), model.name)
        answer = answer_of(scene, model)
        if isinstance(answer, str):
            left_out[model.name] = answer
        else:
            results[model.name] = answer
    if not results:
        reasons = "; ".join(f"{name}: {reason}" for name, reason in left_out.items())
        raise ConvergenceError(f"models: none of them solves the scene: {reasons}")
    top = best_for(scene, [model for model in known if model.name in results]).name
    results = with_measured_errors(scene, ladder.models(scene.kind), results)
    carried = {**results, top: _with_expected_uncertainty(results[top])}
    errors: dict[str, dict[str, float]] = {}
    uncertainty = {}
    for difference in to_best(scene, known, carried):
        errors.setdefault(difference.model, {})[difference.quantity] = difference.relative
        if difference.uncertainty is not None:
            uncertainty[difference.quantity] = difference.uncertainty
    return Comparison(
        results=results,
        best=top,
        errors=errors,
        uncertainty=uncertainty,
        undecided=undecided(scene, known, carried),
        left_out=left_out,
    )


def _with_expected_uncertainty(result: Result) -> Result:
    """The result with its expected errors as uncertainties of the quantities whose numerical uncertainty is unknown."""
    expected = {
        name: error * scale(result, name)
        for name, error in result.expected_error.items()
        if result.quantities[name].uncertainty is None
    }
    return with_uncertainty(result, expected)


def chosen_models(kind: str, names: Sequence[str] | None) -> tuple[Model, ...]:
    """The models with the given names, from the simplest up; None means all of the kind; InputError if unknown."""
    known = ladder.models(kind)
    if names is None:
        return known
    if not isinstance(names, list | tuple | set | frozenset) or not names:
        raise InputError(f"models: got {repr(names)[:60]}; give a list of names, such as {[known[0].name]}")
    for name in names:
        ladder.find(kind, name)
    return tuple(model for model in known if model.name in names)


def answer_of(scene: Scene, model: Model, request: Request | None = None) -> Result | str:
    """The result of a model on a scene, or the reason as text why there is none."""
    fits, here = model.applies(scene), model.available()
    if not fits.applies or not here.available:
        return here.detail if fits.applies else fits.reason
    try:
        return solve(scene, model=model.name, **({} if request is None else vars(request)))
    except ConvergenceError as error:
        return f"{type(error).__name__}: {error}"
    except InputError as error:
        if request is not None:
            raise
        return str(error)
