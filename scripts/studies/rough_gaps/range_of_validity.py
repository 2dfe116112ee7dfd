"""Error of Reynolds' theory for real surfaces at many mean gaps, by slope correction and bounds of Stokes flow."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.periodicity import periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description
from roughfilm.rom.homogenization.richardson import off as grid_doubt
from roughfilm.rom.parts.restriction import restricted
from roughfilm.rom.rough_gap.flow.corrected import SlopeCorrected, slope_corrected
from roughfilm.rom.rough_gap.walls import Walls
from scripts.studies.rough_gaps.scenes import peak_over_rms, window_of
from scripts.studies.study import kept

MADE = Path(__file__).parents[2] / "examples" / "surfaces"
NOT_SURFACES = ("recipe",)
"""Names of the files in that folder that describe no surface."""

POINTS = 256
"""Number of nodes along each side of synthetic surfaces; largest number of pixels along a side of a window."""

MAX_WINDOW_FRACTION = 0.75
"""Largest side of a window divided by that of the measurement."""

MIN_GAP_OVER_PEAK = 1.05
"""Smallest mean gap divided by the highest point."""

THICKNESSES = (3.5, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0)
"""Mean gaps h̄/Sq; those at which the walls would touch are left out."""

MIN_GRID_NODES = 8
"""Least number of nodes along a side of a coarser grid by which the error of a finer one is estimated."""

GRID_DIVISORS = (1, 2, 4, 8)
COMPARED_GAP_OVER_PEAK = 2.0
"""Mean gap over the highest point at which grids are compared."""

LEVELS = (0.01, 0.05)


@dataclass(frozen=True, kw_only=True)
class ReynoldsError:
    """Relative excess of the flow by Reynolds' theory over Stokes flow at one mean gap, in the worse direction.

    Attributes
    ----------
    thickness : h̄/Sq.
    wavelength : λ/h̄.
    error, bar : best estimate by the slope correction, and its uncertainty.
    bound : upper bound of the error.
    direction : 0 for flow along x, 1 along y.
    """

    thickness: float
    wavelength: float
    error: float
    bar: float
    bound: float
    direction: int


@dataclass(frozen=True, kw_only=True)
class CoarserGrid:
    """A surface on a coarser grid: pixel (m), rms slope, and the error at ``COMPARED_GAP_OVER_PEAK``."""

    pixel: float
    slope: float
    error: float


@dataclass(frozen=True, kw_only=True)
class SurfaceValidity:
    """The errors of one measured or synthetic surface at its mean gaps; ``shape`` counts nodes, ``spacing`` is in m."""

    name: str
    measured: bool
    shape: tuple[int, int]
    spacing: tuple[float, float]
    rms_height: float
    slope: float
    peak: float
    mismatch: float
    found: tuple[ReynoldsError, ...]
    coarser: tuple[CoarserGrid, ...]

    def within(self, level: float) -> float | None:
        """Return the least h̄/Sq from which on error plus uncertainty are within ``level``; None if there is none."""
        good = None
        for one in sorted(self.found, key=lambda off: -off.thickness):
            if one.error + one.bar > level:
                break
            good = one.thickness
        return good


def made_surfaces(folder: Path = MADE, points: int = POINTS) -> dict[str, Surface]:
    """Return the described surfaces of a folder by name, restricted to ``points`` nodes along a side."""
    found = {}
    for file in sorted(folder.glob("*.toml")):
        if file.stem not in NOT_SURFACES:
            found[file.stem.replace("_", " ")] = coarse(make(read_description(file)), points)
    return found


def measured_surfaces(folder: Path | None, points: int = POINTS) -> dict[str, Surface]:
    """Return a prepared window of every instrument file of a folder, with about ``points`` pixels along a side."""
    found: dict[str, Surface] = {}
    for file in [] if folder is None else sorted(folder.iterdir()):
        try:
            whole = read_surface(file)
        except InputError:
            continue  # no instrument file
        pixels = [min(points, int(MAX_WINDOW_FRACTION * count)) for count in whole.shape]
        size = [count * step for count, step in zip(pixels, whole.spacing, strict=True)]
        found[file.name] = window_of(whole, size, [2 ** round(np.log2(count)) for count in pixels])
    return found


def coarse(surface: Surface, points: int) -> Surface:
    """Return the surface on at most ``points`` nodes along the longer side, without the waves beyond these nodes."""
    part = points / max(surface.shape)
    if part >= 1:
        return surface
    shape = (round(surface.shape[0] * part), round(surface.shape[1] * part))
    spacing = (surface.size[0] / shape[0], surface.size[1] / shape[1])
    return Surface(heights=restricted(surface.heights, shape), spacing=spacing, periodic=True, source=surface.source)


def reach(
    surfaces: Mapping[str, Surface],
    *,
    measured: bool,
    folder: Path,
    thicknesses: Sequence[float] = THICKNESSES,
    coarser: Sequence[int] = GRID_DIVISORS,
    advance: Callable[[str], None] = lambda _words: None,
) -> tuple[SurfaceValidity, ...]:
    """Compute the errors of each surface at its mean gaps and pixels; they are stored in the folder."""
    found = []
    for name, surface in surfaces.items():
        advance(name)
        settings = {"thicknesses": [*thicknesses], "coarser": [*coarser], "just_above": MIN_GAP_OVER_PEAK}
        digest = Inputs(heights=surface.heights, spacing=surface.spacing, settings=settings).digest

        make_it = partial(_reach, name, surface, measured, thicknesses, coarser)
        entries = kept(folder / f"reach-{name.replace(' ', '_')}.json", {"digest": digest}, make_it)
        found.append(_whole(entries))
    return tuple(found)


def _whole(entries: dict[str, Any]) -> SurfaceValidity:
    lists = {"found": tuple(ReynoldsError(**one) for one in entries["found"])}
    pixels = {"coarser": tuple(CoarserGrid(**one) for one in entries["coarser"])}
    pairs = {name: tuple(entries[name]) for name in ("shape", "spacing")}
    return SurfaceValidity(**{**entries, **lists, **pixels, **pairs})


def _reach(
    name: str, surface: Surface, measured: bool, thicknesses: Sequence[float], coarser: Sequence[int]
) -> SurfaceValidity:
    peak, rms = peak_over_rms(surface), float(surface.heights.std())
    nearest = MIN_GAP_OVER_PEAK * peak
    mismatch = periodicity_mismatch(surface)
    return SurfaceValidity(
        name=name,
        measured=measured,
        shape=surface.shape,
        spacing=surface.spacing,
        rms_height=rms,
        slope=slope_of(surface),
        peak=peak,
        mismatch=mismatch,
        found=tuple(off(surface, one) for one in (nearest, *(t for t in thicknesses if t > 1.02 * nearest))),
        coarser=tuple(_coarse(surface, part, COMPARED_GAP_OVER_PEAK * peak * rms) for part in coarser),
    )


def _coarse(surface: Surface, part: int, mean_gap: float) -> CoarserGrid:
    less = coarse(surface, max(surface.shape) // part)
    return CoarserGrid(
        pixel=float(np.sqrt(np.prod(less.spacing))),
        slope=slope_of(less),
        error=off(less, mean_gap / float(less.heights.std())).error,
    )


def slope_of(surface: Surface) -> float:
    """Return the rms slope g' from all waves on the grid."""
    return wave_power(surface.heights, surface.spacing).moments.rms_slope


def off(surface: Surface, thickness: float) -> ReynoldsError:
    """Return the error of Reynolds' theory at a mean gap of ``thickness`` rms heights, under a flat wall.

    The uncertainty is that of the ratio alone: the effects that the slope correction leaves out, and the change of the
    ratio on every second and every fourth node.
    """
    heights = surface.heights - surface.heights.mean()
    rms = float(heights.std())
    gap = thickness * rms
    grids = [
        _on_nodes(heights, gap, surface.spacing, every)
        for every in (4, 2, 1)
        if every == 1 or all(count % every == 0 and count >= MIN_GRID_NODES * every for count in surface.shape)
    ]
    doubts = grid_doubt([grid.excess for grid in grids])
    found = grids[-1]
    worse = int(np.argmax(found.excess))
    error, bound = found.excess[worse], found.greatest_excess[worse]
    left_out = found.left_out[worse]
    return ReynoldsError(
        thickness=thickness,
        wavelength=2 * np.pi * rms / slope_of(surface) / gap,
        error=float(error),
        bar=float(min(left_out * (1 + error), max(error, bound - error)) + doubts[worse]),
        bound=float(bound),
        direction=worse,
    )


def _on_nodes(heights: Array, gap: float, spacing: tuple[float, float], every: int) -> SlopeCorrected:
    lower = heights[::every, ::every]
    steps = (spacing[0] * every, spacing[1] * every)
    return slope_corrected(Walls(lower=lower, upper=np.full(lower.shape, gap), spacing=steps))
