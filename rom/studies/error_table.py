"""The errors of every setting of a sweep against the reference, and the numbers that order them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.studies.ordering import Ordering, fitted_powers, ordering
from roughfilm.rom.studies.reference import Reference, interval
from roughfilm.rom.studies.sufficient import TOLERANCES
from roughfilm.rom.studies.sweep import Sweep, kind_of_sweep, loaded, relative_error, sweeping

EQUAL_ERRORS = 0.01
"""Errors within this fraction of each other have no order: a model without load has an error of 100 % everywhere."""

RANK_GAIN = 0.1
"""Fitted powers are taken if their rank correlation is larger by this than any candidate's, at the same coverage."""

MIN_CASES = 8
"""Fewest cases from which a number that orders the errors is sought."""


def cases_left_out(sweep: Sweep, setting: str, reference: Reference, quantity: str) -> dict[str, int]:
    """The numbers of cases that are left out of the order of the errors of a setting, by reason; zeros are omitted."""
    own, top = (np.isfinite(sweep.found[name][quantity]) for name in (setting, reference.setting))
    features = sweep.features()
    numbers = np.full(own.shape, bool(features))
    for values in features.values():
        numbers &= np.isfinite(values) & (values > 0)
    judged, both = loaded(sweep, reference.setting), own & top
    reasons = {
        f"no {reference.setting} result": int((~top).sum()),
        f"no {setting} result": int((top & ~own).sum()),
        "a quantity too small to divide by": int((both & ~judged).sum()),
        "no numbers that errors are ordered by": int((both & judged & ~numbers).sum()),
    }
    return {reason: count for reason, count in reasons.items() if count}


def _known(
    sweep: Sweep, setting: str, reference: Reference, quantity: str, *, ordered: bool
) -> tuple[dict[str, Array], Array, tuple[Array, Array]]:
    """The features and errors of the cases whose error is known, and the least and largest possible errors."""
    error = relative_error(sweep, setting, reference.setting, quantity)
    features = sweep.features() if ordered else {}
    known = np.isfinite(error) & loaded(sweep, reference.setting)
    for values in features.values():
        known &= np.isfinite(values) & (values > 0)
    least, largest = interval(sweep, setting, reference, quantity)
    return {name: values[known] for name, values in features.items()}, error[known], (least[known], largest[known])


def orderings(sweep: Sweep, setting: str, reference: Reference, quantity: str) -> dict[str, Ordering]:
    """The ordering by each candidate, by the fitted powers, and the ``chosen`` one of them.

    It is empty for a quantity that the setting does not give, for an error that is the same everywhere, for fewer than
    ``MIN_CASES`` cases, and for cases without the numbers by which errors are ordered.
    """
    features, error, (_, largest) = _known(sweep, setting, reference, quantity, ordered=True)
    if not np.isfinite(sweep.found[setting][quantity]).any():
        return {}
    if error.size < MIN_CASES or not features or error.max() <= (1 + EQUAL_ERRORS) * error.min():
        return {}
    judged = sweeping(kind_of_sweep(sweep))
    orders = {
        name: ordering(features, powers, error, TOLERANCES, largest) for name, powers in judged.candidates.items()
    }
    fitted = fitted_powers({name: features[name] for name in judged.fitted}, error, step=0.25)
    orders["fitted"] = ordering(features, fitted or {judged.fitted[0]: 1}, error, TOLERANCES, largest)
    simple, powers = orders[max(judged.candidates, key=lambda name: orders[name].rank)], orders["fitted"]
    better = powers.rank > simple.rank + RANK_GAIN and powers.coverage >= simple.coverage
    return {**orders, "chosen": powers if better else simple}


def setting_row(
    sweep: Sweep, setting: str, reference: Reference, numbers: Mapping[tuple[str, str], Mapping[str, Ordering]]
) -> dict[str, Any]:
    """The errors of a setting over the cases, its CPU time, and the numbers that order its errors, as JSON entries."""
    errors: dict[str, Any] = {}
    orders = {}
    for quantity in kind_of_sweep(sweep).compared:
        _, error, ends = _known(sweep, setting, reference, quantity, ordered=False)
        spread, least, largest = (_spread(one) for one in (error, *ends))
        intervals = {part: None if spread[part] is None else [least[part], largest[part]] for part in spread}
        errors[quantity] = {**spread, "intervals": intervals}
        if numbers.get((setting, quantity)):
            chosen = numbers[setting, quantity]["chosen"]
            orders[quantity] = {
                "number": sweeping(kind_of_sweep(sweep)).words(chosen.powers),
                "powers": dict(chosen.powers),
                "rank": chosen.rank,
                "thresholds": {f"{tolerance:g}": limit for tolerance, limit in chosen.thresholds.items()},
                "tried": {name: one.rank for name, one in numbers[setting, quantity].items()},
            }
    cpu = sweep.cpu_s[setting]
    return {
        "setting": setting,
        "solved": int(np.isfinite(cpu).sum()),
        "cpu_s": float(np.nanmedian(cpu)),
        "cpu_s_high": float(np.nanpercentile(cpu, 95)),
        "error": errors,
        "ordered_by": orders,
    }


def _spread(error: Array) -> dict[str, float | None]:
    """The median, the 95th percentile and the greatest of the errors; None for an infinite one and without cases."""
    if not error.size:
        return dict.fromkeys(("median", "high", "worst"))
    ordered = np.sort(error)
    median, high = (
        np.percentile(ordered, part, method="higher" if np.isinf(ordered[-1]) else "linear") for part in (50, 95)
    )
    parts = {"median": median, "high": high, "worst": ordered[-1]}
    return {name: float(value) if np.isfinite(value) else None for name, value in parts.items()}


def reference_bars(sweep: Sweep, reference: Reference, quantity: str) -> dict[str, float | int | None]:
    """The uncertainty of the reference over the cases in which its error counts."""
    bar = reference.uncertainty[quantity][loaded(sweep, reference.setting)]
    known = bar[np.isfinite(bar)]
    return {**_spread(known), "known": int(known.size), "cases": int(bar.size)}
