"""Dependence of a leakage on the window, the resolution and the load (Figs. E.19 to E.21), on a milled surface."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import Solid, composite_modulus
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.seal.leakage.direct import direct_flow, direct_leakage
from scripts.studies.thesis_clipping import prepare_as_in_the_thesis

MILLED = "milled_NT1100.opd"
STEEL = Solid(modulus=210e9, poisson=0.3, hardness=5e9)
VISCOSITY, DENSITY = 1.26e-3, 789.0
"""Viscosity, Pa s, and density, kg/m³, of the ethanol in the rig of the source."""

PRESSURE_DROP, LENGTH, WIDTH, DURATION = 1e6, 15e-3, 60e-3, 300.0
"""Pressure, Pa (the rig's is not published), length of the leak and width of the middle part, m, and time, s."""

LOAD = 4e6
"""Usual load, Pa: 6 kN, a middle force of Fig. E.18, over 15 x 100 mm²; the load of the rig is not published."""

LOADS = tuple(float(load) for load in LOAD * np.array([0.5, 1, 2, 8, 25, 50, 100]))
"""Loads, Pa: half, equal to and twice ``LOAD``, and multiples with a larger contact area."""

PARTS = {"a": 1.0, "b": 2 / 3, "c": 0.45}
"""Sides of the windows over those of the measurement."""

PLACES = {"a": 1, "b": 2, "c": 3}
"""Number of windows along each side."""

PERIODS = (1, 2, 4, 8, 16)
"""Numbers of periods in a row, for the cell with the largest end effect."""

CONTACT_TOLERANCE = 1e-6


@dataclass(frozen=True, kw_only=True)
class Leak:
    """Leakage through one cell at one load.

    Attributes
    ----------
    window : name of the window: a, b or c.
    resolution : number of nodes along a side over the usual number: 0.5, 1 or 2.
    start : corner of the window, over the sides of the measurement.
    mismatch : periodicity mismatch before and after the joining of the edges.
    load : mean pressure, Pa.
    homogenized, uncertainty : A₁₁ and A₂₂, and their uncertainties, m³.
    direct, direct_uncertainty : permeability of one cell between two reservoirs, solved directly, and uncertainty, m³.
    """

    window: str
    resolution: float
    start: tuple[float, float]
    mismatch: tuple[float, float]
    load: float
    mean_gap: float
    area_fraction: float
    roughness: float
    homogenized: tuple[float, float]
    uncertainty: tuple[float, float]
    direct: tuple[float, float]
    direct_uncertainty: tuple[float, float]

    def apart(self, direction: int) -> float:
        """Return the relative excess of the direct solution over the homogenized one."""
        return self.direct[direction] / self.homogenized[direction] - 1

    def volume(self, direction: int, *, direct: bool = False) -> float:
        """Return the volume that leaks through the middle part of the rig in 300 s, m³, along x (0) or y (1)."""
        passed = (self.direct if direct else self.homogenized)[direction]
        return passed * PRESSURE_DROP / (12 * VISCOSITY * LENGTH) * WIDTH * DURATION


def study(
    folder: Path,
    *,
    loads: Sequence[float] = LOADS,
    coarser: int = 1,
    advance: Callable[[str], None] = lambda _words: None,
) -> tuple[Leak, ...]:
    """Compute all windows at the usual resolution; windows a and b in the middle at half of it and at double.

    ``coarser`` divides the nodes along each side.
    """
    measured = read_surface(folder / MILLED)
    found: list[Leak] = []
    for window in PARTS:
        for start in places(window):
            advance(f"window {window}")
            found += leaks(measured, window, start, 1.0, loads=loads, coarser=coarser)
    for window, resolution in product(("a", "b"), (0.5, 2.0)):
        advance(f"window {window} at {resolution:g} of its nodes")
        found += leaks(measured, window, places(window)[0], resolution, loads=loads[:3], coarser=coarser)
    return tuple(found)


def places(window: str) -> list[tuple[float, float]]:
    """Return the corners of the windows over the sides of the measurement; the middle window is the first."""
    steps = np.linspace(0, 1 - PARTS[window], PLACES[window]) if PLACES[window] > 1 else np.zeros(1)
    middle = (1 - PARTS[window]) / 2
    around = [(float(x), float(y)) for x, y in product(steps, steps)]
    return [(middle, middle), *(one for one in around if one != (middle, middle))]


def leaks(
    measured: Surface,
    window: str,
    start: tuple[float, float],
    resolution: float,
    *,
    loads: Sequence[float],
    coarser: int = 1,
) -> list[Leak]:
    """Compute the leakage through one window at every load; each contact starts from the one before."""
    prepared = prepare_as_in_the_thesis(measured, read_recipe(recipe(measured, window, start, resolution, coarser)))
    surface = prepared.surface
    press = Press(surface.heights, surface.spacing, composite_modulus(STEEL), hardness=STEEL.hardness)
    mismatch = prepared.record["periodicity_mismatch"]
    found, before = [], None
    for load in loads:
        contact = before = press.at(load, tolerance=CONTACT_TOLERANCE, start=before)
        one = flow_factors(contact.gap, surface.spacing)
        straight = direct_leakage(contact.gap, surface.spacing)
        passed, uncertainty = (np.diag(part.pressure) for part in (one.factors, one.uncertainty))
        found.append(
            Leak(
                window=window,
                resolution=resolution,
                start=start,
                mismatch=(mismatch["before"], mismatch["after"]),
                load=load,
                mean_gap=contact.mean_gap,
                area_fraction=contact.area_fraction,
                roughness=float(surface.heights.std()),
                homogenized=(float(passed[0]), float(passed[1])),
                uncertainty=(float(uncertainty[0]), float(uncertainty[1])),
                direct=(float(straight.permeability[0]), float(straight.permeability[1])),
                direct_uncertainty=(float(straight.uncertainty[0]), float(straight.uncertainty[1])),
            )
        )
    return found


def recipe(
    measured: Surface, window: str, start: tuple[float, float], resolution: float, coarser: int = 1
) -> Mapping[str, Any]:
    """Return the recipe of ``roughfilm surface`` for a window; double resolution is smoothed over 5 points.

    The usual nodes are the least powers of two that are not fewer than the window's pixels.
    """
    part = PARTS[window]
    pixels = [max(2, round(part * count)) for count in measured.shape]
    whole = [2 ** int(np.ceil(np.log2(count))) for count in pixels]
    size = [count * step for count, step in zip(pixels, measured.spacing, strict=True)]
    return {
        "window": {
            "size": [f"{length} m" for length in size],
            "start": [f"{place * length} m" for place, length in zip(start, measured.size, strict=True)],
        },
        "grid": {"points": [max(16, round(count * resolution) // coarser) for count in whole]},
        "edges": {"method": "blended"},
        "smoothing": 5 if resolution > 1 else 3,
    }


def in_a_row(measured: Surface, cell: Leak, direction: int, *, coarser: int = 2) -> tuple[tuple[int, float], ...]:
    """Return the relative excess of the direct flow over the homogenized one for several periods in a row.

    ``coarser`` divides the nodes along each side.
    """
    prepared = prepare_as_in_the_thesis(
        measured, read_recipe(recipe(measured, cell.window, cell.start, cell.resolution, coarser))
    )
    surface = prepared.surface
    press = Press(surface.heights, surface.spacing, composite_modulus(STEEL), hardness=STEEL.hardness)
    gap = press.at(cell.load, tolerance=CONTACT_TOLERANCE).gap
    endless = flow_factors(gap, surface.spacing).factors.pressure[direction, direction]
    return tuple(
        (count, direct_flow(gap, surface.spacing, direction, periods=count).permeability / endless - 1)
        for count in PERIODS
    )


def sensitivity(found: Sequence[Leak], direction: int) -> float:
    """Return the slope d ln A/d ln W over the first three loads of one cell."""
    low, _, high = sorted(found, key=lambda one: one.load)[:3]
    passed = [one.homogenized[direction] for one in (low, high)]
    return float(np.log(passed[1] / passed[0]) / np.log(high.load / low.load))
