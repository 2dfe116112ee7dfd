"""Random dry contacts: surfaces from files, from light touch to nearly full contact, elastic and plastic."""

from numpy.random import Generator

from roughfilm.contact.foundation.units import with_unit
from scripts.studies.coverage.random_entries import Entries, between, chance
from scripts.studies.coverage.surfaces import SIDE, drawn_surface, in_file, rms_slope

MODULUS = 210e9
POISSON = 0.3


def draw(rng: Generator) -> Entries:
    """Return a surface of rms slope 0.003 to 0.6 with P/(E* g') = 3·10⁻⁴ to 3 and H/(E* g') = 0.01 to 20, or none."""
    return pressed(rng, 64 if chance(rng, 0.5) else 96, (3e-4, 3.0))


def pressed(rng: Generator, points: int, pressures: tuple[float, float]) -> Entries:
    """Return a rough surface under a pressure over E* g' in a range."""
    heights = drawn_surface(rng, points, rng.uniform(5, 20))
    slope = between(rng, 3e-3, 0.6)
    heights *= slope * SIDE / rms_slope(heights)
    unit = MODULUS / (1 - POISSON**2) * slope
    solid: Entries = {"modulus": with_unit(MODULUS, "Pa"), "poisson": POISSON}
    pressure = unit * between(rng, *pressures)
    if chance(rng, 0.6):
        hardness = unit * between(rng, 0.01, 20)
        solid["hardness"] = with_unit(hardness, "Pa")
        pressure = min(pressure, hardness * rng.uniform(0.005, 0.95))
    return {
        "geometry": in_file(heights, (SIDE / points, SIDE / points)),
        "solid": solid,
        "load": {"pressure": with_unit(pressure, "Pa")},
    }
