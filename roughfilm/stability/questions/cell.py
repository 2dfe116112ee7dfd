"""Gaps that test the cell solvers: contrasts, contact, lays, odd grids, and invalid input."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.stability.joint import cut_grooves, joined

SIDE = 1e-3
"""Period of the surfaces, m."""

ROUGHNESS = 1e-6
"""Rms height of the surfaces, m."""

SEED = 20071
"""Seed of the random surfaces."""

CONTRASTS = tuple(10.0**power for power in range(0, 17, 2))
"""Contrasts of h³: the largest over the smallest."""

CONTACTS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
"""Fractions of the area in contact."""

LAYS = (0.02, 0.1, 0.3, 3.0, 10.0, 50.0)
"""Ratios of the correlation lengths along x and y."""

ASPECTS = (0.01, 0.1, 0.3, 3.0, 10.0, 100.0)
"""Ratios dx/dy."""

OFFSETS = (1e-8, 1e-9, 1e-10)
"""Constants added to the gap, m."""


@dataclass(frozen=True, kw_only=True)
class CellGap:
    """A periodic gap, and the exact flow through it if it is known.

    Attributes
    ----------
    group, name : group of gaps, and name of the gap.
    thickness : film thickness at the nodes, m, shape (nx, ny).
    spacing : dx and dy, m.
    offset : constant added to the thickness, m.
    exact : A₁₁, A₁₂ and A₂₂ of the network, m³, None if no formula gives them.
    refused : whether the solver must refuse the gap.
    """

    group: str
    name: str
    thickness: Any
    spacing: Any = (1e-6, 1e-6)
    offset: float = 0.0
    exact: tuple[float, float, float] | None = None
    refused: bool = False


def gaps(points: int) -> Iterator[CellGap]:
    """All gaps, on grids of about ``points`` nodes along a side."""
    yield from _contrasts(points)
    yield from _contacts(points)
    yield from _lays(points)
    yield from _grids(points)
    yield from _near_sealing(points)
    yield from _offsets(points)
    yield from _limits()


def rough(points: int, hurst: float = 0.8, shortest: int = 4, seed: int = SEED) -> Array:
    """The heights of a self-affine surface with waves from 1/8 of the side (roll-off) to ``shortest`` nodes (cut-off).

    Returns
    -------
    Array
        Heights, m, shape (points, points).
    """
    return self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=seed,
        hurst=hurst,
        roll_off=SIDE / 8,
        cut_off=shortest * SIDE / points,
        rms_height=ROUGHNESS,
    ).heights


def truncated(heights: Array, contact: float) -> Array:
    """The gap between heights and a plane that cuts off the fraction ``contact``, in the unit of the heights.

    Without contact, the least gap is 0.01 times the rms height.
    """
    if contact == 0:
        return np.asarray(heights.max() - heights + 0.01 * heights.std())
    return np.maximum(np.quantile(heights, 1 - contact) - heights, 0.0)


def _contrasts(points: int) -> Iterator[CellGap]:
    """Patterns of two thicknesses whose h³ have a given contrast, and a smooth gap of the same contrast."""
    i, j = np.indices((points, points))
    random = np.random.default_rng(SEED).random((points // 4, points // 4)).repeat(4, 0).repeat(4, 1)
    patterns = {
        "ridges across": i // 4 % 2,
        "ridges along": j // 4 % 2,
        "oblique ridges": (i + 2 * j) // 8 % 2,
        "checkerboard": (i // 8 + j // 8) % 2,
        "random blocks": random > 0.5,
        "random nodes": np.random.default_rng(SEED + 1).random((points, points)) > 0.4,
    }
    smooth = np.cos(2 * np.pi * i / points) * np.cos(2 * np.pi * j / points)
    for (name, low), contrast in product(patterns.items(), CONTRASTS):
        gap = 1e-6 * np.where(low == 1, contrast ** (-1 / 3), 1.0)
        exact = _laminate(gap) if "ridges a" in name else None
        yield CellGap(group="contrast of h³", name=f"{name}, {contrast:.0e}", thickness=gap, exact=exact)
    for contrast in CONTRASTS:
        gap = 1e-6 * contrast ** (smooth / 6)
        yield CellGap(group="contrast of h³", name=f"smooth, {contrast:.0e}", thickness=gap)


def _laminate(gap: Array) -> tuple[float, float, float]:
    """A of a gap that varies along one axis: faces of <h⁻³>⁻¹ = 2h₁²h₂²/(h₁ + h₂) in series, h³ side by side."""
    along = 0 if np.ptp(gap[:, 0]) > 0 else 1
    line = gap[:, 0] if along == 0 else gap[0]
    after = np.roll(line, -1)
    series, aside = 1 / np.mean((line + after) / (2 * line**2 * after**2)), np.mean(line**3)
    return (float(series), 0.0, float(aside)) if along == 0 else (float(aside), 0.0, float(series))


def _contacts(points: int) -> Iterator[CellGap]:
    surfaces = {
        "Hurst 0.8": rough(points),
        "Hurst 0.3 down to two nodes": rough(points, 0.3, 2),
        "noise from node to node": np.random.default_rng(SEED).standard_normal((points, points)) * ROUGHNESS,
    }
    for (name, heights), contact in product(surfaces.items(), CONTACTS):
        gap = truncated(heights, contact)
        yield CellGap(group="contact", name=f"{name}, {100 * contact:g} %", thickness=gap)


def _lays(points: int) -> Iterator[CellGap]:
    for lay in (one for one in LAYS if max(one, 1 / one) <= 0.45 * points):
        surface = gaussian(
            size=(SIDE, SIDE),
            points=(2 * points, 2 * points),
            seed=SEED,
            rms_height=ROUGHNESS,
            correlation_length=SIDE / points / min(lay, 1.0) * 1.05,
            anisotropy=lay,
        )
        for contact in (0.0, 0.2, 0.4):
            gap, name = truncated(surface.heights, contact), f"γ = {lay:g}, {100 * contact:g} %"
            yield CellGap(group="lay", name=name, thickness=gap, spacing=surface.spacing)
    i, j = np.indices((points, points)) / points
    for (m, n), contact in product(((1, 4), (3, 8), (8, 3), (1, 16)), (0.0, 0.3)):
        gap = truncated(ROUGHNESS * np.cos(2 * np.pi * (m * i + n * j)), contact)
        yield CellGap(group="lay", name=f"oblique grooves, {m} and {n} periods, {100 * contact:g} %", thickness=gap)
    surface = joined(cut_grooves(0.9))
    heights = surface.heights - surface.heights.mean()
    for separation in (3e-6, 1e-6, 3e-7):
        name, gap = f"grooves that end at a joint, separation {separation:g} m", np.maximum(separation - heights, 0.0)
        yield CellGap(group="lay", name=name, thickness=gap, spacing=surface.spacing)
    steps = np.arange(points)
    spiral = np.zeros((points, points))
    spiral[steps, steps] = spiral[steps, (steps + 1) % points] = 1e-6
    flow = 1e-18 / (2 * points)
    yield CellGap(group="lay", name="a spiral groove one node wide", thickness=spiral, exact=(flow, flow, flow))


def _grids(points: int) -> Iterator[CellGap]:
    whole, n = rough(points), points
    for aspect, contact in product(ASPECTS, (0.0, 0.2)):
        name, gap = f"dx/dy = {aspect:g}, {100 * contact:g} %", truncated(whole, contact)
        yield CellGap(group="pixels", name=name, thickness=gap, spacing=(1e-6 * aspect, 1e-6))
    shapes = [(n - 1, n), (n, n - 1), (n - 1, n - 1), (n - 27, n - 25), (2, 2), (2, 3), (3, 2), (5, 7), (7, 9)]
    for shape in (*shapes, (2, n), (n, 2), (3, n // 2), (n, n // 8), (17, n - 5)):
        gap = truncated(whole[: shape[0], : shape[1]], 0.0 if min(shape) < 4 else 0.2)
        yield CellGap(group="sizes", name=f"{shape[0]} × {shape[1]}", thickness=gap)
    for unit in (1e-9, 1e5):
        gap = unit / ROUGHNESS * truncated(whole, 0.2)
        yield CellGap(group="sizes", name=f"gap in units of {unit:g} m", thickness=gap)


def _near_sealing(points: int) -> Iterator[CellGap]:
    """Gaps with almost as much contact as seals them, in both directions or in one, and isolated pockets."""
    for seed in range(SEED, SEED + 4):
        heights = rough(points, 0.8 if seed % 2 else 0.5, 4, seed)
        for name, closed in (("both seal", all), ("one seals", any)):
            low, high = 0.2, 0.9
            for _ in range(30):
                middle = (low + high) / 2
                low, high = (low, middle) if closed(sealed(truncated(heights, middle))) else (middle, high)
            for more in (0.0, 1e-4, 1e-2):
                gap = truncated(heights, max(low - more, 0.0))
                title = f"surface {seed - SEED + 1}, {100 * more:g} % before {name}"
                yield CellGap(group="near sealing", name=title, thickness=gap)
    i, j = np.indices((points, points))
    heights = rough(points)
    strip = np.where(j < points // 3, 0.0, truncated(heights, 0.2))
    pockets = np.where((i % 16 < 10) & (j % 16 < 10), 1e-6 + heights - heights.min(), 0.0)
    others = {
        "a wall along x": strip,
        "a wall along y": np.ascontiguousarray(strip.T),
        "pockets alone": pockets,
        "pockets joined along x by slits of 1 nm": pockets + np.where((i % 16 >= 10) & (j % 16 == 5), 1e-9, 0.0),
        "pockets in a film of 10 nm": np.where(pockets > 0, pockets, 1e-8),
    }
    for name, gap in others.items():
        exact = (0.0, 0.0, 0.0) if name == "pockets alone" else None
        yield CellGap(group="near sealing", name=name, thickness=gap, exact=exact)


def _offsets(points: int) -> Iterator[CellGap]:
    surfaces = {"Hurst 0.8": rough(points), "Hurst 0.3": rough(points, 0.3, 2)}
    for (name, heights), contact, offset in product(surfaces.items(), (0.2, 0.5, 0.8), OFFSETS):
        title = f"{name}, {100 * contact:g} %, {1e9 * offset:g} nm"
        yield CellGap(group="offset", name=title, thickness=truncated(heights, contact), offset=offset)


def _limits() -> Iterator[CellGap]:
    """Invalid thicknesses, spacings and offsets."""
    valid = truncated(rough(64), 0.2)
    one = np.zeros(valid.shape)
    one[5, 7] = 1.0
    invalid = CellGap(group="limits", name="", thickness=valid, refused=True)
    values: dict[str, Any] = {
        "h < 0 at one node": valid - 1e-12 * one,
        "h = NaN at one node": np.where(one > 0, math.nan, valid),
        "h = inf at one node": np.where(one > 0, math.inf, valid),
        "no nodes": np.zeros((0, 0)),
        "no columns": np.zeros((5, 0)),
        "one node": np.ones((1, 1)),
        "one row": valid[:1],
        "one column": valid[:, :1],
        "a profile": valid[0],
        "three dimensions": np.ones((4, 4, 4)),
        "closed everywhere": np.zeros((8, 8)),
        "complex numbers": valid + 0j,
        "words": np.full((4, 4), "wide"),
        "truth values": valid > 0,
    }
    for name, thickness in values.items():
        yield replace(invalid, name=name, thickness=thickness)
    spacings: dict[str, Any] = {
        "dx = 0": (0.0, 1e-6),
        "dx < 0": (-1e-6, 1e-6),
        "dx = NaN": (math.nan, 1e-6),
        "dx = inf": (math.inf, 1e-6),
        "one length": (1e-6,),
        "three lengths": (1e-6, 1e-6, 1e-6),
    }
    for name, spacing in spacings.items():
        yield replace(invalid, name=name, spacing=spacing)
    for offset in (-1e-9, math.nan, math.inf):
        yield replace(invalid, name=f"an offset of {offset:g} m", offset=offset)
