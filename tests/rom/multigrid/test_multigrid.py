"""The multigrid preconditioner against sparse elimination, on awkward grids."""

import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import spsolve

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.multigrid.gradients import apply
from roughfilm.rom.multigrid.multigrid import Multigrid

NOWHERE, FIRST, SECOND, BOTH = (False, False), (True, False), (False, True), (True, True)
EDGES = [NOWHERE, FIRST, SECOND, BOTH]
SHAPES = [(1, 1), (1, 2), (2, 1), (1, 9), (9, 1), (2, 2), (2, 3), (3, 2), (3, 3), (4, 7), (13, 17), (16, 12), (19, 5)]


def harmonic(first, second):
    return 2 * first * second / (first + second)


def film(conductance, periodic=NOWHERE, *, ratio=1.0, mask=None, leak=0.0, open_ends=True):
    """Centre, east and north; pressure is given half a node beyond the ends, and at the masked nodes."""
    k = conductance
    east = ratio * harmonic(k, np.roll(k, -1, 0))
    north = harmonic(k, np.roll(k, -1, 1))
    if not periodic[0]:
        east[-1] = 0
    if not periodic[1]:
        north[:, -1] = 0
    centre = leak * k + east + np.roll(east, 1, 0) + north + np.roll(north, 1, 1)
    if open_ends and not periodic[0]:
        centre[0] += 2 * ratio * k[0]
        centre[-1] += 2 * ratio * k[-1]
    if open_ends and not periodic[1]:
        centre[:, 0] += 2 * k[:, 0]
        centre[:, -1] += 2 * k[:, -1]
    if mask is not None:
        east[mask | np.roll(mask, -1, 0)] = 0
        north[mask | np.roll(mask, -1, 1)] = 0
        centre[mask] = 1
    return centre, east, north


def whole(centre, east, north, periodic):
    """The same matrix, made entry by entry from its definition."""
    rows, columns = centre.shape
    matrix = sparse.lil_matrix((centre.size, centre.size))
    for i in range(rows):
        for j in range(columns):
            here = i * columns + j
            matrix[here, here] += centre[i, j]
            ends = []
            if i + 1 < rows or periodic[0]:
                ends.append(((i + 1) % rows * columns + j, east[i, j]))
            if j + 1 < columns or periodic[1]:
                ends.append((i * columns + (j + 1) % columns, north[i, j]))
            for there, coupling in ends:
                matrix[here, there] -= coupling
                matrix[there, here] -= coupling
    return matrix.tocsc()


def rough(shape, seed, hurst=0.8):
    """A self-affine periodic surface of rms 1 without roll-off."""
    random = np.random.default_rng(seed)
    q = np.hypot(shape[0] * np.fft.fftfreq(shape[0])[:, None], shape[1] * np.fft.rfftfreq(shape[1]))
    q[0, 0] = np.inf
    height = np.fft.irfft2(np.fft.rfft2(random.normal(size=shape)) * np.maximum(q, 4) ** (-1 - hurst), s=shape)
    return height / height.std()


def masked_film(size, seed, periodic=NOWHERE, ratio=1.0):
    """A rough film that is 20 % out of the problem and 1e9 apart in h³, and its wedge term."""
    height = rough((size, size), seed)
    height -= np.quantile(height, 0.2)
    mask = height <= 0
    height = np.maximum(height / height.max(), 1e-3)
    source = np.where(mask, 0, np.roll(height, 1, 0) - np.roll(height, -1, 0))
    return film(height**3, periodic, mask=mask, ratio=ratio), source


@pytest.mark.parametrize("periodic", EDGES)
@pytest.mark.parametrize("shape", SHAPES)
def test_it_solves_what_elimination_solves(shape, periodic):
    random = np.random.default_rng(sum(shape) + 701)
    matrix = film(np.exp(2 * random.normal(size=shape)), periodic, leak=0.01)
    b = random.normal(size=shape)
    expected = spsolve(whole(*matrix, periodic), b.ravel()).reshape(shape)
    solved = Multigrid(*matrix, periodic=periodic).solve(b, tolerance=1e-12)
    assert np.abs(solved.solution - expected).max() < 1e-9 * np.abs(expected).max()
    assert solved.iterations <= 14


@pytest.mark.parametrize("periodic", EDGES)
@pytest.mark.parametrize("shape", SHAPES)
def test_the_operator_is_what_its_equation_says(shape, periodic):
    random = np.random.default_rng(sum(shape) + 1303)
    centre, east, north, p = random.random((4, *shape))
    expected = (whole(centre, east, north, periodic) @ p.ravel()).reshape(shape)
    assert apply(centre, east, north, p, periodic) == pytest.approx(expected, rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("periodic", EDGES)
@pytest.mark.parametrize("shape", [(1, 8), (7, 11), (12, 9), (16, 16)])
@pytest.mark.parametrize("ratio", [1e-3, 1.0, 1e3])
def test_the_cycle_is_symmetric_positive_and_close_to_the_inverse(shape, periodic, ratio):
    random = np.random.default_rng(2203)
    mask = random.random(shape) < 0.1
    matrix = film(10 ** (-3 * random.random(shape)), periodic, ratio=ratio, mask=mask, leak=1e-3)
    multigrid = Multigrid(*matrix, periodic=periodic)
    units = np.eye(mask.size).reshape(-1, *shape)
    inverse = np.array([multigrid.cycle(unit).ravel() for unit in units])
    assert np.abs(inverse - inverse.T).max() < 1e-12 * np.abs(inverse).max()
    root = np.linalg.cholesky(whole(*matrix, periodic).toarray())
    values = np.linalg.eigvalsh(root.T @ ((inverse + inverse.T) / 2) @ root)
    assert 0.05 < values.min() <= values.max() < 1 + 1e-8


def test_the_cycle_is_linear():
    random = np.random.default_rng(88)
    multigrid = Multigrid(*film(random.random((14, 9)) + 0.01, SECOND), periodic=SECOND)
    first, second = random.normal(size=(2, 14, 9))
    expected = 3 * multigrid.cycle(first) - 1e6 * multigrid.cycle(second)
    assert multigrid.cycle(3 * first - 1e6 * second) == pytest.approx(expected, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("periodic", EDGES)
@pytest.mark.parametrize("shape", [(23, 31), (32, 24)])
def test_holes_of_any_shape_and_single_nodes_between_them(shape, periodic):
    random = np.random.default_rng(419)
    mask = random.random(shape) < 0.45
    mask[5, :] = True
    mask[8:11, 3:6] = True
    mask[9, 4] = False
    matrix = film(10 ** (-9 * random.random(shape)), periodic, mask=mask, leak=1e-2)
    b = random.normal(size=shape)
    expected = spsolve(whole(*matrix, periodic), b.ravel()).reshape(shape)
    solution = Multigrid(*matrix, periodic=periodic).solve(b, tolerance=1e-11).solution
    assert solution[mask] == pytest.approx(b[mask])
    scaled = np.abs(solution - expected) * matrix[0]
    assert scaled.max() < 1e-7 * np.abs(b).max()


def test_jumps_of_1e9_between_neighbours():
    random = np.random.default_rng(5077)
    matrix = film(np.where(random.random((24, 24)) < 0.5, 1e-9, 1.0))
    p = random.normal(size=(24, 24))
    b = (whole(*matrix, NOWHERE) @ p.ravel()).reshape(p.shape)
    solved = Multigrid(*matrix).solve(b)
    left = b - (whole(*matrix, NOWHERE) @ solved.solution.ravel()).reshape(p.shape)
    assert solved.residual == pytest.approx(np.linalg.norm(left) / np.linalg.norm(b), rel=1e-3)
    assert solved.residual <= 1e-10


@pytest.mark.parametrize("shape", [(1, 12), (12, 1), (15, 16), (16, 15), (33, 33)])
def test_without_any_given_pressure_the_mean_is_free(shape):
    random = np.random.default_rng(613)
    matrix = film(np.exp(random.normal(size=shape)), BOTH)
    expected = random.normal(size=shape)
    b = (whole(*matrix, BOTH) @ expected.ravel()).reshape(shape)
    solution = Multigrid(*matrix, periodic=BOTH).solve(b).solution
    assert solution - solution.mean() == pytest.approx(expected - expected.mean(), abs=1e-6)


def test_closed_pockets_beside_an_open_film():
    random = np.random.default_rng(911)
    shape = (20, 27)
    k = np.exp(random.normal(size=shape))
    wall = np.zeros(shape, dtype=bool)
    wall[4:10, [5, 12]] = wall[[4, 9], 5:13] = True
    wall[14, 8:11] = wall[16, 8:11] = wall[15, [8, 10]] = True
    centre, east, north = film(k, leak=0.0)
    open_centre = centre - east - np.roll(east, 1, 0) - north - np.roll(north, 1, 1)
    east[wall | np.roll(wall, -1, 0)] = 0
    north[wall | np.roll(wall, -1, 1)] = 0
    centre = open_centre + east + np.roll(east, 1, 0) + north + np.roll(north, 1, 1)
    centre[wall] = 1
    centre[15, 9] = 0
    pocket = np.zeros(shape, dtype=bool)
    pocket[5:9, 6:12] = True
    expected = random.normal(size=shape)
    expected[15, 9] = 0
    b = (whole(centre, east, north, NOWHERE) @ expected.ravel()).reshape(shape)
    solution = Multigrid(centre, east, north).solve(b).solution
    difference = solution - expected
    assert difference[pocket] == pytest.approx(difference[pocket].mean(), abs=1e-7)
    assert difference[~pocket] == pytest.approx(0, abs=1e-7)


@pytest.mark.parametrize("seed", [311, 313, 317])
def test_rough_contacts_that_no_flow_enters_close_many_pockets(seed):
    size = 96
    height = rough((size, size), seed)
    height -= np.quantile(height, 0.3)
    contact = height <= 0
    k = np.maximum(height / height.max(), 1e-3) ** 3
    _, east, north = film(k, mask=contact)
    leak = np.zeros_like(k)
    leak[[0, -1]] = np.where(contact, 0, k)[[0, -1]]
    centre = leak + east + np.roll(east, 1, 0) + north + np.roll(north, 1, 1)
    matrix = whole(np.where(centre == 0, 1, centre), east, north, NOWHERE)
    matrix.eliminate_zeros()
    label = connected_components(matrix, directed=False)[1]
    open_piece = np.bincount(label, (leak + (centre == 0)).ravel()) > 0
    assert np.count_nonzero(~open_piece) >= 3
    b = np.random.default_rng(seed + 1).normal(size=k.shape) * np.sqrt(centre)
    b -= np.where(open_piece, 0, np.bincount(label, b.ravel()) / np.bincount(label))[label].reshape(k.shape)
    solved = Multigrid(np.where(centre == 0, 1, centre), east, north).solve(b)
    left = b.ravel() - matrix @ solved.solution.ravel()
    assert np.linalg.norm(left) < 2e-10 * np.linalg.norm(b)
    assert solved.iterations <= 25


@pytest.mark.parametrize("size", [64, 97, 128, 255, 256])
def test_iterations_for_a_slider_hardly_depend_on_the_grid(size):
    height = np.linspace(2.5, 1, size)[:, None] * np.ones(size)
    assert Multigrid(*film(height**3)).solve(height).iterations <= 9


@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 0.3, 1.0, 3.0, 1e2, 1e4])
@pytest.mark.parametrize("periodic", [NOWHERE, BOTH])
def test_iterations_hardly_depend_on_the_anisotropy(ratio, periodic):
    height = 4 + rough((128, 131), 3001)
    b = np.random.default_rng(733).normal(size=height.shape)
    matrix = film(height.clip(0.3) ** 3, periodic, ratio=ratio, leak=1e-3)
    assert Multigrid(*matrix, periodic=periodic).solve(b).iterations <= 11


@pytest.mark.parametrize("periodic", EDGES)
@pytest.mark.parametrize("size", [64, 129, 256])
def test_iterations_for_rough_films_with_holes(size, periodic):
    matrix, source = masked_film(size, 20077, periodic)
    assert Multigrid(*matrix, periodic=periodic).solve(source).iterations <= 25


@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 1e2, 1e4])
def test_iterations_for_stretched_rough_films_with_holes(ratio):
    matrix, source = masked_film(256, 20089, ratio=ratio)
    assert Multigrid(*matrix).solve(source, tolerance=1e-9).iterations <= 25


def test_a_good_start_saves_iterations():
    matrix, source = masked_film(64, 557)
    multigrid = Multigrid(*matrix)
    first = multigrid.solve(source)
    near = multigrid.solve(source, start=first.solution * (1 + 1e-7))
    assert near.iterations < first.iterations / 2
    assert multigrid.solve(source, start=first.solution).iterations == 0


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("size", [1e5, 1e8])
def test_a_start_that_is_far_off_in_a_weakly_coupled_part_costs_few_iterations(single, size):
    random = np.random.default_rng(20071)
    gap = np.exp(0.3 * random.normal(size=(64, 64)))
    east, north = ((gap + np.roll(gap, -1, axis)) / 2 for axis in (0, 1))
    east[[15, 47]] *= 1e-3
    centre = east + np.roll(east, 1, 0) + north + np.roll(north, 1, 1)
    source = north - np.roll(north, 1, 1)
    start = np.zeros((64, 64))
    start[16:48] = size
    multigrid = Multigrid(centre, east, north, periodic=(True, True), single=single)
    fresh = multigrid.minimise(source, None, tolerance=1e-3)
    started = multigrid.minimise(source, None, tolerance=1e-3, start=start)
    assert started.iterations <= fresh.iterations + 5
    assert (source * started.solution).sum() == pytest.approx((source * fresh.solution).sum(), rel=1e-6)


def test_nothing_given_is_nothing_found_and_arguments_stay():
    matrix, source = masked_film(20, 83)
    before = [part.copy() for part in (*matrix, source)]
    multigrid = Multigrid(*matrix)
    multigrid.solve(source)
    multigrid.cycle(source)
    assert not multigrid.solve(np.zeros_like(source), start=source).solution.any()
    assert all(np.array_equal(now, then) for now, then in zip((*matrix, source), before, strict=True))


def test_what_cannot_be_solved_is_said_in_a_line():
    ones = np.ones((12, 12))
    multigrid = Multigrid(4 * ones, ones, ones, periodic=BOTH)
    with pytest.raises(ConvergenceError, match="without a Dirichlet node") as closed:
        multigrid.solve(ones)
    assert "\n" not in str(closed.value)
    matrix, source = masked_film(64, 97)
    with pytest.raises(ConvergenceError, match="after 3 iterations") as short:
        Multigrid(*matrix).solve(source, limit=3)
    assert short.value.iterations == 3
    with pytest.raises(ConvergenceError, match="nan"):
        Multigrid(*matrix).solve(np.where(source > 0, np.nan, source))


@pytest.mark.parametrize("shapes", [((3, 4), (4, 3), (3, 4)), ((5,), (5,), (5,)), ((0, 3), (0, 3), (0, 3))])
def test_arrays_that_do_not_fit_are_refused(shapes):
    with pytest.raises(InputError, match="one shape"):
        Multigrid(*(np.ones(shape) for shape in shapes))
    multigrid = Multigrid(5 * np.ones((3, 4)), np.ones((3, 4)), np.ones((3, 4)))
    for ask in (multigrid.solve, multigrid.cycle):
        with pytest.raises(InputError, match=r"\(3, 4\)"):
            ask(np.ones((4, 3)))


def test_a_preconditioner_that_gains_nothing_is_not_believed(monkeypatch):
    """One that goes where chance has it gains next to nothing, as if there were nothing left to gain."""
    centre, east, north = film(np.exp(rough((48, 48), 31)), BOTH)
    source = east - np.roll(east, 1, 0)
    whole_energy = float(east.sum())
    chance = np.random.default_rng(33)

    def by_chance(self):
        given, values = self._finest
        noise = chance.normal(size=given.shape)
        values[:] = noise * (noise * given).sum()

    monkeypatch.setattr(Multigrid, "_cycle", by_chance)
    with pytest.raises(ConvergenceError, match="may change by"):
        Multigrid(centre, east, north, periodic=BOTH).minimise(source, whole_energy, tolerance=1e-3)
