"""The discretised film: nodes that hold lubricant, and faces through which it flows."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import conduct, linearise, rupture
from roughfilm.rom.cavitation.oblique import Oblique

Values = TypeVar("Values", bound=NDArray[Any])


@dataclass(frozen=True, kw_only=True)
class Network:
    """Nodes (i, j), sliding towards growing i, each with a control volume; all arrays of shape (nx, ny).

    The unknowns are p, the pressure above cavitation pressure, and ξ <= 1, the filling fraction (1 where p > 0);
    θ = ξ + ϑ(p), where ϑ is the compression. The flow through the face from (i, j) to (i+1, j) is

        F = C (ξ_i + ω ϑ_i + (1 - ω) ϑ_(i+1)) - K φ (p_(i+1) - p_i),

    in m³/s at the density of the cavitation pressure, where φ is the logarithmic mean of (1 + ϑ) η0/η of the two nodes.
    A film that ruptures between the nodes, after a part s of the face, carries

        F_s = C_s (ξ_i + ω ϑ_i) + K_s φ p_i

    whatever the pressure behind the rupture is, with C_s and K_s of that part and φ of p_i and the cavitation pressure.
    It ruptures where it carries least, as p >= 0 and θ <= 1 on both sides of a rupture: the flow is the least of F and
    all F_s. The flow towards (i, j+1) has only the second term.

    The filling fraction is taken upstream, the compression from both sides: F is continuous where a film begins or
    ends, and second-order accurate inside it. An oblique lay adds the flows of
    :class:`roughfilm.rom.cavitation.oblique.Oblique`.

    Attributes
    ----------
    couette : C of the face towards i+1, m³/s; for the last i only if periodic.
    upstream : ω, 1/2 except on cells so coarse that advection of compression dominates the pressure flow.
    east, north : K of the faces towards i+1 and j+1, m³/(Pa s); for the last i or j only if periodic.
    supply : flow from the inlet into the nodes i = 0, m³/s, shape (ny,); None if these are fixed, or x is periodic.
    fixed : nodes whose ``pressure``, Pa, is given.
    part_couette, part_east : C_s and K_s of each part of the faces towards i+1, shape (parts, nx, ny); no parts where
        films do not rupture inside a face.
    storage : V a of ∂(θV)/∂t = V a θ - s of the volumes V of the nodes, m³/s; zero in steady flow.
    stored : s, m³/s.
    periodic : whether i is periodic, and j.
    oblique : flows that an oblique lay adds; None without one.
    spills : whether the sides j = 0 and j = -1 are at the cavitation pressure; they then discharge what exceeds their
        filling, and receive nothing from outside.
    """

    couette: Array
    upstream: Array
    east: Array
    north: Array
    supply: Array | None
    fixed: NDArray[np.bool_]
    pressure: Array
    storage: Array
    stored: Array
    part_couette: Array = field(default_factory=lambda: np.zeros((0, 0, 0)))
    part_east: Array = field(default_factory=lambda: np.zeros((0, 0, 0)))
    periodic: tuple[bool, bool] = (False, False)
    oblique: Oblique | None = None
    spills: tuple[bool, bool] = (False, False)

    @property
    def shape(self) -> tuple[int, int]:
        """(nx, ny)."""
        return self.couette.shape[0], self.couette.shape[1]

    @property
    def supplied(self) -> Array:
        """``supply``, an empty array where there is none."""
        return np.zeros(0) if self.supply is None else self.supply

    @property
    def drifting(self) -> tuple[Array, Array]:
        """``drift`` and ``threshold`` of the oblique lay, empty arrays where there is none."""
        nothing = np.zeros((0, 0))
        return (nothing, nothing) if self.oblique is None else (self.oblique.drift, self.oblique.threshold)

    def with_whole_faces(self) -> Self:
        """The network whose films rupture at nodes only."""
        return replace(self, part_couette=self.part_couette[:0], part_east=self.part_east[:0])

    def banks(self, values: Values) -> tuple[Values, ...]:
        """Views of the values at the inlet and the spilling sides, whose nodes are never under pressure."""
        views = [] if self.supply is None else [values[0]]
        views += [values[:, j] for j, spills in zip((0, -1), self.spills, strict=True) if spills]
        return tuple(views)

    def linearise(
        self, kind: NDArray[np.int8], pressure: Array, fill: Array, laws: Sequence[Array], parts: Sequence[Array]
    ) -> float:
        """Write the balances and their derivatives into ``parts``; see ``linearise`` in ``balance``.

        ``laws`` are ϑ, dθ/dp, φ and dφ/dp at the pressure. Returns the largest flow through a face, m³/s.
        """
        faces = (self.couette, self.upstream, self.east, self.north, self.part_couette, self.part_east)
        nodes = (self.storage, self.stored, self.supplied)
        largest = float(linearise(*faces, *nodes, *self.periodic, kind, pressure, fill, *laws, *parts))
        if self.oblique is not None:
            balance, centre, _, _, south, north = parts
            self.oblique.linearise(kind, (pressure, fill), (laws[0], laws[1], laws[2]), (balance, centre, south, north))
        return largest

    def conductance(self, mobility: Array) -> tuple[Array, Array]:
        """K φ of the faces towards i+1 and j+1, m³/(Pa s), from θ η0/η at the nodes."""
        east, north = np.empty(self.shape), np.empty(self.shape)
        conduct(self.east, self.north, mobility, *self.periodic, east, north)
        return east, north

    def least_flow(self, flow: Array, state: "State", excess: Array, mobility: Array) -> Array:
        """The least of the flow F of whole faces towards i+1, m³/s, and of the flows F_s of films that rupture in them.

        ``excess`` and ``mobility`` are ϑ and φ of the state.
        """
        flow = flow.copy()
        faces = (self.part_couette, self.part_east, self.upstream)
        rupture(*faces, state.pressure, state.fill, excess, mobility, flow)
        return flow


@dataclass(frozen=True, kw_only=True)
class State:
    """Pressure above cavitation pressure, Pa, and filling fraction ξ of every node, shape (nx, ny)."""

    pressure: Array
    fill: Array
