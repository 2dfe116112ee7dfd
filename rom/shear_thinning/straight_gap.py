"""The viscosity across a straight gap of a lubricant that thins with shear.

One wall of the gap slides with the speed u along x, the other one rests. The shear stress is linear across,

    τ(c) = (A + c B) τ_c,    c = z/h - 1/2,    B = h ∇p/τ_c,

where z is the distance from the sliding wall. With the relative fluidity φ(|S|) of a law
(:mod:`roughfilm.rom.lubricants.shear_thinning`), S = A + c B, and the viscosity η₀ at rest the walls and the flow give

    ∫ φ S dc = (-U, 0),    U = η₀ u/(h τ_c),    ∫ c φ S dc = -η₀/(h² τ_c) (q - (u h/2, 0)).

These are the conditions of a stationary point of ∫ Ψ(|S|) dc + U A₁ + m·B, m = -∫ c φ S dc, with Ψ' = φ S. As the shear
rate grows with the stress, this is a convex function of (A, B), and of A alone where the pressure gradient is given:
there is one solution, which Newton's method with a line search finds.

The secant viscosity η(z) = η₀/φ is the same along and across the sliding. The integrals F₀, F₁ and F₂ of
:class:`roughfilm.rom.cavitation.fluid.Viscosities` with η(z) hence carry the flow q in both directions and have the
stress on the walls: a shear-thinning film needs no viscosity of its own for the flow across.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled, inlined
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.lubricants.shear_thinning import MOST_FLUIDITY, SPACING, ThinningCurve

POINTS = 10
"""Gauss points across the gap, or on each side of the place in the gap where the stress is least."""

STEPS = 60
"""Largest number of Newton steps of a node."""

HALVINGS = 30
"""Largest number of halvings of a step."""

TOLERANCE = 1e-10
"""Relative error of the wall speed and of the flow at which Newton's method ends."""

ACCEPTED = 1e-9
"""The same above which a solution is refused."""


@dataclass(frozen=True)
class ShearedGap:
    """The viscosities of a film and the stress from which they follow.

    Attributes
    ----------
    viscosities : viscosities of the film.
    stress : A₁, A₂, B₁ and B₂ of each place, shape (..., 4), from which the stress of a film near this one is sought.
    """

    viscosities: Viscosities
    stress: Array


@inlined
def integrate(points, weights, relative, stress, curve, begin, sums, fluidity):  # type: ignore[no-untyped-def]
    """Write ∫ (φ - 1) c^k dc, k = 0, 1, 2, and ∫ φ d ln φ/d ln S c^k/S² dc, k = 0 to 4, into the sums.

    Where the viscosity at rest is uniform across, there are points on both sides of the least stress.
    """
    ax, ay, bx, by = stress[0], stress[1], stress[2], stress[3]
    slope = bx * bx + by * by
    least = -(ax * bx + ay * by) / slope if slope > 0.0 else -1.0
    sides = 2 if -0.5 < least < 0.5 and relative.size == 0 else 1
    last = curve.shape[0] - 1
    d0 = d1 = d2 = e0 = e1 = e2 = e3 = e4 = 0.0
    for side in range(sides):
        low = least if side == 1 else -0.5
        width = (least if side < sides - 1 else 0.5) - low
        for k in range(points.size):
            c, weight = low + width * points[k], width * weights[k]
            sx, sy = ax + c * bx, ay + c * by
            square = sx * sx + sy * sy
            place = (0.5 * np.log(square) - begin) / SPACING if square > 0.0 else -1.0
            value = growth = 0.0
            if place >= last:
                growth = curve[last, 1] / SPACING
                value = min(curve[last, 0] + curve[last, 1] * (place - last), 2.0 * MOST_FLUIDITY)
            elif place > 0.0:
                cell = int(place)
                t = place - cell
                left, rise = curve[cell, 0], curve[cell, 1]
                step, fall = curve[cell + 1, 0] - left, curve[cell + 1, 1]
                second, third = 3.0 * step - 2.0 * rise - fall, rise + fall - 2.0 * step
                value = left + t * (rise + t * (second + t * third))
                growth = (rise + t * (2.0 * second + 3.0 * t * third)) / SPACING
            local = np.exp(value)
            if relative.size:
                local *= relative[k]
                fluidity[k] = local
            d = weight * (local - 1.0)
            d0 += d
            d1 += c * d
            d2 += c * c * d
            if growth != 0.0:
                e = weight * local * growth / square
                e0 += e
                e *= c
                e1 += e
                e *= c
                e2 += e
                e *= c
                e3 += e
                e4 += c * e
    sums[0], sums[1], sums[2] = d0, d1, d2
    sums[3], sums[4], sums[5], sums[6], sums[7] = e0, e1, e2, e3, e4


@inlined
def derivatives(sums, stress, matrix):  # type: ignore[no-untyped-def]
    """Write the symmetric derivatives of the conditions by A and B, of which the upper triangle is used."""
    ax, ay, bx, by = stress[0], stress[1], stress[2], stress[3]
    xx0, xx1, xx2 = ax * ax, 2.0 * ax * bx, bx * bx
    xy0, xy1, xy2 = ax * ay, ax * by + ay * bx, bx * by
    yy0, yy1, yy2 = ay * ay, 2.0 * ay * by, by * by
    for k in range(3):
        e0, e1, e2 = sums[3 + k], sums[4 + k], sums[5 + k]
        both = sums[k] + (1.0 if k == 0 else 1.0 / 12.0 if k == 2 else 0.0)
        row, column = k // 2 * 2, (k + 1) // 2 * 2
        matrix[row, column] = both + xx0 * e0 + xx1 * e1 + xx2 * e2
        matrix[row, column + 1] = xy0 * e0 + xy1 * e1 + xy2 * e2
        matrix[row + 1, column + 1] = both + yy0 * e0 + yy1 * e1 + yy2 * e2
        if k == 1:
            matrix[1, 2] = matrix[0, 3]


@inlined
def eliminate(matrix, right, unknowns):  # type: ignore[no-untyped-def]
    """Solve a symmetric positive definite system in place, of its first unknowns."""
    for i in range(unknowns):
        for j in range(i + 1, unknowns):
            factor = matrix[i, j] / matrix[i, i]
            for k in range(j, unknowns):
                matrix[j, k] -= factor * matrix[i, k]
            right[j] -= factor * right[i]
    for back in range(unknowns):
        i = unknowns - 1 - back
        for k in range(i + 1, unknowns):
            right[i] -= matrix[i, k] * right[k]
        right[i] /= matrix[i, i]


@inlined
def conditions(sums, sliding, moment, stress, missing):  # type: ignore[no-untyped-def]
    """Write what is missing in the wall speeds and in the flow."""
    ax, ay, bx, by = stress[0], stress[1], stress[2], stress[3]
    missing[0] = ax + (ax * sums[0] + bx * sums[1]) + sliding
    missing[1] = ay + (ay * sums[0] + by * sums[1])
    missing[2] = bx / 12.0 + (ax * sums[1] + bx * sums[2]) - moment[0]
    missing[3] = by / 12.0 + (ay * sums[1] + by * sums[2]) - moment[1]


@compiled
def balance_stress(points, weights, relative, curve, begin, sliding, moment, unknowns, stress, integrals, fluidity, sums, matrix, step, missing):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Solve for A and B of every node from their first values; ``unknowns`` is 4, or 2 where B is given.

    Writes ∫ (φ - 1) c^k dc, k = 0, 1, 2, and φ of the points where the viscosity at rest varies across. Returns the
    largest relative error.
    """
    worst = 0.0
    for n in range(sliding.size):
        known, at = relative[n], stress[n]
        integrate(points, weights, known, at, curve, begin, sums, fluidity[n])
        conditions(sums, sliding[n], moment[n], at, missing)
        scale = abs(sliding[n])
        if unknowns == 4:
            scale = max(scale, 6.0 * max(abs(moment[n, 0]), abs(moment[n, 1])))
        else:
            scale = max(scale, 6.0 * max(abs(missing[2]), abs(missing[3])))  # the flow, as its moment is given as 0
        error = 0.0
        for _ in range(STEPS):
            error = max(abs(missing[0]), abs(missing[1]))
            if unknowns == 4:
                error = max(error, 6.0 * max(abs(missing[2]), abs(missing[3])))
            if error <= TOLERANCE * scale:
                break
            derivatives(sums, at, matrix)
            descent = 0.0
            for k in range(unknowns):
                step[k] = -missing[k]
            eliminate(matrix, step, unknowns)
            for k in range(unknowns):
                descent += missing[k] * step[k]
            for _ in range(HALVINGS):
                for k in range(unknowns):
                    at[k] += step[k]
                integrate(points, weights, known, at, curve, begin, sums, fluidity[n])
                conditions(sums, sliding[n], moment[n], at, missing)
                slope = 0.0
                for k in range(unknowns):
                    slope += missing[k] * step[k]
                if abs(slope) <= abs(descent):
                    break
                for k in range(unknowns):
                    at[k] -= step[k]
                    step[k] *= 0.5
                descent *= 0.5
        if scale > 0.0:
            worst = max(worst, error / scale)
        for k in range(3):
            integrals[n, k] = sums[k]
    return worst


def _gauss() -> tuple[Array, Array]:
    """The points and weights of Gauss on 0 to 1."""
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    return (1 + points) / 2, weights / 2


def _balanced(
    curve: ThinningCurve,
    sliding: Array,
    moment: Array,
    gradient: Array | None,
    across: tuple[Array, Array, Array] | None = None,
    start: Array | None = None,
) -> tuple[Array, Array, Array]:
    """∫ (φ - 1) c^k dc of each node, k = 0, 1, 2, φ at points across where the viscosity varies there, and (A, B).

    Parameters
    ----------
    sliding : U of each node.
    moment : ∫ c φ S dc along x and y, shape (nodes, 2), of which A and B are sought.
    gradient : B, in place of ``moment``.
    across : points z/h, their weights, and the fluidity at rest there, shape (nodes, points), over that of ``sliding``.
    start : (A, B) from which they are sought, shape (nodes, 4).

    Raises
    ------
    ConvergenceError
        If the stress of a node does not converge.
    """
    points, weights, relative = across or (*_gauss(), np.ones((sliding.size, 0)))
    stress = np.zeros((sliding.size, 4))
    if start is not None:
        stress[:] = start
    elif gradient is None:
        rate = np.sqrt(sliding**2 + 12 * (moment**2).sum(axis=1))
        thinned = np.divide(curve.relative_stress(rate), rate, out=np.ones_like(rate), where=rate > 0)
        stress[:, 0] = -thinned * sliding
        stress[:, 2:] = 12 * thinned[:, None] * moment
    else:
        by_pressure = (gradient**2).sum(axis=1) / 12
        pulled = curve.relative_stress(np.abs(sliding))
        for _ in range(2):
            pulled = np.minimum(np.abs(sliding) / curve.fluidity(np.sqrt(pulled**2 + by_pressure))[0], pulled)
        stress[:, 0] = -np.copysign(pulled, sliding)
        stress[:, 2:] = gradient
    integrals, fluidity = np.zeros((sliding.size, 3)), np.zeros(relative.shape)
    scratch = np.zeros(8), np.zeros((4, 4)), np.zeros(4), np.zeros(4)
    law = np.stack([curve.values, SPACING * curve.slopes], axis=1), curve.begin
    unknowns = 4 if gradient is None else 2
    error = balance_stress(
        points, weights, relative, *law, sliding, moment, unknowns, stress, integrals, fluidity, *scratch
    )
    if not error <= ACCEPTED:
        raise ConvergenceError(
            f"lubricant.shear_thinning: the stress across the film has a relative error of {error:.1g}, and it must be "
            f"below {ACCEPTED:g}; raise the critical stress or the index",
            outcome=Outcome.STALLED,
        )
    return integrals, fluidity, stress


def _effective(viscosity: Array, integrals: Array) -> Viscosities:
    """The viscosities of a film from ∫ (φ - 1) c^k dc, shape (nodes, 3); they are ``viscosity`` where these are 0."""
    zeroth, first, second = integrals.T.reshape(3, *viscosity.shape)
    total = 1 + zeroth
    return Viscosities(
        flow=viscosity / (1 + 12 * (second - first**2 / total)),
        shear=viscosity / total,
        carried=1 + 2 * first / total,
    )


def thinned_by_gradient(
    curve: ThinningCurve, viscosity: Array, thickness: Array, speed: Array | float, gradient: tuple[Array, Array]
) -> Viscosities:
    """The viscosities of a film with a given pressure gradient.

    Its flow is that of the law to a relative error of about 1e-8, and of up to 1e-4 where the pressure drives stresses
    of some hundred times the critical one.

    Parameters
    ----------
    curve : fluidity over stress.
    viscosity : viscosity η₀ at rest, at the local temperature and pressure, Pa s.
    thickness : film thickness h, m, of the shape of ``viscosity``, as the others are.
    speed : speed u of the sliding wall, m/s.
    gradient : ∂p/∂x and ∂p/∂y, Pa/m.

    Raises
    ------
    ConvergenceError
        If the stress of a node does not converge.
    """
    unit = viscosity / (thickness * curve.stress)
    along, across = (np.broadcast_to(thickness * one / curve.stress, viscosity.shape).ravel() for one in gradient)
    driven = np.stack([along, across], axis=1)
    return _effective(viscosity, _balanced(curve, (unit * speed).ravel(), np.zeros_like(driven), driven)[0])


def thinned_by_flow(
    curve: ThinningCurve,
    viscosity: Array,
    thickness: Array,
    speed: Array | float,
    driven: tuple[Array, Array],
    start: Array | None = None,
) -> ShearedGap:
    """The viscosities of a film with a given flow.

    ``driven`` is the flow less that of sliding at a uniform viscosity, (q_x - u h/2, q_y), m²/s, and ``start`` the
    stress of a film near this one; the other parameters, the error and what is raised are those of
    :func:`thinned_by_gradient`.
    """
    unit = viscosity / (thickness * curve.stress)
    along, across = (np.broadcast_to(-unit / thickness * one, viscosity.shape).ravel() for one in driven)
    near = None if start is None else start.reshape(-1, 4)
    moment = np.stack([along, across], axis=1)
    integrals, _, stress = _balanced(curve, (unit * speed).ravel(), moment, None, start=near)
    return ShearedGap(_effective(viscosity, integrals), stress.reshape(*viscosity.shape, 4))


def thinned_across(
    curve: ThinningCurve,
    viscosity: Array,
    across: tuple[Sequence[float] | Array, Sequence[float] | Array],
    thickness: Array,
    speed: Array | float,
    driven: tuple[Array, Array],
    start: Array | None = None,
) -> tuple[Array, Array]:
    """The viscosity at points across a film, Pa s, whose viscosity at rest varies across, and the stress.

    Parameters
    ----------
    curve : fluidity over stress.
    viscosity : viscosity η₀ at rest at the points, Pa s, shape (..., points).
    across : points z/h from the sliding wall, and the weights of a quadrature over 0 to 1 at these points.
    thickness : film thickness h, m, shape (...), as ``speed`` and the flows.
    speed : speed u of the sliding wall, m/s.
    driven : the flow less that of sliding at a uniform viscosity, (q_x - u h/2, q_y), m²/s.
    start : stress of a film near this one, shape (..., 4).

    Raises
    ------
    ConvergenceError
        If the stress of a node does not converge.
    """
    points, weights = (np.ascontiguousarray(one, dtype=float) for one in across)
    mean = 1 / (weights / viscosity).sum(axis=-1)
    unit = mean / (thickness * curve.stress)
    moment = np.stack([np.broadcast_to(-unit / thickness * one, mean.shape).ravel() for one in driven], axis=1)
    relative = np.ascontiguousarray((mean[..., None] / viscosity).reshape(-1, points.size))
    near = None if start is None else start.reshape(-1, 4)
    _, fluidity, stress = _balanced(curve, (unit * speed).ravel(), moment, None, (points, weights, relative), near)
    thinned = viscosity / (fluidity / relative).reshape(viscosity.shape)
    return thinned, stress.reshape(*mean.shape, 4)
