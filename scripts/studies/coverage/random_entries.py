"""Random numbers and surfaces from which studies draw their scenes."""

from typing import Any

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.units import with_unit

Entries = dict[str, Any]
"""Entries of a scene file."""


def between(rng: Generator, low: float, high: float) -> float:
    """Return a random number with a log-uniform distribution from ``low`` to ``high``."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def chance(rng: Generator, part: float) -> bool:
    """Return True with the probability ``part``."""
    return bool(rng.random() < part)


def length(metres: float) -> str:
    """Return the text of a length in m with its unit, as in a scene file."""
    return with_unit(metres, "m")


def random_surface(rng: Generator, side: float, points: int, rms_height: float, finest: int) -> Entries:
    """A self-affine surface whose shortest waves have so many points, or a Gaussian one, with or without a lay."""
    common = {
        "size": [length(side)] * 2,
        "points": [points] * 2,
        "seed": int(rng.integers(1000, 10**6)),
        "rms_height": length(rms_height),
    }
    if chance(rng, 0.6):
        fractal = {"hurst": float(rng.uniform(0.5, 1.0)), "roll_off": length(side / rng.uniform(1.0, 2.0))}
        return {"kind": "self_affine", **common, **fractal, "cut_off": length(side * finest / points)}
    anisotropy = 1.0 if chance(rng, 0.6) else float(rng.uniform(1.5, 6.0))
    return {
        "kind": "gaussian",
        **common,
        "correlation_length": length(side * finest / points / 1.5),
        "anisotropy": anisotropy,
        **({"lay_angle": f"{90 * int(rng.integers(2))} deg"} if anisotropy > 1 else {}),
    }
