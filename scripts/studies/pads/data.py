"""Textured pads of infinite width over Reynolds number and aspect ratio of the pockets, by each model."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.runs import Answers, ModelRun

FILM, VISCOSITY, DENSITY = 20e-6, 0.01, 1000.0
"""Minimum film thickness, m, viscosity, Pa s, and density, kg/m³; the numbers of the page do not depend on them."""

CELLS = 10
"""Number of cells over the length of a pad; the pocket of a cell is as long as the land around it."""

TEXTURED = {"full": CELLS, "inlet half": CELLS // 2}
"""Number of cells with a pocket, counted from the inlet."""

DEPTHS = (0.5, 1.0)
"""Depths of the pockets over the film thickness."""

RISES = (0.0, 0.5)
"""Rises of the pad over the film thickness: parallel and inclined."""

RATIOS = (8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0)
"""Aspect ratios λ: length over depth of a pocket."""

NUMBERS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 400.0)
"""Reynolds numbers ρ u h/η."""

NO_INERTIA = 1e-3
"""Reynolds number that stands for none."""

CHECKED_RATIOS, CHECKED_NUMBERS = (8.0, 24.0, 64.0), (20.0, 200.0)
"""The pads that are solved by the Navier-Stokes equations too."""

RESOLUTIONS = {"reynolds": 2048, "film": 400, "film_slope": 400, "navier_stokes": 480}
COARSER = 240
"""Columns of the coarser mesh of the Navier-Stokes equations."""

CELL_RESOLUTION = 200


@dataclass(frozen=True, kw_only=True)
class Pad:
    """A pad: the cells with a pocket, depth and rise over the film, λ, and Re."""

    texture: str
    depth: float
    rise: float
    ratio: float
    number: float

    @property
    def pocket(self) -> float:
        """Length of a pocket, m."""
        return self.ratio * self.depth * FILM

    @property
    def length(self) -> float:
        """Length of the pad, m."""
        return 2 * CELLS * self.pocket

    @property
    def speed(self) -> float:
        """Sliding speed, m/s."""
        return self.number * VISCOSITY / (DENSITY * FILM)

    @property
    def load_unit(self) -> float:
        """The load 6 η u L²/h², N/m."""
        return 6 * VISCOSITY * self.speed * (self.length / FILM) ** 2

    def scene(self) -> Scene:
        """The pad as a bearing whose liquid bears any tension."""
        geometry = {"length": with_unit(self.length, "m"), "film": with_unit(FILM, "m")}
        geometry |= (
            {"shape": "linear", "rise": with_unit(self.rise * FILM, "m")} if self.rise else {"shape": "parallel"}
        )
        texture = {
            "length": with_unit(self.pocket, "m"),
            "depth": with_unit(self.depth * FILM, "m"),
            "start": with_unit(self.pocket / 2, "m"),
            "pitch": with_unit(2 * self.pocket, "m"),
            "columns": TEXTURED[self.texture],
        }
        return read_scene(
            {
                "name": f"{self.texture}, λ = {self.ratio:g}, Re = {self.number:g}",
                "kind": "bearing",
                "geometry": {**geometry, "texture": texture},
                "lubricant": {**_liquid(), "cavitation_pressure": "-1 GPa"},
                "motion": {"speed": with_unit(self.speed, "m/s")},
            }
        )

    def cell(self) -> Scene:
        """One cell of the pad between parallel walls, periodic."""
        return read_scene(
            {
                "name": f"cell, λ = {self.ratio:g}, Re = {self.number:g}",
                "kind": "pocket",
                "geometry": {
                    "length": with_unit(2 * self.pocket, "m"),
                    "film": with_unit(FILM, "m"),
                    "profile": "cylindrical",
                    "width": with_unit(self.pocket, "m"),
                    "depth": with_unit(self.depth * FILM, "m"),
                },
                "lubricant": _liquid(),
                "motion": {"reynolds_number": self.number},
                "boundary": {"ambient_pressure": "1 GPa"},
            }
        )


def _liquid() -> dict[str, str]:
    return {"viscosity": with_unit(VISCOSITY, "Pa*s"), "density": with_unit(DENSITY, "kg/m^3")}


@dataclass(frozen=True, kw_only=True)
class Plan:
    """The pads that are solved; tests solve fewer."""

    ratios: tuple[float, ...] = RATIOS
    numbers: tuple[float, ...] = NUMBERS
    checked_ratios: tuple[float, ...] = CHECKED_RATIOS
    checked_numbers: tuple[float, ...] = CHECKED_NUMBERS
    film_cells: int = RESOLUTIONS["film"]

    def maps(self) -> list[tuple[str, float, float]]:
        """The texture, depth and rise of each map: the parallel pad at both depths, the inclined one at one depth."""
        textured = [("full", depth, 0.0) for depth in DEPTHS] + [("inlet half", depth, 0.0) for depth in DEPTHS]
        return [*textured, ("full", 1.0, RISES[1]), ("inlet half", 1.0, RISES[1])]

    def pads(self) -> Iterator[Pad]:
        """Every pad, with those without inertia."""
        for texture, depth, rise in self.maps():
            for ratio in self.ratios:
                for number in (NO_INERTIA, *self.numbers):
                    yield Pad(texture=texture, depth=depth, rise=rise, ratio=ratio, number=number)

    def checked(self) -> Iterator[Pad]:
        """The pads that are solved by the Navier-Stokes equations."""
        for texture, depth, rise in (("full", 1.0, 0.0), ("inlet half", 1.0, 0.0)):
            for ratio in self.checked_ratios:
                for number in self.checked_numbers:
                    yield Pad(texture=texture, depth=depth, rise=rise, ratio=ratio, number=number)

    def run(self, pad: Pad, model: str) -> ModelRun:
        """The run of a model for a pad."""
        resolution = self.film_cells if model in ("film", "film_slope") else RESOLUTIONS[model]
        return ModelRun(scene=pad.scene(), model=model, resolution=resolution)

    def runs(self) -> list[ModelRun]:
        """All runs, those in this process first."""
        pads = [*self.pads()]
        films = [self.run(pad, model) for pad in pads for model in ("film", "film_slope")]
        reynolds = [self.run(pad, "reynolds") for pad in pads if pad.number == NO_INERTIA]
        cells = [cell_run(pad) for pad in pads if pad.texture == "full" and pad.rise == 0]
        resolved = [one for pad in self.checked() for one in checks(pad)]
        return [*reynolds, *films, *cells, *resolved]


def cell_run(pad: Pad) -> ModelRun:
    """The run of one cell of a pad."""
    return ModelRun(scene=pad.cell(), model="film_slope", resolution=CELL_RESOLUTION)


def checks(pad: Pad) -> tuple[ModelRun, ModelRun]:
    """The runs of the Navier-Stokes equations for a pad on two meshes, the finer one first."""
    scene = pad.scene()
    fine, coarse = (
        ModelRun(scene=scene, model="navier_stokes", resolution=columns)
        for columns in (RESOLUTIONS["navier_stokes"], COARSER)
    )
    return fine, coarse


@dataclass(frozen=True, kw_only=True)
class PadStudy:
    """The results of the pads.

    Attributes
    ----------
    plan : the pads.
    found : results by :attr:`scripts.studies.runs.ModelRun.key`.
    """

    plan: Plan
    found: Answers

    def load(self, pad: Pad, model: str) -> float:
        """The load of a pad over 6 η u L²/h²; NaN where the model has no solution."""
        return _load(self.found.get(self.plan.run(pad, model).key), pad)

    def map(self, name: tuple[str, float, float], value: Callable[[Pad], float]) -> Array:
        """A value of every pad of a map, shape (ratios, numbers)."""
        texture, depth, rise = name
        return np.array(
            [
                [
                    value(Pad(texture=texture, depth=depth, rise=rise, ratio=ratio, number=number))
                    for number in self.plan.numbers
                ]
                for ratio in self.plan.ratios
            ]
        )

    def by_inertia(self, pad: Pad, model: str = "film_slope") -> float:
        """The change of the load by inertia, over 6 η u L²/h²."""
        return self.load(pad, model) - self.load(replace(pad, number=NO_INERTIA), model)

    def without(self, pad: Pad) -> float:
        """The load by the Reynolds equation, over 6 η u L²/h², which does not depend on Re."""
        return self.load(replace(pad, number=NO_INERTIA), "reynolds")

    def by_cells(self, pad: Pad) -> float:
        """The change of the load by inertia that single periodic cells predict, over 6 η u L²/h².

        It is the load of a cell in which the pressure at its ends is ambient, for every pocket of the pad.
        """
        loads = [
            result["load_per_area"].value / (6 * VISCOSITY * one.speed * (one.length / FILM**2))
            if (result := self.found.get(cell_run(one).key)) is not None
            else np.nan
            for one in (pad, replace(pad, number=NO_INERTIA))
        ]
        return (loads[0] - loads[1]) * TEXTURED[pad.texture] / CELLS

    @cached_property
    def checked(self) -> Mapping[Pad, tuple[float, float]]:
        """The load by the Navier-Stokes equations over 6 η u L²/h², and its change from the coarser mesh."""
        loads = {pad: [_load(self.found.get(run.key), pad) for run in checks(pad)] for pad in self.plan.checked()}
        return {pad: (fine, abs(fine - coarse)) for pad, (fine, coarse) in loads.items() if np.isfinite(fine)}


def _load(result: Result | None, pad: Pad) -> float:
    return np.nan if result is None else result["load_per_width"].value / pad.load_unit


def finite(values: Iterable[float]) -> Array:
    """The finite ones of values."""
    array = np.array([*values])
    return np.asarray(array[np.isfinite(array)])
