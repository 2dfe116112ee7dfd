"""What the contact solver is tried on: loads and hardnesses, awkward surfaces, and what it must refuse."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.stability.checks.contact import rms_slope

Heights = NDArray[np.number]

SIDE = 1e-4
"""m, the period of the surfaces."""

MODULUS = 1e11
"""E*, Pa."""

SEED = 20071

AREAS = (1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 0.9, 0.99, 1.0)
"""About these parts of the nominal area are to be in contact, by A = 2 P/(E* g') and by full contact for 1."""

FINE, FEW = 1024, 2
"""Points along a side for the lightest loads, and how few points in contact call for them."""

LOADS = (0.01, 0.03, 0.1, 0.3, 0.6, 0.9, 0.99, 0.999)
"""P/H."""

HARDNESSES = (3.0, 1.0, 0.3, 0.1, 0.03, 0.01)
"""H/(E* g')."""

TRIALS = (
    ("elastic, light", math.inf, 0.005),
    ("elastic, heavy", math.inf, 0.2),
    ("P/H = 0.1", 0.3, 0.03),
    ("P/H = 0.6", 0.3, 0.18),
    ("P/H = 0.99", 0.3, 0.297),
)
"""What every awkward surface is put through: H/(E* g') and P/(E* g')."""

SOLVED, REFUSED, ALL_PLASTIC = "solved", "refused", "all at the hardness"
"""What ought to come of a probe."""


@dataclass(frozen=True, kw_only=True)
class Probe:
    """One question to the solver: where it stands on the page, what is pressed, and what ought to come of it."""

    group: str
    row: str
    column: str
    heights: Heights
    spacing: tuple[float, float]
    hardness: float
    load: float
    expected: str = SOLVED


def probes(points: int) -> Iterator[Probe]:
    """Every probe, on grids of about so many points along a side."""
    yield from _over_loads(points)
    for group, row, heights, spacing in _surfaces(points):
        unit = MODULUS * (rms_slope(np.asarray(heights, dtype=float), spacing) or 1e-3)
        for column, hardness, load in TRIALS:
            yield Probe(
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
    """Self-affine heights and their spacing, the period ``ratio`` times as long as wide."""
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


def _over_loads(points: int) -> Iterator[Probe]:
    heights, spacing = rough(points)
    fine, fine_spacing = rough(FINE)
    unit = MODULUS * 0.1
    for area in AREAS:
        small = area < FEW / points**2
        ratio = area / 2 if area <= 0.1 else 2.0 if area == 1 else float(-np.log(1 - area) / 2)
        yield Probe(
            group="elastic",
            row=f"real area, on {FINE} points where {points} would hold less than {FEW}",
            column=f"{area:g}",
            heights=fine if small else heights,
            spacing=fine_spacing if small else spacing,
            hardness=math.inf,
            load=ratio * unit,
        )
    for hardness in HARDNESSES:
        for load in LOADS:
            yield Probe(
                group="elastic-plastic",
                row=f"H/(E* g') = {hardness:g}",
                column=f"P/H = {load:g}",
                heights=heights,
                spacing=spacing,
                hardness=hardness * unit,
                load=load * hardness * unit,
            )


def _surfaces(points: int) -> Iterator[tuple[str, str, Heights, tuple[float, float]]]:
    step = SIDE / points
    square = (step, step)
    for slope in (1e-8, 1e-4, 1.0, 100.0):
        yield "amplitude", f"rms slope {slope:g}", *rough(points, slope)
    for side in (1e-9, 1.0, 1e4):
        yield "amplitude", f"period {side:g} m", *rough(points, 0.1, side)
    longest = min(20.0, 0.2 * points)
    for ratio in (1 / longest, 0.2, 5.0, longest):
        surface = gaussian(
            size=(SIDE, SIDE),
            points=(points, points),
            seed=SEED,
            rms_height=1e-6,
            correlation_length=2.01 * step / min(ratio, 1.0),
            anisotropy=ratio,
        )
        yield "anisotropy", f"γ = {ratio:g}", surface.heights, surface.spacing
    whole, _ = rough(points)
    n = points
    for shape in (
        (n - 1, n),
        (n, n - 1),
        (n - 1, n - 1),
        (n - 3, n - 5),
        (n, n // 4),
        (3, n),
        (n, 2),
        (n, 1),
        (1, n - 1),
    ):
        yield "sizes", f"{shape[0]} × {shape[1]}", whole[: shape[0], : shape[1]], square
    for hurst in (0.8, 0.3):
        section, spacing = rough(FINE, hurst=hurst)
        yield "lines", f"section of {FINE}, Hurst {hurst:g}", section[:, :1], spacing
    noise = np.random.default_rng(SEED).standard_normal((FINE, 1))
    yield "lines", f"white noise on {FINE}", 1e-7 * noise, square
    for ratio in (0.01, 0.1, 0.3, 3.0, 10.0, 100.0):
        yield "cells", f"dx/dy = {ratio:g}", whole, (step * ratio, step)
    i, j = np.indices((n, n), dtype=float)
    ripple, ridge = np.cos(2 * math.pi * i / n), np.where(i % 2, -1.0, 1.0)
    noise = np.random.default_rng(SEED).standard_normal((n, n))
    shapes = {
        "one wave": ripple,
        "egg-box": ripple * np.cos(2 * math.pi * j / n),
        "one-pixel ridges": ridge,
        "one-pixel checkerboard": ridge * np.where(j % 2, -1.0, 1.0),
        "one-pixel waves on a long one": ripple + 0.01 * ridge,
        "waves of three pixels": np.cos(2 * math.pi * i / 3),
    }
    for name, heights in shapes.items():
        yield "waves", name, 1e-7 * heights, square
    shapes = {
        "tilt": i / n,
        "tilt in both directions": (i + 0.6 * j) / n,
        "step": np.where(i < n / 3, 1.0, 0.0),
        "terraces": np.floor(4 * whole / whole.std()),
        "one spike": np.where((i == 5) & (j == 7), 1.0, 0.0),
        "one pit": np.where((i == 5) & (j == 7), -1.0, 0.0),
        "white noise": noise,
        "plateau with pits": np.minimum(noise, 0.0),
        "flat": np.zeros((n, n)),
    }
    for name, heights in shapes.items():
        yield "steps", name, 1e-7 * heights, square
    yield "input", "float32", whole.astype(np.float32), square
    yield "input", "whole numbers", np.rint(whole / whole.std()).astype(np.int64), (4.0, 4.0)
    yield "input", "columns first", np.asfortranarray(whole), square
    yield "input", "every second point", whole[::2, ::2], square
    yield "input", "1 mm above zero", whole + 1e-3, square


def _limits(points: int) -> Iterator[Probe]:
    """Loads, heights, spacings and hardnesses that are at the edge of sense or beyond."""
    heights, spacing = rough(points)
    hardness = 0.3 * MODULUS * 0.1
    sound = Probe(
        group="limits",
        row="load",
        column="P = H",
        heights=heights,
        spacing=spacing,
        hardness=hardness,
        load=hardness,
        expected=ALL_PLASTIC,
    )
    yield sound
    broken = replace(sound, expected=REFUSED)
    for name, load in (
        ("P just above H", hardness * (1 + 1e-12)),
        ("P = 2 H", 2 * hardness),
        ("P = 0", 0.0),
        ("P < 0", -1e6),
        ("P = NaN", math.nan),
        ("P = inf", math.inf),
    ):
        yield replace(broken, column=name, load=load)
    broken = replace(broken, load=0.1 * hardness)
    third = np.indices(heights.shape)[0] == 3
    for name, values in {
        "a height of NaN": np.where(third, np.nan, heights),
        "a height of inf": np.where(third, np.inf, heights),
        "no heights": np.zeros((0, 0)),
        "one height": np.zeros((1, 1)),
    }.items():
        yield replace(broken, row="heights", column=name, heights=values)
    for name, steps in {"dx = 0": (0.0, 1e-6), "dx < 0": (-1e-6, 1e-6), "dx = NaN": (math.nan, 1e-6)}.items():
        yield replace(broken, row="spacing", column=name, spacing=steps)
    for name, value in {"H = 0": 0.0, "H < 0": -1e9, "H = NaN": math.nan}.items():
        yield replace(broken, row="hardness", column=name, hardness=value, load=1e6)
