"""The extension of a displacement to the open gap, beside dense solutions of the half-space."""

import numpy as np
import pytest

from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.extension import PLAIN_ITERATIONS, Extension
from roughfilm.contact.mechanics.loop_ranges import Pieces

N = 192


@pytest.fixture(scope="module")
def patches():
    """Free nodes in about 1000 patches, a tenth of all, on a periodic grid."""
    rng = np.random.default_rng(20075)
    wave = np.fft.fftfreq(N) * N
    q = np.hypot(wave[:, None], wave[None, :])
    field = np.fft.ifft2(np.fft.fft2(rng.standard_normal((N, N))) * (q < N / 6) / (1 + q)).real
    return field > np.quantile(field, 0.9)


def extended(residual, free, *, members=1, iteration=PLAIN_ITERATIONS):
    """The extension of a residual, given on the whole grid, from the free nodes."""
    pieces = Pieces(free.shape, Team(members))
    nodes = [low + np.flatnonzero(free.reshape(-1)[low:high]) for low, high in pieces.nodes]
    pieces.reserve(max(map(len, nodes)))
    pieces.set_counts([len(listed) for listed in nodes])
    index = np.zeros(pieces.capacity * members, dtype=np.int32)
    values = np.zeros(index.size, dtype=np.float32)
    for first, listed in zip(pieces.firsts, nodes, strict=True):
        index[first : first + len(listed)] = listed
        values[first : first + len(listed)] = residual.reshape(-1)[listed]
    grid = np.full(free.size, np.nan, dtype=np.float32)
    spacing = (1 / free.shape[0], 1 / free.shape[0])
    Extension(free.shape, spacing, pieces).extend(index, values, grid, iteration=iteration)
    return grid.reshape(free.shape)


def exact_pressures(free, count, seed):
    """Random pressures on the free nodes with zero sum, white and smooth ones, and the displacements 2/|q| ∗ p."""
    rng = np.random.default_rng(seed)
    wave = 2 * np.pi * N * np.fft.fftfreq(N)
    q = np.hypot(wave[:, None], wave[None, :])
    q[0, 0] = np.inf
    for smoothness in np.linspace(0, 1.5, count):
        p = np.fft.ifft2(np.fft.fft2(rng.standard_normal((N, N))) / q**smoothness).real * free
        p[free] -= p[free].mean()
        yield p, np.fft.ifft2(np.fft.fft2(p) * 2 / q).real, q


def test_the_preconditioner_inverts_the_half_space_within_a_factor_of_three(patches):
    """Without the extension it is up to (p, |q| K p)/(p, p) times too large, about 1 + 2σ/q for long waves."""
    spread = {True: [], False: []}
    for p, u, q in exact_pressures(patches, 8, 20076):
        u[patches] -= u[patches].mean()
        for extends, displaced in ((True, extended(u, patches)), (False, np.where(patches, u, 0))):
            inverse = np.fft.ifft2(np.fft.fft2(displaced) * np.where(np.isinf(q), 0, q) / 2).real[patches]
            spread[extends].append(float(np.vdot(inverse, u[patches]) / np.vdot(p[patches], u[patches])))
    assert 0.8 < min(spread[True]) <= max(spread[True]) < 2.0
    assert max(spread[False]) > 2 * max(spread[True])


def test_free_nodes_keep_their_values_and_threads_change_nothing(patches):
    residual = np.random.default_rng(20077).standard_normal((N, N))
    one, many = (extended(residual, patches, members=members) for members in (1, 3))
    assert np.array_equal(one[patches], residual[patches].astype(np.float32))
    assert many == pytest.approx(one, abs=1e-6)
    assert np.isfinite(one).all()


def test_a_constant_is_extended_as_a_constant(patches):
    assert extended(np.ones((N, N)), patches) == pytest.approx(np.ones((N, N)), abs=0.05)


@pytest.mark.parametrize("shape", [(3000, 1), (1, 3000), (331, 200), (7, 5)])
def test_any_shape_is_covered(shape):
    rng = np.random.default_rng(20078)
    free = rng.random(shape) < 0.3
    grid = extended(rng.standard_normal(shape), free)
    assert np.isfinite(grid).all()


def test_the_first_iterations_on_a_small_grid_do_not_extend():
    free = np.random.default_rng(20079).random((64, 64)) < 0.2
    assert not extended(np.ones((64, 64)), free, iteration=0)[~free].any()
