"""The dimensionless numbers of a pocket on which the errors of its models depend."""

from roughfilm.rom.pocket.pressure import load_over_pressure
from roughfilm.rom.pocket.scene import Pocket

SYMBOLS = {
    "reynolds_number": "Re",
    "reduced_reynolds_number": "Re·h/w",
    "film": "h/L",
    "depth": "d/h",
    "aspect": "2d/w",
    "slope": "slope",
    "asymmetry": "2|s|/w",
    "loaded": "load/p_max",
}
"""Symbols of the numbers: h is the film, L its period; w, d and s are width, depth and shift of a groove."""

MIN_ASYMMETRY = 1e-3
"""The asymmetry of a symmetric groove."""

MIN_LOAD_SCALE = 1e-3
"""Load over the largest pressure below which errors are relative to the pressure."""


def numbers(scene: Pocket) -> dict[str, float]:
    """The dimensionless numbers of the deepest, narrowest and steepest grooves, with load to first order in Re."""
    return {
        "reynolds_number": scene.reynolds_number,
        "reduced_reynolds_number": scene.reduced_reynolds_number,
        "film": scene.geometry.film / scene.geometry.length,
        "depth": scene.depth,
        "aspect": scene.aspect,
        "slope": scene.slope,
        "asymmetry": max(1 - scene.aspect / scene.slope, MIN_ASYMMETRY),
        "loaded": max(load_over_pressure(scene.gap(), scene.reynolds_number), MIN_LOAD_SCALE),
    }
