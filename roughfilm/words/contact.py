"""Numbers of a contact with their uncertainties."""

from collections.abc import Mapping

from roughfilm.contact.mechanics.store import Row
from roughfilm.words.numbers import digits, with_error


def number_of(row: Row, name: str, factor: float, uncertainties: Mapping[str, float]) -> str:
    """A number of a row times a factor, with its uncertainty if that is known and not 0; "–" for a missing number."""
    value = getattr(row, name)
    if value is None:
        return "–"
    if not uncertainties.get(name):
        return digits(value * factor)
    return with_error(value * factor, uncertainties[name] * factor).replace("-", "−")
