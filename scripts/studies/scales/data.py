"""Rough films with every wave resolved and with all waves averaged, for waves of many lengths."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.preparation.recipe import Edges, Grid, Recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries
from scripts.studies.thesis_clipping import prepare_as_in_the_thesis

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
SURFACE = "ground_striated.x3p"
ROUGHNESS = 0.1
"""Rms height of the scaled measured surface over the smallest film thickness."""

MODULUS = "1 GPa"
"""Bulk modulus; the source prints 10⁹ GPa, but its figure agrees with 1 GPa (10 GPa: pressures a fifth higher)."""

NEVER = "-0.2 GPa"
"""Cavitation pressure below all pressures of the study, so that no film cavitates."""

NARROW_INLET = 270.0
"""Phase of the waves, degrees, at which the gap is narrowest at the inlet."""

RATIOS = tuple(2.0**-k for k in range(9))
IN_PLANE = tuple(2.0**-k for k in range(1, 6))
OF_SURFACE = tuple(2.0**-k for k in range(4))
"""Lengths of the waves, or of the measured cell, over the length of the bearing."""

PHASES = (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0)
"""Phases of the waves, degrees; the phase of a real surface at the inlet is unknown."""

DRAWN = RATIOS[4:]
"""Ratios that are drawn in Fig. C.3."""


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Relative errors of the averaged film against the resolved one.

    ``pressure`` is the largest difference over the largest pressure; None for films in the plane.
    """

    ratio: float
    phase: float
    pressure: float | None
    load: float
    friction: float
    cpu_direct: float
    cpu_homogenized: float
    uncertainty: float


@dataclass(frozen=True, kw_only=True)
class WaveErrors:
    """Errors of averaging one kind of roughness, for waves of many lengths and phases."""

    title: str
    pairs: tuple[Pair, ...]

    @property
    def ratios(self) -> list[float]:
        """The ratios, from the longest waves to the shortest."""
        return sorted({pair.ratio for pair in self.pairs}, reverse=True)

    def worst(self, name: str) -> Array:
        """Return the largest error over all phases, shape (ratios,)."""
        return np.array([max(abs(getattr(p, name)) for p in self.pairs if p.ratio == r) for r in self.ratios])

    def mean(self, name: str) -> Array:
        """Return the absolute value of the mean error over all phases, shape (ratios,)."""
        return np.array([abs(np.mean([getattr(p, name) for p in self.pairs if p.ratio == r])) for r in self.ratios])

    def rate(self, name: str, shortest: int = 4) -> float:
        """Return the power of ε with which the largest error falls for the shortest waves."""
        worst = self.worst(name)[-shortest:]
        return float(np.polyfit(np.log(self.ratios[-shortest:]), np.log(worst), 1)[0])

    @property
    def cost(self) -> float:
        """CPU time of resolving the shortest waves divided by that of averaging them."""
        last = [pair for pair in self.pairs if pair.ratio == self.ratios[-1]]
        return float(np.median([pair.cpu_direct / pair.cpu_homogenized for pair in last]))


def solve(scene: Any, name: str) -> Result:
    """Solve a bearing; ``direct`` takes a measured surface on the coarsest grid that has its pixels."""
    model = find("bearing", name)
    coarse = name == "direct" and scene.roughness.kind == "surface"
    return model.solve(scene, Request(resolution=model.resolutions_of(scene)[0] if coarse else None))


def slider(ratio: float, phase: float, cavitation: str = NEVER) -> Any:
    """Return the scene of Fig. C.3; in the source the film does not cavitate."""
    waves = [f"roughness.wavelength={0.1 * ratio!r} m", f"roughness.phase={phase!r} deg"]
    oil = [f"lubricant.compressibility.bulk_modulus={MODULUS}", f"lubricant.cavitation_pressure={cavitation}"]
    return load_scene(SCENES / "rough_slider.toml", [*oil, *waves])


def pad(ratio: float, phase: float) -> Any:
    """Return a converging pad of finite width with ridges at 45 degrees."""
    changes = ["geometry.shape=linear", f"roughness.wavelength={20e-3 * ratio!r} m", f"roughness.phase={phase!r} deg"]
    return load_scene(SCENES / "rough_pad.toml", changes)


def over(surface: Path, ratio: float, phase: float) -> Any:
    """Return the converging pad with a measured surface whose cell is ``ratio`` of its length; the phase must be 0."""
    assert phase == 0
    read = read_surface(surface)
    entries = scene_entries(pad(1.0, 0.0))
    film = 20e-6
    scale = ROUGHNESS * film / float(read.heights.std())
    stretch = 20e-3 * ratio / (read.spacing[0] * read.shape[0])
    rough = {"kind": "surface", "surface": str(surface), "scale": scale, "stretch": stretch}
    return read_scene({**entries, "roughness": rough})


def pairs(
    make: Callable[[float, float], Any], title: str, ratios: Sequence[float], phases: Sequence[float]
) -> WaveErrors:
    """Solve films by both models for all lengths of the waves and all phases."""
    found = []
    averaged = solve(make(ratios[-1], 0.0), "homogenized")
    for ratio in ratios:
        for phase in phases:
            resolved = solve(make(ratio, phase), "direct")
            found.append(_pair(ratio, phase, averaged, resolved))
    return WaveErrors(title=title, pairs=tuple(found))


def _pair(ratio: float, phase: float, averaged: Result, resolved: Result) -> Pair:
    def error(name: str) -> float:
        return averaged.quantities[name].value / resolved.quantities[name].value - 1

    load = resolved["load_per_width"]
    assert load.uncertainty is not None
    return Pair(
        ratio=ratio,
        phase=phase,
        pressure=pressure_error(averaged, resolved),
        load=error("load_per_width"),
        friction=error("friction_per_width"),
        cpu_direct=resolved.numerics.cpu_s,
        cpu_homogenized=averaged.numerics.cpu_s,
        uncertainty=load.uncertainty / load.value,
    )


def pressure_error(averaged: Result, resolved: Result) -> float | None:
    """Return the largest difference on a line over the largest pressure; None for films in the plane."""
    (x, p), (there, waves) = (line(result) for result in (averaged, resolved))
    if resolved.fields["pressure"].values.shape[1] > 1:
        return None
    return float(np.abs(np.interp(there, x, p) - waves).max() / waves.max())


def line(found: Result) -> tuple[Array, Array]:
    """Return position, m, and pressure, Pa, on the first line along the sliding."""
    return found.fields["x"].values[:, 0], found.fields["pressure"].values[:, 0]


def measured(surfaces: Path | None, directory: Path, name: str = SURFACE, points: int = 64) -> Path | None:
    """Write a measured surface as a periodic cell and return its file; None where the surface is absent."""
    source = surfaces and surfaces / name
    if source is None or not source.is_file():
        return None
    recipe = Recipe(grid=Grid(points=(points, points)), edges=Edges(method="blended"))
    cell = prepare_as_in_the_thesis(read_surface(source), recipe).surface
    target = directory / "cell.h5"
    save_surface(cell, target)
    return target
