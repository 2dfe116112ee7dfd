"""Which models would have done in a sweep: errors of every setting against the reference, and what inertia changes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.studies.reference import Reference, interval
from roughfilm.rom.studies.sweep import Sweep, kind_of_sweep, relative_error

TOLERANCES = (0.01, 0.02, 0.05, 0.10)
"""Errors within which cases are counted."""


@dataclass(frozen=True, kw_only=True)
class Suitability:
    """The errors of a setting in one quantity over the cases of a sweep.

    Attributes
    ----------
    setting, quantity : their names.
    error : relative errors against the reference, shape (cases,); NaN without both results.
    largest : the largest error; NaN without any.
    worst : number of the case with the largest error; None without any.
    within : by tolerance, the numbers of cases that are certainly and possibly within it: error ± the uncertainty of
        the reference is below it, or overlaps it.
    cases : number of cases with an error.
    """

    setting: str
    quantity: str
    error: Array
    largest: float
    worst: int | None
    within: Mapping[float, tuple[int, int]]
    cases: int


@dataclass(frozen=True, kw_only=True)
class InertiaChange:
    """The change of a quantity by inertia: the difference of two settings whose models differ by inertia alone.

    Attributes
    ----------
    without, setting : names of the settings without and with inertia.
    quantity : name of the quantity.
    change : difference over the scale of the quantity in the reference, shape (cases,); NaN without both results.
    """

    without: str
    setting: str
    quantity: str
    change: Array


def suitability(sweep: Sweep, setting: str, reference: Reference, quantity: str) -> Suitability:
    """The errors of a setting in a compared quantity against the reference of a sweep."""
    error = relative_error(sweep, setting, reference.setting, quantity)
    least, most = interval(sweep, setting, reference, quantity)
    known = np.isfinite(error)
    worst = int(np.nanargmax(error)) if known.any() else None
    return Suitability(
        setting=setting,
        quantity=quantity,
        error=error,
        largest=np.nan if worst is None else float(error[worst]),
        worst=worst,
        within={
            tolerance: (int((most[known] <= tolerance).sum()), int((least[known] <= tolerance).sum()))
            for tolerance in TOLERANCES
        },
        cases=int(known.sum()),
    )


def cheapest_sufficient(
    sweep: Sweep, settings: Sequence[str], reference: Reference, quantities: Sequence[str], tolerance: float
) -> list[str | None]:
    """The setting with the least CPU time in each case whose |error| + uncertainty is within a tolerance.

    All quantities that the reference found count. Where the uncertainty is unknown, the error alone counts. The
    reference itself is always sufficient; a case that it did not solve has None.

    Parameters
    ----------
    sweep : the sweep.
    settings : names of the settings, without the reference.
    reference : the reference.
    quantities : names of compared quantities.
    tolerance : largest relative error.
    """
    found: list[str | None] = []
    errors = {}
    for setting in settings:
        worst = np.zeros(len(sweep.names))
        for quantity in quantities:
            error = relative_error(sweep, setting, reference.setting, quantity)
            total = error + np.nan_to_num(reference.uncertainty[quantity])
            worst = np.where(np.isfinite(sweep.found[reference.setting][quantity]), np.maximum(worst, total), worst)
        errors[setting] = worst
    for case in range(len(sweep.names)):
        if not np.isfinite(sweep.cpu_s[reference.setting][case]):
            found.append(None)
            continue
        enough = [name for name in settings if errors[name][case] <= tolerance]
        found.append(min([*enough, reference.setting], key=lambda name: sweep.cpu_s[name][case]))
    return found


def inertia_changes(
    sweep: Sweep, models: Sequence[Model], best_settings: Mapping[str, str], reference: Reference, quantity: str
) -> tuple[InertiaChange, ...]:
    """The change of a compared quantity by inertia, for each pair of models that differ by inertia alone.

    Parameters
    ----------
    sweep : the sweep.
    models : the models of its kind.
    best_settings : the setting of each model that is compared, by name of the model.
    reference : the reference.
    quantity : name of the quantity.
    """
    size = np.asarray(kind_of_sweep(sweep).scale(sweep.found[reference.setting], quantity), dtype=float)
    pairs = [
        (best_settings[one.name], best_settings[other.name])
        for one in models
        for other in models
        if other.keeps - one.keeps == {Effect.INERTIA} and one.keeps < other.keeps
        if not one.keeps or (one.complete and other.complete)
        if one.name in best_settings and other.name in best_settings
    ]
    found = (
        InertiaChange(
            without=one,
            setting=other,
            quantity=quantity,
            change=(sweep.found[other][quantity] - sweep.found[one][quantity]) / size,
        )
        for one, other in pairs
    )
    return tuple(change for change in found if np.isfinite(change.change).any())


def finest_settings(sweep: Sweep, models: Sequence[Model]) -> dict[str, str]:
    """The setting of each model of a sweep with its first scheme and finest resolution, by name of the model."""
    chosen = {}
    for model in models:
        own = [name for name in sweep.found if name.split("-")[0] == model.name]
        solved = [name for name in own if np.isfinite(sweep.cpu_s[name]).any()]
        schemes = [scheme for scheme in model.schemes if any(name.split("-")[-1] == scheme for name in solved)]
        first = [name for name in solved if not schemes or name.split("-")[-1] == schemes[0]]
        if first:
            chosen[model.name] = max(first, key=lambda name: float(np.nanmax(sweep.resolution[name])))
    return chosen
