"""The error of a model in a quantity in the one form in which commands, pages, warnings and files state it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from roughfilm.contact.foundation.rounding import share
from roughfilm.rom.ladder.result import Result

BY_LAWS = "expected by the laws"
"""Source of an error that the fitted laws expect."""

BY_ITS_RUN = "its own uncertainty"
"""Source of the error of the most complete model, which is the uncertainty of its own run."""

BY_CORRECTION = "estimated from its own correction"
"""Source of the error of a model that corrects a simpler one, by the size of the correction."""

MAX_STATED_ERROR = 1.0
"""Largest relative error by the laws that is printed as a number; a larger one says nothing about the value."""

MIN_STATED_UNCERTAINTY = 1e-6
"""Relative uncertainty below which a difference is printed alone."""

LEAST_STATED = 1e-5
"""Relative error below which 0 % is printed."""

ENTRY = "errors"
"""Name of the errors of a result in its provenance."""


@dataclass(frozen=True, kw_only=True)
class StatedError:
    """The error of a model in a quantity, over the size of the quantity.

    Attributes
    ----------
    error : bound of the error; infinite if it is unknown. For a measured error it is |difference| + uncertainty.
    source : origin of the bound in words: ``BY_LAWS``, ``BY_ITS_RUN`` or "measured against <model>".
    difference : signed difference from the model against which the error is measured; None if it is not measured.
    uncertainty : uncertainty of the difference, which contains the error of that model; None if it is unknown.
    """

    error: float
    source: str
    difference: float | None = None
    uncertainty: float | None = None

    @property
    def amount(self) -> str:
        """The error in per cent: a bound such as "1.2 %", or a measured one such as "+7.4 % ± 1.6 %".

        Examples
        --------
        >>> StatedError(error=0.012, source=BY_LAWS).amount, measured("film", 0.074, 0.016).amount
        ('1.2 %', '+7.4 % ± 1.6 %')
        """
        if self.difference is None:
            return percent(self.error)
        size = _share(abs(self.difference))
        sign = "" if size == "0 %" else "−" if self.difference < 0 else "+"
        if self.uncertainty is None or not math.isfinite(self.uncertainty):
            return f"{sign}{size} ± ?"
        if self.uncertainty < MIN_STATED_UNCERTAINTY:
            return sign + size
        return f"{sign}{size} ± {_share(self.uncertainty)}"

    @property
    def words(self) -> str:
        """The error with its source, such as "1.2 % (expected by the laws)"; without it for an unknown error."""
        return f"{self.amount} ({self.source})" if math.isfinite(self.error) else self.amount


def measured(against: str, difference: float, uncertainty: float | None) -> StatedError:
    """The error that is measured against a model: |difference| + uncertainty, infinite if the latter is None."""
    bound = abs(difference) + (math.inf if uncertainty is None else uncertainty)
    source = f"measured against {against}"
    return StatedError(error=bound, source=source, difference=difference, uncertainty=uncertainty)


def percent(fraction: float) -> str:
    """The text of the bound of an error in per cent, "above 100 %" if it is larger, "unknown" if it is not finite.

    Examples
    --------
    >>> percent(0.0123), percent(0.25), percent(2.52), percent(math.inf)
    ('1.2 %', '25 %', 'above 100 %', 'unknown')
    """
    if MAX_STATED_ERROR < fraction < math.inf:
        return f"above {100 * MAX_STATED_ERROR:.0f} %"
    return _share(fraction)


def _share(fraction: float) -> str:
    return "0 %" if fraction < LEAST_STATED else share(fraction)


def entries_of_errors(errors: Mapping[str, StatedError]) -> dict[str, dict[str, Any]]:
    """The errors by quantity as JSON can hold them; unknown errors are left out, as is an unknown uncertainty."""
    return {
        quantity: {name: value for name, value in vars(one).items() if value is not None}
        for quantity, one in errors.items()
        if math.isfinite(one.error)
    }


def stated_errors(result: Result) -> dict[str, StatedError]:
    """The errors of a result by quantity, as its provenance holds them."""
    known = {quantity: StatedError(**entry) for quantity, entry in result.provenance.get(ENTRY, {}).items()}
    by_laws = {name: StatedError(error=error, source=BY_LAWS) for name, error in result.expected_error.items()}
    return {**by_laws, **known}
