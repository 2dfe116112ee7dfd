"""Measured surfaces as ``roughfilm surface`` prepares them: oblique grooves, and grinding marks along an axis."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from scripts.studies.lay.data import POINTS, FactorPair, box_of, compare, gap_at
from scripts.studies.thesis_clipping import prepare_as_in_the_thesis

OBLIQUE, STRIATED = "oblique_grooves.x3p", "ground_striated.x3p"

SEPARATIONS = (4, 3, 2.5, 2, 1.7, 1.4, 1.2, 1.1, 1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0, -0.1, -0.2, -0.4)
"""Over the highest point; below 1 the surfaces touch."""

SHOWN = (4, 2, 1.4, 1, 0.8, 0.6, 0.4, 0.2, 0, -0.2, -0.4)
"""Separations in the table."""


@dataclass(frozen=True, kw_only=True)
class MeasuredLay:
    """A prepared surface over its separations.

    Attributes
    ----------
    lay : degrees from x towards y, along the ridges.
    found : by separation over the highest point.
    boxes : φ₁ and φ₂ of a large box of the cell's own A, by the same; nan where det A is not resolved.
    """

    name: str
    lay: float
    roughness: float
    found: Mapping[float, FactorPair]
    boxes: Mapping[float, Array]


def prepared_surfaces(folder: Path | None, points: int = POINTS) -> dict[str, Prepared]:
    """The measured surfaces that are in a folder, by name, on ``points`` × ``points`` nodes."""
    if folder is None:
        return {}
    recipe = read_recipe({"grid": {"points": [points, points]}, "edges": {"method": "blended"}})
    files = [folder / name for name in (OBLIQUE, STRIATED)]
    return {file.name: prepare_as_in_the_thesis(read_surface(file), recipe) for file in files if file.is_file()}


def lay_of(prepared: Prepared) -> float:
    """Degrees from x towards y."""
    return texture_direction(power_spectrum(prepared.surface))


def over_separations(name: str, prepared: Prepared, separations: Sequence[float] = SEPARATIONS) -> MeasuredLay:
    """Compute both kinds of factors, from thick films to deep contact."""
    surface = prepared.surface
    heights = surface.heights - surface.heights.mean()
    found = {one: compare(gap_at(heights, one * float(heights.max())), surface.spacing) for one in separations}
    return MeasuredLay(
        name=name,
        lay=lay_of(prepared),
        roughness=float(heights.std()),
        found=found,
        boxes={one: box_of(both.cell.pressure, surface.size) for one, both in found.items()},
    )


def along(pressure: Array, lay: float) -> float:
    """A along a direction given in degrees."""
    direction = np.array([np.cos(np.radians(lay)), np.sin(np.radians(lay))])
    return float(direction @ pressure @ direction)
