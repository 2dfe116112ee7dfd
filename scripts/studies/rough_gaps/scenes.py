"""Gaps of the report on rough gaps: sinusoids, random surfaces, and windows of measured surfaces."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.rough_gap.scene import RoughGap
from scripts.studies.thesis_clipping import prepare_as_in_the_thesis

MEAN_GAP = 10e-6
"""Mean gap, m; only ratios to it matter."""

CREEPING = 1e-3
"""Reynolds number of scenes for Stokes flow alone."""

OWN = 96
"""Number of points along a side of random surfaces and windows; 24, 32 and 48 divide it."""

SEED = 20071

LAY = 2.5
"""Correlation length along the lay over that across it."""

MILLED = "milled_NT1100.opd"

WINDOW = 50e-6
"""Side of the milled window that is resolved in three dimensions, m."""

WAVES = 8
"""Number of waves of that window along each side; finer ones are left out, so that all meshes have the same surface."""


def gap(
    geometry: Mapping[str, Any],
    mean_gap: float = MEAN_GAP,
    reynolds_number: float = CREEPING,
    layers: int | None = None,
) -> RoughGap:
    """Return the scene of a gap with the entries ``geometry``, filled with oil."""
    scene = read_scene(
        {
            "name": "rough gap",
            "kind": "rough_gap",
            "geometry": {**geometry, "mean_gap": f"{mean_gap!r} m"},
            "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
            "flow": {"reynolds_number": reynolds_number},
            "mesh": {} if layers is None else {"layers": layers},
        }
    )
    assert isinstance(scene, RoughGap)
    return scene


def over_waves(amplitude: float, wavelength: float, reynolds_number: float = CREEPING) -> RoughGap:
    """Return the scene of a gap over ridges across x; amplitude and wavelength are over the mean gap."""
    geometry = {
        "surface": "sinusoid",
        "amplitude": f"{amplitude * MEAN_GAP!r} m",
        "wavelength": f"{wavelength * MEAN_GAP!r} m",
    }
    return gap(geometry, reynolds_number=reynolds_number)


def over_random(
    roughness: float, wavelength: float, *, lay: bool = False, reynolds_number: float = CREEPING, points: int = OWN
) -> RoughGap:
    """Return a gap over a random surface of Sq and λ = 2π Sq/g' over the mean gap; 24 nodes hold all waves."""
    size = wavelength * MEAN_GAP / _wavelength_of_unit(lay, points)
    return gap(
        {"surface": _random(size, roughness * MEAN_GAP, lay=lay, points=points)}, reynolds_number=reynolds_number
    )


def _random(size: float, rms_height: float, *, lay: bool, points: int) -> dict[str, Any]:
    return {
        "kind": "gaussian",
        "size": [f"{size!r} m"] * 2,
        "points": [points, points],
        "seed": SEED,
        "rms_height": f"{rms_height!r} m",
        "correlation_length": f"{size / (6 if lay else 5)!r} m",
        "anisotropy": LAY if lay else 1.0,
    }


@lru_cache(maxsize=4)
def _wavelength_of_unit(lay: bool, points: int) -> float:
    scene = gap({"surface": _random(1.0, 1e-3, lay=lay, points=points)}, mean_gap=1.0)
    return 1 / scene.gap_over_wavelength


def milled_window(folder: Path | None, target: Path) -> Path | None:
    """Return the file of a prepared window of the milled surface; None if the measurement is absent."""
    source = None if folder is None else folder / MILLED
    if source is None or not source.is_file():
        return None
    fine = window_of(read_surface(source), (WINDOW, WINDOW), (OWN, OWN))
    waves = np.fft.rfft2(fine.heights)
    along, across = (np.abs(np.fft.fftfreq(OWN, 1 / OWN)) <= WAVES, np.fft.rfftfreq(OWN, 1 / OWN) <= WAVES)
    held = np.fft.irfft2(waves * np.outer(along, across), s=fine.shape)
    save_surface(Surface(heights=held, spacing=fine.spacing, periodic=True, source=fine.source), target)
    return target


def window_of(measured: Surface, size: Sequence[float], points: Sequence[int]) -> Surface:
    """Return the window of at least ``size``, m, whose edges match best, prepared with blended edges."""
    recipe = {
        "window": {"size": [f"{side} m" for side in size]},
        "grid": {"points": [*points]},
        "edges": {"method": "blended"},
    }
    return prepare_as_in_the_thesis(measured, read_recipe(recipe)).surface


def peak_over_rms(surface: Surface) -> float:
    """Return the height of the highest point above the mean plane, over the rms height."""
    return float((surface.heights.max() - surface.heights.mean()) / np.std(surface.heights))
