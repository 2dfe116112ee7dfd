"""The temperature of the lubricant that enters a film: new lubricant and hot lubricant from the film before."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.field.coupling import HOTTEST
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm, Mixture
from roughfilm.rom.bearing.thermal.field.nodal import between_nodes, logarithms
from roughfilm.rom.bearing.thermal.tables import Heat
from roughfilm.rom.cavitation.evaluation.flows import flow_along, node_balances
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.lubricants.thermal.law import celsius
from roughfilm.rom.temperature.dissipation import dissipation, film_flows


class WithViscosities(Protocol):
    """The temperatures of a film by an energy equation."""

    @property
    def viscosities(self) -> Viscosities:
        """The viscosities at these temperatures at the nodes."""
        ...


HeatedT = TypeVar("HeatedT", bound=WithViscosities)

MIXED = 1e-4
"""Error of the temperature of a mixture, K, at which its iteration stops."""

SETTLED = 5e-4
"""The same where film and mixture are found together, K, at which a film settles; about 2e-5 in ln η."""

COARSE_NODES = 2000
"""Largest number of nodes of a grid on which temperatures and mixture of each film are iterated to the end.

On finer grids those of the first film without another one near it are.
"""

LEAST_STEP = 0.01
"""Smallest step of the temperature at the inlet, K, from which the slope of the mixture is taken."""

LEAST_CHANGE = 1e-9
"""Change of a temperature, K, at which it belongs to its heat."""

MAX_MIXTURES = 40
"""Largest number of temperatures of a mixture that are tried."""

FIRST_SLOPE = 0.5
"""Change of the mixture at the inlet with the temperature there, over its share of hot lubricant, at the beginning."""

STEEPEST = 0.98
"""Largest change of a mixture with the temperature at the inlet by which its iteration extrapolates."""

LEAST_KEPT = 1e-5
"""Least part of the hot lubricant that stays in a film behind a groove, over which the round-off of its heat grows."""


@dataclass(frozen=True, kw_only=True)
class Returning:
    """The hot lubricant that leaves a film at its end and enters the next one with new lubricant.

    Attributes
    ----------
    inlet : whether lubricant enters at a node through the inlet, shape (nx, ny).
    leaving : flow that leaves at the nodes of the end, m³/s, shape (nx, ny).
    share : hot lubricant over all that enters through the inlet.
    new : temperature of the new lubricant there, K.
    """

    inlet: NDArray[np.bool_]
    leaving: Array
    share: float
    new: float

    @property
    def first(self) -> Mixture:
        """The mixture from which an iteration starts."""
        return Mixture(temperature=self.new, error=0.0, slope=FIRST_SLOPE * self.share)

    def mixture(self, liquid: Liquid, temperature: Array) -> float:
        """The temperature of the mixture, K, from those of the nodes, shape (nx, ny)."""
        hot = float((self.leaving * liquid.heat(temperature)[0]).sum() / self.leaving.sum())
        cold = float(liquid.heat(np.array([self.new]))[0][0])
        return temperature_of(liquid, self.share * hot + (1 - self.share) * cold)


def temperature_of(liquid: Liquid, heat: float) -> float:
    """The temperature, K, at which a liquid has a heat, J/m³."""
    temperature = np.array([liquid.temperature])
    for _ in range(MAX_MIXTURES):
        value, capacity = liquid.heat(temperature)
        change = (heat - value) / capacity
        temperature = temperature + change
        if abs(change[0]) <= LEAST_CHANGE:
            break
    return float(temperature[0])


def new_lubricant(scene: Bearing, solution: Solution, supplied: float) -> Array:
    """The temperature of new lubricant at the nodes, K, shape (nx, ny), where it enters.

    That of a supply is its own, that at the inlet and in gaps between films that of the inlet, and everywhere else that
    of the supplied lubricant.

    Parameters
    ----------
    supplied : temperature of the supplied lubricant, K.
    """
    grid, shape = solution.grid, solution.problem.shape
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    temperature = np.full(grid.shape, supplied)
    at_inlet = scene.boundary.inlet.temperature
    if at_inlet is not None:
        for nodes in gaps(shape, grid) if shape.joined[0] else [0]:
            temperature[nodes] = at_inlet
    for one, inflow in zip(scene.supply, solution.problem.inflows, strict=True):
        if one.temperature is not None:
            temperature[inflow.covers(x, y)] = one.temperature
    return temperature


def returning(scene: Bearing, solution: Solution, new: Array) -> Returning | None:
    """The hot lubricant that enters a film again; None of a single pad and of films that have no end.

    The next film of a pad of a ring is the next pad, and that of a bore with one inlet is itself. ``carried_over``
    times what leaves at the end enters again, at most all that enters.

    Parameters
    ----------
    new : temperature of new lubricant at the nodes, K, shape (nx, ny).
    """
    if solution.network.periodic[0] or not isinstance(scene.geometry, Ring | Shaft):
        return None
    net = node_balances(solution)
    inlet, end = np.zeros(net.shape, dtype=bool), np.zeros(net.shape, dtype=bool)
    inlet[0], end[-1] = net[0] > 0, net[-1] < 0
    leaving, entering = np.where(end, -net, 0.0), float(net[inlet].sum())
    carried = min((scene.heat or Heat()).carried_over * float(leaving.sum()), entering)
    if carried <= 0:
        return None
    return Returning(inlet=inlet, leaving=leaving, share=carried / entering, new=float(new[0].mean()))


def replaced(scene: Bearing, solution: Solution, liquid: Liquid) -> Array:
    """The heat transfer coefficient, W/(m² K), that stands for hot lubricant which new lubricant replaces in a supply.

    Where lubricant flows from a film into a supply, the part 1 - ``carried_over`` of it is replaced: with its
    flow F and ρ c at the supply, a heat transfer F ρ c (1/carried_over - 1) lowers its temperature above that of the
    new lubricant by the factor ``carried_over``. Shape (nx, ny); 0 where nothing is replaced.
    """
    grid, kept = solution.grid, max((scene.heat or Heat()).carried_over, LEAST_KEPT)
    covered = np.zeros(grid.shape, dtype=bool)
    if kept < 1:
        x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
        for inflow in solution.problem.inflows:
            covered |= inflow.covers(x, y)
    if not covered.any():
        return np.zeros(grid.shape)
    arriving = np.roll(flow_along(solution), 1, axis=0)
    first = covered & ~np.roll(covered, 1, axis=0) & (arriving > 0)
    capacity = float(liquid.heat(np.array([liquid.temperature]))[1][0])
    return np.where(first, arriving * capacity * (1 / kept - 1) / grid.areas, 0.0)


def seen_from_inside(viscosities: Viscosities, solution: Solution) -> Viscosities:
    """The viscosities of a film; where lubricant flows back into its end, those before the end at all nodes of it.

    The direction of the flow through a node of the end depends on the viscosity there where the pressure of the end
    feeds the sides. With the viscosity of what flows through it, films with new and with hot lubricant at the node
    would alternate; that of the node before, where both mix, changes with the flow without a jump.
    """
    if not flows_back(solution):
        return viscosities
    return Viscosities(
        flow=_inside(viscosities.flow), shear=_inside(viscosities.shear), carried=_inside(viscosities.carried)
    )


def flows_back(solution: Solution) -> bool:
    """Whether lubricant flows back into the end of a film."""
    return not solution.network.periodic[0] and bool((node_balances(solution)[-1] > 0).any())


def _inside(values: Array) -> Array:
    """Values at the nodes, shape (nx, ny), with those before the end at the end."""
    return np.concatenate([values[:-1], values[-2:-1]])


def is_seen_from_inside(solution: Solution) -> bool:
    """Whether a film was solved with the viscosities before its end at the nodes of the end."""
    own = solution.problem.at_nodes
    return own is not None and not solution.network.periodic[0] and np.array_equal(own.shear[-1], own.shear[-2])


def power_of_end(solution: Solution, warm: Array) -> Array | None:
    """The power, W, that a film dissipates at its end beyond that with the viscosities of the temperatures there.

    None where the viscosities of the film at the end are those of its temperatures.

    Parameters
    ----------
    warm : viscosities at the temperatures of the nodes, Pa s, shape (nx, ny).
    """
    own = solution.problem.at_nodes
    if own is None or not is_seen_from_inside(solution):
        return None
    power = np.zeros(solution.grid.shape)
    all_nodes = dissipation(solution, film_flows(solution))
    power[-1] = all_nodes[-1] * (1 - warm[-1] / own.shear[-1])
    return power


def mixture_of(near: HeatedFilm | None, solution: Solution) -> Mixture | None:
    """The mixture at the inlet of a film near another one, with its response at the nodes of the latter."""
    known = None if near is None else near.inlet
    if near is None or known is None or known.response is None or known.response.shape[1:] == solution.grid.shape:
        return known
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    found = between_nodes(known.response, near.grid, solution.problem.shape.joined, x.ravel(), y.ravel())
    response = found.reshape(-1, *x.shape)
    return replace(known, response=np.stack([_inside(one) for one in response]) if flows_back(solution) else response)


def with_entering(
    scene: Bearing,
    solution: Solution,
    near: HeatedFilm | None,
    solve: Callable[[Array, HeatedT | None], HeatedT],
    carried: Callable[[HeatedT], Array],
) -> tuple[HeatedT, Mixture | None]:
    """The temperatures of a film with the lubricant that enters it, and the mixture at its inlet.

    Parameters
    ----------
    near : temperatures of a film near this one.
    solve : solve(entering, near), the temperatures of the film for those of the lubricant that enters at the nodes, K,
        shape (nx, ny), from temperatures near them.
    carried : carried(temperatures), the temperatures of the lubricant that leaves at the nodes, K, shape (nx, ny).

    Returns
    -------
    temperatures, mixture
        The temperatures of the film and the mixture, None where no hot lubricant enters again.

    Raises
    ------
    ConvergenceError
        If the temperatures or the mixture do not converge.
    """
    liquid = scene.lubricant.liquid
    new = new_lubricant(scene, solution, liquid.temperature)
    back, known = returning(scene, solution, new), mixture_of(near, solution)
    if back is None:
        return solve(new, None), None
    return at_mixture(
        lambda inlet, last: solve(np.where(back.inlet, inlet, new), last),
        lambda one: back.mixture(liquid, carried(one)),
        back.first if known is None else known,
        viscosities=lambda one: seen_from_inside(one.viscosities, solution),
        once=known is not None and is_fine(near, solution),
    )


def is_fine(near: HeatedFilm | None, solution: Solution) -> bool:
    """Whether the temperatures of a film are not iterated to the end, as another one near it is, and its grid fine."""
    return near is not None and solution.state.pressure.size > COARSE_NODES


def at_mixture(
    solve: Callable[[float, HeatedT | None], HeatedT],
    image: Callable[[HeatedT], float],
    first: Mixture,
    *,
    viscosities: Callable[[HeatedT], Viscosities],
    once: bool,
) -> tuple[HeatedT, Mixture]:
    """The temperatures of a film whose inlet has about the temperature of the mixture that they bring about.

    The heat that leaves grows by less than the heat that enters, since warmer lubricant is thinner, so that the mixture
    contracts by at most its share of hot lubricant and what stays in the film; the iteration extrapolates this slope.
    On a fine grid the temperature at the inlet is an unknown of the iteration of film and temperatures
    (:func:`roughfilm.rom.bearing.thermal.field.coupling.coupled`), with the slope of a coarse grid.

    Parameters
    ----------
    solve : solve(temperature, near), the temperatures of the film, K, for a temperature at the inlet.
    image : image(temperatures), the temperature of their mixture, K.
    first : mixture from which the iteration starts.
    viscosities : viscosities(temperatures), those of the next film.
    once : whether the temperatures for the first temperature at the inlet are enough, whatever its error.

    Returns
    -------
    temperatures, mixture
        The temperatures of the film and the mixture at its inlet.

    Raises
    ------
    ConvergenceError
        If the mixture does not converge.
    """
    inlet, slope, response = first.following, first.slope, first.response
    before: tuple[float, float, HeatedT] | None = None
    near: HeatedT | None = None
    for _ in range(MAX_MIXTURES):
        near = solve(inlet, near)
        rest = image(near) - inlet
        if not once and before is not None and abs(inlet - before[0]) >= LEAST_STEP:
            slope = min(max(1 + (rest - before[1]) / (inlet - before[0]), 0.0), STEEPEST)
            response = logarithms(viscosities(near)) - logarithms(viscosities(before[2]))
            response /= inlet - before[0]
        mixture = Mixture(temperature=inlet, error=rest, slope=slope, response=response)
        if once or abs(rest) <= MIXED:
            return near, mixture
        if inlet > HOTTEST:
            break
        before, inlet = (inlet, rest, near), mixture.following
    raise ConvergenceError(
        "temperature: thermal runaway, hot lubricant enters the film again and heats its inlet to "
        f"{celsius(inlet)} and above; lower heat.carried_over, or supply more new lubricant through sides or supplies",
        outcome=Outcome.DIVERGED,
        iterations=MAX_MIXTURES,
    )
