"""The reference of a sweep with its uncertainty in every case, and the models that it can distinguish."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.ladder.model import OF_LUBRICANT, Effect, Model, best
from roughfilm.rom.studies.convergence import converge
from roughfilm.rom.studies.sweep import Sweep, kind_of_sweep, loaded, relative_error

MAX_WRONG = 0.05
"""Fraction of the cases in which a reference may distinguish models wrongly: its uncertainty covers 95 of 100."""


@dataclass(frozen=True, kw_only=True)
class Reference:
    """The setting to which the errors of a sweep refer.

    Attributes
    ----------
    setting : name of the setting.
    uncertainty : by compared quantity, its uncertainty over the scale of the quantity, shape (cases,); NaN if unknown.
    """

    setting: str
    uncertainty: Mapping[str, Array]


class Order(StrEnum):
    """The order of two settings by their errors over all cases of a sweep."""

    FIRST = "the first is nearer"
    SECOND = "the second is nearer"
    UNDECIDED = "cannot be distinguished"
    MIXED = "depends on the case"


@dataclass(frozen=True, kw_only=True)
class Ranking:
    """The comparison of two settings in one quantity.

    Attributes
    ----------
    settings : names of both settings.
    quantity : name of the quantity.
    nearer : fractions of the cases in which the first and the second one certainly has the smaller error; in the other
        cases their errors ± the uncertainty of the reference overlap.
    order : the order over all cases.
    """

    settings: tuple[str, str]
    quantity: str
    nearer: tuple[float, float]
    order: Order


def reference_of(sweep: Sweep, models: Sequence[Model]) -> Reference:
    """The best model of a sweep, at its best scheme and finest resolution, as the reference.

    A model that solved less than half as many cases as another one is not taken.

    Its uncertainty in a case is the larger one of that by the grids of the sweep, if there are two or more, and that
    stated by the run. Where both are unknown it is the expected error by the fitted laws. If the reference is not the
    most complete model of the kind, it is at least this expected error, which contains the effects left out. In cases
    outside the range of the model it is unknown. Models of
    effects that only some lubricants have count if the sweep has a model of these effects.

    Parameters
    ----------
    sweep : the sweep.
    models : all models of the kind of its scenes.
    """
    counts = {name: _solved(values) for name, values in sweep.found.items()}
    known = [name for name, count in counts.items() if 2 * count >= max(counts.values())]
    top = best([model for model in models if model.name in {_model(name) for name in known}])
    own = [name for name in known if _model(name) == top.name]
    schemes = [scheme for scheme in top.schemes if any(_scheme(name) == scheme for name in own)]
    grids = [name for name in own if not schemes or _scheme(name) == schemes[0]]
    setting = max(grids, key=lambda name: np.nanmax(sweep.resolution[name], initial=0))
    tried = frozenset[Effect]().union(*(one.keeps for one in models if one.name in {_model(name) for name in counts}))
    possible = [one for one in models if not (one.keeps & OF_LUBRICANT) - tried]
    complete = top.name == best(possible).name
    return Reference(
        setting=setting,
        uncertainty={
            quantity: _uncertainty(sweep, setting, grids, top, complete, quantity)
            for quantity in kind_of_sweep(sweep).compared
        },
    )


def _solved(values: Mapping[str, Array]) -> int:
    """The number of cases with any quantity."""
    return int(np.any([np.isfinite(one) for one in values.values()], axis=0).sum())


def _model(setting: str) -> str:
    return setting.split("-")[0]


def _scheme(setting: str) -> str:
    last = setting.split("-")[-1]
    return "" if last.isdigit() or last == _model(setting) else last


def _uncertainty(
    sweep: Sweep, setting: str, grids: Sequence[str], model: Model, complete: bool, quantity: str
) -> Array:
    size = np.asarray(kind_of_sweep(sweep).scale(sweep.found[setting], quantity), dtype=float)
    own = sweep.uncertainty[setting][quantity] / size
    numerical = np.fmax(own, _by_grids(sweep, setting, grids, model, quantity, size) / size)
    expected = sweep.expected_error[setting][quantity]
    found = np.where(np.isnan(numerical), expected, numerical) if complete else np.fmax(numerical, expected)
    return np.where(list(map(bool, sweep.outside.get(setting, [False] * found.size))), np.nan, found)


def _by_grids(sweep: Sweep, setting: str, grids: Sequence[str], model: Model, quantity: str, size: Array) -> Array:
    """The uncertainty by the grids of a setting, in the unit of the quantity; NaN for cases with one grid."""
    found = np.full(size.size, np.nan)
    for case in range(size.size):
        solved = [name for name in grids if np.isfinite(sweep.resolution[name][case])]
        values = {int(sweep.resolution[name][case]): sweep.found[name][quantity][case] for name in solved}
        resolutions = [n for n in sorted(values) if np.isfinite(values[n])]
        if len(resolutions) > 1 and np.isfinite(sweep.found[setting][quantity][case]):
            found[case] = converge(
                resolutions,
                [values[n] for n in resolutions],
                formal_order=None if callable(model.order) else model.order,
                noise=sweep.residual[setting][case] * size[case],
            ).uncertainty
    return found


def interval(sweep: Sweep, setting: str, reference: Reference, quantity: str) -> tuple[Array, Array]:
    """The least and largest possible relative errors |error| ± u of a setting, shape (cases,) each.

    The largest one is infinite where the uncertainty u of the reference is unknown.
    """
    error = relative_error(sweep, setting, reference.setting, quantity)
    bar = _bar(reference, quantity)
    return np.maximum(error - bar, 0.0), error + bar


def _bar(reference: Reference, quantity: str) -> Array:
    bar = reference.uncertainty[quantity]
    return np.where(np.isnan(bar), np.inf, bar)


def ranking(sweep: Sweep, pair: tuple[str, str], reference: Reference, quantity: str) -> Ranking | None:
    """The comparison of two settings; None without a case that both solved.

    A setting is nearer over all cases if it certainly has the smaller error in more than ``MAX_WRONG`` of them, and the
    other one in at most ``MAX_WRONG``.
    """
    error = [relative_error(sweep, one, reference.setting, quantity) for one in pair]
    known = np.isfinite(error[0]) & np.isfinite(error[1]) & loaded(sweep, reference.setting)
    if not known.any():
        return None
    apart = np.abs(error[0] - error[1]) > 2 * _bar(reference, quantity)
    first, second = (float(np.mean((apart & (error[one] < error[1 - one]))[known])) for one in (0, 1))
    if max(first, second) <= MAX_WRONG:
        order = Order.UNDECIDED
    elif min(first, second) > MAX_WRONG:
        order = Order.MIXED
    else:
        order = Order.FIRST if first > second else Order.SECOND
    return Ranking(settings=pair, quantity=quantity, nearer=(first, second), order=order)
