"""What the cell problems are tried on: contrast, contact, lays, awkward grids, and what they must refuse."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.stability.joint import cut_grooves, joined

SIDE, ROUGHNESS = 1e-3, 1e-6
"""m: the period of the surfaces, and their rms height."""

SEED = 20071

CONTRASTS = tuple(10.0**power for power in range(0, 17, 2))
"""Of h³, the largest over the smallest."""

CONTACTS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
LAYS = (0.02, 0.1, 0.3, 3.0, 10.0, 50.0)
ASPECTS = (0.01, 0.1, 0.3, 3.0, 10.0, 100.0)
OFFSETS = (1e-8, 1e-9, 1e-10)

SOLVED, REFUSED = "solved", "refused"
"""What ought to come of a probe."""


@dataclass(frozen=True, kw_only=True)
class Probe:
    """One question: where it stands on the page, a gap, and what ought to come of it.

    Attributes
    ----------
    exact : A₁₁, A₁₂ and A₂₂ of the network, where a formula has them, m³.
    offset : m, as ``roughfilm.rom.homogenization.flow_factors`` takes it.
    """

    group: str
    name: str
    gap: Any
    spacing: Any = (1e-6, 1e-6)
    offset: float = 0.0
    exact: tuple[float, float, float] | None = None
    expected: str = SOLVED


def probes(points: int) -> Iterator[Probe]:
    """Every probe, on grids of about so many nodes along a side."""
    yield from _contrasts(points)
    yield from _contacts(points)
    yield from _lays(points)
    yield from _grids(points)
    yield from _near_sealing(points)
    yield from _offsets(points)
    yield from _limits()


def rough(points: int, hurst: float = 0.8, shortest: int = 4, seed: int = SEED) -> Array:
    """Heights of a self-affine surface of eight waves, its shortest wave so many nodes long, m."""
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
    """A gap of which so much is in contact; without any, its least is a hundredth of the roughness."""
    if contact == 0:
        return np.asarray(heights.max() - heights + 0.01 * heights.std())
    return np.maximum(np.quantile(heights, 1 - contact) - heights, 0.0)


def _contrasts(points: int) -> Iterator[Probe]:
    """Two gaps side by side in patterns, the smaller the least that a contrast allows, and one that is smooth."""
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
    for name, low in patterns.items():
        for contrast in CONTRASTS:
            gap = 1e-6 * np.where(low == 1, contrast ** (-1 / 3), 1.0)
            exact = _laminate(gap) if "ridges a" in name else None
            yield Probe(group="contrast of h³", name=f"{name}, {contrast:.0e}", gap=gap, exact=exact)
    for contrast in CONTRASTS:
        yield Probe(group="contrast of h³", name=f"smooth, {contrast:.0e}", gap=1e-6 * contrast ** (smooth / 6))


def _laminate(gap: Array) -> tuple[float, float, float]:
    """A of a gap that varies along one axis: faces of <h⁻³>⁻¹ = 2h₁²h₂²/(h₁ + h₂) in series, h³ side by side."""
    along = 0 if np.ptp(gap[:, 0]) > 0 else 1
    line = gap[:, 0] if along == 0 else gap[0]
    after = np.roll(line, -1)
    series, aside = 1 / np.mean((line + after) / (2 * line**2 * after**2)), np.mean(line**3)
    return (float(series), 0.0, float(aside)) if along == 0 else (float(aside), 0.0, float(series))


def _contacts(points: int) -> Iterator[Probe]:
    noise = np.random.default_rng(SEED).standard_normal((points, points)) * ROUGHNESS
    surfaces = {
        "Hurst 0.8": rough(points),
        "Hurst 0.3 down to two nodes": rough(points, 0.3, 2),
        "noise from node to node": noise,
    }
    for name, heights in surfaces.items():
        for contact in CONTACTS:
            yield Probe(group="contact", name=f"{name}, {100 * contact:g} %", gap=truncated(heights, contact))


def _lays(points: int) -> Iterator[Probe]:
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
            gap = truncated(surface.heights, contact)
            yield Probe(group="lay", name=f"γ = {lay:g}, {100 * contact:g} %", gap=gap, spacing=surface.spacing)
    i, j = np.indices((points, points)) / points
    for waves in ((1, 4), (3, 8), (8, 3), (1, 16)):
        heights = ROUGHNESS * np.cos(2 * np.pi * (waves[0] * i + waves[1] * j))
        for contact in (0.0, 0.3):
            name = f"oblique grooves, {waves[0]} and {waves[1]} periods, {100 * contact:g} %"
            yield Probe(group="lay", name=name, gap=truncated(heights, contact))
    surface = joined(cut_grooves(0.9))
    heights = surface.heights - surface.heights.mean()
    for separation in (3e-6, 1e-6, 3e-7):
        name = f"grooves that end at a joint, separation {separation:g} m"
        yield Probe(group="lay", name=name, gap=np.maximum(separation - heights, 0.0), spacing=surface.spacing)
    steps = np.arange(points)
    spiral = np.zeros((points, points))
    spiral[steps, steps] = spiral[steps, (steps + 1) % points] = 1e-6
    passed = 1e-18 / (2 * points)
    yield Probe(group="lay", name="a spiral groove one node wide", gap=spiral, exact=(passed, passed, passed))


def _grids(points: int) -> Iterator[Probe]:
    whole = rough(points)
    for aspect in ASPECTS:
        for contact in (0.0, 0.2):
            name, spacing = f"dx/dy = {aspect:g}, {100 * contact:g} %", (1e-6 * aspect, 1e-6)
            yield Probe(group="pixels", name=name, gap=truncated(whole, contact), spacing=spacing)
    n = points
    shapes = [(n - 1, n), (n, n - 1), (n - 1, n - 1), (n - 27, n - 25), (2, 2), (2, 3), (3, 2), (5, 7), (7, 9)]
    for shape in (*shapes, (2, n), (n, 2), (3, n // 2), (n, n // 8), (17, n - 5)):
        gap = truncated(whole[: shape[0], : shape[1]], 0.0 if min(shape) < 4 else 0.2)
        yield Probe(group="sizes", name=f"{shape[0]} × {shape[1]}", gap=gap)
    for unit in (1e-9, 1e5):
        yield Probe(group="sizes", name=f"gap in units of {unit:g} m", gap=unit / ROUGHNESS * truncated(whole, 0.2))


def _near_sealing(points: int) -> Iterator[Probe]:
    """The most contact that still lets flow through: in either direction, and in one of them alone."""
    for seed in range(SEED, SEED + 4):
        heights = rough(points, 0.8 if seed % 2 else 0.5, 4, seed)
        for name, closed in (("both", all), ("one", any)):
            low, high = 0.2, 0.9
            for _ in range(30):
                middle = (low + high) / 2
                low, high = (low, middle) if closed(sealed(truncated(heights, middle))) else (middle, high)
            for more in (0.0, 1e-4, 1e-2):
                gap = truncated(heights, max(low - more, 0.0))
                title = f"surface {seed - SEED + 1}, {100 * more:g} % before {name} seal{'s' if name == 'one' else ''}"
                yield Probe(group="near sealing", name=title, gap=gap)
    i, j = np.indices((points, points))
    heights = rough(points)
    strip = np.where(j < points // 3, 0.0, truncated(heights, 0.2))
    yield Probe(group="near sealing", name="a wall along x", gap=strip)
    yield Probe(group="near sealing", name="a wall along y", gap=np.ascontiguousarray(strip.T))
    pockets = np.where((i % 16 < 10) & (j % 16 < 10), 1e-6 + heights - heights.min(), 0.0)
    yield Probe(group="near sealing", name="pockets alone", gap=pockets, exact=(0.0, 0.0, 0.0))
    pierced = pockets + np.where((i % 16 >= 10) & (j % 16 == 5), 1e-9, 0.0)
    yield Probe(group="near sealing", name="pockets joined along x by slits of 1 nm", gap=pierced)
    shallow = np.where(pockets > 0, pockets, 1e-8)
    yield Probe(group="near sealing", name="pockets in a film of 10 nm", gap=shallow)


def _offsets(points: int) -> Iterator[Probe]:
    for name, heights in (("Hurst 0.8", rough(points)), ("Hurst 0.3", rough(points, 0.3, 2))):
        for contact in (0.2, 0.5, 0.8):
            for offset in OFFSETS:
                title = f"{name}, {100 * contact:g} %, {1e9 * offset:g} nm"
                yield Probe(group="offset", name=title, gap=truncated(heights, contact), offset=offset)


def _limits() -> Iterator[Probe]:
    """What makes no sense."""
    sound = truncated(rough(64), 0.2)
    one = np.zeros(sound.shape)
    one[5, 7] = 1.0
    broken = Probe(group="limits", name="", gap=sound, expected=REFUSED)
    gaps: dict[str, Any] = {
        "h < 0 at one node": sound - 1e-12 * one,
        "h = NaN at one node": np.where(one > 0, math.nan, sound),
        "h = inf at one node": np.where(one > 0, math.inf, sound),
        "no nodes": np.zeros((0, 0)),
        "no columns": np.zeros((5, 0)),
        "one node": np.ones((1, 1)),
        "one row": sound[:1],
        "one column": sound[:, :1],
        "a profile": sound[0],
        "three dimensions": np.ones((4, 4, 4)),
        "closed everywhere": np.zeros((8, 8)),
        "complex numbers": sound + 0j,
        "words": np.full((4, 4), "wide"),
        "truth values": sound > 0,
    }
    for name, gap in gaps.items():
        yield replace(broken, name=name, gap=gap)
    spacings: dict[str, Any] = {
        "dx = 0": (0.0, 1e-6),
        "dx < 0": (-1e-6, 1e-6),
        "dx = NaN": (math.nan, 1e-6),
        "dx = inf": (math.inf, 1e-6),
        "one length": (1e-6,),
        "three lengths": (1e-6, 1e-6, 1e-6),
    }
    for name, spacing in spacings.items():
        yield replace(broken, name=name, spacing=spacing)
    for offset in (-1e-9, math.nan, math.inf):
        yield replace(broken, name=f"an offset of {offset:g} m", offset=offset)
