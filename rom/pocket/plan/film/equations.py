"""The thin-film (Prandtl) Navier-Stokes equations in plan."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.basis import STIFFNESS, Basis
from roughfilm.rom.pocket.plan.film import kernels
from roughfilm.rom.pocket.plan.film.sheet import Sheet


CENTRAL = 2 / 3


@dataclass(frozen=True, kw_only=True)
class SheetFlow:
    """Amplitudes of u and v, shape (nx, ny, n), and pressures, shape (nx, ny)."""

    along: Array
    across: Array
    pressure: Array


@dataclass(frozen=True, kw_only=True)
class Sampled:
    u: Array
    v: Array
    face: Array


class Film:
    """The discrete equations of a sheet at one Reynolds number."""

    def __init__(self, sheet: Sheet, basis: Basis, reynolds_number: float):
        self.sheet, self.basis, self.reynolds_number = sheet, basis, reynolds_number
        self.weighted = np.ascontiguousarray((basis.weights * basis.shape).T)
        self.turning = np.ascontiguousarray((basis.weights * basis.slope).T)
        self.viscous = [STIFFNESS * a / h for a, h in zip((sheet.area_u, sheet.area_v), sheet.thickness[:2])]
        self.grid = np.zeros((2, 6, max(r.shape[1] for r in sheet.rows)))
        for axis in range(2):
            self.grid[axis, :, : sheet.rows[axis].shape[1]] = sheet.rows[axis]
        self.shape3 = (*sheet.thickness.shape[1:], basis.nodes.size)

    def sample(self, state: SheetFlow, upwind: Array, *, known: bool, change: bool) -> Sampled:
        b = self.basis
        base = 0.0 if change else 1.0
        u = state.along @ b.shape + base * b.nodes
        v = state.across @ b.shape
        psi_u = state.along @ b.primitive + base * b.nodes**2 / 2
        psi_v = state.across @ b.primitive
        out = np.empty((8, *self.shape3))
        kernels.face_values(
            u, v, psi_u, psi_v, state.along[:, :, 0] + base / (2 * b.flow), np.ascontiguousarray(state.across[:, :, 0]),
            self.sheet.thickness, self.grid, b.shape[0], b.primitive[0], upwind, np.bool_(known), CENTRAL, out,
        )
        return Sampled(u=u, v=v, face=out)

    def advected(self, one: Sampled, other: Sampled) -> tuple[Array, Array]:
        out = np.empty((2, 2, *self.shape3))
        kernels.momentum(one.u, one.v, one.face, other.u, other.v, other.face, self.sheet.thickness, self.grid, out)
        return out[:, 0] @ self.weighted + out[:, 1] @ self.turning

    def linear(self, state: SheetFlow, *, change: bool) -> SheetFlow:
        """Viscous force, pressure force and divergence."""
        s, f = self.sheet, self.basis.flow
        (lx, bx), (ly, by) = s.rows[0][:2], s.rows[1][:2]
        hu, hv = s.thickness[:2]
        along = self.viscous[0][:, :, None] * state.along
        across = self.viscous[1][:, :, None] * state.across
        p = state.pressure
        along[:, :, 0] += f * hu * by * (np.roll(p, -1, 0) - p)
        across[:, :, 0] += f * hv * bx[:, None] * (np.roll(p, -1, 1) - p)
        qx = hu * (f * state.along[:, :, 0] + (0.0 if change else 0.5))
        qy = hv * f * state.across[:, :, 0]
        div = by * (qx - np.roll(qx, 1, 0)) + bx[:, None] * (qy - np.roll(qy, 1, 1))
        return SheetFlow(along=along, across=across, pressure=div)
