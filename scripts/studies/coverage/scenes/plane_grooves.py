"""Random cells of a pocket in plan with one groove across them, about as deep as the film: their flow is plane."""

from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from scripts.studies.coverage.random_entries import Entries, between, chance, length
from scripts.studies.coverage.scenes.deep_dimples import DEPTHS, MIN_REYNOLDS_NUMBER
from scripts.studies.coverage.scenes.dimples import CELL

FLAT = 0.1
"""Part of the cell beside the groove that stays flat at least."""


def draw(rng: Generator) -> Entries:
    """Return a cell with a groove, h/L = 0.005 to 0.15, w/L = 0.12 to 0.85, d/h = 0.25 to 1, Re = 5 to 300.

    Two of five grooves are off the middle.

    Raises
    ------
    InputError
        If the groove is steeper than 1, or narrower than the film is thick.
    """
    film, width, depth = between(rng, 0.005, 0.15), between(rng, 0.12, 0.85), between(rng, *DEPTHS)
    if width < film or 2 * depth * film > width:
        raise InputError(f"geometry: got h/L = {film:.3g}, w/L = {width:.3g}, d/h = {depth:.3g}; draw again")
    place = rng.uniform(-0.5, 0.5) * (1 - FLAT - width) if chance(rng, 0.4) else 0.0
    groove = {
        "shape": "groove",
        "width": length(CELL * width),
        "depth": length(CELL * film * depth),
        "position": length(CELL * place),
    }
    return {
        "kind": "pocket",
        "geometry": {
            "length": length(CELL),
            "breadth": length(CELL / 2),
            "film": length(CELL * film),
            "dimples": [groove],
        },
        "lubricant": {"viscosity": "0.1 mPa*s", "density": "1000 kg/m^3"},
        "motion": {"reynolds_number": between(rng, MIN_REYNOLDS_NUMBER, 300)},
    }
