r"""The thin-film (Prandtl) Navier-Stokes equations over a cell in plan: full inertia, lowest order in slope.

In units of film thickness, sliding speed U and viscous stress η U / film, with Y = 0 on the fixed wall, Y = 1 on the
sliding one, the velocities u along x and v along y, and the flow m upward through the surfaces of constant Y,

    Re [ ∂(h u u)/∂x + ∂(h u v)/∂y + ∂(u m)/∂Y ] = -h ∂p/∂x + (1/h) ∂²u/∂Y²,
    Re [ ∂(h v u)/∂x + ∂(h v v)/∂y + ∂(v m)/∂Y ] = -h ∂p/∂y + (1/h) ∂²v/∂Y²,
    m = -∂/∂x (h ∫_0^Y u dY) - ∂/∂y (h ∫_0^Y v dY),      m(Y = 1) = 0.

Across the film u = Y + Σ a_k φ_k(Y) and v = Σ b_k φ_k(Y) (:mod:`roughfilm.rom.thin_film.basis`), and the equations are
tested with the same φ_k. Only φ_0 carries flow and couples to the pressure, which is uniform across the film. The
amplitudes and the pressure lie on a staggered grid, on which each cell balances its momentum and each node its flow.
The momentum through a face is reconstructed at each Y from the upstream side. On a film that does not vary along y the
method is that of :mod:`roughfilm.rom.thin_film.thin_film`.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.film import kernels
from roughfilm.rom.pocket.plan.film.sheet import Sheet
from roughfilm.rom.thin_film.basis import STIFFNESS, Basis


@dataclass(frozen=True, kw_only=True)
class SheetFlow:
    """The amplitudes of u and v, shape (nx, ny, n), and the pressures, shape (nx, ny), or the imbalances of each.

    ``flat`` is the vector of all of them, of which the others are views.
    """

    flat: Array
    shape: tuple[int, int]

    @property
    def modes(self) -> int:
        """The number of polynomials across the film."""
        return (self.flat.size // (self.shape[0] * self.shape[1]) - 1) // 2

    @property
    def along(self) -> Array:
        """The amplitudes of u, or the imbalances of momentum along x."""
        return self.flat[: self._size].reshape(*self.shape, -1)

    @property
    def across(self) -> Array:
        """The amplitudes of v, or the imbalances of momentum along y."""
        return self.flat[self._size : 2 * self._size].reshape(*self.shape, -1)

    @property
    def pressure(self) -> Array:
        """The pressures, or the imbalances of flow."""
        return self.flat[2 * self._size :].reshape(self.shape)

    @property
    def _size(self) -> int:
        return self.shape[0] * self.shape[1] * self.modes


@dataclass(frozen=True, kw_only=True)
class Velocities:
    """Velocities at the points across the film, of cells and at their faces, or changes of them.

    ``faces`` are u and v at nodes, u and v at corners, the flows along y and x through the corners, and the flows that
    enter each cell of u and v below a point; shape (8, nx, ny, points). ``upwind`` are the directions of the
    reconstructions.
    """

    u: Array
    v: Array
    faces: Array
    upwind: Array


@dataclass(frozen=True, kw_only=True)
class Film:
    """The discrete equations of a sheet with a basis at one Reynolds number."""

    sheet: Sheet
    basis: Basis
    reynolds_number: float

    def still(self) -> SheetFlow:
        """The flow of shear alone, without pressure."""
        nx, ny = self.sheet.shape
        return SheetFlow(flat=np.zeros(nx * ny * (2 * len(self.basis.shape) + 1)), shape=self.sheet.shape)

    def velocities(self, flow: SheetFlow) -> Velocities:
        """The velocities of a flow."""
        upwind = np.empty((4, *self.sheet.shape, self.basis.nodes.size))
        return self._sampled(flow, upwind, known=False, shear=1.0)

    def imbalance(self, flow: SheetFlow, velocities: Velocities) -> SheetFlow:
        """The imbalance of momentum of each cell and test function, and of the flow of each node."""
        inertia = self._inertia(velocities, velocities) / 2
        return SheetFlow(flat=inertia + self._creeping(flow, shear=1.0), shape=flow.shape)

    def change(self, velocities: Velocities, change: SheetFlow) -> SheetFlow:
        """The change of the imbalance to first order in a change of the flow."""
        changed = self._sampled(change, velocities.upwind, known=True, shear=0.0)
        inertia = self._inertia(velocities, changed)
        return SheetFlow(flat=inertia + self._creeping(change, shear=0.0), shape=change.shape)

    def force(self, flow: SheetFlow, velocities: Velocities) -> float:
        """The largest viscous force of a cell, or momentum flow through a node."""
        through = self.sheet.thickness[2] * self.sheet.around[1] * np.abs(velocities.faces[0]).max(axis=2) ** 2
        scale = float(np.abs(self.basis.weights * self.basis.shape[0]).sum())
        viscous = max(
            float(np.abs(stiffness[:, :, None] * amplitudes).max())
            for stiffness, amplitudes in zip(self._stiffness, (flow.along, flow.across), strict=True)
        )
        return max(viscous, self.reynolds_number * scale * float(through.max()))

    @cached_property
    def _stiffness(self) -> tuple[Array, Array]:
        area_u, area_v, _ = self.sheet.areas
        return STIFFNESS * area_u / self.sheet.thickness[0], STIFFNESS * area_v / self.sheet.thickness[1]

    @cached_property
    def _tests(self) -> tuple[Array, Array]:
        """The test functions and their derivatives with the weights of the points, shape (points, n)."""
        basis = self.basis
        weights = basis.weights
        return np.ascontiguousarray((weights * basis.shape).T), np.ascontiguousarray((weights * basis.slope).T)

    def _sampled(self, flow: SheetFlow, upwind: Array, *, known: bool, shear: float) -> Velocities:
        """The velocities of amplitudes and ``shear`` times Y, with known directions of reconstruction or their own."""
        basis, nodes = self.basis, self.basis.nodes
        u, v = flow.along @ basis.shape + shear * nodes, flow.across @ basis.shape
        below_u, below_v = flow.along @ basis.primitive + shear * nodes**2 / 2, flow.across @ basis.primitive
        first = np.stack([flow.along[:, :, 0] + shear / (2 * basis.flow), flow.across[:, :, 0]])
        faces = np.empty((8, *u.shape))
        polynomial = np.stack([basis.shape[0], basis.primitive[0]])
        kernels.face_values(
            *(u, v, below_u, below_v, first, self.sheet.thickness, self.sheet.rows, self.sheet.central, polynomial),
            *(upwind, np.bool_(known), faces),
        )
        return Velocities(u=u, v=v, faces=faces, upwind=upwind)

    def _inertia(self, one: Velocities, other: Velocities) -> Array:
        """The inertial imbalance to first order in ``other``, as a flat vector."""
        leaving = np.empty((2, 2, *one.u.shape))
        kernels.momentum(
            *(one.u, one.v, one.faces, other.u, other.v, other.faces, self.sheet.thickness, self.sheet.rows, leaving)
        )
        shape, slope = self._tests
        tested = leaving[:, 0] @ shape + leaving[:, 1] @ slope
        nx, ny = self.sheet.shape
        return np.concatenate([self.reynolds_number * tested.ravel(), np.zeros(nx * ny)])

    def _creeping(self, flow: SheetFlow, *, shear: float) -> Array:
        """The imbalance without inertia, as a flat vector."""
        ones, mean = SheetFlow(flat=np.empty_like(flow.flat), shape=flow.shape), self.basis.flow
        (h_u, h_v, *_), (around_x, around_y), pressure = self.sheet.thickness, self.sheet.around, flow.pressure
        along, across = flow.along[:, :, 0], flow.across[:, :, 0]
        np.multiply(self._stiffness[0][:, :, None], flow.along, out=ones.along)
        np.multiply(self._stiffness[1][:, :, None], flow.across, out=ones.across)
        ones.along[:, :, 0] += mean * h_u * around_y * (np.roll(pressure, -1, axis=0) - pressure)
        ones.across[:, :, 0] += mean * h_v * around_x * (np.roll(pressure, -1, axis=1) - pressure)
        flow_x, flow_y = h_u * (mean * along + shear / 2), h_v * mean * across
        ones.pressure[:] = around_y * (flow_x - np.roll(flow_x, 1, axis=0))
        ones.pressure[:] += around_x * (flow_y - np.roll(flow_y, 1, axis=1))
        return ones.flat
