"""Random pockets: deep, wide, narrow, off-centre, several, and through points joined by straight lines."""

import numpy as np
from numpy.random import Generator

from scripts.studies.coverage.random_entries import Entries, between, chance, length

SHAPES = ("cylindrical", "splined", "points")
CHANCES = (0.4, 0.35, 0.25)
"""Probabilities of the profiles of a groove."""

PERIOD = 1e-3
"""Length of the period, m."""


def draw(rng: Generator) -> Entries:
    """Return one to three grooves: w/L = 0.1 to 0.9, d/h = 0.05 to 3, 2d/w <= 1, h/L = 0.005 to 0.2, Re = 0 to 300.

    A fifth of the scenes has Re = 0.001, which stands for none, and a fifth has several grooves. 40 of 100 grooves are
    off the middle of the period. The lubricant is so thin that no film ruptures; load and friction as p+ do not
    depend on it.
    """
    film = PERIOD * between(rng, 0.005, 0.2)
    count = int(rng.integers(2, 4)) if chance(rng, 0.2) else 1
    share = PERIOD / count
    grooves = []
    for number in range(count):
        width = share * between(rng, 0.1, 0.9)
        depth = min(film * between(rng, 0.05, 3.0), width / 2 * rng.uniform(0.2, 1.0))
        room = (share - width) / 2
        offset = rng.uniform(-1, 1) * room if chance(rng, 0.4) else 0.0
        middle = (number - (count - 1) / 2) * share + offset
        grooves.append({"position": length(middle), **groove(rng, width, depth)})
    return {
        "geometry": {"length": length(PERIOD), "film": length(film), "grooves": grooves},
        "lubricant": {"viscosity": "0.1 mPa*s", "density": "1000 kg/m^3"},
        "motion": {"reynolds_number": 1e-3 if chance(rng, 0.2) else between(rng, 0.3, 300)},
    }


def groove(rng: Generator, width: float, depth: float) -> Entries:
    """Return one groove: an arc, two cubics shifted by up to 0.4 w, or a V, a trapezoid or random points."""
    shape = str(rng.choice(SHAPES, p=CHANCES))
    drawn: Entries = {"profile": shape, "width": length(width), "depth": length(depth)}
    if shape == "splined":
        return {**drawn, "shift": length(width * rng.uniform(-0.4, 0.4) if chance(rng, 0.75) else 0.0)}
    return drawn if shape == "cylindrical" else {"profile": shape, "points": points(rng, width, depth)}


def points(rng: Generator, width: float, depth: float) -> list[list[float]]:
    """Return the corners of a V, of a trapezoid, or of three to five random depths, m."""
    corners = str(rng.choice(["v", "trapezoid", "random"]))
    if corners == "v":
        places, depths = [rng.uniform(0.2, 0.8)], [1.0]
    elif corners == "trapezoid":
        places, depths = [rng.uniform(0.15, 0.4), rng.uniform(0.6, 0.85)], [1.0, 1.0]
    else:
        count = int(rng.integers(3, 6))
        places = list((np.arange(count) + rng.uniform(0.25, 0.75, count) + 0.25) / (count + 0.5))
        depths = list(rng.uniform(0.2, 1.0, count))
        depths[int(rng.integers(count))] = 1.0
    inner = [[float(width * (place - 0.5)), float(depth * one)] for place, one in zip(places, depths, strict=True)]
    return [[-width / 2, 0.0], *inner, [width / 2, 0.0]]
