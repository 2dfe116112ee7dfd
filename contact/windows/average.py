"""A quantity of a surface that is as large as very many windows: its mean over the windows that are known."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.rounding import with_error
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.windows.scatter import scatter

SCATTER, LOW, HIGH = "_scatter", "_window_low", "_window_high"
"""Endings of the names of columns: the scatter of the mean, and the ends of the interval for one window."""


@dataclass(frozen=True, kw_only=True)
class WindowAverage:
    """The mean of a quantity over windows, with its numerical uncertainty and its scatter apart from each other.

    Attributes
    ----------
    values : one value for each window, shape (n,).
    value : arithmetic mean.
    uncertainty : mean numerical uncertainty of the windows, whose errors may be alike; None if it is unknown.
    mean_interval : 95 % confidence interval of the mean, from how the windows differ; None if there are too few.
    interval : 95 % prediction interval for one further window; None if there are too few windows.
    zeros : fraction of the windows whose value is 0, such as sealed ones.
    """

    values: Array
    value: float
    uncertainty: float | None
    mean_interval: tuple[float, float] | None
    interval: tuple[float, float] | None
    zeros: float

    __repr__ = brief

    @property
    def scatter(self) -> float | None:
        """The half width of the confidence interval of the mean, at its longer side; None if it is unknown."""
        if self.mean_interval is None:
            return None
        low, high = self.mean_interval
        return max(self.value - low, high - self.value)

    def above(self, limit: float) -> Self:
        """The average of which the mean may be as small as a limit from the windows in another arrangement.

        The lower end of the confidence interval is multiplied by the ratio of the limit to the mean.
        """
        if self.mean_interval is None or not 0 <= limit < self.value:
            return self
        low, high = self.mean_interval
        return replace(self, mean_interval=(low * limit / self.value, high))

    def scaled(self, factor: float) -> Self:
        """The average of the quantity times a positive factor."""
        return replace(
            self,
            values=factor * self.values,
            value=factor * self.value,
            uncertainty=None if self.uncertainty is None else factor * self.uncertainty,
            mean_interval=_times(self.mean_interval, factor),
            interval=_times(self.interval, factor),
        )

    def entries(self, unit: str) -> dict[str, Any]:
        """The entries for JSON."""
        return {
            "value": self.value,
            "unit": unit,
            "uncertainty": self.uncertainty,
            "scatter": self.scatter,
            "window_interval": None if self.interval is None else list(self.interval),
        }

    def columns(self, name: str) -> dict[str, float]:
        """The numbers by the names of their columns; NaN where a number is unknown."""
        low, high = self.interval or (math.nan, math.nan)
        scattered = math.nan if self.scatter is None else self.scatter
        return {name: self.value, f"{name}{SCATTER}": scattered, f"{name}{LOW}": low, f"{name}{HIGH}": high}


@dataclass(frozen=True, kw_only=True)
class ScatteredQuantity(Quantity):
    """A quantity that is a mean over windows: its ``uncertainty`` is numerical, and the scatter is apart from it.

    Attributes
    ----------
    scatter : half width of the 95 % confidence interval of the mean, from how the windows differ, in the same unit;
        None if it is unknown.
    window_interval : 95 % prediction interval for one further window; None if it is unknown.
    """

    scatter: float | None = None
    window_interval: tuple[float, float] | None = None

    def __str__(self) -> str:
        """The value with its numerical uncertainty, its scatter with two digits, "?" if it is unknown, and the unit."""
        scatter = "?" if self.scatter is None else f"{self.scatter:.2g}"
        unit = f" {self.unit}" if self.unit != "1" else ""
        return f"{with_error(self.value, self.uncertainty)} ± {scatter} (windows){unit}"


def window_average(
    values: Sequence[float],
    uncertainties: Sequence[float | None] = (),
    *,
    independent: float | None = None,
    positive: bool = True,
) -> WindowAverage:
    """The mean of a quantity over windows.

    Parameters
    ----------
    values : one value for each window.
    uncertainties : numerical uncertainty of each value; none, or None or an infinite one, if they are unknown.
    independent : effective number of independent windows; by default the number of windows.
    positive : whether the quantity is 0 or more, see :func:`roughfilm.contact.windows.scatter.scatter`.

    Raises
    ------
    InputError
        If there are no values, or a value is out of range.
    """
    found = scatter(values, independent, positive)
    known = [one for one in uncertainties if one is not None and math.isfinite(one)]
    return WindowAverage(
        values=found.values,
        value=found.mean,
        uncertainty=sum(known) / len(known) if known and len(known) == len(values) else None,
        mean_interval=found.mean_interval,
        interval=found.interval,
        zeros=found.zeros,
    )


def _times(interval: tuple[float, float] | None, factor: float) -> tuple[float, float] | None:
    return None if interval is None else (factor * interval[0], factor * interval[1])
