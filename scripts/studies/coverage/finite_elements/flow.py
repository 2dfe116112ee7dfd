"""Newton's method for the steady Navier-Stokes equations in a periodic gap, by Taylor-Hood finite elements.

In film thicknesses, sliding speeds and η u / Ly the flow obeys

    Re (w · grad) w = -grad(p) + div(grad(w)) + force,   div(w) = 0,   w = (u, v).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import splu
from skfem import MeshTri2

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from scripts.studies.coverage.finite_elements.spaces import Fields, Spaces

GRAD_DIV = 1.0
"""Weight of the integral of div(w) div(test), which is zero for the exact flow and improves the conservation of mass.

Source: Olshanskii, Lube, Heister and Löwe 2009, doi:10.1016/j.cma.2009.09.005.
"""

NEWTON_STEPS = 10
"""Largest number of Newton steps at one Reynolds number."""

LAST_STEP = 1e-6
"""Largest change of a velocity in the last Newton step; the error is its square."""

LEAST_STRIDE = 0.02
"""Least step of the continuation over the Reynolds number."""

Vector = Callable[[Array, Array], tuple[Array, Array]]
"""A vector field of x and y."""


@dataclass(frozen=True, kw_only=True)
class Flow:
    """A flow, and the forces per length that the walls exert on the liquid, as integrals with each shape.

    Attributes
    ----------
    spaces : the finite elements.
    fields : velocities and pressure.
    force_x, force_y : shape (nodes,); zero, to the accuracy of Newton's method, at nodes that are not on a wall.
    """

    spaces: Spaces
    fields: Fields
    force_x: Array
    force_y: Array


def _sliding(_x: Array, y: Array) -> tuple[Array, Array]:
    """Return the velocities of the walls: 1 at y = 1, 0 elsewhere."""
    return np.where(np.abs(y - 1) < 1e-9, 1.0, 0.0), np.zeros_like(y)


def _residual(spaces: Spaces, flow: Fields, convection: Array, loads: tuple[Array, Array]) -> tuple[Array, ...]:
    """Return the integrals of the equations with each shape: momentum in x and y, and -div(w)."""
    u, v, p = flow.u[spaces.of_element], flow.v[spaces.of_element], flow.p[spaces.pressure_of_element]
    momentum = []
    for own, row, pressure, load in zip((u, v), spaces.volume, spaces.divergence, loads, strict=True):
        stress = np.einsum("eij,ej->ei", spaces.stiffness + convection, own)
        volume = np.einsum("eij,ej->ei", row[0], u) + np.einsum("eij,ej->ei", row[1], v)
        momentum.append(spaces.vector(stress + GRAD_DIV * volume - np.einsum("epi,ep->ei", pressure, p)) - load)
    mass = sum(np.einsum("epi,ei->ep", own, w) for own, w in zip(spaces.divergence, (u, v), strict=True))
    return (*momentum, spaces.vector(-mass, pressure=True))


def _convection(spaces: Spaces, reynolds_number: float, flow: Fields) -> Array:
    """Return the integrals of shape times Re (w · grad) shape by element."""
    u, v = (spaces.at_points(one, spaces.shapes)[:, None] for one in (flow.u, flow.v))
    return reynolds_number * spaces.product(spaces.shapes, u * spaces.slopes[0] + v * spaces.slopes[1])


def _jacobian(spaces: Spaces, reynolds_number: float, flow: Fields, convection: Array) -> dict[tuple[str, str], Array]:
    blocks = {}
    for row, own, volume in zip("uv", (flow.u, flow.v), spaces.volume, strict=True):
        for column, slope, part in zip("uv", spaces.slopes, volume, strict=True):
            gradient = reynolds_number * spaces.at_points(own, slope)[:, None]
            blocks[row, column] = spaces.product(spaces.shapes * gradient, spaces.shapes) + GRAD_DIV * part
        blocks[row, row] = blocks[row, row] + spaces.stiffness + convection
    for row, part in zip("uv", spaces.divergence, strict=True):
        blocks["p", row] = -part
        blocks[row, "p"] = -part.transpose(0, 2, 1)
    return blocks


def _newton(spaces: Spaces, reynolds_number: float, flow: Fields, loads: tuple[Array, Array]) -> Fields | None:
    """Return the flow at a Reynolds number, from a flow nearby; None if Newton's method does not converge."""
    for _ in range(NEWTON_STEPS):
        convection = _convection(spaces, reynolds_number, flow)
        factors = splu(spaces.matrix(_jacobian(spaces, reynolds_number, flow, convection)))
        step = spaces.expanded(factors.solve(-spaces.reduced(*_residual(spaces, flow, convection, loads))))
        flow = Fields(u=flow.u + step.u, v=flow.v + step.v, p=flow.p + step.p)
        change = max(np.abs(step.u).max(), np.abs(step.v).max())
        if not change < 100:
            return None
        if change < LAST_STEP or reynolds_number == 0:
            return flow
    return None


def solve(mesh: MeshTri2, reynolds_number: float, *, walls: Vector = _sliding, force: Vector | None = None) -> Flow:
    """Return the steady flow in a gap, if necessary by continuation from creeping flow.

    Parameters
    ----------
    mesh : triangles of one period (see :class:`Spaces`).
    reynolds_number : Re, of the film thickness and the sliding speed.
    walls : velocity on the walls at points x, y; by default the upper wall slides with speed 1.
    force : force per volume at points x, y; by default none.

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge.
    """
    spaces = Spaces(mesh)
    zero = np.zeros(spaces.nodes.shape[1])
    loads = (zero, zero)
    if force is not None:
        given = force(*spaces.points)
        parts = [np.einsum("eq,eiq->ei", one * spaces.weights, spaces.shapes) for one in given]
        loads = spaces.vector(parts[0]), spaces.vector(parts[1])
    u, v = zero.copy(), zero.copy()
    u[spaces.walls], v[spaces.walls] = walls(*spaces.nodes[:, spaces.walls])
    start = Fields(u=u, v=v, p=np.zeros(spaces.pressure_nodes.shape[1]))
    flow = _newton(spaces, 0.0, start, loads)
    reached, stride = 0.0, 1.0
    while flow is not None and reached < 1 and reynolds_number > 0:
        target = min(reached + stride, 1.0)
        found = _newton(spaces, target * reynolds_number, flow, loads)
        if found is not None:
            flow, reached, stride = found, target, 2 * stride
            continue
        stride /= 3
        if stride < LEAST_STRIDE:
            flow = None
    if flow is None:
        raise ConvergenceError(
            f"finite elements: no steady flow was found above Re = {reached * reynolds_number:.4g} "
            f"(requested: {reynolds_number:.4g})",
            outcome=Outcome.STALLED,
        )
    force_x, force_y, _ = _residual(spaces, flow, _convection(spaces, reynolds_number, flow), loads)
    return Flow(spaces=spaces, fields=flow, force_x=force_x, force_y=force_y)
