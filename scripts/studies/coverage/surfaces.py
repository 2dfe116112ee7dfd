"""Random rough surfaces in files, made without this package, and the same surfaces at more points."""

import hashlib
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.parts.surface_geometry import SurfaceGeometry
from scripts.studies.coverage.random_entries import Entries, between, chance

DESCRIBING = ("surface", "spacing", "digest", "amplitude", "wavelength")
"""Keys of a scene that describe the heights of a wall."""

SIDE = 1e-3
"""Side of the surfaces, m."""


def drawn_surface(rng: Generator, points: int, finest: float) -> Array:
    """Return heights of unit rms whose shortest waves have ``finest`` points or more, shape (points, points).

    The spectrum is a power law (Hurst exponent 0.2 to 1) or Gaussian, isotropic or with a lay in any direction, with
    random phases; 4 of 10 surfaces are then bent smoothly to plateaus or peaks.
    """
    number = np.fft.fftfreq(points) * points
    x, y = np.meshgrid(number, number, indexing="ij")
    angle, ratio = rng.uniform(0, np.pi), 1.0 if chance(rng, 0.6) else between(rng, 1.5, 6)
    along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    q = np.hypot(along / ratio, across * ratio) if ratio > 1 else np.hypot(x, y)
    highest = points / finest
    if chance(rng, 0.7):
        power = np.maximum(q, between(rng, 1, highest / 2)) ** (-2 * (1 + rng.uniform(0.2, 1.0)))
    else:
        power = np.exp(-((q / between(rng, min(1.5, highest / 2), highest / 2)) ** 2))
    kept = (np.hypot(x, y) <= highest) & (np.hypot(x, y) > 0)
    random = np.fft.fft2(rng.standard_normal((points, points)))
    heights = np.fft.ifft2(np.where(kept, np.sqrt(power) * random, 0)).real
    heights /= heights.std()
    if chance(rng, 0.4):
        bend = rng.uniform(0.3, 1.2) * rng.choice([-1, 1])
        heights = np.fft.ifft2(np.where(kept, np.fft.fft2(np.exp(bend * heights)), 0)).real * np.sign(bend)
    heights -= heights.mean()
    return np.asarray(heights / heights.std())


def rms_slope(heights: Array) -> float:
    """Return √(<|∇z|²>) of heights on a square of unit side."""
    points = heights.shape[0]
    number = 2 * np.pi * np.fft.fftfreq(points) * points
    power = np.abs(np.fft.fft2(heights) / heights.size) ** 2
    return float(np.sqrt(((number[:, None] ** 2 + number[None, :] ** 2) * power).sum()))


def stored(values: Array) -> Path:
    """Return the path of a file with these values, which is named after them."""
    return _kept(values.tobytes(), ".npy", lambda path: np.save(path, values))


def in_file(heights: Array, spacing: tuple[float, float], source: Mapping[str, Any] | None = None) -> Entries:
    """Return the geometry of a scene with these periodic heights, their spacing, m, and their origin, in a file."""
    surface = Surface(heights=heights, spacing=spacing, periodic=True, source=source or {})
    content = heights.tobytes() + repr((spacing, source) if source else spacing).encode()
    return {"surface": str(_kept(content, ".h5", lambda path: save_surface(surface, path)))}


def _kept(content: bytes, suffix: str, write: Callable[[Path], None]) -> Path:
    """Return the path of a file named after its content, which is written if it is missing."""
    folder = Path(tempfile.gettempdir()) / "roughfilm-coverage"
    folder.mkdir(exist_ok=True)
    path = folder / f"{hashlib.sha256(content).hexdigest()[:16]}{suffix}"
    if not path.is_file():
        write(path)
    return path


def refined(scene: Scene, factor: int) -> Scene:
    """Return the scene with its surfaces on a grid finer by a factor, through the same points and without new waves."""
    entries: dict[str, Any] = scene_entries(scene)
    geometry: SurfaceGeometry = scene.geometry  # type: ignore[attr-defined]
    fine = _finer(geometry, entries["geometry"], factor)
    upper = getattr(geometry, "upper", None)
    if upper is not None:
        fine["upper"] = _finer(upper, entries["geometry"]["upper"], factor)
    return read_scene({**entries, "geometry": fine})


def _finer(wall: SurfaceGeometry, entries: Entries, factor: int) -> Entries:
    surface = wall.read()
    dx, dy = surface.spacing
    kept = {key: value for key, value in entries.items() if key not in DESCRIBING}
    return {**kept, **in_file(padded(surface.heights, factor), (dx / factor, dy / factor))}


def padded(heights: Array, factor: int) -> Array:
    """Return the trigonometric interpolation of periodic heights, shape (factor nx, factor ny), nx and ny even."""
    waves = np.fft.fftshift(np.fft.fft2(heights))
    added = [(count * factor - count) // 2 for count in heights.shape]
    waves = np.pad(waves, [(number, number) for number in added])
    return np.asarray(np.fft.ifft2(np.fft.ifftshift(waves)).real * factor**2)
