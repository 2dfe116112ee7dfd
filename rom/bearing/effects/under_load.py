"""Variants of a bearing under a load: the film thickness at which they carry it."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.effects.ablation import Variant, VariantSolution
from roughfilm.rom.bearing.equilibrium.grids import FILM_RESIDUAL, FILM_STEP, converted
from roughfilm.rom.bearing.equilibrium.grids import under_load as equilibria
from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.outside import film_outside
from roughfilm.rom.bearing.quantities import load_of, nominal_area, scene_positions
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shear_thinning import thinning
from roughfilm.rom.cavitation.evaluation.grids import cells_of
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.ladder.model import Progress, silent

MAX_THINNING = 30.0
"""Film thickness of the scene over the thinnest film that is tried, without asperities."""

MIN_FILM_OVER_AMPLITUDE = 1.001
"""Smallest mean gap over the amplitude of sinusoidal ridges."""


@dataclass(frozen=True, kw_only=True)
class VariantState:
    """The converged film of a variant and its load, N (N/m if infinitely wide)."""

    variant: Variant
    solution: Solution
    load: float

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities, with the film thickness as ``film``."""
        film = Quantity(value=self.scene.geometry.thinnest, unit="m")
        return self.variant.outputs.quantities(self.scene, self.solution) | {"film": film}

    @property
    def scene(self) -> Bearing:
        """The scene with the film thickness."""
        return self.variant.scene

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
    def thinned(self) -> Callable[[Solution], Solution]:
        """thinned(solution), the film with the viscosities of its shear; the film itself of a Newtonian lubricant."""
        coupling = thinning(self.scene)
        if coupling is None:
            return lambda solution: solution
        return coupling.film(tolerance=FILM_RESIDUAL, ruptures=self.variant.ruptures)

    @cached_property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return nominal_area(self.scene, self.grid)

    @cached_property
    def min_gap(self) -> float:
        """The smallest mean gap with known flow factors, m."""
        thinnest, roughness = self.scene.geometry.thinnest / MAX_THINNING, self.scene.roughness
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
        return self.min_gap + max(0.0, self.scene.geometry.thinnest - float(thickness.min()))

    @property
    def touching(self) -> float:
        """The film thickness at which a search begins, m."""
        return self.scene.geometry.thinnest if self.mixed is None else self.mixed.touching

    @property
    def widest(self) -> float:
        """The largest film thickness of the geometry, m."""
        return self.scene.geometry.widest

    def contact_load(self, film: float) -> float:
        """The load of the asperities at a film thickness, N."""
        return 0.0 if self.mixed is None else self.mixed.contact_load(film)

    @property
    def remedy(self) -> str:
        """The remedy for a load that is too large."""
        return "lower the load" if self.mixed is None else self.mixed.remedy

    def at(self, film: float, speed: float, start: State | None = None) -> VariantState:
        """Solve the film at a minimum thickness, m, and a speed, m/s, starting from the state of another film."""
        scene = self.scene.at_speed(speed).at_film(film)
        variant = replace(self.variant, scene=scene)
        problem, cells = variant.problem(self.min_gap), (self.cells, self.cells)
        first = solve(problem, cells, start=start, tolerance=FILM_RESIDUAL, ruptures=variant.ruptures)
        solution = self.thinned(first)
        force = solution.grid.areas * (solution.state.pressure + scene.lubricant.cavitation_pressure)
        if self.mixed is not None:
            force = force + asperity_load(solution.problem.shape, solution.grid, self.mixed.asperities).force
        load = load_of(scene, scene_positions(solution), force)
        return VariantState(variant=variant, solution=solution, load=load)


@imports_apart()
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
    cpu = working_time()
    averaged = variant.scene.asperities is not None or variant.rough
    found = equilibria(
        lambda size: VariantFilm(variant=variant, cells=size),
        pressure,
        cells,
        speed=variant.scene.motion.speed,
        guess=variant.scene.geometry.thinnest,
        sensitive=averaged,
        progress=progress,
    )
    here, of_factors = found.states[0], {}
    if found.thicker is not None:
        state = found.states[found.compared]
        own = state.variant.outputs.factor_uncertainties(state.scene, state.solution, state.quantities)
        step = FILM_STEP * state.scene.geometry.thinnest
        of_factors = converted(own, state.values, found.thicker.values, step)
    return VariantSolution(
        scene=here.scene,
        levels=tuple(state.values for state in found.states),
        cells=tuple(cells_of(state.solution) for state in found.states),
        units={name: quantity.unit for name, quantity in here.quantities.items()},
        factor_uncertainties=of_factors,
        residual=here.solution.residual,
        imbalance=here.solution.imbalance,
        unknown=infinite_flows(here.solution),
        balance=found.balance,
        cpu_s=working_time() - cpu,
        outside=(*film_outside(here.scene, here.solution), *here.variant.outputs.outside(here.scene, here.solution)),
    )
