"""The answers of a sweep: a quantity over what varies, its best case, and the optimum between the cases."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.studies.parameters import Parameter
from roughfilm.rom.studies.sweep import Sweep, kind_of_sweep

SAME = 1e-9
"""Relative range of values within which a quantity is the same in all cases."""


class Sense(StrEnum):
    """Which end of a quantity is the best one."""

    LARGEST = "largest"
    SMALLEST = "smallest"
    UNCLEAR = "unclear"


SENSES: Mapping[str, Sense] = {
    **dict.fromkeys(("load", "film_min", "least_gap", "film_load", "specific_load", "stiffness"), Sense.LARGEST),
    **dict.fromkeys(
        (
            "friction",
            "friction_coefficient",
            "power_loss",
            "torque",
            "leakage",
            "side_leakage",
            "permeability",
            "contact_load",
        ),
        Sense.SMALLEST,
    ),
}
"""The best end by quantity, without "bearing_" before its name and "_plus", "_per_width" and "_per_area" behind it."""

ENDINGS = ("", "_per_area", "_per_width", "_plus")
"""Endings of the name of a quantity, the preferred one first: that of the whole scene, then those with a unit."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """A quantity in every case of a sweep by one setting.

    Attributes
    ----------
    quantity : name of the quantity.
    setting : name of the setting.
    sense : best end of the quantity.
    values : the quantity in its unit, shape (cases,); NaN without a result.
    uncertainty : numerical uncertainty of the values, or the expected error by the fitted laws where that is unknown,
        in the same unit, shape (cases,); NaN where both are unknown.
    by_laws : cases whose uncertainty is the expected error by the fitted laws, shape (cases,).
    order : numbers of the ranked cases, the best or, if the sense is unclear, the largest first.
    unranked : numbers of the cases whose uncertainty exceeds their value, which are left out of the order; none where
        this holds for all cases.
    """

    quantity: str
    setting: str
    sense: Sense
    values: Array
    uncertainty: Array
    by_laws: NDArray[np.bool_]
    order: tuple[int, ...]
    unranked: tuple[int, ...] = ()

    @property
    def best(self) -> int:
        """The number of the best case."""
        return self.order[0]

    @property
    def worst(self) -> int:
        """The number of the worst case."""
        return self.order[-1]

    @property
    def middle(self) -> int:
        """The number of the case in the middle of the order."""
        return self.order[len(self.order) // 2]

    @property
    def decided(self) -> bool | None:
        """Whether the best two cases differ by more than √(u₁² + u₂²); None if an uncertainty u is unknown."""
        if len(self.order) < 2:
            return None
        first, second = self.order[:2]
        bar = math.hypot(self.uncertainty[first], self.uncertainty[second])
        return None if math.isnan(bar) else bool(abs(self.values[first] - self.values[second]) > bar)


@dataclass(frozen=True, kw_only=True)
class Optimum:
    """The vertex of the parabola through the best case and its neighbours.

    Attributes
    ----------
    place : value of the parameter.
    value : the quantity there.
    place_uncertainty : uncertainty of ``place``.
    value_uncertainty : uncertainty of ``value``.
    """

    place: float
    value: float
    place_uncertainty: float
    value_uncertainty: float


def sense_of(quantity: str) -> Sense:
    """The best end of a quantity by its name: the load largest, friction and leakage smallest.

    Examples
    --------
    >>> sense_of("load_per_width").value, sense_of("bearing_friction").value, sense_of("mean_gap").value
    ('largest', 'smallest', 'unclear')
    """
    return SENSES.get(base_of(quantity).removeprefix("bearing_"), Sense.UNCLEAR)


def base_of(quantity: str) -> str:
    """The name of a quantity without its ending "_plus", "_per_width" or "_per_area"."""
    return next((quantity.removesuffix(end) for end in ENDINGS if end and quantity.endswith(end)), quantity)


def wanted_quantity(sweep: Sweep, setting: str, want: str | None = None) -> str:
    """The name of the quantity of a question among those that a setting found.

    A name without an ending is the first of ``<name>``, ``<name>_per_area``, ``_per_width`` and ``_plus`` that exists.
    Without a question it is the first compared quantity of the kind that is not the same in all cases.

    Parameters
    ----------
    sweep : the sweep.
    setting : name of the setting.
    want : name of the quantity; None for the default.

    Raises
    ------
    InputError
        If the setting has no such quantity; the message lists those that it has.
    """
    known = [name for name, values in sweep.found[setting].items() if np.isfinite(values).any()]
    if want is not None:
        for name in (want, *(f"{want}{end}" for end in ENDINGS)):
            if name in known:
                return name
        raise InputError(f"want: got {want!r}; {setting} has {', '.join(known)}")
    compared = [_preferred(name, known) for name in kind_of_sweep(sweep).compared if name in known]
    varying = [name for name in (*compared, *known) if not _same(sweep.found[setting][name])]
    return next(iter([*varying, *compared, *known]))


def asked_quantities(sweep: Sweep, setting: str) -> tuple[str, ...]:
    """The compared quantities of the kind that a setting found, each of the whole scene, or at least with its unit."""
    known = [name for name, values in sweep.found[setting].items() if np.isfinite(values).any()]
    return tuple(dict.fromkeys(_preferred(name, known) for name in kind_of_sweep(sweep).compared if name in known))


def _preferred(quantity: str, known: Sequence[str]) -> str:
    """The quantity of the same base whose ending comes first, such as load for load_per_width."""
    return next((name for end in ENDINGS if (name := f"{base_of(quantity)}{end}") in known), quantity)


def compared_partner(sweep: Sweep, quantity: str) -> str | None:
    """The compared quantity of a sweep whose errors are those of a quantity; None if there is none."""
    compared = kind_of_sweep(sweep).compared
    if quantity in compared:
        return quantity
    return next((name for name in compared if base_of(name) == base_of(quantity)), None)


def _same(values: Array) -> bool:
    known = values[np.isfinite(values)]
    return bool(np.ptp(known) <= SAME * np.abs(known).max()) if known.size else True


def answer_of(sweep: Sweep, setting: str, quantity: str, left_out: Collection[int] = ()) -> Answer:
    """The values of a quantity by a setting, with their uncertainty and their order; the setting found it in a case.

    Parameters
    ----------
    sweep : the sweep.
    setting : name of the setting.
    quantity : name of the quantity.
    left_out : numbers of cases that are not ranked, such as edited ones, unless all solved cases are among them.
    """
    values = sweep.found[setting][quantity]
    own = sweep.uncertainty[setting][quantity]
    by_laws = np.full(values.size, np.nan)
    partner = compared_partner(sweep, quantity)
    if partner is not None:
        ratio = _ratio(values, sweep.found[setting][partner])
        own = np.where(np.isnan(own), sweep.uncertainty[setting][partner] * ratio, own)
        size = np.asarray(kind_of_sweep(sweep).scale(sweep.found[setting], partner), dtype=float)
        by_laws = sweep.expected_error[setting][partner] * size * ratio
    sense = sense_of(quantity)
    size = np.abs(values) if sense is Sense.SMALLEST else -values
    uncertainty = np.where(np.isnan(own), by_laws, own)
    solved = np.isfinite(values)
    kept = solved & ~np.isin(np.arange(values.size), [*left_out])
    solved = kept if kept.any() else solved
    worthless = solved & (uncertainty > np.abs(values))
    ranked = np.flatnonzero(solved if (worthless == solved).all() else solved & ~worthless)
    return Answer(
        quantity=quantity,
        setting=setting,
        sense=sense,
        values=values,
        uncertainty=uncertainty,
        by_laws=np.isnan(own) & np.isfinite(by_laws),
        order=tuple(int(case) for case in ranked[np.argsort(size[ranked], kind="stable")]),
        unranked=tuple(int(case) for case in np.setdiff1d(np.flatnonzero(solved), ranked)),
    )


def _ratio(values: Array, partner: Array) -> Array:
    """The size of the unit of one quantity in that of its partner, shape (cases,); NaN for values of zero."""
    ratio = np.full(values.size, np.nan)
    np.divide(np.abs(values), np.abs(partner), out=ratio, where=np.abs(partner) > 0)
    return ratio


def slice_of(parameters: Sequence[Parameter], along: Parameter, case: int) -> NDArray[np.int64]:
    """The numbers of the cases that differ from a case in one parameter only, in the order of its values."""
    same = np.ones(along.values.size, dtype=bool)
    for one in parameters:
        if one.name != along.name:
            codes = one.codes()
            same &= codes == codes[case]
    cases = np.flatnonzero(same)
    if along.numeric:
        cases = cases[~np.isnan(along.values[cases])]
    keys = along.values[cases] if along.numeric else along.codes()[cases]
    ordered: NDArray[np.int64] = cases[np.argsort(keys, kind="stable")]
    return ordered


def optimum(parameters: Sequence[Parameter], along: Parameter, answer: Answer) -> Optimum | None:
    """The vertex of the parabola through the best case and its two neighbours along a parameter.

    With values y over x the vertex is x₂ - ((x₂-x₁)²(y₂-y₃) - (x₂-x₃)²(y₂-y₁)) / (2((x₂-x₁)(y₂-y₃) - (x₂-x₃)(y₂-y₁))).
    Its uncertainty combines that of the three values, by their derivatives, with the distance to the vertex of the
    parabola through the best case and two other neighbours, or to the best case itself without more cases. On a
    logarithmic axis x is the logarithm of the parameter.

    The result is None if the best case is at an end of the cases, if an uncertainty is unknown, or if the uncertainty
    of the vertex reaches beyond the neighbours.

    Parameters
    ----------
    parameters : all parameters of the sweep.
    along : the numeric parameter.
    answer : the answer, whose sense is not unclear.
    """
    if not along.numeric or answer.sense is Sense.UNCLEAR:
        return None
    cases = [case for case in slice_of(parameters, along, answer.best) if np.isfinite(answer.values[case])]
    middle = cases.index(answer.best) if answer.best in cases else 0
    if not 0 < middle < len(cases) - 1:
        return None
    x = along.values[cases]
    x = np.log(x) if along.logarithmic else x
    y, bars = answer.values[cases], answer.uncertainty[cases]
    used = slice(middle - 1, middle + 2)
    if np.isnan(bars[used]).any() or not {*cases[used]} <= {*answer.order}:
        return None
    found = _vertex(x[used], y[used])
    if found is None:
        return None
    place, value = found
    errors = np.zeros((2, 3))
    for number in range(3):
        moved = y[used].copy()
        moved[number] += bars[used][number]
        other = _vertex(x[used], moved)
        if other is None:
            return None
        errors[:, number] = other[0] - place, other[1] - value
    others = [found for start in (middle - 2, middle) if (found := _shifted(x, y, start)) is not None]
    shift = max((abs(one[0] - place) for one in others), default=abs(place - x[middle]))
    rise = max((abs(one[1] - value) for one in others), default=abs(value - y[middle]))
    spread = math.hypot(*errors[0], shift)
    low, high = place - spread, place + spread
    if low < x[middle - 1] or high > x[middle + 1]:
        return None
    ends = (math.exp(low), math.exp(place), math.exp(high)) if along.logarithmic else (low, place, high)
    return Optimum(
        place=float(ends[1]),
        value=float(value),
        place_uncertainty=float(max(ends[2] - ends[1], ends[1] - ends[0])),
        value_uncertainty=float(math.hypot(*errors[1], rise)),
    )


def _shifted(x: Array, y: Array, start: int) -> tuple[float, float] | None:
    """The vertex of the parabola through three cases from ``start`` on; None where there are no three."""
    if start < 0 or start + 3 > x.size:
        return None
    return _vertex(x[start : start + 3], y[start : start + 3])


def _vertex(x: Array, y: Array) -> tuple[float, float] | None:
    """The place and value of the vertex of the parabola through three points; None for a straight line."""
    left, right = (y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])
    bend = (right - left) / (x[2] - x[0])
    if bend == 0:
        return None
    slope = left + bend * (x[1] - x[0])
    return float(x[1] - slope / (2 * bend)), float(y[1] - slope**2 / (4 * bend))
