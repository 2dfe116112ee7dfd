"""Maps of the reference model, and of the differences of the other models from it."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.advice.stated import percent
from roughfilm.words.headline import listed
from roughfilm.words.scales import Scale

SIGNED = "RdBu_r"
"""Colours of fields with a sign, white at 0."""

QUANTILE = 99.9
"""Per cent of the points of a map whose values its colours contain."""

DIFFERENCE_QUANTILE = 99.0
"""The same of a difference, which may be large along the edges, where models have other conditions."""


PLACES = f" in {DIFFERENCE_QUANTILE:g} of 100 points"


@dataclass(frozen=True, kw_only=True)
class Differences:
    """The differences of models from the reference, in the unit of a figure.

    Attributes
    ----------
    drawn : maps of the differences that are larger than the uncertainty, by model.
    limit : magnitude at the ends of their colours.
    words : a sentence on the other models.
    """

    drawn: Mapping[str, Array]
    limit: float
    words: tuple[str, ...]

    @property
    def colours(self) -> dict[str, Any]:
        """The options of a map: white at 0, and the same magnitude at both ends."""
        return {"cmap": SIGNED, "vmin": -self.limit, "vmax": self.limit}


def differences(
    maps: Mapping[str, Array], reference: str, title: str, scale: Scale, uncertainty: float | None = None
) -> Differences:
    """The differences of maps from that of the reference model.

    Parameters
    ----------
    maps : values by model in the SI unit, on the same points, the reference among them.
    reference : name of the reference model.
    title : name of the field in a sentence.
    scale : unit of the figure.
    uncertainty : uncertainty of the reference in the SI unit; a smaller difference is said in words. None if unknown.
    """
    found = {name: values - maps[reference] for name, values in maps.items() if name != reference}
    sizes = {name: float(np.nanpercentile(np.abs(one), DIFFERENCE_QUANTILE)) for name, one in found.items()}
    least = max(uncertainty or 0.0, scale.negligible)
    drawn = {name: one / scale.factor for name, one in found.items() if sizes[name] > least}
    limit = max((sizes[name] for name in drawn), default=scale.factor) / scale.factor
    return Differences(drawn=drawn, limit=limit, words=_words(maps, reference, title, found.keys() - drawn.keys()))


def _words(maps: Mapping[str, Array], reference: str, title: str, names: Collection[str]) -> tuple[str, ...]:
    """The sentence on the models whose differences are not drawn; none without such models."""
    if not names:
        return ()
    largest = float(np.nanmax(np.abs(maps[reference])))
    found = [np.abs(maps[name] - maps[reference]) for name in names]
    size = max(float(np.nanpercentile(one, DIFFERENCE_QUANTILE)) for one in found)
    models = listed([name for name in maps if name in names])
    part = percent(size / largest) if largest else "0 %"
    if part == "0 %":
        everywhere = all(float(np.nanmax(one)) <= size for one in found)
        return (f"The {title} by {models} is that by {reference}{'' if everywhere else PLACES}.",)
    return (
        f"The {title} by {models} differs from that by {reference} by at most {part} of its largest value{PLACES}, "
        "less than the uncertainty of the latter.",
    )


def on_points(axes: Sequence[Array], values: Array, points: Sequence[Array]) -> Array:
    """Values on a grid of two axes, linear between its points, on the grid of two others; shape of the latter."""
    if all(one.shape == other.shape and np.allclose(one, other) for one, other in zip(axes, points, strict=True)):
        return values
    table = RegularGridInterpolator(tuple(axes), values, bounds_error=False, fill_value=None)
    return np.asarray(table(tuple(np.meshgrid(*points, indexing="ij"))))
