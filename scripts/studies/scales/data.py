"""Rough films with every wave followed, beside the same with all of them averaged, over the length of the waves."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import Grid, Recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
SURFACE = "ground_striated.x3p"
ROUGHNESS = 0.1
"""Rms height of the measured surface over the least film, to which its heights are scaled."""

MODULUS = "1 GPa"
"""The source prints 10⁹ GPa; with 1 GPa pressures are those of its figure, with 10 GPa a fifth higher."""

NEVER = "-0.2 GPa"
"""A pressure of cavitation that no film here comes to; a constant bulk modulus knows no zero of pressure."""

NARROW_INLET = 270.0
"""The phase that puts the narrowest place of a wave at the inlet, degrees."""

RATIOS = tuple(2.0**-k for k in range(9))
IN_PLANE = tuple(2.0**-k for k in range(1, 6))
OF_SURFACE = tuple(2.0**-k for k in range(4))
"""Lengths of the waves, or of the measured cell, over the bearing."""

PHASES = (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0)
"""Of the waves, degrees: what stands at the inlet is not known of a real surface."""

DRAWN = RATIOS[4:]
"""Of Fig. C.3."""


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Errors of the averaged film against the followed one, each a part of the followed one's.

    ``pressure`` is the largest difference over the largest pressure; None in the plane, where waves cross lines.
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
class Study:
    """One kind of roughness over its lengths."""

    title: str
    pairs: tuple[Pair, ...]

    @property
    def ratios(self) -> list[float]:
        """From the longest waves to the shortest."""
        return sorted({pair.ratio for pair in self.pairs}, reverse=True)

    def worst(self, name: str) -> Array:
        """The largest error over all phases, for each length of the waves."""
        return np.array([max(abs(getattr(p, name)) for p in self.pairs if p.ratio == r) for r in self.ratios])

    def mean(self, name: str) -> Array:
        """The size of the error averaged over all phases."""
        return np.array([abs(np.mean([getattr(p, name) for p in self.pairs if p.ratio == r])) for r in self.ratios])

    def rate(self, name: str, shortest: int = 4) -> float:
        """The power of ε by which the largest error falls over the shortest waves."""
        worst = self.worst(name)[-shortest:]
        return float(np.polyfit(np.log(self.ratios[-shortest:]), np.log(worst), 1)[0])

    @property
    def cost(self) -> float:
        """CPU time of following the shortest waves over that of averaging them."""
        last = [pair for pair in self.pairs if pair.ratio == self.ratios[-1]]
        return float(np.median([pair.cpu_direct / pair.cpu_homogenized for pair in last]))


def solve(scene: Any, name: str) -> Result:
    """A bearing by a rung; a surface, whose pixels say what there is, on the coarsest grid that follows it."""
    rung = find("bearing", name)
    coarse = name == "direct" and scene.roughness.kind == "surface"
    return rung.solve(scene, Request(resolution=rung.resolutions_of(scene)[0] if coarse else None))


def slider(ratio: float, phase: float, cavitation: str = NEVER) -> Any:
    """The film of Fig. C.3; the source's bears any tension."""
    waves = [f"roughness.wavelength={0.1 * ratio!r} m", f"roughness.phase={phase!r} deg"]
    oil = [f"lubricant.compressibility.bulk_modulus={MODULUS}", f"lubricant.cavitation_pressure={cavitation}"]
    return load_scene(SCENES / "rough_slider.toml", [*oil, *waves])


def pad(ratio: float, phase: float) -> Any:
    """A converging pad with sides, its ridges at 45 degrees."""
    changes = ["geometry.shape=linear", f"roughness.wavelength={20e-3 * ratio!r} m", f"roughness.phase={phase!r} deg"]
    return load_scene(SCENES / "rough_pad.toml", changes)


def over(surface: Path, ratio: float, phase: float) -> Any:
    """The converging pad under a measured surface, whose cell is ``ratio`` of it; a phase means nothing here."""
    assert phase == 0
    read = read_surface(surface)
    entries = scene_entries(pad(1.0, 0.0))
    film = 20e-6
    scale = ROUGHNESS * film / float(read.heights.std())
    stretch = 20e-3 * ratio / (read.spacing[0] * read.shape[0])
    rough = {"kind": "surface", "surface": str(surface), "scale": scale, "stretch": stretch}
    return read_scene({**entries, "roughness": rough})


def pairs(make: Callable[[float, float], Any], title: str, ratios: Sequence[float], phases: Sequence[float]) -> Study:
    """Both rungs over the lengths of the waves and their phases."""
    found = []
    averaged = solve(make(ratios[-1], 0.0), "homogenized")
    for ratio in ratios:
        for phase in phases:
            followed = solve(make(ratio, phase), "direct")
            found.append(_pair(ratio, phase, averaged, followed))
    return Study(title=title, pairs=tuple(found))


def _pair(ratio: float, phase: float, averaged: Result, followed: Result) -> Pair:
    def error(name: str) -> float:
        return averaged.quantities[name].value / followed.quantities[name].value - 1

    load = followed["load_per_width"]
    assert load.uncertainty is not None
    return Pair(
        ratio=ratio,
        phase=phase,
        pressure=pressure_error(averaged, followed),
        load=error("load_per_width"),
        friction=error("friction_per_width"),
        cpu_direct=followed.numerics.cpu_s,
        cpu_homogenized=averaged.numerics.cpu_s,
        uncertainty=load.uncertainty / load.value,
    )


def pressure_error(averaged: Result, followed: Result) -> float | None:
    """The largest difference on a line over the largest pressure; None in the plane."""
    (x, p), (there, waves) = (line(result) for result in (averaged, followed))
    if followed.fields["pressure"].values.shape[1] > 1:
        return None
    return float(np.abs(np.interp(there, x, p) - waves).max() / waves.max())


def line(found: Result) -> tuple[Array, Array]:
    """Position, m, and pressure, Pa, on the first line along the sliding."""
    return found.fields["x"].values[:, 0], found.fields["pressure"].values[:, 0]


def measured(surfaces: Path | None, directory: Path, name: str = SURFACE, points: int = 64) -> Path | None:
    """A measured surface as a periodic cell of so many points a side, in a file; None where it is absent."""
    source = surfaces and surfaces / name
    if source is None or not source.is_file():
        return None
    recipe = Recipe(grid=Grid(points=(points, points)))
    cell = prepare(read_surface(source), recipe).surface
    target = directory / "cell.h5"
    save_surface(cell, target)
    return target
