"""One bearing, several effects: the same scene without some of them, and what each of them adds."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.film import averaged_film
from roughfilm.rom.bearing.mixed.film import Seeping, mixed_problem
from roughfilm.rom.bearing.mixed.reading import mixed_doubt, mixed_quantities
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.model import Reading
from roughfilm.rom.bearing.numbers import without_texture
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import load_loops, odd, unresolved
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.homogenization.gap_factors import GapFactors
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.lubricants.compressibility import Incompressible
from roughfilm.rom.lubricants.viscosity import ConstantViscosity


@dataclass(frozen=True, kw_only=True)
class Composition:
    """A bearing as it is taken: its scene, and what of it counts.

    Attributes
    ----------
    scene : whose film is the one that is solved.
    sides : whether anything flows through its sides.
    ruptures : whether the film does; else it bears any tension, and the inlet is full.
    factors : whether roughness changes the flow; asperities touch all the same.
    """

    scene: Bearing
    sides: bool = True
    ruptures: bool = True
    factors: bool = True

    @property
    def rough(self) -> bool:
        """Whether the flow is averaged over a roughness."""
        return self.scene.roughness is not None and self.factors

    def problem(self, reach: float | None = None) -> Problem:
        """The film to be solved; flow factors are those of mean gaps down to ``reach``, m, by default of this film.

        Raises InputError where flow factors are not known, or seal this film.
        """
        scene = self.scene
        if scene.asperities is not None:
            problem = mixed_problem(scene, asperities_of(scene))
            if not self.factors:
                smooth = SmoothFlow(mean_gap=asperities_of(scene).mean_gap)
                problem = replace(problem, shape=replace(problem.shape, roughness=smooth))
        else:
            problem = averaged_film(scene) if self.rough and reach is None else scene.problem()
            if reach is not None and self.rough and scene.roughness is not None:
                known = Seeping(scene.roughness.factors(reach))
                problem = replace(problem, shape=replace(problem.shape, roughness=known))
        return problem if self.sides else replace(problem, ends=replace(problem.ends, sides=None))

    @property
    def reading(self) -> Reading:
        """What is read off its film."""
        if self.scene.asperities is not None:
            return Reading(quantities=mixed_quantities, doubt=mixed_doubt)
        return Reading(quantities=bearing_quantities)


@dataclass(frozen=True, kw_only=True)
class SmoothFlow:
    """Flow as between smooth walls as far apart as the mean gap of rough ones, m, over their separation, m."""

    mean_gap: Callable[[Array], Array]

    def __call__(self, separation: Array, /) -> GapFactors:
        """Those of a smooth film, each of the shape of ``separation``."""
        h = self.mean_gap(separation)
        none, inverse = np.zeros_like(h), 1 / h
        return GapFactors(
            along=h**3,
            across=h**3,
            cross=none,
            drag=h,
            drag_across=none,
            couette=inverse,
            shear_couette=none,
            streaming=inverse,
            least=h,
        )


@dataclass(frozen=True, kw_only=True)
class SceneEffect:
    """One effect of a bearing: whether a scene has it, and how the scene is taken without it."""

    name: str
    present: Callable[[Bearing], bool]
    without: Callable[[Composition], Composition]


def _has_texture(scene: Bearing) -> bool:
    return without_texture(scene) is not scene


def _flows_aside(scene: Bearing) -> bool:
    return not scene.wide and not (isinstance(scene.geometry, Ring) and scene.geometry.endless)


def _feels_pressure(scene: Bearing) -> bool:
    lubricant = scene.lubricant
    return not isinstance(lubricant.compressibility, Incompressible) or not isinstance(
        lubricant.piezoviscosity, ConstantViscosity
    )


def _unchanging(scene: Bearing) -> Bearing:
    laws = {"compressibility": Incompressible(), "piezoviscosity": ConstantViscosity()}
    return scene.model_copy(update={"lubricant": scene.lubricant.model_copy(update=laws)})


EFFECTS: tuple[SceneEffect, ...] = (
    SceneEffect(name="side flow", present=_flows_aside, without=lambda one: replace(one, sides=False)),
    SceneEffect(
        name="texture", present=_has_texture, without=lambda one: replace(one, scene=without_texture(one.scene))
    ),
    SceneEffect(
        name="cavitation",
        present=lambda scene: scene.motion.speed != 0,
        without=lambda one: replace(one, ruptures=False),
    ),
    SceneEffect(
        name="pressure dependence",
        present=_feels_pressure,
        without=lambda one: replace(one, scene=_unchanging(one.scene)),
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
)
"""In the order in which they are switched on. Without roughness asperities touch all the same, but no flow feels them;
without asperities the flow factors are those of the roughness undeformed, cut off where it would touch."""


def effects_of(scene: Bearing) -> tuple[SceneEffect, ...]:
    """The effects that a scene has, in the order in which they are switched on."""
    return tuple(part for part in EFFECTS if part.present(scene))


def without(scene: Bearing, parts: Sequence[SceneEffect]) -> Composition:
    """The scene without some of its effects."""
    taken = Composition(scene=scene)
    for part in parts:
        taken = part.without(taken)
    return taken


def steps(scene: Bearing) -> tuple[Composition, ...]:
    """The scene with none of its effects, then with one after the other switched on; the last is all of it."""
    parts = effects_of(scene)
    return tuple(without(scene, parts[count:]) for count in range(len(parts) + 1))


def ablations(scene: Bearing) -> tuple[Composition, ...]:
    """The whole scene without each of its effects alone."""
    return tuple(without(scene, [part]) for part in effects_of(scene))


@dataclass(frozen=True, kw_only=True)
class Composed:
    """What a composition carries, rubs and lets through.

    Attributes
    ----------
    levels : values by name, in the units of ``units``: on the grid asked for, and on those half and a quarter as fine.
    doubt : by how much values may be off as flow factors and contact pressures are, in their units.
    residual : of the film; ``balance``: what the load misses that was asked for, relative to it.
    cells, cpu_s : along a side; s.
    warnings : sentences.
    """

    levels: tuple[Mapping[str, float], ...]
    units: Mapping[str, str]
    doubt: Mapping[str, float]
    residual: float
    cells: int
    cpu_s: float
    balance: float = 0.0
    warnings: tuple[str, ...] = ()

    @property
    def values(self) -> Mapping[str, float]:
        """On the grid asked for."""
        return self.levels[0]


@dataclass(frozen=True, kw_only=True)
class Amount:
    """A number and how far off it may be, both in one unit."""

    value: float
    uncertainty: float
    unit: str


def at_film(taken: Composition, cells: int, progress: Progress = silent) -> Composed:
    """Solve a composition at the film of its scene.

    Raises
    ------
    InputError
        Where roughness or contact are not known for so thin a film.
    ConvergenceError
        If the film does not come into balance.
    """
    problem, reading, scene = taken.problem(), taken.reading, taken.scene
    load_loops(problem.shape.wide)
    cpu = time.process_time()
    found = balance(problem, (cells, cells), ruptures=taken.ruptures, progress=progress)
    quantities = reading.quantities(scene, found)
    rough = problem.shape.roughness is not None
    return Composed(
        levels=tuple({n: q.value for n, q in reading.quantities(scene, one).items()} for one in solved_grids(found)),
        units={name: quantity.unit for name, quantity in quantities.items()},
        doubt=reading.doubt(scene, found, quantities) if rough else {},
        residual=found.residual,
        cells=cells,
        cpu_s=time.process_time() - cpu,
        warnings=(*unresolved(found), *odd(scene, found)),
    )


def solved_grids(found: Solution) -> tuple[Solution, ...]:
    """A solution and those on grids about half and a quarter as fine, as far as there are any."""
    grids = [found]
    while (coarser := grids[-1].coarser) is not None and coarser.grid.x.size <= 0.75 * grids[-1].grid.x.size:
        grids.append(coarser)
    return tuple(grids)


def amount(one: Composed, name: str) -> Amount | None:
    """One value and its error; None where there is none."""
    return _told(one.units, name, [level.get(name) for level in one.levels], one.doubt.get(name, 0.0), (one,))


def added(more: Composed, less: Composed, name: str) -> Amount | None:
    """What one composition has more than another, and the error of that; None where either does not tell it.

    Grids err alike, and so do flow factors: the error is that of the difference, by the rule for any quantity.
    """
    pairs = zip(more.levels, less.levels, strict=False)
    differences = [a[name] - b[name] if name in a and name in b else None for a, b in pairs]
    doubt = abs(more.doubt.get(name, 0.0) - less.doubt.get(name, 0.0))
    return _told(more.units, name, differences, doubt, (more, less))


def _told(
    units: Mapping[str, str], name: str, levels: Sequence[float | None], doubt: float, of: Sequence[Composed]
) -> Amount | None:
    """The first level, with the larger of the last step of the grids and a quarter of the one before."""
    known = [level for level in levels if level is not None]
    if not known or levels[0] is None:
        return None
    changes = [abs(fine - coarse) / 4**count for count, (fine, coarse) in enumerate(pairwise(known))]
    left = sum(abs(one.values[name]) * (one.residual * one.cells + one.balance) for one in of)
    return Amount(value=known[0], uncertainty=max(changes, default=float("inf")) + doubt + left, unit=units[name])
