"""The last line of a command that solves a scene: the value, whether its error is small enough, and the cost."""

import math

from roughfilm.rom.advice.stated import LEAST_STATED, percent, stated_errors
from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.result import Result
from roughfilm.words.cost import cost_in_words
from roughfilm.words.headline import whole
from roughfilm.words.numbers import digits
from roughfilm.words.outside import outside_in_words
from roughfilm.words.units import scale_of, without_round_off


def summary(result: Result, quantity: str, within: float) -> str:
    """The value of a quantity, its error compared with a tolerance, and the cost, in one line.

    A result outside the range of its model says so first.

    Parameters
    ----------
    result : the result, with its errors.
    quantity : name of a quantity of the kind.
    within : tolerated error over the size of the quantity.
    """
    if quantity.startswith("leakage") and "sealed" in result.quantities and result["sealed"].value == 1:
        return f"sealed, no leakage, by {result.model}; {cost_in_words(result)}"
    value, error = value_of(result, quantity), judgement(result, quantity, within)
    if result.outside:
        return f"{error}; {value} by {result.model}; {cost_in_words(result)}"
    return f"{value} by {result.model}; {error}; {cost_in_words(result)}"


def value_of(result: Result, quantity: str) -> str:
    """The value of a quantity with its unit and numerical uncertainty in per cent, such as "load 12.3 N/m ± 0.5 %"."""
    kind = kind_of(result)
    if quantity not in result.quantities:
        return f"no {kind.named[quantity]}"
    name = whole(quantity, result)
    of_all = " of the whole bearing" if name.startswith("bearing_") else ""
    title, shown = f"{kind.named[quantity]}{of_all}", without_round_off(result.quantities)[name]
    size, unit = scale_of(shown.unit, abs(shown.value))
    own = result[quantity]
    relative = math.nan if own.uncertainty is None or shown.value == 0 else own.uncertainty / abs(own.value)
    bar = f" ± {percent(relative)}" if relative >= LEAST_STATED else ""
    if bar and own.unit == "degC" and own.uncertainty is not None:  # its zero is not that of temperature
        bar = f" ± {own.uncertainty:.2g} K"
    return f"{title} {digits(shown.value / size)}{unit and f' {unit}'}{bar}"


def judgement(result: Result, quantity: str, within: float) -> str:
    """Whether the error of a quantity is within a tolerance, with the error and its source."""
    if result.outside:
        return outside_in_words(result.outside)
    error = stated_errors(result).get(quantity)
    if error is None or not math.isfinite(error.error):
        return f"error unknown, not known to be enough for {percent(within)}"
    return f"{'' if error.error <= within else 'not '}enough for {percent(within)}: error {error.words}"
