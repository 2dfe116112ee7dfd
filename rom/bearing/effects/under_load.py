"""Variants of a bearing under a load: the film thickness at which they carry it."""

import math
import time
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.effects.ablation import Variant, VariantSolution
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, balanced
from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.film import MixedFilm, widest_film
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.quantities import load_of, nominal_area, scene_positions
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import load_loops
from roughfilm.rom.bearing.uncertainty import cells_of
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Solution, coarsening, solve
from roughfilm.rom.ladder.model import Progress, silent

MAX_THINNING = 30.0
"""Film thickness of the scene over the thinnest film that is tried, without asperities."""

MIN_FILM_OVER_AMPLITUDE = 1.001
"""Smallest mean gap over the amplitude of sinusoidal ridges."""

LOAD_TOLERANCE = 1e-7
"""Relative error of the load at which the search stops."""

FILM_RESIDUAL = 1e-11
"""Residual at which a film solve stops."""

GRIDS = 4
"""Largest number of grids, the coarser ones for the uncertainty."""

MIN_GRID_CELLS = 16
"""Smallest number of cells along a side of a coarser grid."""

PRESCRIBED = ("load", "load_per_width")
"""Quantities that the load prescribes."""

LOAD_RATIOS = {"friction_coefficient": "friction_per_width", "contact_share": "contact_load_per_width"}
"""Quantities over the load, by the quantity in their numerator."""

FILM_STEP = 1e-3
"""Relative change of the film thickness over which derivatives are variant."""


@dataclass(frozen=True, kw_only=True)
class VariantState:
    """The converged film of a variant and its load, N (N/m if infinitely wide)."""

    variant: Variant
    solution: Solution
    load: float

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities, with the film thickness as ``film``."""
        scene = self.variant.scene
        film = Quantity(value=scene.geometry.film, unit="m")
        return self.variant.outputs.quantities(scene, self.solution) | {"film": film}

    @property
    def values(self) -> dict[str, float]:
        """The values of the quantities in SI units."""
        return {name: quantity.value for name, quantity in self.quantities.items()}


@dataclass(frozen=True, kw_only=True)
class VariantFilm:
    """A variant on a grid of ``cells`` along and across, at any film thickness and speed."""

    variant: Variant
    cells: int

    @property
    def scene(self) -> Bearing:
        """The scene of the variant; its film thickness and speed have no effect."""
        return self.variant.scene

    @cached_property
    def grid(self) -> Grid:
        """The grid, the same for all films."""
        return grid(self.scene.geometry.film_shape(), (self.cells, self.cells))

    @cached_property
    def mixed(self) -> MixedFilm | None:
        """The mixed film, which has the contact load of the asperities; None without asperities."""
        if self.scene.asperities is None:
            return None
        return MixedFilm(scene=self.scene, asperities=asperities_of(self.scene), cells=self.cells)

    @cached_property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return nominal_area(self.scene, self.grid)

    @cached_property
    def min_gap(self) -> float:
        """The smallest mean gap with known flow factors, m."""
        thinnest, roughness = self.scene.geometry.film / MAX_THINNING, self.scene.roughness
        if not self.variant.rough or roughness is None:
            return thinnest
        if isinstance(roughness, Sinusoid):
            return MIN_FILM_OVER_AMPLITUDE * roughness.amplitude
        return max(thinnest, roughness.factors(thinnest).narrowest)

    @cached_property
    def closest(self) -> float:
        """The smallest film thickness that can be solved, m."""
        if self.mixed is not None:
            return self.mixed.closest
        thickness = self.scene.geometry.film_shape().thickness(*np.meshgrid(self.grid.x, self.grid.y, indexing="ij"))
        return self.min_gap + max(0.0, self.scene.geometry.film - float(thickness.min()))

    @property
    def touching(self) -> float:
        """The film thickness at which a search begins, m."""
        return self.scene.geometry.film if self.mixed is None else self.mixed.touching

    @property
    def widest(self) -> float:
        """The largest film thickness of the geometry, m."""
        return widest_film(self.scene)

    def contact_load(self, film: float) -> float:
        """The load of the asperities at a film thickness, N."""
        return 0.0 if self.mixed is None else self.mixed.contact_load(film)

    def at(self, film: float, speed: float, start: State | None = None) -> VariantState:
        """Solve the film at a minimum thickness, m, and a speed, m/s, starting from the state of another film."""
        motion = self.scene.motion.model_copy(update={"speed": speed})
        scene = self.scene.model_copy(update={"geometry": self.scene.geometry.at_film(film), "motion": motion})
        variant = replace(self.variant, scene=scene)
        problem, cells = variant.problem(self.min_gap), (self.cells, self.cells)
        solution = solve(problem, cells, start=start, tolerance=FILM_RESIDUAL, ruptures=variant.ruptures)
        force = solution.grid.areas * (solution.state.pressure + scene.lubricant.cavitation_pressure)
        if self.mixed is not None:
            force = force + asperity_load(solution.problem.shape, solution.grid, self.mixed.asperities).force
        load = load_of(scene, scene_positions(solution), force)
        return VariantState(variant=variant, solution=solution, load=load)


def under_load(variant: Variant, pressure: float, cells: int, progress: Progress = silent) -> VariantSolution:
    """Solve for the film thickness at which a variant carries a load, on successively finer grids.

    Parameters
    ----------
    pressure : the load over the nominal area, Pa.
    cells : number of cells along a side of the finest grid.

    Raises
    ------
    InputError
        If no film thickness gives the load.
    ConvergenceError
        If a film or the load does not converge.
    """
    if not 0 < pressure < float("inf"):
        raise InputError(f"pressure: got {pressure!r} Pa; it must be above 0 and finite")
    load_loops(variant.scene.wide)
    cpu, guess, speed = time.process_time(), variant.scene.geometry.film, variant.scene.motion.speed
    states: list[VariantState] = []
    grids = [size for size, _ in coarsening((cells, cells), wide=True)][-GRIDS:]
    sizes = [size for size in grids if size >= MIN_GRID_CELLS or size == cells]
    for count, size in enumerate(sizes):
        progress(count / len(sizes), f"{size} cells along a side")
        film = VariantFilm(variant=variant, cells=size)
        films = FilmsAtSpeed(film=film, speed=speed)
        states.append(balanced(films, pressure, tolerance=LOAD_TOLERANCE, guess=guess))
        guess = states[-1].variant.scene.geometry.film
    here = states[-1]
    thicker = film.at((1 + FILM_STEP) * guess, speed, here.solution.state)
    return VariantSolution(
        levels=tuple(state.values for state in reversed(states)),
        cells=tuple(cells_of(state.solution) for state in reversed(states)),
        units={name: quantity.unit for name, quantity in here.quantities.items()},
        factor_uncertainties=_factor_uncertainties(here, thicker),
        residual=here.solution.residual,
        imbalance=here.solution.imbalance,
        unknown=infinite_flows(here.solution),
        balance=abs(here.load / (pressure * film.area) - 1),
        cpu_s=time.process_time() - cpu,
    )


def _factor_uncertainties(here: VariantState, thicker: VariantState) -> dict[str, float]:
    """The uncertainties under a load that come from flow factors and contact pressures.

    An error δW of the load at constant film thickness changes the film thickness by δW/(-dW/dh). The uncertainty of a
    quantity is its own one at constant film thickness, with its sign, plus its change with the film thickness.
    """
    if here.solution.problem.shape.roughness is None:
        return {}
    values, others, variant = here.values, thicker.values, here.variant
    own = variant.outputs.factor_uncertainties(variant.scene, here.solution, here.quantities)
    step = FILM_STEP * values["film"]
    slope = (values["load_per_width"] - others["load_per_width"]) / step
    of_film = own["load_per_width"] / slope if slope > 0 else float("inf")
    uncertainties = {
        name: abs(math.copysign(own[name], values[name]) + (others[name] - values[name]) / step * of_film)
        for name in own
        if name in others and name not in PRESCRIBED
    }
    for ratio, name in LOAD_RATIOS.items():
        if ratio in values and name in uncertainties:
            uncertainties[ratio] = uncertainties[name] / values["load_per_width"]
    return uncertainties | {"film": of_film}
