r"""The thin-film (Prandtl) Navier-Stokes equations along a gap: full inertia, lowest order in slope.

In units of film thickness Ly, sliding speed u and viscous stress η u / Ly, with Y = 0 on the fixed wall, Y = 1 on the
sliding one, and the stream function ψ(x, Y) = h ∫_0^Y u dY:

    Re [ ∂(h u²)/∂x - ∂(u ∂ψ/∂x)/∂Y ] = -h dp/dx + (1/h) ∂²u/∂Y²,      ψ(x, 1) = q.

Across the film u = Y + Σ a_k φ_k(Y) (:mod:`roughfilm.rom.thin_film.basis`), tested with the same φ_k. The flow gives
a_0 = (q/h - 1/2) / ∫φ_0, and the pressure appears in the test with φ_0 alone. Along the film the method uses
second-order finite volumes: the momentum through a face is reconstructed at each Y from the upstream side, which is
downstream for back-flow, so that the solution has no oscillations.
"""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.thin_film import periodic_solve as ring
from roughfilm.rom.thin_film.basis import STIFFNESS, Basis
from roughfilm.rom.thin_film.columns import columns
from roughfilm.rom.thin_film.gap import Gap

OFFSETS = (-2, -1, 0, 1)
"""The cells whose values are interpolated to a face, relative to the cell on its right."""


@dataclass(frozen=True, kw_only=True)
class Strip:
    """The cells of a periodic gap, in film thicknesses.

    ``faces`` has one more entry than the cells; ``face_thickness`` omits the last face, which equals the first.
    ``middle`` are weights that interpolate to a face, ``from_left`` and ``from_right`` those that reconstruct from one
    side; shape (cells, 4), in the order of OFFSETS.
    """

    faces: Array
    face_thickness: Array
    centres: Array
    thickness: Array
    lengths: Array
    middle: Array
    from_left: Array
    from_right: Array


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


def strip(gap: Gap, resolution: int, *, second_order: bool = True) -> Strip:
    """The cells of a gap, about ``resolution`` of them, denser where it bends; every corner is a face."""
    faces = columns(gap, resolution)
    centres, lengths = (faces[1:] + faces[:-1]) / 2, np.diff(faces)
    left2, left, right, right2 = (np.roll(lengths, -offset) for offset in OFFSETS)
    from_left, from_right, middle = (np.zeros((lengths.size, len(OFFSETS))) for _ in range(3))
    weight = left / (left + left2) if second_order else np.zeros_like(left)
    from_left[:, 0], from_left[:, 1] = -weight, 1 + weight
    weight = right / (right + right2) if second_order else np.zeros_like(left)
    from_right[:, 2], from_right[:, 3] = 1 + weight, -weight
    middle[:, 1], middle[:, 2] = right / (left + right), left / (left + right)
    return Strip(
        faces=faces,
        face_thickness=gap.thickness(faces[:-1] * gap.film) / gap.film,
        centres=centres,
        thickness=gap.thickness(centres * gap.film) / gap.film,
        lengths=lengths,
        middle=middle,
        from_left=from_left,
        from_right=from_right,
    )


def creeping(film: Strip, modes: int) -> StripFlow:
    """The flow of the Reynolds equation on these cells, without inertia."""
    h, dx = film.thickness, film.lengths
    return StripFlow(amplitudes=np.zeros((h.size, modes - 1)), flow=float((dx / h**2).sum() / (2 * (dx / h**3).sum())))


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
    inner = np.einsum("fo,fok->fk", film.middle, _around(state.amplitudes))
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
    around = _around(state.amplitudes @ inner)
    forward = from_flow + np.einsum("fo,fom->fm", film.middle, around) > 0
    parts = np.where(forward[:, None, :], film.from_left[:, :, None], film.from_right[:, :, None])
    u_face = from_flow + (parts * around).sum(axis=1)

    through = h_face[:, None] * (u_face**2 @ weighted.T)
    rise = _next(stream_function(film, across, state)) - stream_function(film, across, state)
    viscous = (dx / h)[:, None] * STIFFNESS * a
    turning = across.weights * across.slope
    imbalance = reynolds_number * (_next(through) - through + (u * rise) @ turning.T) + viscous

    n = a.shape[1]
    blocks = np.zeros((h.size, 5, n, n - 1))
    by_momentum = 2 * h_face[:, None] * u_face
    downstream = _tested(by_momentum * forward, weighted, inner)
    blocks[:, 1:3] += _next(film.from_left[:, :2, None, None] * downstream[:, None])
    blocks[:, :2] -= film.from_left[:, :2, None, None] * downstream[:, None]
    if not forward.all():
        upstream = _tested(by_momentum * ~forward, weighted, inner)
        blocks[:, 3:] += _next(film.from_right[:, 2:, None, None] * upstream[:, None])
        blocks[:, 2:4] -= film.from_right[:, 2:, None, None] * upstream[:, None]
    blocks[:, 2] += _tested(rise, turning, inner)
    by_stream = _tested(u, turning, across.primitive[1:])
    lever = film.middle[:, 1:3] * h_face[:, None]
    blocks[:, 2:4] += _next(lever)[:, :, None, None] * by_stream[:, None]
    blocks[:, 1:3] -= lever[:, :, None, None] * by_stream[:, None]
    blocks *= reynolds_number
    k = np.arange(1, n)
    blocks[:, 2, k, k - 1] += (dx / h)[:, None] * STIFFNESS

    through_by_flow = 2 / across.flow * (u_face * across.shape[0]) @ weighted.T
    by_flow = reynolds_number * (_next(through_by_flow) - through_by_flow)
    by_flow += reynolds_number * (across.shape[0] * rise) @ turning.T / (across.flow * h)[:, None]
    by_flow[:, 0] += dx * STIFFNESS / (across.flow * h**2)
    force = float(max(np.abs(viscous).max(), reynolds_number * np.abs(through).max()))
    return Linearised(imbalance=imbalance, blocks=blocks, by_flow=by_flow, force=force)


def pressure_rise(film: Strip, across: Basis, imbalance: Array) -> Array:
    """The pressure rise along each cell that balances the first test function, shape (cells,)."""
    return np.asarray(-imbalance[:, 0] / (film.thickness * across.flow))


def step(film: Strip, across: Basis, linear: Linearised, imbalance: Array) -> tuple[StripFlow, Array]:
    """The changes of flow, and of pressure rise along each cell, that remove an imbalance with periodic pressure."""
    known = np.stack([imbalance[:, 1:], linear.by_flow[:, 1:]], axis=2)
    answer = ring.solve(linear.blocks[:, :, 1:], known)
    around = np.stack([np.roll(answer, -offset, axis=0) for offset in range(-2, 3)], axis=1)
    first = np.einsum("iok,iokr->ir", linear.blocks[:, :, 0], around)
    lever = -1 / (film.thickness * across.flow)
    rise, by_flow = lever * (imbalance[:, 0] - first[:, 0]), lever * (linear.by_flow[:, 0] - first[:, 1])
    flow = float(rise.sum() / by_flow.sum())
    change = StripFlow(amplitudes=answer[:, :, 1] * flow - answer[:, :, 0], flow=-flow)
    return change, np.asarray(rise - by_flow * flow)


def _tested(values: Array, first: Array, second: Array) -> Array:
    """The sums over the points across of values times two sets of functions, shape (cells, first, second)."""
    return np.asarray((first * values[:, None, :]) @ second.T)


def _next(values: Array) -> Array:
    return np.roll(values, -1, axis=0)


def _around(values: Array) -> Array:
    """The values of the cells at OFFSETS, shape (cells, 4, ...)."""
    return np.stack([np.roll(values, -offset, axis=0) for offset in OFFSETS], axis=1)
