"""Marches in words: their quantities in the units in which people read them."""

from collections.abc import Iterator, Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.words.numbers import with_error
from roughfilm.words.units import scale_of

SHOWN = {
    "m": (1e-6, "µm"),
    "Pa": (1e6, "MPa"),
    "m^3/s": (1e-6 / 60, "ml/min"),
    "m^2/s": (1e-4 / 60, "cm²/min"),
    "N*m": (1.0, "N m"),
    "1": (1.0, ""),
    "degC": (1.0, "°C"),
}
"""The unit in which a quantity of each SI unit is shown, and its size; that of others depends on their size."""


def shown(quantity: Quantity) -> tuple[str, str]:
    """The number of a quantity with its uncertainty, and its unit."""
    size, unit = SHOWN.get(quantity.unit) or scale_of(quantity.unit, abs(quantity.value))
    uncertainty = None if quantity.uncertainty is None else quantity.uncertainty / size
    return with_error(quantity.value / size, uncertainty), unit


def rows_of(quantities: Mapping[str, Quantity], titles: Mapping[str, str]) -> Iterator[tuple[str, str, str]]:
    """Title, number and unit of each quantity."""
    for name, quantity in quantities.items():
        yield (titles[name], *shown(quantity))


def headline(quantities: Mapping[str, Quantity]) -> str:
    """The least film, the peak pressure and the highest temperature, if there is one, in one phrase."""
    titles = {"film_min": "least film", "pressure_max": "peak pressure", "temperature_max": "highest temperature"}
    known = {title: quantities[name] for name, title in titles.items() if name in quantities}
    return ", ".join(f"{title} {' '.join(shown(one))}" for title, one in known.items())
