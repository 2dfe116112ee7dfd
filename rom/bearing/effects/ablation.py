"""Variants of a bearing without some of its physical effects, and the differences between variants."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.film import FlooredFlowFactors, averaged_film
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.bearing.mixed.quantities import MIXED_OUTPUTS
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.numbers import without_texture
from roughfilm.rom.bearing.outside import film_outside
from roughfilm.rom.bearing.quantities import FILM_OUTPUTS, Outputs
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shear_thinning import thinning
from roughfilm.rom.bearing.thermal.heat_balance import Heated
from roughfilm.rom.bearing.warnings import scene_warnings
from roughfilm.rom.cavitation.evaluation.flows import IMBALANCE_FACTOR
from roughfilm.rom.cavitation.evaluation.grids import cells_of, grid_sequence, grid_uncertainty, grid_warnings
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.homogenization.gap_factors import GapFactors
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.viscosity import ConstantViscosity


@dataclass(frozen=True, kw_only=True)
class Variant:
    """A bearing with or without some of its effects.

    Attributes
    ----------
    scene : the scene, with the film thickness that is solved.
    sides : whether there is flow through the sides.
    ruptures : whether the film cavitates; without cavitation pressures may be negative, and the inlet is full.
    factors : whether roughness changes the flow; the contact of asperities does not depend on it.
    heat : the temperature of the film and what its heat brings about; None where the scene gives the viscosity.
    """

    scene: Bearing
    sides: bool = True
    ruptures: bool = True
    factors: bool = True
    heat: Heated | None = None

    @property
    def rough(self) -> bool:
        """Whether the flow is averaged over a roughness."""
        return self.scene.roughness is not None and self.factors

    def problem(self, min_gap: float | None = None) -> Problem:
        """The problem of the film.

        Parameters
        ----------
        min_gap : smallest mean gap for which flow factors are made, m; by default that of this film.

        Raises
        ------
        InputError
            If the flow factors are unknown, or seal this film.
        """
        scene = self.scene
        if scene.asperities is not None:
            problem = mixed_problem(scene, asperities_of(scene))
            if not self.factors:
                smooth = SmoothFlow(mean_gap=asperities_of(scene).mean_gap)
                problem = replace(problem, shape=replace(problem.shape, roughness=smooth))
        else:
            problem = averaged_film(scene) if self.rough and min_gap is None else scene.problem()
            if min_gap is not None and self.rough and scene.roughness is not None:
                factors = FlooredFlowFactors(scene.roughness.factors(min_gap))
                problem = replace(problem, shape=replace(problem.shape, roughness=factors))
        return problem if self.sides else replace(problem, ends=replace(problem.ends, sides=None))

    @property
    def outputs(self) -> Outputs:
        """The functions that evaluate its film."""
        if self.heat is not None:
            return self.heat.outputs
        return FILM_OUTPUTS if self.scene.asperities is None else MIXED_OUTPUTS


@dataclass(frozen=True, kw_only=True)
class SmoothFlow:
    """The flow factors of smooth walls at the mean gap of rough walls, over the separation of the rough walls, m."""

    mean_gap: Callable[[Array], Array]

    def __call__(self, separation: Array, /) -> GapFactors:
        """The flow factors, each of the shape of ``separation``."""
        h = self.mean_gap(separation)
        zero, inverse = np.zeros_like(h), 1 / h
        return GapFactors(
            along=h**3,
            across=h**3,
            cross=zero,
            drag=h,
            drag_across=zero,
            couette=inverse,
            shear_couette=zero,
            streaming=inverse,
            least=h,
        )


@dataclass(frozen=True, kw_only=True)
class SceneEffect:
    """An effect of a bearing.

    Attributes
    ----------
    name : name of the effect.
    present : present(scene), whether the scene has the effect.
    without : without(variant), the variant without the effect.
    kept : kept(scene), why an effect of the scene is not switched off, although it has it; "" if it is, or if the scene
        does not have the effect.
    """

    name: str
    present: Callable[[Bearing], bool]
    without: Callable[[Variant], Variant]
    kept: Callable[[Bearing], str] = lambda _scene: ""


def _has_texture(scene: Bearing) -> bool:
    return without_texture(scene) is not scene


def _side_flow_kept(scene: Bearing) -> str:
    """Why the sides of a film stay open: without them nothing determines its pressure, or nothing leaves it."""
    if scene.wide:
        return ""
    geometry = scene.geometry
    if scene.supply:
        return "what is supplied inside of the film leaves through its sides"
    joined = (isinstance(geometry, Ring) and geometry.endless) or (isinstance(geometry, Lobes) and geometry.joined)
    return "lubricant enters and leaves the film through its sides alone" if joined else ""


def _has_side_flow(scene: Bearing) -> bool:
    return not scene.wide and not _side_flow_kept(scene)


def _depends_on_pressure(scene: Bearing) -> bool:
    lubricant = scene.lubricant
    return not isinstance(lubricant.compressibility, Incompressible) or not isinstance(
        lubricant.piezoviscosity, ConstantViscosity
    )


def _independent_of_pressure(scene: Bearing) -> Bearing:
    laws = {"compressibility": Incompressible(), "piezoviscosity": ConstantViscosity()}
    return scene.model_copy(update={"lubricant": scene.lubricant.model_copy(update=laws)})


def _newtonian(scene: Bearing) -> Bearing:
    return scene.model_copy(update={"lubricant": scene.lubricant.model_copy(update={"shear_thinning": None})})


def _heats(scene: Bearing) -> bool:
    return not scene.lubricant.lacking


EFFECTS: tuple[SceneEffect, ...] = (
    SceneEffect(
        name="side flow",
        present=_has_side_flow,
        without=lambda one: replace(one, sides=False),
        kept=_side_flow_kept,
    ),
    SceneEffect(
        name="texture", present=_has_texture, without=lambda one: replace(one, scene=without_texture(one.scene))
    ),
    SceneEffect(
        name="cavitation",
        present=lambda scene: scene.motion.speed != 0 or scene.motion.approach != 0,
        without=lambda one: replace(one, ruptures=False),
    ),
    SceneEffect(
        name="pressure dependence",
        present=_depends_on_pressure,
        without=lambda one: replace(one, scene=_independent_of_pressure(one.scene)),
    ),
    SceneEffect(
        name="roughness",
        present=lambda scene: scene.roughness is not None,
        without=lambda one: replace(one, factors=False),
    ),
    SceneEffect(
        name="asperities",
        present=lambda scene: scene.asperities is not None,
        without=lambda one: replace(one, scene=one.scene.model_copy(update={"asperities": None})),
    ),
    SceneEffect(
        name="shear thinning",
        present=lambda scene: scene.lubricant.shear_thinning is not None,
        without=lambda one: replace(one, scene=_newtonian(one.scene)),
    ),
    SceneEffect(
        name="heating",
        present=_heats,
        without=lambda one: replace(one, scene=one.scene.isothermal()),
        kept=lambda scene: "".join(scene.lubricant.left_out_heat),
    ),
)
"""All effects in the order in which they are switched on.

Without roughness asperities touch but do not change the flow. Without asperities the flow factors are those of the
undeformed roughness, truncated where the walls overlap. Without
shear thinning the viscosity is that at rest. Without heating the film has the temperature of its supply,
with it the one at which its heat is balanced (:mod:`roughfilm.rom.bearing.effects.heated`).
"""


def effects_of(scene: Bearing) -> tuple[SceneEffect, ...]:
    """The effects that a scene has, in the order in which they are switched on."""
    return tuple(effect for effect in EFFECTS if effect.present(scene))


def without(scene: Bearing, effects: Sequence[SceneEffect]) -> Variant:
    """The variant of a scene without some of its effects."""
    variant = Variant(scene=scene)
    for effect in effects:
        variant = effect.without(variant)
    return variant


def steps(scene: Bearing) -> tuple[Variant, ...]:
    """The variants with the first 0, 1, 2, ... effects of a scene, the last one with all of them."""
    effects = effects_of(scene)
    return tuple(without(scene, effects[count:]) for count in range(len(effects) + 1))


def ablations(scene: Bearing) -> tuple[Variant, ...]:
    """The variants without one effect each."""
    return tuple(without(scene, [effect]) for effect in effects_of(scene))


@dataclass(frozen=True, kw_only=True)
class VariantSolution:
    """The quantities of a variant.

    Attributes
    ----------
    scene : the scene at its film on the finest grid.
    levels : values by name on the finest grid and on coarser ones, in the units of ``units``.
    cells : numbers of cells along a side of these grids.
    factor_uncertainties : uncertainties from flow factors and contact pressures, in the same units.
    residual : residual of the film.
    imbalance : relative error of the flow along the film.
    unknown : quantities without an uncertainty.
    cpu_s : CPU time, s.
    balance : relative error of the load.
    warnings : sentences.
    outside : the ways in which the film is outside the range of the model.
    """

    scene: Bearing
    levels: tuple[Mapping[str, float], ...]
    cells: tuple[float, ...]
    units: Mapping[str, str]
    factor_uncertainties: Mapping[str, float]
    residual: float
    imbalance: float
    cpu_s: float
    balance: float = 0.0
    unknown: frozenset[str] = frozenset()
    warnings: tuple[str, ...] = ()
    outside: tuple[str, ...] = ()

    @property
    def values(self) -> Mapping[str, float]:
        """The values on the finest grid."""
        return self.levels[0]


@dataclass(frozen=True, kw_only=True)
class Amount:
    """A value with its uncertainty, which is infinite if unknown, both in ``unit``."""

    value: float
    uncertainty: float
    unit: str


@imports_apart()
def at_film(variant: Variant, cells: int, progress: Progress = silent) -> VariantSolution:
    """Solve a variant at the film thickness of its scene.

    Raises
    ------
    InputError
        If flow factors or contact pressures are unknown for so thin a film.
    ConvergenceError
        If the film does not converge.
    """
    problem, outputs, scene = variant.problem(), variant.outputs, variant.scene
    cpu = working_time()
    thinned = thinning(scene)
    solution = balance(
        problem,
        (cells, cells),
        ruptures=variant.ruptures,
        heated=None if thinned is None else thinned.film(tolerance=RESIDUAL_TOLERANCE, ruptures=variant.ruptures),
        progress=progress,
    )
    quantities = outputs.quantities(scene, solution)
    rough, grids = problem.shape.roughness is not None, grid_sequence(solution)
    return VariantSolution(
        scene=scene,
        levels=tuple({n: q.value for n, q in outputs.quantities(scene, one).items()} for one in grids),
        cells=tuple(cells_of(one) for one in grids),
        units={name: quantity.unit for name, quantity in quantities.items()},
        factor_uncertainties=outputs.factor_uncertainties(scene, solution, quantities) if rough else {},
        residual=solution.residual,
        imbalance=solution.imbalance,
        unknown=infinite_flows(solution),
        cpu_s=working_time() - cpu,
        warnings=(*grid_warnings(solution), *scene_warnings(scene, solution)),
        outside=film_outside(scene, solution),
    )


def amount(one: VariantSolution, name: str) -> Amount | None:
    """A quantity with its uncertainty; None if the variant does not have it."""
    levels = [level.get(name) for level in one.levels]
    return _amount(one.units, name, levels, one.factor_uncertainties.get(name, 0.0), (one,))


def difference(more: VariantSolution, less: VariantSolution, name: str) -> Amount | None:
    """The difference of two variants in a quantity with its uncertainty; None if one of them does not have it.

    Errors of grids and flow factors are correlated, so that the uncertainty is estimated from the difference itself.
    """
    pairs = zip(more.levels, less.levels, strict=False)
    differences = [a[name] - b[name] if name in a and name in b else None for a, b in pairs]
    of_factors = abs(more.factor_uncertainties.get(name, 0.0) - less.factor_uncertainties.get(name, 0.0))
    return _amount(more.units, name, differences, of_factors, (more, less))


def _amount(
    units: Mapping[str, str],
    name: str,
    levels: Sequence[float | None],
    of_factors: float,
    variants: Sequence[VariantSolution],
) -> Amount | None:
    """The value on the first level, with the uncertainty that follows from the others."""
    pairs = zip(variants[0].cells, levels, strict=False)
    known = {cells: level for cells, level in pairs if level is not None}
    if levels[0] is None:
        return None
    of_grid = grid_uncertainty([*known], [*known.values()]) if len(known) > 1 else math.inf
    if any(name in one.unknown for one in variants):
        of_grid = math.inf
    of_balance = sum(abs(one.values[name]) * (IMBALANCE_FACTOR * one.imbalance + one.balance) for one in variants)
    return Amount(value=levels[0], uncertainty=of_grid + of_factors + of_balance, unit=units[name])
