"""Surfaces, loads and hardnesses that test the contact solver, and invalid input that it must refuse."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.stability.checks.contact import rms_slope

Heights = NDArray[np.number]

SIDE = 1e-4
"""Period of the surfaces, m."""

MODULUS = 1e11
"""Composite modulus E*, Pa."""

SEED = 20071
"""Seed of the random surfaces."""

AREA_FRACTIONS = (1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 0.9, 0.99, 1.0)
"""Approximate fractions of the nominal area in contact, from A = 2 P/(E* g'); 1 is full contact."""

FINE_POINTS = 1024
"""Number of points along a side for the lightest loads, and along a line."""

MIN_CONTACT_POINTS = 2
"""Expected number of points in contact below which a load is solved on the fine grid."""

LOADS = (0.01, 0.03, 0.1, 0.3, 0.6, 0.9, 0.99, 0.999)
"""Loads P/H."""

HARDNESSES = (3.0, 1.0, 0.3, 0.1, 0.03, 0.01)
"""Hardnesses H/(E* g')."""

TRIALS = (
    ("elastic, light", math.inf, 0.005),
    ("elastic, heavy", math.inf, 0.2),
    ("P/H = 0.1", 0.3, 0.03),
    ("P/H = 0.6", 0.3, 0.18),
    ("P/H = 0.99", 0.3, 0.297),
)
"""Name, H/(E* g') and P/(E* g') of the loads on every difficult surface."""


@dataclass(frozen=True, kw_only=True)
class Pressing:
    """One question to the contact solver: a surface with its spacing (m), hardness (Pa) and mean pressure (Pa).

    The solver must refuse it if ``refused``, and answer with all nodes at the hardness if ``all_plastic``.
    """

    group: str
    row: str
    column: str
    heights: Heights
    spacing: tuple[float, float]
    hardness: float
    load: float
    refused: bool = False
    all_plastic: bool = False


def pressings(points: int) -> Iterator[Pressing]:
    """All questions, on grids of about ``points`` points along a side."""
    yield from _over_loads(points)
    for group, row, heights, spacing in _surfaces(points):
        unit = MODULUS * (rms_slope(np.asarray(heights, dtype=float), spacing) or 1e-3)
        for column, hardness, load in TRIALS:
            yield Pressing(
                group=group,
                row=row,
                column=column,
                heights=heights,
                spacing=spacing,
                hardness=hardness * unit,
                load=load * unit,
            )
    yield from _limits(min(points, 64))


def rough(
    points: int, slope: float = 0.1, side: float = SIDE, ratio: float = 1.0, hurst: float = 0.8
) -> tuple[Heights, tuple[float, float]]:
    """The heights of a self-affine surface, shape (points, points), and their spacing, m.

    Parameters
    ----------
    points : number of points along each side.
    slope : rms slope.
    side : period in y, m.
    ratio : period in x over that in y.
    hurst : Hurst exponent.
    """
    cut_off = 8 * side * max(ratio, 1.0) / points
    surface = self_affine(
        size=(side * ratio, side),
        points=(points, points),
        seed=SEED,
        hurst=hurst,
        roll_off=max(side * min(ratio, 1.0) / 4, 1.5 * cut_off),
        cut_off=cut_off,
        rms_slope=slope,
    )
    return surface.heights, surface.spacing


def _over_loads(points: int) -> Iterator[Pressing]:
    coarse, fine = rough(points), rough(FINE_POINTS)
    unit = MODULUS * 0.1
    for area in AREA_FRACTIONS:
        heights, spacing = fine if area < MIN_CONTACT_POINTS / points**2 else coarse
        ratio = area / 2 if area <= 0.1 else 2.0 if area == 1 else float(-np.log(1 - area) / 2)
        yield Pressing(
            group="elastic",
            row=f"real area, on {FINE_POINTS} points where {points} would hold less than {MIN_CONTACT_POINTS}",
            column=f"{area:g}",
            heights=heights,
            spacing=spacing,
            hardness=math.inf,
            load=ratio * unit,
        )
    for hardness, load in product(HARDNESSES, LOADS):
        yield Pressing(
            group="elastic-plastic",
            row=f"H/(E* g') = {hardness:g}",
            column=f"P/H = {load:g}",
            heights=coarse[0],
            spacing=coarse[1],
            hardness=hardness * unit,
            load=load * hardness * unit,
        )


def _surfaces(points: int) -> Iterator[tuple[str, str, Heights, tuple[float, float]]]:
    """Difficult surfaces: group, row, heights and spacing."""
    n, step = points, SIDE / points
    square = (step, step)
    for slope in (1e-8, 1e-4, 1.0, 100.0):
        yield "amplitude", f"rms slope {slope:g}", *rough(n, slope)
    for side in (1e-9, 1.0, 1e4):
        yield "amplitude", f"period {side:g} m", *rough(n, 0.1, side)
    longest = min(20.0, 0.2 * n)
    for ratio in (1 / longest, 0.2, 5.0, longest):
        surface = gaussian(
            size=(SIDE, SIDE),
            points=(n, n),
            seed=SEED,
            rms_height=1e-6,
            correlation_length=2.01 * step / min(ratio, 1.0),
            anisotropy=ratio,
        )
        yield "anisotropy", f"γ = {ratio:g}", surface.heights, surface.spacing
    whole, _ = rough(n)
    odd = [(n - 1, n), (n, n - 1), (n - 1, n - 1), (n - 3, n - 5), (n, n // 4), (3, n), (n, 2), (n, 1), (1, n - 1)]
    for shape in odd:
        yield "sizes", f"{shape[0]} × {shape[1]}", whole[: shape[0], : shape[1]], square
    for hurst in (0.8, 0.3):
        section, spacing = rough(FINE_POINTS, hurst=hurst)
        yield "lines", f"section of {FINE_POINTS}, Hurst {hurst:g}", section[:, :1], spacing
    noise = np.random.default_rng(SEED).standard_normal((FINE_POINTS, 1))
    yield "lines", f"white noise on {FINE_POINTS}", 1e-7 * noise, square
    for ratio in (0.01, 0.1, 0.3, 3.0, 10.0, 100.0):
        yield "cells", f"dx/dy = {ratio:g}", whole, (step * ratio, step)
    i, j = np.indices((n, n), dtype=float)
    ripple, ridge = np.cos(2 * math.pi * i / n), np.where(i % 2, -1.0, 1.0)
    noise = np.random.default_rng(SEED).standard_normal((n, n))
    shapes = {
        ("waves", "one wave"): ripple,
        ("waves", "egg-box"): ripple * np.cos(2 * math.pi * j / n),
        ("waves", "one-pixel ridges"): ridge,
        ("waves", "one-pixel checkerboard"): ridge * np.where(j % 2, -1.0, 1.0),
        ("waves", "one-pixel waves on a long one"): ripple + 0.01 * ridge,
        ("waves", "waves of three pixels"): np.cos(2 * math.pi * i / 3),
        ("steps", "tilt"): i / n,
        ("steps", "tilt in both directions"): (i + 0.6 * j) / n,
        ("steps", "step"): np.where(i < n / 3, 1.0, 0.0),
        ("steps", "terraces"): np.floor(4 * whole / whole.std()),
        ("steps", "one spike"): np.where((i == 5) & (j == 7), 1.0, 0.0),
        ("steps", "one pit"): np.where((i == 5) & (j == 7), -1.0, 0.0),
        ("steps", "white noise"): noise,
        ("steps", "plateau with pits"): np.minimum(noise, 0.0),
        ("steps", "flat"): np.zeros((n, n)),
    }
    for (group, name), heights in shapes.items():
        yield group, name, 1e-7 * heights, square
    yield "input", "float32", whole.astype(np.float32), square
    yield "input", "whole numbers", np.rint(whole / whole.std()).astype(np.int64), (4.0, 4.0)
    yield "input", "columns first", np.asfortranarray(whole), square
    yield "input", "every second point", whole[::2, ::2], square
    yield "input", "1 mm above zero", whole + 1e-3, square


def _limits(points: int) -> Iterator[Pressing]:
    """Loads, heights, spacings and hardnesses at the limit of their range and beyond."""
    heights, spacing = rough(points)
    hardness = 0.3 * MODULUS * 0.1
    limit = Pressing(
        group="limits",
        row="load",
        column="P = H",
        heights=heights,
        spacing=spacing,
        hardness=hardness,
        load=hardness,
        all_plastic=True,
    )
    yield limit
    invalid = replace(limit, refused=True, all_plastic=False)
    loads = {
        "P just above H": hardness * (1 + 1e-12),
        "P = 2 H": 2 * hardness,
        "P = 0": 0.0,
        "P < 0": -1e6,
        "P = NaN": math.nan,
        "P = inf": math.inf,
    }
    for name, load in loads.items():
        yield replace(invalid, column=name, load=load)
    invalid = replace(invalid, load=0.1 * hardness)
    third = np.indices(heights.shape)[0] == 3
    surfaces = {
        "a height of NaN": np.where(third, np.nan, heights),
        "a height of inf": np.where(third, np.inf, heights),
        "no heights": np.zeros((0, 0)),
        "one height": np.zeros((1, 1)),
    }
    for name, values in surfaces.items():
        yield replace(invalid, row="heights", column=name, heights=values)
    for name, steps in {"dx = 0": (0.0, 1e-6), "dx < 0": (-1e-6, 1e-6), "dx = NaN": (math.nan, 1e-6)}.items():
        yield replace(invalid, row="spacing", column=name, spacing=steps)
    for name, value in {"H = 0": 0.0, "H < 0": -1e9, "H = NaN": math.nan}.items():
        yield replace(invalid, row="hardness", column=name, hardness=value, load=1e6)
