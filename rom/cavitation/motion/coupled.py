"""Newton's method for a film together with the coordinates of its wall and the pressures behind restrictors."""

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED, FLOODED, advance, settle_bank
from roughfilm.rom.cavitation.discretise import Faces
from roughfilm.rom.cavitation.motion.bands import Bands
from roughfilm.rom.cavitation.motion.contact import ContactForce
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.newton import BALANCE_ROUNDOFF, Linear

DIFFERENCE = 1e-6
"""Change of the film thickness over the least distance from the smallest one, for derivatives by the coordinates."""

MAX_APPROACH = 0.6
"""Largest fraction of the distance from the smallest film thickness that one step may close."""

FORCE_TOLERANCE = 1e-9
"""Net force on a coordinate over the sum of the sizes of its parts at which the iteration stops."""

COLUMNS_KEPT = 5
"""Number of steps for which the derivatives by the coordinates are kept: they change little from step to step."""

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
    storage : a and s of ∂(θh)/∂t = a θh - s, 1/s and m/s, each a number or of the shape of the grid.
    """

    speed: float
    force: Array
    stiffness: Array
    free: NDArray[np.bool_]
    storage: tuple[float | Array, float | Array] = (0.0, 0.0)


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
    """The unknowns of a film and its coordinates during the iteration, with the film and its balances at them."""

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
    columns: Array | None = None

    def evaluate(self) -> Self:
        """Evaluate the balances and their derivatives; nodes behind restrictors keep theirs."""
        film, drive = self.film, self.drive
        self.faces = film.faces(self.place)
        self.contact = film.contact_at(self.place)
        self.network = net = film.network(self.faces, self.pressures, speed=drive.speed, storage=drive.storage)
        self.kind = np.where(net.fixed, np.int8(FIXED), np.where(self.kind == FIXED, np.int8(FILM), self.kind))
        self.pressure = np.where(net.fixed, net.pressure, self.pressure)
        self.fill = np.where(self.kind == CAVITY, self.fill, 1.0)
        known = self.kind.copy()
        for number in film.restricted:
            known[film.covered[number]] = FILM
        parts = [np.empty(net.shape) for _ in range(6)]
        mobility = film.problem.mobility(self.pressure)
        laws = (*film.problem.compression(self.pressure), *mobility)
        self.largest = net.linearise(known, self.pressure, self.fill, laws, parts) or 1.0
        for bank, rest in zip(net.banks(self.kind), net.banks(parts[0]), strict=True):
            settle_bank(bank, rest)
        self.linear = Linear(self.kind, mobility[0], *parts)
        return self

    @property
    def rest(self) -> Array:
        """The balances of the nodes with an unknown, m³/s."""
        return np.where(self.kind >= FIXED, 0.0, self.linear.balance)

    @property
    def inflow_excess(self) -> Array:
        """What each inflow behind a restrictor gives to the film minus what passes its restrictor, m³/s."""
        film, given = self.film, np.zeros(len(self.film.restricted))
        for row, number in enumerate(film.restricted):
            given[row] = film.sides * float(self.linear.balance[film.covered[number]].sum()) - self._passed(number)[0]
        return given

    def residual(self, tolerance: float) -> float:
        """The largest of these and of the balances of the nodes, over the largest flow through a face.

        If it is above the tolerance, the balances below the round-off of the pressures are left out: at rest, nothing
        flows.
        """
        rest, excess = np.abs(self.rest), float(np.abs(self.inflow_excess).max(initial=0.0))
        residual = max(float(rest.max()), excess) / self.largest
        if residual <= tolerance:
            return residual
        rounding = BALANCE_ROUNDOFF * np.abs(self.linear.centre * self.pressure)
        return max(float(rest[rest > rounding].max(initial=0.0)), excess) / self.largest

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
        """The sum of the sizes of the parts of the force on each coordinate; 1 without any force."""
        film = self.film
        parts = np.tensordot(np.abs(self.pressure - film.ambient), np.abs(film.weights), axes=2)
        sizes = parts + self.contact.sizes + np.abs(self.drive.force)
        return np.where(sizes > 0, sizes, 1.0)

    def by_coordinates(self, *, central: bool = False) -> Array:
        """The derivatives of the balances by the free coordinates, in the last axis, by differences."""
        least, free = self.film.room(self.place), np.flatnonzero(self.drive.free)
        columns = np.zeros((*self.network.shape, free.size))
        for column, number in enumerate(free):
            step = np.zeros(self.place.size)
            step[number] = DIFFERENCE * least / float(self.film.reach[number])
            ahead = replace(self, place=self.place + step).evaluate().linear.balance
            behind = replace(self, place=self.place - step).evaluate() if central else self
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
        bands = Bands(self.linear.without(known[..., 0]), periodic=self.network.periodic[0])
        change = bands.solve(np.where(known, 0.0, np.concatenate([sources, *columns], axis=-1)))
        if not within:
            return Response(change=change, pressures=np.zeros((0, sources.shape[-1])))
        count = sources.shape[-1]
        change, spread = change[..., :count], change[..., count:]
        matrix, right = np.zeros((len(within),) * 2), np.zeros((len(within), count)) + passed
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
        force = np.tensordot(
            np.where((self.kind == FILM)[..., None], film.weights, 0.0), response.change, ((0, 1),) * 2
        )
        for number, pressures in zip(film.restricted, response.pressures, strict=True):
            force += np.outer(film.weights[film.covered[number]].sum(axis=0), pressures)
        return np.asarray(force)

    def step(self) -> tuple[Response, Array]:
        """The changes of the unknowns of the film, of one source, and of the free coordinates."""
        free = np.flatnonzero(self.drive.free)
        passed = np.array([self._passed(number)[0] for number in self.film.restricted])
        own = self.respond(-self.linear.balance[..., None], passed[:, None])
        if not free.size:
            return own, np.zeros(0)
        if self.columns is None:
            self.columns = self.by_coordinates()
        moved = self.respond(-self.columns)
        matrix = self.force_of(moved)[free] - (self.drive.stiffness + self.contact.stiffness)[np.ix_(free, free)]
        net_force = (self.film.force(self.pressure) + self.pull + self.force_of(own)[:, 0])[free]
        places = _solved(matrix, -net_force)
        return Response(
            change=own.change + (moved.change @ places)[..., None],
            pressures=own.pressures + (moved.pressures @ places)[:, None],
        ), places


def _solved(matrix: Array, right: Array) -> Array:
    """The solution of a small dense system; ConvergenceError if it is singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise ConvergenceError(
            "motion: no force resists a motion of the wall; take another place to start from", outcome=Outcome.DIVERGED
        ) from None


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


def settled(film: MovingFilm, start: Instant, drive: Drive, *, tolerance: float, limit: int = ITERATIONS) -> Instant:
    """The instant at which inflow equals outflow at every node and behind every restrictor, and all forces balance.

    The unknowns are the pressure or the filling fraction u of every node, and z, the free coordinates and the pressures
    behind restrictors. A step eliminates the former: with the balances R, A = ∂R/∂u, and with G the net forces and the
    net flows behind restrictors,

        (G_z - G_u A⁻¹ R_z) δz = -(G - G_u A⁻¹ R),    δu = -A⁻¹ (R + R_z δz).

    Parameters
    ----------
    start : an instant near the solution; its coordinates that are not free are those of the solution.
    tolerance : residual at which the iteration stops.
    limit : largest number of steps.

    Raises
    ------
    ConvergenceError
        If the iteration does not converge.
    """
    trial = trial_at(film, start, drive)
    free, whole, open_by = np.flatnonzero(drive.free), True, CLOSED * film.room(trial.place)
    residual = force_residual = np.inf
    for iteration in range(limit + 1):
        with np.errstate(over="ignore", invalid="ignore"):  # an overflow gives a residual that is not finite
            trial.evaluate()
        residual = trial.residual(tolerance)
        net_force = np.abs(film.force(trial.pressure) + trial.pull) / trial.sizes
        force_residual = float(net_force[free].max(initial=0.0))
        if not np.isfinite(residual + force_residual):
            break
        if residual <= tolerance and force_residual <= FORCE_TOLERANCE and whole:
            return Instant(
                place=trial.place,
                pressures=trial.pressures,
                state=State(pressure=trial.pressure, fill=trial.fill),
                kind=trial.kind,
                faces=trial.faces,
                network=trial.network,
                balance=trial.linear.balance,
                residual=residual,
                force_residual=force_residual,
                iterations=iteration,
            )
        response, places = trial.step()
        moved = np.zeros(trial.place.size)
        moved[free] = places
        part = MAX_APPROACH / max(film.closing(trial.place, moved), MAX_APPROACH)
        trial.place = trial.place + part * moved
        trial.pressures[list(film.restricted)] += part * response.pressures[:, 0]
        _advance(trial, part * response.change[..., 0])
        whole = part == 1
        if not whole and film.room(trial.place) < open_by:
            residual = np.inf
            break
        if not whole or iteration % COLUMNS_KEPT == COLUMNS_KEPT - 1:
            trial.columns = None
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


def _advance(trial: Trial, change: Array) -> None:
    """Add the change to the unknowns of the nodes, which may change their kind."""
    if trial.film.ruptures:
        advance(*(values.reshape(-1) for values in (trial.kind, trial.pressure, trial.fill, change)))
    else:
        trial.pressure += np.where(trial.kind == FILM, change, 0.0)


def kinds(network: Network, state: State) -> NDArray[np.int8]:
    """The kind of every node of a state."""
    kind = np.where(state.fill < 1, np.int8(CAVITY), np.int8(FILM))
    for bank, fill in zip(network.banks(kind), network.banks(state.fill), strict=True):
        bank[:] = np.where(fill < 1, CAVITY, FLOODED)
    kind[network.fixed] = FIXED
    return np.asarray(kind)
