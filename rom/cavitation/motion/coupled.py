"""Newton's method for a film together with the coordinates of its wall and the pressures behind restrictors."""

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, finite_arithmetic
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED, FLOODED, advance, settle_bank
from roughfilm.rom.cavitation.discretise import Faces
from roughfilm.rom.cavitation.motion.bands import Bands, Ring, factors_of
from roughfilm.rom.cavitation.motion.contact import ContactForce
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.newton import BALANCE_ROUNDOFF, Linear
from roughfilm.rom.cavitation.relaxation import relaxed
from roughfilm.rom.cavitation.restricted import first_pressures
from roughfilm.rom.parts.allowance import spend

DIFFERENCE = 1e-6
"""Change of the film thickness over the least distance from the smallest one, for derivatives by the coordinates."""

MAX_APPROACH = 0.6
"""Largest fraction of the distance from the smallest film thickness that one step may close."""

FORCE_TOLERANCE = 1e-9
"""Net force on a coordinate over the sum of the sizes of its parts at which the iteration stops."""

NEAR_LINEAR, MIN_PASSABLE = 0.5, 1e-3
"""Relative change by which the flow through a restrictor may differ from a linear one in a step, and the least part."""

SWEEPS, SWEEPS_OF_LINE = 5, 20
"""Relaxation sweeps after a step that changed the kind of a node, in the plane and on a line.

In the plane they follow a step only if it changed fewer nodes than all before, since steps and sweeps may otherwise
move nodes to and fro; and everywhere only if no storage is negative, so that the balances form an M-function.
"""

LEAST_STORED = 1e-5
"""Flow over the volume of a node per step to which balances are related where nothing flows through a face."""

STALLED = 0.5
"""Ratio of successive residuals from which on they are the round-off of the pressures, or nearly so."""

LEAST_FLOW = 1e-3
"""Smallest flow through a film, over the largest one through a face, to which the sum of all balances is related."""

LEAST_PART = 1e-3
"""Least size of the parts of the force on a coordinate over that on the whole film: pads may carry nothing,
and the round-off of pressures, such as that of a film at ambient pressure, balances."""

REFILLED = 1e-12
"""Excess inflow of a refilled node, over the largest flow through a face, from which on it is under pressure."""

COLUMNS_KEPT = 5
"""Largest number of steps for which the derivatives by the coordinates are kept, as they change little.

They are also taken anew once no node changes its kind any more, so that the last steps converge quadratically.
"""

CLOSED = 1e-9
"""Distance from the smallest film thickness over that at the start below which the iteration stops."""

ITERATIONS = 40
"""Largest number of Newton steps."""


@dataclass(frozen=True, kw_only=True)
class Drive:
    """What acts on a film at an instant.

    Attributes
    ----------
    speed : speed of the sliding wall, m/s, at least 0.
    force : f of the force f - S q on each coordinate besides that of the film, N (N m of an angle).
    stiffness : S, shape (coordinates, coordinates).
    free : whether each coordinate moves so that its forces balance; the others are given.
    storage, of_gap : a and s, and b, of ∂(θh)/∂t = a θh + b h - s, each a number or of the shape of the grid.
    """

    speed: float
    force: Array
    stiffness: Array
    free: NDArray[np.bool_]
    storage: tuple[float | Array, float | Array] = (0.0, 0.0)
    of_gap: float | Array = 0.0


@dataclass(frozen=True, kw_only=True)
class Instant:
    """A film at one instant.

    Attributes
    ----------
    place : the coordinates q of the wall.
    pressures : pressure of each inflow in the film, Pa above cavitation pressure.
    state, kind : pressure, filling fraction and kind of every node.
    faces, network : the film at these coordinates.
    balance : outflow minus inflow of every node with its storage, m³/s; at a fixed node it is what enters from outside.
    residual : the largest balance of a node that is not fixed over the largest flow through a face.
    force_residual : the largest net force on a free coordinate over the sum of the sizes of its parts.
    iterations : Newton steps.
    """

    place: Array
    pressures: Array
    state: State
    kind: NDArray[np.int8]
    faces: Faces
    network: Network
    balance: Array
    residual: float
    force_residual: float
    iterations: int


@dataclass(frozen=True, kw_only=True)
class Response:
    """Changes of the unknowns of the nodes, shape (nx, ny, sources), and of the pressures behind restrictors, Pa."""

    change: Array
    pressures: Array


@dataclass(kw_only=True)
class Trial:
    """The unknowns of a film and its coordinates during the iteration, with the film and its balances at them.

    Nodes of refilled cavities are ``FLOODED``: their pressure and filling are known, and they take in what they lack.
    """

    film: MovingFilm
    drive: Drive
    place: Array
    pressures: Array
    pressure: Array
    fill: Array
    kind: NDArray[np.int8]
    faces: Faces = field(init=False)
    contact: ContactForce = field(init=False)
    network: Network = field(init=False)
    linear: Linear = field(init=False)
    largest: float = field(init=False)
    factors: Bands | Ring | None = None
    columns: Array | None = None

    def sample(self) -> Self:
        """Sample the film at the coordinates."""
        film, drive = self.film, self.drive
        self.faces, self.contact = film.faces(self.place), film.contact_at(self.place)
        self.network = film.network(
            self.faces, self.pressures, speed=drive.speed, storage=drive.storage, of_gap=drive.of_gap
        )
        return self

    def relax(self) -> None:
        """Relax the unknowns of the nodes, which moves fronts over many nodes; a Newton step may move them by one."""
        sweeps = SWEEPS_OF_LINE if self.network.shape[1] == 1 else SWEEPS
        state = relaxed(self.network, self.film.problem, State(pressure=self.pressure, fill=self.fill), sweeps)
        self.pressure, self.fill, self.kind = state.pressure, state.fill, kinds(self.network, state)

    def evaluate(self) -> Self:
        """Evaluate the balances and their derivatives; nodes behind restrictors keep theirs."""
        film, net = self.film, self.network
        self.kind = np.where(net.fixed, np.int8(FIXED), np.where(self.kind == FIXED, np.int8(FILM), self.kind))
        self.pressure = np.where(net.fixed, net.pressure, self.pressure)
        self.fill = np.where(self.kind == CAVITY, self.fill, 1.0)
        known = self.kind.copy()
        for number in film.restricted:
            known[film.covered[number]] = FILM
        parts = [np.empty(net.shape) for _ in range(6)]
        mobility = film.problem.mobility(self.pressure)
        laws = (*film.problem.compression(self.pressure), *mobility)
        flow = net.linearise(known, self.pressure, self.fill, laws, parts)
        self.largest = flow or LEAST_STORED * float(net.storage.max()) or 1.0
        for bank, rest in zip(net.banks(self.kind), net.banks(parts[0]), strict=True):
            settle_bank(bank, rest)
        if film.refills and (pressed := (self.kind == FLOODED) & (parts[0] < -REFILLED * self.largest)).any():
            self.kind = np.where(pressed, np.int8(FILM), self.kind)
            return self.evaluate()
        self.linear, self.factors = Linear(self.kind, mobility[0], *parts), None
        return self

    @property
    def rest(self) -> Array:
        """The balances of the nodes with an unknown, m³/s."""
        return np.where(self.kind >= FIXED, 0.0, self.linear.balance)

    @property
    def entering(self) -> float:
        """The mean of what enters and what leaves through fixed nodes, m³/s, at least ``LEAST_FLOW`` of a face."""
        given = self.linear.balance[self.kind >= FIXED]
        return max(float(np.abs(given).sum()) / 2, LEAST_FLOW * self.largest)

    @property
    def inflow_excess(self) -> Array:
        """What each inflow behind a restrictor gives to the film minus what passes its restrictor, m³/s."""
        film, given = self.film, np.zeros(len(self.film.restricted))
        for row, number in enumerate(film.restricted):
            given[row] = film.sides * float(self.linear.balance[film.covered[number]].sum()) - self._passed(number)[0]
        return given

    @property
    def overfull(self) -> bool:
        """Whether a cavity surrounds a ring in steady flow, with pressure beside it.

        What this drives into the cavity never leaves it: its matrix is singular, and its filling that of round-off.
        """
        surrounds = (self.kind == CAVITY).all(axis=0)
        steady = self.network.periodic[0] and not self.network.storage.any()
        return bool(steady and surrounds.any() and self.pressure.any())

    def unbalanced(self, *, round_off: bool) -> tuple[float, float]:
        """The largest balance over the largest flow through a face, and the sum of all over the flow through the film.

        Parameters
        ----------
        round_off : whether balances below the round-off of the unknowns, and of the mean pressure of the load that is
            carried, count as 0: at rest nothing else flows.
        """
        rest, excess = self.rest, float(np.abs(self.inflow_excess).max(initial=0.0))
        if round_off:
            weights, load = np.abs(self.film.weights), self.drive.force - self.drive.stiffness @ self.place
            carried = np.abs(self.pressure - self.film.ambient).ravel() @ weights + self.contact.sizes
            loads = np.minimum(np.abs(load), carried) / weights.sum(axis=0)
            unknowns = np.where(self.kind == CAVITY, 1.0, np.abs(self.pressure) + loads.max(initial=0.0))
            flows = np.abs(self.linear.centre) * unknowns + self.network.storage
            rest = np.where(np.abs(rest) > BALANCE_ROUNDOFF * flows, rest, 0.0)
        return max(float(np.abs(rest).max()), excess) / self.largest, abs(float(rest.sum())) / self.entering

    def _passed(self, number: int) -> tuple[float, float]:
        """The flow through the restrictor of an inflow, m³/s, and minus its derivative by the pressure behind it."""
        inflow = self.film.inflows[number]
        assert inflow.restrictor is not None
        return inflow.restrictor.flow(inflow.pressure - float(self.pressures[number]))

    @property
    def pull(self) -> Array:
        """The forces on the coordinates besides that of the film, with that of contact."""
        return np.asarray(self.drive.force + self.contact.force - self.drive.stiffness @ self.place)

    @property
    def sizes(self) -> Array:
        """The sum of the sizes of the parts of the force on each coordinate, bounded below; 1 without any force."""
        film = self.film
        above = np.abs(self.pressure - film.ambient)
        sizes = above.ravel() @ np.abs(film.weights) + self.contact.sizes + np.abs(self.drive.force)
        rounded = BALANCE_ROUNDOFF / FORCE_TOLERANCE * np.abs(self.pressure)
        least = film.sides * float(((LEAST_PART * above + rounded) * film.grid.areas).sum()) * film.reach
        sizes = np.maximum(sizes, least)
        return np.where(sizes > 0, sizes, 1.0)

    def by_coordinates(self, *, central: bool = False) -> Array:
        """The derivatives of the balances by the free coordinates, in the last axis, by differences."""
        least, free = self.film.room(self.place), np.flatnonzero(self.drive.free)
        columns = np.zeros((*self.network.shape, free.size))
        for column, number in enumerate(free):
            step = np.zeros(self.place.size)
            step[number] = DIFFERENCE * least / float(self.film.reach[number])
            ahead = replace(self, place=self.place + step).sample().evaluate().linear.balance
            behind = replace(self, place=self.place - step).sample().evaluate() if central else self
            columns[..., column] = (ahead - behind.linear.balance) / ((2 if central else 1) * step[number])
        return columns

    def respond(self, sources: Array, passed: Array | float = 0.0) -> Response:
        """The changes that right-hand sides of the balances bring about at unmoved coordinates.

        Parameters
        ----------
        sources : right-hand sides A δu = s of the balances of all nodes, m³/s, one in each entry of the last axis.
        passed : right-hand sides of the flows through the restrictors, m³/s, shape (restrictors, sources).
        """
        film, known = self.film, (self.kind >= FIXED)[..., None]
        within = [film.covered[number] for number in film.restricted]
        columns = [self.linear.image(nodes.astype(float))[..., None] for nodes in within]
        if self.factors is None:
            self.factors = factors_of(self.linear, known[..., 0], periodic=self.network.periodic[0])
        change = self.factors.solve(np.where(known, 0.0, np.concatenate([sources, *columns], axis=-1)))
        if not within:
            return Response(change=change, pressures=np.zeros((0, sources.shape[-1])))
        count = sources.shape[-1]
        change, spread = change[..., :count], change[..., count:]
        matrix = np.zeros((len(within),) * 2, dtype=change.dtype)
        right = np.zeros((len(within), count), dtype=change.dtype) + passed
        for row, (number, nodes) in enumerate(zip(film.restricted, within, strict=True)):
            by_unknowns = np.where(self.kind >= FIXED, 0.0, self.linear.adjoint(nodes.astype(float)))
            direct = np.array([column[nodes].sum() for column in columns])
            matrix[row] = film.sides * (direct - np.tensordot(by_unknowns, spread, axes=2))
            matrix[row, row] += self._passed(number)[1]
            right[row] += film.sides * (sources[nodes].sum(axis=0) - np.tensordot(by_unknowns, change, axes=2))
        pressures = _solved(matrix, right)
        return Response(change=change - spread @ pressures, pressures=pressures)

    def force_of(self, response: Response) -> Array:
        """The changes of the force on every coordinate, shape (coordinates, sources)."""
        film = self.film
        change = np.where((self.kind == FILM)[..., None], response.change, 0.0)
        force = film.weights.T @ change.reshape(self.kind.size, -1)
        for number, pressures in zip(film.restricted, response.pressures, strict=True):
            force += np.outer(film.weights[film.covered[number].ravel()].sum(axis=0), pressures)
        return np.asarray(force)

    def step(self) -> tuple[Array, Array, Array]:
        """The changes of the unknowns of nodes, of the pressures behind restrictors, and of the free coordinates."""
        free = np.flatnonzero(self.drive.free)
        if self.columns is None:
            self.columns = self.by_coordinates()
        passed = np.zeros((len(self.film.restricted), 1 + free.size))
        passed[:, 0] = [self._passed(number)[0] for number in self.film.restricted]
        response = self.respond(-np.concatenate([self.linear.balance[..., None], self.columns], axis=-1), passed)
        forces = self.force_of(response)[free]
        matrix = forces[:, 1:] - (self.drive.stiffness + self.contact.stiffness)[np.ix_(free, free)]
        net_force = (self.film.force(self.pressure) + self.pull)[free] + forces[:, 0]
        places = _solved(matrix, -net_force)
        weights = np.append(1.0, places)
        change = np.einsum("ijk,k", response.change, weights)  # without the threads of BLAS, which cost more here
        return change, response.pressures @ weights, places


def _solved(matrix: Array, right: Array) -> Array:
    """The solution of a small linear system; UnresistedError if the matrix is singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        raise UnresistedError(
            "motion: the film does not resist the motion of its wall; give a mass, or a start near the equilibrium",
            outcome=Outcome.DIVERGED,
        ) from None


class UnresistedError(ConvergenceError):
    """A film does not resist the motion of its wall, as where it has no pressure."""


def full_film(film: MovingFilm, place: Array) -> Instant:
    """A full film at cavitation pressure and given coordinates, from which an iteration starts."""
    faces = film.faces(place)
    pressures = first_pressures(film.inflows, film.covered, None)
    net = film.network(faces, pressures, speed=film.problem.speed)
    state = State(pressure=np.where(net.fixed, net.pressure, 0.0), fill=np.ones(net.shape))
    return Instant(
        place=place,
        pressures=pressures,
        state=state,
        kind=kinds(net, state),
        faces=faces,
        network=net,
        balance=np.zeros(net.shape),
        residual=np.inf,
        force_residual=np.inf,
        iterations=0,
    )


def turned_round(film: MovingFilm, instant: Instant) -> Instant:
    """An instant of a film as one of the film mirrored in x."""
    other, turned = film.mirrored, film.turned_round
    faces = other.faces(instant.place)
    return replace(
        instant,
        state=State(pressure=turned(instant.state.pressure), fill=turned(instant.state.fill)),
        kind=turned(instant.kind),
        faces=faces,
        network=other.network(faces, instant.pressures, speed=other.problem.speed),
        balance=turned(instant.balance),
    )


def trial_at(film: MovingFilm, instant: Instant, drive: Drive) -> Trial:
    """The unknowns at an instant, not yet evaluated."""
    return Trial(
        film=film,
        drive=drive,
        place=instant.place.copy(),
        pressures=instant.pressures.copy(),
        pressure=instant.state.pressure.copy(),
        fill=instant.state.fill.copy(),
        kind=instant.kind.copy(),
    )


@finite_arithmetic("motion")
def settled(
    film: MovingFilm,
    start: Instant,
    drive: Drive,
    *,
    tolerance: float,
    limit: int = ITERATIONS,
    starved: bool = False,
) -> Instant:
    """The instant at which inflow equals outflow at every node and behind every restrictor, and all forces balance.

    The unknowns are the pressure or the filling fraction u of every node, and z, the free coordinates and the pressures
    behind restrictors. A step eliminates the former: with the balances R, A = ∂R/∂u, and with G the net forces and the
    net flows behind restrictors,

        (G_z - G_u A⁻¹ R_z) δz = -(G - G_u A⁻¹ R),    δu = -A⁻¹ (R + R_z δz).

    Parameters
    ----------
    start : an instant near the solution; its coordinates that are not free are those of the solution.
    tolerance : residual at which the iteration stops, and sum of all balances over the flow through the film; it is
        larger where the round-off of the volumes over a short time step exceeds it.
    limit : largest number of steps.
    starved : whether pressures behind restrictors may fall below that of cavitation, as on the way to an equilibrium.

    Raises
    ------
    ConvergenceError
        If the iteration does not converge, a film takes in more than a restrictor passes at cavitation pressure, or a
        steady film has a cavity around a ring that would fill.
    """
    trial = trial_at(film, start, drive)
    free, whole, line = np.flatnonzero(drive.free), True, film.grid.shape[1] == 1
    residual = force_residual = fewest = np.inf
    changed, outdated, unbalanced, open_by = 0, False, (np.inf, np.inf), CLOSED * film.room(trial.place)
    for iteration in range(limit + 1):
        with np.errstate(over="ignore", invalid="ignore"):  # an overflow gives a residual that is not finite
            trial.sample()
            if film.ruptures and not film.refills and 0 < changed < fewest and trial.network.storage.min() >= 0:
                fewest = np.inf if line else changed
                trial.relax()
            trial.evaluate()
        before, unbalanced = unbalanced, trial.unbalanced(round_off=False)
        if unbalanced[0] > STALLED * before[0]:
            unbalanced = trial.unbalanced(round_off=True)
        residual, imbalance = unbalanced
        least = max(tolerance, BALANCE_ROUNDOFF * float(trial.network.storage.max()) / trial.largest)
        net_force = np.abs(film.force(trial.pressure) + trial.pull) / trial.sizes
        force_residual = float(net_force[free].max(initial=0.0))
        if not np.isfinite(residual + force_residual):
            break
        if max(residual, imbalance) <= least and force_residual <= FORCE_TOLERANCE and whole:
            if trial.overfull:
                raise ConvergenceError(
                    "cavitation: no steady film was found: a cavity surrounds the bearing, and the film beside it "
                    "would fill it; take more cells, or change lubricant.cavitation_pressure",
                    outcome=Outcome.STALLED,
                    iterations=iteration,
                )
            if not starved:
                _check_restrictors(trial)
            return Instant(
                place=trial.place,
                pressures=trial.pressures,
                state=State(pressure=trial.pressure, fill=trial.fill),
                kind=trial.kind,
                faces=trial.faces,
                network=trial.network,
                balance=trial.linear.balance,
                residual=residual if residual <= tolerance else trial.unbalanced(round_off=True)[0],
                force_residual=force_residual,
                iterations=iteration,
            )
        spend(trial.kind.size)
        change, pressures, places = trial.step()
        moved = np.zeros(trial.place.size)
        moved[free] = places
        part = MAX_APPROACH / max(film.closing(trial.place, moved), MAX_APPROACH) * _passable(trial, pressures)
        trial.place = trial.place + part * moved
        trial.pressures[list(film.restricted)] += part * pressures
        changed, whole = _advance(trial, part * change), part == 1
        if not whole and film.room(trial.place) < open_by:
            residual = np.inf
            break
        outdated = outdated or changed > 0
        if not whole or (outdated and not changed) or iteration % COLUMNS_KEPT == COLUMNS_KEPT - 1:
            trial.columns, outdated = None, False
    finite = np.isfinite(residual + force_residual)
    reason = (
        f"the residual is {residual:.1e} and the relative net force {force_residual:.1e} after {limit} steps"
        if finite
        else "the pressures diverge, or the walls meet"
    )
    raise ConvergenceError(
        f"motion: {reason}; take more cells or smaller steps",
        outcome=Outcome.UNFINISHED if finite else Outcome.DIVERGED,
        iterations=limit,
    )


def _check_restrictors(trial: Trial) -> None:
    """Raise ConvergenceError if a film takes in more than a restrictor passes at cavitation pressure."""
    if trial.film.ruptures and min(trial.pressures[list(trial.film.restricted)], default=0.0) < 0:
        raise ConvergenceError(
            "supply: the film takes in more than a restrictor passes, and the pressure behind it falls below that of "
            "cavitation; raise the pressure of the supply or widen the restrictor",
            outcome=Outcome.STALLED,
        )


def _passable(trial: Trial, change: Array) -> float:
    """The part, halved from 1, of a change of the pressures behind restrictors over which their flows are near linear.

    Newton's method from Δp to -Δp and back would go on for ever through an orifice, whose flow changes as √Δp.
    """
    part = 1.0
    for number, moved in zip(trial.film.restricted, change, strict=True):
        inflow = trial.film.inflows[number]
        assert inflow.restrictor is not None
        drop = inflow.pressure - float(trial.pressures[number])
        flow, slope = inflow.restrictor.flow(drop)
        while part > MIN_PASSABLE:
            linear, passed = flow - slope * part * moved, inflow.restrictor.flow(drop - part * float(moved))[0]
            if abs(passed - linear) <= NEAR_LINEAR * max(abs(flow), abs(linear)):
                break
            part /= 2
    return part


def _advance(trial: Trial, change: Array) -> int:
    """Add the change to the unknowns of the nodes; returns how many nodes changed their kind."""
    if trial.film.ruptures:
        changed = int(advance(*(values.reshape(-1) for values in (trial.kind, trial.pressure, trial.fill, change))))
        if trial.film.refills:
            trial.kind[trial.kind == CAVITY] = FLOODED
        return changed
    trial.pressure += np.where(trial.kind == FILM, change, 0.0)
    return 0


def kinds(network: Network, state: State) -> NDArray[np.int8]:
    """The kind of every node of a state."""
    kind = np.where(state.fill < 1, np.int8(CAVITY), np.int8(FILM))
    for bank, fill in zip(network.banks(kind), network.banks(state.fill), strict=True):
        bank[:] = np.where(fill < 1, CAVITY, FLOODED)
    kind[network.fixed] = FIXED
    return np.asarray(kind)
