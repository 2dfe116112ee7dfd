r"""The thin-film (Prandtl) Navier-Stokes equations along a gap: full inertia, lowest order in slope.

In units of film thickness Ly, sliding speed u and viscous stress η u / Ly, with Y = 0 on the fixed wall, Y = 1 on the
sliding one, and the stream function ψ(x, Y) = h ∫_0^Y u dY:

    Re [ ∂(h u²)/∂x - ∂(u ∂ψ/∂x)/∂Y ] = -h dp/dx + (1/h) ∂²u/∂Y²,      ψ(x, 1) = q.

Across the film u = Y + Σ a_k φ_k(Y) (:mod:`roughfilm.rom.thin_film.basis`), tested with the same φ_k. The flow gives
a_0 = (q/h - 1/2) / ∫φ_0, and the pressure appears in the test with φ_0 alone. Along the film the method uses
second-order finite volumes: the momentum through a face is reconstructed at each Y from the upstream side, which is
downstream for back-flow, so that the solution has no oscillations.

A gap is periodic, or has two ends with prescribed pressures. The cells of both form a ring, whose cut is between the
last cell and the first. Liquid enters through an end with the developed velocity of a flow between parallel walls,
u = Y + a_0 φ_0, so that a_k = 0 for k > 0. Where it leaves, the a_k are extrapolated.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.thin_film import periodic_solve as ring
from roughfilm.rom.thin_film.basis import STIFFNESS, Basis
from roughfilm.rom.thin_film.columns import columns
from roughfilm.rom.thin_film.gap import Gap

OFFSETS = (-2, -1, 0, 1)
"""The cells whose values are interpolated to a face, relative to the cell on its right."""

DEVELOPED = ((0.0, 0.0, 0.0, 0.0), (0.0, 2.0, 0.0, 0.0))
"""Weights of these cells at the two faces of the first cell, into which developed flow enters: a_k = 0 at the end."""


@dataclass(frozen=True, kw_only=True)
class Strip:
    """The cells of a gap, in film thicknesses.

    There is one more face than cells; the last one of a periodic gap equals the first. ``around`` are the indices of
    the cells near a face, ``middle`` weights that interpolate to it, ``from_left`` and ``from_right`` those that
    reconstruct from one side; shape (faces, 4), in the order of OFFSETS. ``inside`` is 0 for a face at an end and 1 for
    all others. ``pressure_difference`` is the pressure at the last face minus that at the first.
    """

    faces: Array
    face_thickness: Array
    centres: Array
    thickness: Array
    lengths: Array
    around: NDArray[np.intp]
    middle: Array
    from_left: Array
    from_right: Array
    inside: Array
    pressure_difference: float


@dataclass(frozen=True, kw_only=True)
class StripFlow:
    """The amplitudes a_1 .. a_{n-1} of each cell, shape (cells, n-1), and the volume flow q."""

    amplitudes: Array
    flow: float


@dataclass(frozen=True, kw_only=True)
class Linearised:
    """The imbalance of every cell and test function, shape (cells, n), and its derivatives.

    ``blocks``, shape (cells, 5, n, n-1), are those by the amplitudes of cells i-2 .. i+2, and ``by_flow``, shape
    (cells, n), those by q. ``force`` is the largest viscous force of a cell or momentum flow through a face.
    """

    imbalance: Array
    blocks: Array
    by_flow: Array
    force: float


def strip(gap: Gap, resolution: int, *, second_order: bool = True, pressure_difference: float | None = None) -> Strip:
    """The cells of a gap, about ``resolution`` of them, denser where it bends; every corner is a face.

    A gap with a pressure difference between its last face and its first has ends; without one it is periodic.
    """
    faces = columns(gap, resolution)
    centres, lengths = (faces[1:] + faces[:-1]) / 2, np.diff(faces)
    around = np.add.outer(np.arange(faces.size), OFFSETS) % lengths.size
    left2, left, right, right2 = lengths[around].T
    from_left, from_right, middle = (np.zeros(around.shape) for _ in range(3))
    weight = left / (left + left2) if second_order else np.zeros_like(left)
    from_left[:, 0], from_left[:, 1] = -weight, 1 + weight
    weight = right / (right + right2) if second_order else np.zeros_like(left)
    from_right[:, 2], from_right[:, 3] = 1 + weight, -weight
    middle[:, 1], middle[:, 2] = right / (left + right), left / (left + right)
    inside = np.ones(faces.size)
    if pressure_difference is not None:
        from_left[:2], from_right[-2:] = DEVELOPED, [parts[::-1] for parts in reversed(DEVELOPED)]
        middle[0], middle[-1], inside[[0, -1]] = from_left[0], from_left[-1], 0.0
    return Strip(
        faces=faces,
        face_thickness=gap.thickness(faces * gap.film) / gap.film,
        centres=centres,
        thickness=gap.thickness(centres * gap.film) / gap.film,
        lengths=lengths,
        around=around,
        middle=middle,
        from_left=from_left,
        from_right=from_right,
        inside=inside,
        pressure_difference=pressure_difference or 0.0,
    )


def creeping(film: Strip, modes: int) -> StripFlow:
    """The flow of the Reynolds equation on these cells, without inertia."""
    h, dx = film.thickness, film.lengths
    driven = 6 * (dx / h**2).sum() - film.pressure_difference
    return StripFlow(amplitudes=np.zeros((h.size, modes - 1)), flow=float(driven / (12 * (dx / h**3).sum())))


def first_amplitude(across: Basis, h: Array, flow: float) -> Array:
    """The first amplitude a_0 = (q/h - 1/2) / ∫φ_0; shape of ``h``."""
    return np.asarray((flow / h - 0.5) / across.flow)


def all_amplitudes(film: Strip, across: Basis, state: StripFlow) -> Array:
    """The amplitudes a_0 .. a_{n-1} of each cell, shape (cells, n)."""
    return np.column_stack([first_amplitude(across, film.thickness, state.flow), state.amplitudes])


def velocity(film: Strip, across: Basis, state: StripFlow) -> Array:
    """The velocity u along each cell, shape (cells, points)."""
    return np.asarray(across.nodes + all_amplitudes(film, across, state) @ across.shape)


def face_amplitudes(film: Strip, across: Basis, state: StripFlow) -> Array:
    """The amplitudes at each face, a_0 exact and the others interpolated, shape (cells, n)."""
    inner = np.einsum("fo,fok->fk", film.middle, state.amplitudes[film.around])
    return np.column_stack([first_amplitude(across, film.face_thickness, state.flow), inner])


def stream_function(film: Strip, across: Basis, state: StripFlow) -> Array:
    """The stream function ψ at each face and point across, shape (cells, points)."""
    return np.asarray(
        film.face_thickness[:, None] * (across.nodes**2 / 2 + face_amplitudes(film, across, state) @ across.primitive)
    )


def linearise(film: Strip, across: Basis, reynolds_number: float, state: StripFlow) -> Linearised:
    """The imbalance of momentum of each cell and test function, and its derivatives."""
    h, h_face, dx = film.thickness, film.face_thickness, film.lengths
    weighted, inner = across.weights * across.shape, across.shape[1:]
    a, u = all_amplitudes(film, across, state), velocity(film, across, state)

    from_flow = across.nodes + first_amplitude(across, h_face, state.flow)[:, None] * across.shape[0]
    around = (state.amplitudes @ inner)[film.around]
    forward = from_flow + np.einsum("fo,fom->fm", film.middle, around) > 0
    parts = np.where(forward[:, None, :], film.from_left[:, :, None], film.from_right[:, :, None])
    u_face = from_flow + (parts * around).sum(axis=1)

    through = h_face[:, None] * (u_face**2 @ weighted.T)
    rise = np.diff(stream_function(film, across, state), axis=0)
    viscous = (dx / h)[:, None] * STIFFNESS * a
    turning = across.weights * across.slope
    imbalance = reynolds_number * (np.diff(through, axis=0) + (u * rise) @ turning.T) + viscous

    n = a.shape[1]
    blocks = np.zeros((h.size, 5, n, n - 1))
    by_momentum = 2 * h_face[:, None] * u_face
    _add_faces(blocks, film.from_left, _tested(by_momentum * forward, weighted, inner))
    if not forward.all():
        _add_faces(blocks, film.from_right, _tested(by_momentum * ~forward, weighted, inner))
    blocks[:, 2] += _tested(rise, turning, inner)
    by_stream, lever = _tested(u, turning, across.primitive[1:]), film.middle * h_face[:, None]
    for place in range(len(OFFSETS)):
        blocks[:, 1 + place] += lever[1:, place, None, None] * by_stream
        blocks[:, place] -= lever[:-1, place, None, None] * by_stream
    blocks *= reynolds_number
    k = np.arange(1, n)
    blocks[:, 2, k, k - 1] += (dx / h)[:, None] * STIFFNESS

    through_by_flow = 2 / across.flow * (u_face * across.shape[0]) @ weighted.T
    by_flow = reynolds_number * np.diff(through_by_flow, axis=0)
    by_flow += reynolds_number * (across.shape[0] * rise) @ turning.T / (across.flow * h)[:, None]
    by_flow[:, 0] += dx * STIFFNESS / (across.flow * h**2)
    force = float(max(np.abs(viscous).max(), reynolds_number * np.abs(through).max()))
    return Linearised(imbalance=imbalance, blocks=blocks, by_flow=by_flow, force=force)


def pressure_rise(film: Strip, across: Basis, imbalance: Array) -> Array:
    """The pressure rise along each cell that balances the first test function, shape (cells,)."""
    return np.asarray(-imbalance[:, 0] / (film.thickness * across.flow))


def step(
    film: Strip, across: Basis, linear: Linearised, imbalance: Array, pressure_difference: float = 0.0
) -> tuple[StripFlow, Array]:
    """The changes of flow, and of pressure rise along each cell, that remove an imbalance.

    The pressure rises add up to ``pressure_difference``.
    """
    known = np.stack([imbalance[:, 1:], linear.by_flow[:, 1:]], axis=2)
    answer = ring.solve(linear.blocks[:, :, 1:], known)
    around = np.stack([np.roll(answer, -offset, axis=0) for offset in range(-2, 3)], axis=1)
    first = np.einsum("iok,iokr->ir", linear.blocks[:, :, 0], around)
    lever = -1 / (film.thickness * across.flow)
    rise, by_flow = lever * (imbalance[:, 0] - first[:, 0]), lever * (linear.by_flow[:, 0] - first[:, 1])
    flow = float((rise.sum() - pressure_difference) / by_flow.sum())
    change = StripFlow(amplitudes=answer[:, :, 1] * flow - answer[:, :, 0], flow=-flow)
    return change, np.asarray(rise - by_flow * flow)


def _tested(values: Array, first: Array, second: Array) -> Array:
    """The sums over the points across of values times two sets of functions, shape (cells, first, second)."""
    return np.asarray((first * values[:, None, :]) @ second.T)


def _add_faces(blocks: Array, parts: Array, by_face: Array) -> None:
    """Add the derivatives of what flows through both faces of each cell; ``parts`` are those of the cells near them."""
    for place in np.flatnonzero(parts.any(axis=0)):
        blocks[:, 1 + place] += parts[1:, place, None, None] * by_face[1:]
        blocks[:, place] -= parts[:-1, place, None, None] * by_face[:-1]
