"""Random cells of a pocket in plan: dimples of every shape, turned, rounded, off the middle, several, staggered."""

import math

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.random_entries import Entries, between, chance, length

SHAPES = ("spherical", "ellipsoidal", "conical", "box", "chevron", "groove", "points")
CHANCES = (0.25, 0.15, 0.1, 0.15, 0.15, 0.05, 0.15)
"""Probabilities of the shapes of a dimple."""

CELL = 1e-3
"""Length of the cell, m."""

MAX_EXTENT = 0.85
"""Largest extent of a dimple over the cell, of a staggered one over half of it."""

MAX_POINTS = 9
"""Largest number of points of a map along a side."""


def draw(rng: Generator) -> Entries:
    """Return a cell of one dimple, of two, or staggered: B/L = 0.5 to 2, h/L = 0.005 to 0.2, d/h = 0.05 to 3.

    The extents of a dimple are 0.15 to 0.85 of the cell, and its mean slope at most 1. A fifth of the scenes has
    Re = 0.001, which stands for none, the others 0.3 to 300; a fifth has two dimples, a quarter of the others is
    staggered; 40 of 100 dimples are off the middle. The lubricant is so thin that no film ruptures; load and friction
    as p+ do not depend on it.

    Raises
    ------
    InputError
        If the film is thicker than the narrowest part of a dimple or of an edge, over which no film is thin.
    """
    film, breadth = CELL * between(rng, 0.005, 0.2), CELL * between(rng, 0.5, 2.0)
    count = 2 if chance(rng, 0.2) else 1
    staggered = count == 1 and chance(rng, 0.25)
    room = min(CELL / count, breadth) / (2 if staggered else 1)
    dimples = []
    for number in range(count):
        one = dimple(rng, room, film)
        place = CELL * (number - (count - 1) / 2) / count
        if chance(rng, 0.4):
            place += rng.uniform(-0.5, 0.5) * (1 - MAX_EXTENT) * room
            if one["shape"] != "groove":
                one["position_across"] = length(rng.uniform(-0.5, 0.5) * breadth)
        dimples.append({**one, "position": length(place)})
    entries: Entries = {
        "kind": "pocket",
        "geometry": {
            "length": length(CELL),
            "breadth": length(breadth),
            "film": length(film),
            "arrangement": "staggered" if staggered else "aligned",
            "dimples": dimples,
        },
        "lubricant": {"viscosity": "0.1 mPa*s", "density": "1000 kg/m^3"},
        "motion": {"reynolds_number": 1e-3 if chance(rng, 0.2) else between(rng, 0.3, 300)},
    }
    scene = read_scene({"name": "cell", **entries})
    assert isinstance(scene, Pocket)
    plan = scene.plan()
    if plan.film > plan.smallest:
        raise InputError(f"geometry.film: got {plan.film} m; the narrowest part of the wall is {plan.smallest} m")
    return entries


def dimple(rng: Generator, room: float, film: float) -> Entries:
    """Return one dimple whose extents after rotation fit into a square of the side ``room``, m."""
    shape = str(rng.choice(SHAPES, p=CHANCES))
    angle = math.radians(float(rng.choice([0.0, 90.0, rng.uniform(-90, 90)])))
    width, breadth = (room * MAX_EXTENT * between(rng, 0.18, 1.0) for _ in range(2))
    if shape in ("spherical", "conical", "groove"):
        breadth = width
    turned = abs(math.cos(angle)), abs(math.sin(angle))
    tip = math.radians(rng.uniform(10, 60))
    if shape == "chevron":
        width = min(width, breadth)
        turned, angle = (1.0, 0.0), float(rng.choice([0.0, math.pi]))
        tip = min(tip, math.atan(2 * (room * MAX_EXTENT - width) / breadth))
    shrunk = min(1.0, room / max(width * turned[0] + breadth * turned[1], width * turned[1] + breadth * turned[0]))
    width, breadth = width * shrunk, breadth * shrunk
    least = min(width * (math.cos(tip) if shape == "chevron" else 1.0), breadth)
    edge = least * rng.uniform(0.05, 0.5)
    steep = edge if shape in ("box", "chevron") else least / (MAX_POINTS - 1 if shape == "points" else 2)
    depth = min(film * between(rng, 0.05, 3.0), steep * rng.uniform(0.2, 1.0))
    found: Entries = {"shape": shape, "width": length(width), "depth": length(depth)}
    if shape in ("ellipsoidal", "box", "chevron", "points"):
        found["breadth"] = length(breadth)
    if shape in ("box", "chevron") or (shape in ("spherical", "ellipsoidal", "conical") and chance(rng, 0.3)):
        found["edge"] = length(edge)
    if shape == "chevron":
        found["angle"] = f"{math.degrees(tip):.9g} deg"
    if shape == "points":
        del found["depth"]
        found["points"] = points(rng, depth)
    if shape not in ("groove", "spherical", "conical") and angle:
        found["rotation"] = f"{math.degrees(angle):.9g} deg"
    return found


def points(rng: Generator, depth: float) -> list[list[float]]:
    """Return a map of 5 to 9 points along each side, 0 on the border, with random depths inside, m."""
    sides = rng.integers(5, MAX_POINTS + 1, 2)
    depths = np.zeros(sides)
    depths[1:-1, 1:-1] = rng.uniform(0.3, 1.0, sides - 2)
    rows: list[list[float]] = (depth * depths / depths.max()).tolist()
    return rows
