r"""The flow of small disturbances of shear between parallel walls, by Fourier transforms, as a preconditioner.

For u = Y + u' and v = v' between walls with the distance h, the equations of
:mod:`roughfilm.rom.pocket.plan.film.equations` have constant coefficients, so that each pair of wave numbers is
separate. With A_u and A_v the matrices of viscosity and advection by Y, which depend on the wave number along x alone,
C what v adds to the balance of u, and G and D the discrete gradients and divergences,

    A_u a + C b + G_x p e_0 = r_u,    A_v b + G_y p e_0 = r_v,    D_x a_0 + D_y b_0 = r_p.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow
from roughfilm.rom.thin_film.basis import STIFFNESS

Waves = NDArray[np.complex128]


@dataclass(frozen=True, kw_only=True)
class ParallelFilm:
    """The solver of disturbances on the grid of a film whose cells have one size.

    Attributes
    ----------
    areas : areas of the cells of u, v and the nodes.
    inverse_u, inverse_v : inverses of A_u and A_v, shape (nx, n, n), transposed.
    coupling : A_u⁻¹ C, over the difference across, shape (nx, n, n), transposed.
    gradients, divergences : those along x, shape (nx, 1), and across, shape (ny // 2 + 1,).
    difference : the difference across of a value halfway between nodes, shape (ny // 2 + 1,).
    pressure : inverse of the operator of the pressure, shape (nx, ny // 2 + 1).
    """

    areas: tuple[Array, Array, Array]
    inverse_u: Waves
    inverse_v: Waves
    coupling: Waves
    gradients: tuple[Waves, Waves]
    divergences: tuple[Waves, Waves]
    difference: Waves
    pressure: Waves

    @classmethod
    def of(cls, film: Film) -> Self:
        """The parallel film with the same mean of h⁻³, in which pressure drives as much flow along a row of cells."""
        sheet, basis, reynolds_number = film.sheet, film.basis, film.reynolds_number
        (nx, ny), n = sheet.shape, len(basis.shape)
        dx, dy = (sheet.x[-1] - sheet.x[0]) / nx, (sheet.y[-1] - sheet.y[0]) / ny
        h = float(np.mean(sheet.thickness[2] ** -3.0) ** (-1 / 3))
        ahead, ahead_y = np.exp(2j * np.pi * np.arange(nx) / nx), np.exp(2j * np.pi * np.arange(ny // 2 + 1) / ny)
        speed = basis.weights * basis.nodes
        carried, turned = (basis.shape * speed) @ basis.shape.T, (basis.slope * speed) @ basis.primitive.T
        second = 0.5 * (sheet.rows[0, 2, 0] > 0)
        upstream = (1 + second - second / ahead) * (1 - sheet.central) + sheet.central * (1 + ahead) / 2
        advection = (upstream * (1 - 1 / ahead))[:, None, None] * carried * (reynolds_number * h / dx)
        turning = ((ahead - 1 / ahead) / 2)[:, None, None] * turned * (reynolds_number * h / dx)
        viscosity = STIFFNESS / h * np.eye(n)
        inverse_u, inverse_v = np.linalg.inv(2 * advection + turning + viscosity), np.linalg.inv(advection + viscosity)
        coupling = inverse_u @ (((1 + ahead) / 2)[:, None, None] * (carried + turned) * (reynolds_number * h))
        mean, difference = basis.flow * h, (1 - 1 / ahead_y) / dy
        gradients = mean * (ahead[:, None] - 1) / dx, mean * (ahead_y - 1) / dy
        divergences = mean * (1 - 1 / ahead[:, None]) / dx, mean * difference
        by_coupling = (coupling @ inverse_v)[:, :1, 0]
        operator = divergences[0] * (difference * gradients[1] * by_coupling - gradients[0] * inverse_u[:, :1, 0])
        operator -= divergences[1] * gradients[1] * inverse_v[:, :1, 0]
        operator[0, 0] = np.inf
        return cls(
            areas=sheet.areas,
            inverse_u=np.ascontiguousarray(inverse_u.transpose(0, 2, 1)),
            inverse_v=np.ascontiguousarray(inverse_v.transpose(0, 2, 1)),
            coupling=np.ascontiguousarray(coupling.transpose(0, 2, 1)),
            gradients=gradients,
            divergences=divergences,
            difference=difference,
            pressure=1 / operator,
        )

    def solve(self, imbalance: SheetFlow) -> SheetFlow:
        """The disturbance with a given imbalance; the mean pressure is zero."""
        area_u, area_v, area_p = self.areas
        forces = scipy.fft.rfft2(imbalance.along / area_u[:, :, None], axes=(0, 1)) @ self.inverse_u
        b = scipy.fft.rfft2(imbalance.across / area_v[:, :, None], axes=(0, 1)) @ self.inverse_v
        a = forces - self.difference[:, None] * (b @ self.coupling)
        excess = scipy.fft.rfft2(imbalance.pressure / area_p)
        pressure = excess - self.divergences[0] * a[:, :, 0] - self.divergences[1] * b[:, :, 0]
        pressure *= self.pressure
        by_pressure = (self.gradients[1] * pressure)[:, :, None] * self.inverse_v[:, None, 0]
        a += self.difference[:, None] * (by_pressure @ self.coupling)
        a -= (self.gradients[0] * pressure)[:, :, None] * self.inverse_u[:, None, 0]
        values = [
            scipy.fft.irfft2(one, s=imbalance.shape, axes=(0, 1)).ravel() for one in (a, b - by_pressure, pressure)
        ]
        return SheetFlow(flat=np.concatenate(values), shape=imbalance.shape)
