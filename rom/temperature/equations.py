"""The discretised equation of heat over a film and across it, for one temperature field."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import film_areas
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.basis import Basis
from roughfilm.rom.temperature.blocks import LANES, blocks, exchange, sources, upward_flows
from roughfilm.rom.temperature.power import Carriers
from roughfilm.rom.temperature.profiles import divide, profile
from roughfilm.rom.temperature.sweeps import audit, extremes, reaches
from roughfilm.rom.temperature.walls import WallCondition

NEWTON_STEPS = 20
"""Largest number of steps for the temperature of a heat."""

TEMPERATURE_ACCURACY = 1e-9
"""Step, K, at which they stop."""

RENEWED = 1e-9
"""Flow that each point of a node without any flow takes in and gives off, over the largest flow through a face."""

OVERSHOOT = 1e-3
"""Amount over the range of the heat by which a value at a face may lie outside of those of its nodes."""


@dataclass(frozen=True, kw_only=True)
class Linearised:
    """The temperature T = T₀ + offset + E/(ρc) near a heat E of a volume, J/m³; arrays of shape (nx, ny, N).

    Attributes
    ----------
    temperature, offset : T and offset, K.
    inverse_capacity : 1/(ρc), m³ K/J.
    viscosity, steepness : η, Pa s, and dη/dT.
    """

    temperature: Array
    offset: Array
    inverse_capacity: Array
    viscosity: Array
    steepness: Array

    def near(self, supply: float, heat: Array) -> Array:
        """T at a heat near that of these temperatures, to second order."""
        temperature = self.rise(heat)
        temperature += supply
        return temperature

    def rise(self, heat: Array) -> Array:
        """T - T₀ at such a heat, with the round-off of the rise."""
        rise = heat * self.inverse_capacity
        rise += self.offset
        return rise


def linearised(liquid: Liquid, heat: Array, temperature: Array) -> Linearised:
    """The temperature and the viscosity near a heat, J/m³, from temperatures near it, K, by Newton's method."""
    step = np.empty_like(heat)
    for _ in range(NEWTON_STEPS):
        value, capacity = liquid.heat(temperature)
        np.subtract(heat, value, out=step)
        step /= capacity
        if max(float(step.max()), -float(step.min())) <= TEMPERATURE_ACCURACY:
            break
        temperature = temperature + step
    inverse = 1 / capacity
    viscosity, steepness = (np.ascontiguousarray(values) for values in liquid.viscosity(temperature))
    # E at the rounded T in place of E: T - T₀ at E then has the round-off of a small rise, not that of T itself
    offset = temperature - liquid.temperature
    offset -= np.multiply(value, inverse, out=step)
    return Linearised(
        temperature=temperature,
        offset=offset,
        inverse_capacity=inverse,
        viscosity=viscosity,
        steepness=steepness,
    )


@dataclass(frozen=True, kw_only=True)
class Plane:
    """The nodes of a film as the loops take them.

    Attributes
    ----------
    ratios : lengths of the faces over those of the faces upstream, along and against x and y; 0 where there is none.
        An end node has the temperature of its half cell, so that the distance to the next node is halved.
    periodic : whether i is periodic, and j.
    conduction : A ξ k/h, W/K, shape (nx, ny).
    area : A ξ, the filled area of the control volumes, m² (m if infinitely wide); 0 in gaps between films.
    entering : heat of the lubricant that enters, J/m³, shape (nx, ny).
    """

    ratios: tuple[Array, Array, Array, Array]
    periodic: tuple[bool, bool]
    conduction: Array
    area: Array
    entering: Array


def plane(solution: Solution, liquid: Liquid, filling: Array, entering: float | Array) -> Plane:
    """The nodes of a film for a liquid that enters at a temperature, K, a number or of shape (nx, ny)."""
    grid, net = solution.grid, solution.network
    area = film_areas(solution.problem.shape, grid) * filling
    given = np.broadcast_to(np.asarray(entering, dtype=float), grid.shape)
    return Plane(
        ratios=(
            *_ratios(grid.spacing_x, periodic=net.periodic[0]),
            *_ratios(grid.spacing_y, periodic=net.periodic[1]),
        ),
        periodic=net.periodic,
        conduction=area * liquid.conductivity / solution.faces.thickness,
        area=area,
        entering=np.array(np.broadcast_to(liquid.heat(given)[0], grid.shape)),
    )


def _ratios(spacing: Array, *, periodic: bool) -> tuple[Array, Array]:
    """Lengths of the faces over those before and behind them."""
    if periodic:
        return spacing / np.roll(spacing, 1), spacing / np.roll(spacing, -1)
    faces = spacing[:-1]
    if faces.size < 2:
        return np.zeros_like(spacing), np.zeros_like(spacing)
    before, behind = faces[:-1].copy(), faces[1:].copy()
    before[0], behind[-1] = before[0] / 2, behind[-1] / 2
    return np.concatenate([[0.0], faces[1:] / before, [0.0]]), np.concatenate([faces[:-1] / behind, [0.0, 0.0]])


@dataclass(frozen=True, kw_only=True)
class Equations:
    """The equations of all points: flows, m³/s, sources, W, and the inverted equations of the nodes.

    Attributes
    ----------
    along, beside : flows of the points through the faces towards i + 1 and j + 1.
    backward : whether lubricant flows backward through a face of i towards i + 1, shape (nx,).
    entering, leaving : flows of the points from and to the outside.
    stored : what leaves the nodes without an unknown flow, at the temperature of each point, shape (nx, ny).
    upward : flow towards the fixed wall through the surfaces of the points, times their weights.
    reach : factors of the change upstream of the faces towards i + 1 and j + 1 in the values at the faces.
    source : heat that enters from outside, and the part of the dissipation without its change by T - T₀.
    heating : dissipation at the temperatures at which the viscosities are.
    softening : derivative of the logarithm of the dissipation of a node by the temperatures of its points, 1/K.
    solved : the arrays of :func:`roughfilm.rom.temperature.blocks.blocks` from ``inverse`` on.
    """

    along: Array
    beside: Array
    backward: NDArray[np.bool_]
    entering: Array
    leaving: Array
    stored: Array
    upward: Array
    reach: tuple[Array, Array]
    source: Array
    heating: Array
    softening: Array
    solved: tuple[Array, ...]


def equations(
    solution: Solution,
    supply: float,
    moved: Carriers,
    nodes: Plane,
    parts: Basis,
    near: Linearised,
    walls: tuple[WallCondition, WallCondition],
    heat: Array,
    reach: tuple[Array, Array] | None,
    before: Equations | None,
) -> Equations:
    """The equations with the viscosities of the temperatures of ``near``, and a dissipation linear near them.

    ``supply`` is T₀, K.
    The values at the faces have the factors ``reach``, or are limited for a heat, J/m³, where these are None. The
    arrays of the equations ``before``, except for these factors, are written again, which saves time.
    """
    shape, net, size = near.temperature.shape, solution.network, parts.points.size
    shear, stored = np.empty(shape[:2]), np.empty(shape[:2])
    drift, push = np.empty(shape), np.empty(shape)
    if before is None:
        heating, softening, along, beside, entering, leaving, upward = (np.empty(shape) for _ in range(7))
        solved: tuple[Array, ...] = (
            np.empty((*shape, size)),
            *(np.empty(shape) for _ in range(3)),
            *(np.empty(shape[:2]) for _ in range(2)),
        )
    else:
        heating, softening, along, beside = before.heating, before.softening, before.along, before.beside
        entering, leaving, upward, solved = before.entering, before.leaving, before.upward, before.solved
    thickness = solution.faces.thickness
    moving = moved.speed, moved.gradient_x, moved.gradient_y
    across = parts.points, parts.weights, parts.integrals
    profiles = drift, push, heating, softening
    profile(
        near.viscosity, near.steepness, *across, thickness, *moving, *profiles, shear, np.empty(size), np.empty(size)
    )
    backward = np.empty(shape[0], dtype=bool)
    faces = along, beside, backward
    renewed = RENEWED * divide(moved.sliding, moved.pressing, moved.across, drift, push, *nodes.periodic, *faces)
    exchange(along, beside, net.supplied, drift, push, net.fixed, *nodes.periodic, renewed, entering, leaving, stored)
    rising = np.ascontiguousarray((parts.weights[:, None] * parts.integrals / parts.weights).T)
    upward_flows(along, beside, entering, leaving, stored, parts.weights, rising, *nodes.periodic, upward)
    if reach is None:
        reach = np.empty(shape), np.empty(shape)
        least, greatest = extremes(heat)
        reaches(heat, along, beside, *nodes.ratios, *nodes.periodic, OVERSHOOT * (greatest - least), *reach)
    source, power = np.empty(shape), moved.fluid_power * shear
    sources(entering, nodes.entering, power, moved.added, near.temperature, supply, softening, heating, source)
    sliding, fixed = walls
    scratch, right = np.ones((size + 2, size + 2, LANES)), np.ones((size + 2, LANES))
    blocks(
        *(along, beside, leaving, stored, upward, source, heating, softening, nodes.conduction, nodes.area),
        *(near.inverse_capacity, near.offset, sliding.holds, sliding.resistance),
        *(fixed.holds, fixed.resistance, fixed.outside),
        *(bool((wall.resistance == 0).any()) for wall in walls),
        *(parts.weights, parts.slopes, parts.stiffness, parts.ends, *reach, *nodes.periodic),
        *(scratch, scratch.reshape(size + 2, -1), right, np.ones((6, LANES)), np.ones((5, size, LANES)), *solved),
    )
    return Equations(
        along=along,
        beside=beside,
        backward=backward,
        entering=entering,
        leaving=leaving,
        stored=stored,
        upward=upward,
        reach=reach,
        source=source,
        heating=heating,
        softening=softening,
        solved=solved,
    )


def viscosities_across(parts: Basis, viscosity: Array) -> Viscosities:
    """The viscosities of a film from those at its points, Pa s, by the exact integrals of polynomials."""
    fluidity = 1 / viscosity
    zeroth, first = fluidity @ parts.weights, fluidity @ (parts.weights * parts.points)
    second = fluidity @ (parts.weights * parts.points**2) - first**2 / zeroth
    return Viscosities(flow=1 / (12 * second), shear=1 / zeroth, carried=2 * first / zeroth)


@dataclass(frozen=True, kw_only=True)
class Audit:
    """The fluxes into the walls, and sums over a film.

    Attributes
    ----------
    into_sliding, into_fixed : fluxes into the walls, W/m² of filled area, shape (nx, ny).
    residuals : sum of the sizes of the residuals of all equations, W.
    power, entering : the dissipation and the heat that enters, W.
    scale : sum of the sizes of the dissipation, of the heat that enters and of what walls take, W.
    conducted : sum of what the largest rise of each node would conduct across the film, W.
    """

    into_sliding: Array
    into_fixed: Array
    residuals: float
    power: float
    entering: float
    scale: float
    conducted: float


def audited(
    system: Equations,
    nodes: Plane,
    parts: Basis,
    heat: Array,
    rise: Array,
    walls: tuple[WallCondition, WallCondition],
) -> Audit:
    """The fluxes into the walls, the residuals and the sums of a heat and T - T₀, K."""
    (sliding, fixed), into = walls, (np.empty(heat.shape[:2]), np.empty(heat.shape[:2]))
    residuals, power, generated, brought, entering, taken, conducted = audit(
        *(heat, rise, system.along, system.beside, system.leaving, system.stored),
        *(system.upward, system.source, system.heating, system.softening, system.entering, nodes.entering),
        *(nodes.conduction, nodes.area),
        *(sliding.holds, sliding.resistance, sliding.outside, fixed.holds, fixed.resistance, fixed.outside),
        *(parts.points, parts.weights, parts.slopes, parts.stiffness, parts.ends, *system.reach, *nodes.periodic),
        *(np.empty(parts.points.size), *into),
    )
    return Audit(
        into_sliding=into[0],
        into_fixed=into[1],
        residuals=residuals,
        power=power,
        entering=entering,
        scale=generated + brought + taken,
        conducted=conducted,
    )
