"""Flow across that slides along, and along that a pressure across drives: what a slanting lay adds to a network.

With the averaged coefficients A₁₂ and B₂ of a rough film,

    F_x = -A₁₂/(12η) ∂p/∂y,    F_y = (u/2) B₂ θ - A₁₂/(12η) ∂p/∂x.

What sliding drives across, it drives by pressures round the tips of the roughness. Behind a film these stay wet for a
while, as a full gap brings more than the tips let through; where none is wet any more, streamers go straight on. In a
cavity g takes the place of θ,

    g(ξ) = s²,    s = (ξ - ξ₀)/(1 - ξ₀), at least 0,

ξ₀ B₁ the least gap: for sinusoidal ridges within 0.1, 0.13 and 0.24 where their amplitude is 0.1, 0.3 and 0.6 of the
mean gap. (s³ (3 - 2s) is three times nearer, but not convex, and Newton's method then goes round in circles.)

A bath at the pressure of cavitation cannot be sucked at: through a side that has it nothing drifts in, and the nodes
there may be partly full. Any pressure above it does feed what drifts in, as it stands against waves infinitely short.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.compiled import allocating, compiled, inlined
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED
from roughfilm.rom.pocket.gap import Array


@dataclass(frozen=True, kw_only=True)
class Oblique:
    """Pressure across and along exchanged inside cells, and drift through the faces towards j+1; shape (nx, ny).

    A cell lies between the nodes (i, j) and (i+1, j+1). The differences of pressure along and across it, each the mean
    of its two sides, drive G φ times the one through the half faces of the other: with A positive definite, so is what
    the network makes of it. Liquid that drifts is taken from upstream, its compression from both sides.

    Attributes
    ----------
    cross : G = A₁₂/(12η) of the cells, m³/(Pa s).
    drift : D, m³/s, towards j+1 of the faces; of either sign.
    upstream : ω >= 1/2, of the compression, as in :class:`roughfilm.rom.cavitation.network.Network`.
    torn : ξ₀ of the faces towards j+1.
    fixed : nodes whose pressure is given: beyond them lies what lies before them.
    periodic : whether i is.
    """

    cross: Array
    drift: Array
    upstream: Array
    torn: Array
    fixed: NDArray[np.bool_]
    periodic: bool

    def driven(self, mobility: Array, pressure: Array) -> tuple[Array, Array]:
        """What pressure drives through the faces towards i+1 and j+1, m³/s."""
        east, north = np.zeros_like(pressure), np.zeros_like(pressure)
        exchange(self.cross, mobility, pressure, self.periodic, east, north)
        return east, north

    def flows(self, mobility: Array, pressure: Array, fill: Array, excess: Array) -> tuple[Array, Array]:
        """All that flows through the faces towards i+1 and j+1, m³/s."""
        east, north = self.driven(mobility, pressure)
        drifted(self.drift, self.upstream, self.torn, self.fixed, fill, excess, north)
        return east, north

    def image(self, mobility: Array, pressure: Array) -> Array:
        """Outflow less inflow of every node that pressures drive, m³/s; linear in them."""
        return self.outflow(*self.driven(mobility, pressure))

    def outflow(self, east: Array, north: Array) -> Array:
        """Outflow less inflow of every node; what flows past the last node comes in at the first if x is periodic."""
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
        """Add to balance, centre, south and north what drifts and, to the balance alone, what pressure drives."""
        balance, centre, south, north = parts
        (pressure, fill), (excess, excess_slope, mobility) = state, laws
        balance += self.outflow(*self.flows(mobility, pressure, fill, excess))
        faces = (self.drift, self.upstream, self.torn, self.fixed)
        drift_slopes(*faces, kind, fill, excess_slope, centre, south, north)


@compiled
def exchange(cross, mobility, pressure, periodic, east, north):  # type: ignore[no-untyped-def]
    """Add to the flows through the faces what the cells beside them drive."""
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
def wet(fill, torn):  # type: ignore[no-untyped-def]
    """g(ξ), and its slope."""
    part = min(max((fill - torn) / (1.0 - torn), 0.0), 1.0)
    return part * part, 2.0 * part / (1.0 - torn)


def wetness(fill: Array, torn: Array) -> Array:
    """g(ξ) of arrays."""
    part = np.clip((fill - torn) / (1 - torn), 0.0, 1.0)
    return np.asarray(part**2)


@compiled
def drifted(drift, upstream, torn, fixed, fill, excess, north):  # type: ignore[no-untyped-def]
    """Add to the flows through the faces towards j+1 what the sliding drags through them."""
    nx, ny = drift.shape
    for i in range(nx):
        for j in range(ny - 1):
            source, other = (j, j + 1) if drift[i, j] >= 0.0 else (j + 1, j)
            w = upstream[i, j]
            filled = wet(fill[i, other if fixed[i, source] else source], torn[i, j])[0]
            north[i, j] += drift[i, j] * (filled + w * excess[i, source] + (1.0 - w) * excess[i, other])


@allocating
def drift_slopes(drift, upstream, torn, fixed, kind, fill, excess_slope, centre, to_south, to_north):  # type: ignore[no-untyped-def]  # fmt: skip
    """Add the derivatives of what drifts by the unknowns of the nodes on both sides; rows without unknown stay."""
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
                    slopes[place] = d * wet(fill[i, k], torn[i, j])[1]
            if kind[i, j] < FIXED:
                centre[i, j] += slopes[0]
                to_north[i, j] += slopes[1]
            if kind[i, j + 1] < FIXED:
                centre[i, j + 1] -= slopes[1]
                to_south[i, j + 1] -= slopes[0]
