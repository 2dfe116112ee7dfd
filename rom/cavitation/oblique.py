"""Flows that an oblique lay adds: sliding drives flow across, and a pressure gradient across drives flow along.

With the averaged coefficients A₁₂ and B₂ of a rough film,

    F_x = -A₁₂/(12η) ∂p/∂y,    F_y = (u/2) B₂ θ - A₁₂/(12η) ∂p/∂x.

Sliding drives flow across by the pressures around the tips of the roughness. Downstream of a film the tips stay wet for
some distance, because a full gap supplies more than passes the tips; where no tip is wet, the liquid moves in straight
streamers. In a cavity g replaces θ,

    g(ξ) = s²,    s = (ξ - ξ₀)/(1 - ξ₀), at least 0,

where ξ₀ B₁ is the smallest gap. For sinusoidal ridges the error of g is at most 0.1, 0.13 and 0.24 where their
amplitude is 0.1, 0.3 and 0.6 of the mean gap. (s³ (3 - 2s) has a third of that error, but it is not convex, and
Newton's method does not converge with it.)

No liquid drifts in through a side at the cavitation pressure, and the nodes there may be partly full. A side at any
higher pressure supplies the drift in full, since the waves are taken as infinitely short.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import allocating, compiled, inlined
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED


@dataclass(frozen=True, kw_only=True)
class Oblique:
    """Cross flow inside cells, and drift through the faces towards j+1; arrays of shape (nx, ny).

    A cell lies between the nodes (i, j) and (i+1, j+1). The pressure difference along it, the mean of its two sides,
    drives G φ times itself through the half faces across, and vice versa: the discrete operator is positive definite
    where A is. The filling of drifting liquid is taken upstream, its compression from both sides.

    Attributes
    ----------
    cross : G = A₁₂/(12η) of the cells, m³/(Pa s).
    drift : D of the faces, m³/s, positive towards j+1.
    upstream : ω >= 1/2 of the compression, as in :class:`roughfilm.rom.cavitation.network.Network`.
    threshold : ξ₀ of the faces towards j+1.
    fixed : nodes whose pressure is given; the filling beyond them equals that before them.
    periodic : whether i is periodic.
    """

    cross: Array
    drift: Array
    upstream: Array
    threshold: Array
    fixed: NDArray[np.bool_]
    periodic: bool

    def driven(self, mobility: Array, pressure: Array) -> tuple[Array, Array]:
        """Pressure-driven flows through the faces towards i+1 and j+1, m³/s."""
        east, north = np.zeros_like(pressure), np.zeros_like(pressure)
        exchange(self.cross, mobility, pressure, self.periodic, east, north)
        return east, north

    def flows(self, mobility: Array, pressure: Array, fill: Array, excess: Array) -> tuple[Array, Array]:
        """Pressure-driven flows and drift through the faces towards i+1 and j+1, m³/s."""
        east, north = self.driven(mobility, pressure)
        drifted(self.drift, self.upstream, self.threshold, self.fixed, fill, excess, north)
        return east, north

    def image(self, mobility: Array, pressure: Array) -> Array:
        """Pressure-driven outflow minus inflow of every node, m³/s, linear in the pressure."""
        return self.outflow(*self.driven(mobility, pressure))

    def outflow(self, east: Array, north: Array) -> Array:
        """Outflow minus inflow of every node, m³/s, from the flows through the faces."""
        across = north.copy()
        across[:, 1:] -= north[:, :-1]
        return np.asarray(east - np.roll(east, 1, axis=0) + across)

    def linearise(
        self,
        kind: NDArray[np.int8],
        state: tuple[Array, Array],
        laws: tuple[Array, Array, Array],
        parts: tuple[Array, Array, Array, Array],
    ) -> None:
        """Add drift to balance, centre, south and north, and the pressure-driven cross flow to the balance alone."""
        balance, centre, south, north = parts
        (pressure, fill), (excess, excess_slope, mobility) = state, laws
        balance += self.outflow(*self.flows(mobility, pressure, fill, excess))
        faces = (self.drift, self.upstream, self.threshold, self.fixed)
        drift_slopes(*faces, kind, fill, excess_slope, centre, south, north)


@compiled
def exchange(cross, mobility, pressure, periodic, east, north):  # type: ignore[no-untyped-def]
    """Add the cross flow of the cells to the flows through the faces."""
    nx, ny = pressure.shape
    for i in range(nx if periodic else nx - 1):
        k = i + 1 if i + 1 < nx else 0
        for j in range(ny - 1):
            low, right, up, far = pressure[i, j], pressure[k, j], pressure[i, j + 1], pressure[k, j + 1]
            mean = 0.25 * (mobility[i, j] + mobility[k, j] + mobility[i, j + 1] + mobility[k, j + 1])
            half = 0.5 * cross[i, j] * mean
            through_east = -half * 0.5 * ((up - low) + (far - right))
            through_north = -half * 0.5 * ((right - low) + (far - up))
            east[i, j] += through_east
            east[i, j + 1] += through_east
            north[i, j] += through_north
            north[k, j] += through_north


@inlined
def wet(fill, threshold):  # type: ignore[no-untyped-def]
    """g(ξ) and its derivative."""
    part = min(max((fill - threshold) / (1.0 - threshold), 0.0), 1.0)
    return part * part, 2.0 * part / (1.0 - threshold)


def wetness(fill: Array, threshold: Array) -> Array:
    """g(ξ) for arrays."""
    part = np.clip((fill - threshold) / (1 - threshold), 0.0, 1.0)
    return np.asarray(part**2)


@compiled
def drifted(drift, upstream, threshold, fixed, fill, excess, north):  # type: ignore[no-untyped-def]
    """Add the drift to the flows through the faces towards j+1."""
    nx, ny = drift.shape
    for i in range(nx):
        for j in range(ny - 1):
            source, other = (j, j + 1) if drift[i, j] >= 0.0 else (j + 1, j)
            w = upstream[i, j]
            filled = wet(fill[i, other if fixed[i, source] else source], threshold[i, j])[0]
            north[i, j] += drift[i, j] * (filled + w * excess[i, source] + (1.0 - w) * excess[i, other])


@allocating
def drift_slopes(drift, upstream, threshold, fixed, kind, fill, excess_slope, centre, to_south, to_north):  # type: ignore[no-untyped-def]  # fmt: skip
    """Add the derivatives of the drift by the unknowns of both nodes; rows without an unknown are unchanged."""
    nx, ny = drift.shape
    for i in range(nx):
        for j in range(ny - 1):
            d, w = drift[i, j], upstream[i, j]
            source, other = (j, j + 1) if d >= 0.0 else (j + 1, j)
            filling = other if fixed[i, source] else source
            slopes = np.zeros(2)
            for place in range(2):
                k = j + place
                if kind[i, k] == FILM:
                    slopes[place] = d * (w if k == source else 1.0 - w) * excess_slope[i, k]
                elif kind[i, k] == CAVITY and k == filling:
                    slopes[place] = d * wet(fill[i, k], threshold[i, j])[1]
            if kind[i, j] < FIXED:
                centre[i, j] += slopes[0]
                to_north[i, j] += slopes[1]
            if kind[i, j + 1] < FIXED:
                centre[i, j + 1] -= slopes[1]
                to_south[i, j + 1] -= slopes[0]
