"""A composition under a load: the film at which what counts of a bearing carries it."""

import math
import time
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.effects.ablation import Composed, Composition
from roughfilm.rom.bearing.mixed.balance import Speed, balanced
from roughfilm.rom.bearing.mixed.film import MixedFilm, widest_film
from roughfilm.rom.bearing.mixed.touching import touching
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.quantities import carried, nominal_area
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import load_loops
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import COARSEST_CELLS, Solution, solve
from roughfilm.rom.ladder.model import Progress, silent

THINNEST = 30.0
"""The scene's film over the thinnest in which a load is sought, where asperities do not say how thin it can be."""

APART = 1.001
"""Times its amplitude, how thick a film over ridges is at the least."""

TOLERANCE, RESIDUAL = 1e-7, 1e-11
"""Of the load, and of a film."""

LOADS = ("load", "load_per_width")
SHARES = {"friction_coefficient": "friction_per_width", "contact_share": "contact_load_per_width"}
"""What a load fixes, and what is a part of it."""

STEP = 1e-3
"""Of the film, over which is seen what changes with it."""


@dataclass(frozen=True, kw_only=True)
class Carrying:
    """A composition's film in balance; ``load`` in N, N/m if infinitely wide."""

    taken: Composition
    solution: Solution
    load: float

    @property
    def values(self) -> dict[str, float]:
        """What it carries, rubs and lets through, and its ``film``, in SI."""
        told = self.taken.reading.quantities(self.taken.scene, self.solution)
        return {name: quantity.value for name, quantity in told.items()} | {"film": self.taken.scene.geometry.film}


@dataclass(frozen=True, kw_only=True)
class ComposedFilm:
    """A composition on a grid of ``cells`` along and across, at any least film thickness and speed."""

    taken: Composition
    cells: int

    @property
    def scene(self) -> Bearing:
        """Its own film does not count."""
        return self.taken.scene

    @cached_property
    def grid(self) -> Grid:
        """The nodes, the same for all films."""
        return grid(self.scene.geometry.film_shape(), (self.cells, self.cells))

    @cached_property
    def mixed(self) -> MixedFilm | None:
        """Its asperities; None without them."""
        if self.scene.asperities is None:
            return None
        return MixedFilm(scene=self.scene, asperities=asperities_of(self.scene), cells=self.cells)

    @cached_property
    def area(self) -> float:
        """Nominal, m²; m if infinitely wide."""
        return nominal_area(self.scene, self.grid)

    @cached_property
    def reach(self) -> float:
        """The mean gap down to which flow factors are known, m."""
        sought, roughness = self.scene.geometry.film / THINNEST, self.scene.roughness
        if not self.taken.rough or roughness is None:
            return sought
        if isinstance(roughness, Sinusoid):
            return APART * roughness.amplitude
        return max(sought, roughness.factors(sought).narrowest)

    @cached_property
    def closest(self) -> float:
        """The least film that is known, m."""
        if self.mixed is not None:
            return self.mixed.closest
        thickness = self.scene.geometry.film_shape().thickness(*np.meshgrid(self.grid.x, self.grid.y, indexing="ij"))
        return self.reach + max(0.0, self.scene.geometry.film - float(thickness.min()))

    @property
    def touching(self) -> float:
        """Where a search begins, m."""
        return self.scene.geometry.film if self.mixed is None else self.mixed.touching

    @property
    def widest(self) -> float:
        """The thickest film that the geometry allows, m."""
        return widest_film(self.scene)

    def contact_load(self, film: float) -> float:
        """What asperities alone carry at a least film, N."""
        return 0.0 if self.mixed is None else self.mixed.contact_load(film)

    def at(self, film: float, speed: float, start: State | None = None) -> Carrying:
        """Solve the film of a least thickness, m, at a speed, m/s, from the state of another if there is one."""
        motion = self.scene.motion.model_copy(update={"speed": speed})
        scene = self.scene.model_copy(update={"geometry": self.scene.geometry.at_film(film), "motion": motion})
        taken = replace(self.taken, scene=scene)
        problem, cells = taken.problem(self.reach), (self.cells, self.cells)
        found = solve(problem, cells, start=start, tolerance=RESIDUAL, ruptures=taken.ruptures)
        force = found.grid.areas * (found.state.pressure + scene.lubricant.cavitation_pressure)
        if self.mixed is not None:
            force = force + touching(found.problem.shape, found.grid, self.mixed.asperities).force
        x = -found.grid.x if found.turned else found.grid.x
        return Carrying(taken=taken, solution=found, load=carried(scene, x, force))


def under_load(taken: Composition, pressure: float, cells: int, progress: Progress = silent) -> Composed:
    """The film at which a composition carries a load over its nominal area, Pa, and what it does there.

    Solved on three grids, to say how far off it is; what flow factors and contact pressures are off by moves the film
    by that part of the load over how fast the load falls with the film.

    Raises
    ------
    InputError
        If it cannot carry the load in any film, or carries more however thick the film is.
    ConvergenceError
        If a film does not come into balance, or the load does not.
    """
    if not 0 < pressure < float("inf"):
        raise InputError(f"pressure: got {pressure!r} Pa; it must be above 0 and finite")
    load_loops(taken.scene.wide)
    cpu, guess, speed = time.process_time(), taken.scene.geometry.film, taken.scene.motion.speed
    found: list[Carrying] = []
    sizes = [size for size in (cells // 4, cells // 2, cells) if size >= COARSEST_CELLS or size == cells]
    for count, size in enumerate(sizes):
        progress(count / len(sizes), f"{size} cells along a side")
        film = ComposedFilm(taken=taken, cells=size)
        found.append(balanced(Speed(film=film, speed=speed), pressure, tolerance=TOLERANCE, guess=guess))
        guess = found[-1].taken.scene.geometry.film
    here = found[-1]
    thicker = film.at((1 + STEP) * guess, speed, here.solution.state)
    told = here.taken.reading.quantities(here.taken.scene, here.solution)
    return Composed(
        levels=tuple(one.values for one in reversed(found)),
        units={name: quantity.unit for name, quantity in told.items()} | {"film": "m"},
        doubt=_doubt(here, thicker),
        residual=here.solution.residual,
        balance=abs(here.load / (pressure * film.area) - 1),
        cells=cells,
        cpu_s=time.process_time() - cpu,
    )


def _doubt(here: Carrying, thicker: Carrying) -> dict[str, float]:
    """By how much values may be off under a load, as what is averaged is off.

    What makes the walls carry more in one film lets them part until the load is the same again: a value is off by what
    it is off in that film, taken with its sign, and by what it changes with the film.
    """
    if here.solution.problem.shape.roughness is None:
        return {}
    scene, values, others = here.taken.scene, here.values, thicker.values
    quantities = here.taken.reading.quantities(scene, here.solution)
    own = here.taken.reading.doubt(scene, here.solution, quantities)
    step = STEP * values["film"]
    slope = (values["load_per_width"] - others["load_per_width"]) / step
    moved = own["load_per_width"] / slope if slope > 0 else float("inf")
    doubts = {
        name: abs(math.copysign(own[name], values[name]) + (others[name] - values[name]) / step * moved)
        for name in own
        if name in others and name not in LOADS
    }
    for ratio, name in SHARES.items():
        if ratio in values and name in doubts:
            doubts[ratio] = doubts[name] / values["load_per_width"]
    return doubts | {"film": moved}
