"""Films in the plane: against another discretisation, a direct solver, symmetry, and what must not change."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.bicgstab import bicgstab
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.plane import plane_step
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson

LENGTH, LEAST, VISCOSITY, SPEED = 0.05, 20e-6, 0.03, 3.0


def parabolic(x, y):
    return LEAST * (1 + (2 * x / LENGTH - 1) ** 2) + 0 * y


def film(thickness=parabolic, theta=1.0, width=LENGTH, bulk=None, ends=None, **more):
    shape = Shape(thickness=thickness, breaks=(0.0, LENGTH), across=(0.0, width), wide=False)
    law = {} if bulk is None else {"compressibility": stiff(bulk)}
    ends = ends or Ends(theta=theta, sides=(0.0, 0.0))
    return Problem(shape=shape, ends=ends, speed=SPEED, viscosity=VISCOSITY, **law, **more)


def stiff(bulk):
    return ConstantBulkModulus.model_validate({"law": "constant_bulk_modulus", "bulk_modulus": f"{bulk!r} Pa"})


def load_with_reynolds_condition(cells):
    """∇·(h³∇p) = 6ηu ∂h/∂x, p >= 0, by central differences of the expanded equation and projected relaxation."""
    x = np.linspace(0, 1, cells + 1)
    h, slope = 1 + (2 * x - 1) ** 2, 4 * (2 * x - 1)
    step = 1 / cells
    east = h**3 / step**2 + 3 * h**2 * slope / (2 * step)
    west = h**3 / step**2 - 3 * h**2 * slope / (2 * step)
    side, source = h**3 / step**2, -slope
    p = np.zeros((cells + 1, cells + 1))
    red = np.add.outer(np.arange(1, cells), np.arange(1, cells)) % 2 == 0
    e, w, s, b = (values[1:-1, None] for values in (east, west, side, source))
    omega = 2 / (1 + np.sin(np.pi / cells))
    for _ in range(12 * cells):
        for colour in (red, ~red):
            inner = p[1:-1, 1:-1]
            fresh = (e * p[2:, 1:-1] + w * p[:-2, 1:-1] + s * (p[1:-1, 2:] + p[1:-1, :-2]) + b) / (4 * s)
            inner[colour] = np.maximum(0, inner + omega * (fresh - inner))[colour]
    return p.sum() * step**2 * 6 * VISCOSITY * SPEED * LENGTH / LEAST**2 * LENGTH**2


def test_the_slider_of_another_discretisation():
    coarse, fine = load_with_reynolds_condition(32), load_with_reynolds_condition(64)
    theirs = fine + (fine - coarse) / 3
    ours = solve(film(), (128, 128))
    assert ours.levels[-1].load == pytest.approx(theirs, rel=1e-3)
    assert abs(fine / theirs - 1) < 5e-3


@pytest.mark.parametrize("theta", [1.0, 0.8, 0.55])
@pytest.mark.parametrize("bulk", [5e7, 1e10])
def test_a_step_is_what_a_direct_solver_finds(theta, bulk, monkeypatch):
    steps = []

    def both(network, linear, _accuracy):
        found = plane_step(network, linear, accurate(linear, 1e-12))
        steps.append((np.abs(found - direct(linear)).max(), np.abs(direct(linear)).max()))
        return found

    monkeypatch.setattr("roughfilm.rom.cavitation.plane.plane_step", both)
    solve(film(theta=theta, bulk=bulk), (24, 20), tolerance=1e-12)
    assert steps
    assert all(error <= 1e-6 * size + 1e-6 for error, size in steps)


def joined(thickness, side=1e5):
    """A film that is periodic along the sliding, with the pressure ``side`` at its sides."""
    return Problem(
        shape=Shape(
            thickness=thickness, breaks=(0.0, LENGTH), across=(0.0, LENGTH / 2), wide=False, joined=(True, False)
        ),
        ends=Ends(sides=(side, side)),
        speed=SPEED,
        viscosity=VISCOSITY,
    )


def steep(x, y):
    """A film that narrows along the sliding and widens again where it is joined: full in few rows only."""
    return LEAST * (1.5 - x / LENGTH) + 0 * y


def eccentric(place):
    """A journal with its narrowest gap at a fraction ``place`` of the circumference."""
    return lambda x, y: LEAST * (1.0 - 0.8 * np.cos(2 * np.pi * (x / LENGTH - place))) + 0 * y


@pytest.mark.parametrize("thickness", [steep, eccentric(0.5), eccentric(0.9)])
@pytest.mark.parametrize("side", [1e3, 1e5])
def test_a_step_of_a_joined_film_is_what_a_direct_solver_finds(thickness, side, monkeypatch):
    errors = []

    def both(network, linear, _accuracy):
        found, exact = plane_step(network, linear, accurate(linear, 1e-12)), direct(linear)
        if max(network.shape) > 20:
            errors.append(np.abs(found - exact).max() / np.abs(exact).max())
        return found

    monkeypatch.setattr("roughfilm.rom.cavitation.plane.plane_step", both)
    found = solve(joined(thickness, side), (24, 16), tolerance=1e-12)
    assert (found.kind == CAVITY).any()
    assert errors
    assert max(errors) < 1e-6


def pocket(x, y):
    """A wedge with a rectangular pocket, from whose upstream wall a cavity begins."""
    inside = (np.abs(x / LENGTH - 0.35) < 0.15) & (np.abs(y / LENGTH - 0.5) < 0.35)
    return LEAST * (1.1 - 0.1 * x / LENGTH) + 0.4 * LEAST * inside


@pytest.mark.parametrize("cells", [64, 128, 256])
@pytest.mark.parametrize("which", ["pocket", "journal"])
def test_the_cycles_of_a_step_hardly_grow_with_the_grid(which, cells, monkeypatch):
    cycles = []

    def counted(product, inverse, *arguments, **more):
        def once(residual):
            cycles[-1] += 1
            return inverse(residual)

        cycles.append(0)
        return bicgstab(product, once, *arguments, **more)

    monkeypatch.setattr("roughfilm.rom.cavitation.plane.bicgstab", counted)
    monkeypatch.setattr(
        "roughfilm.rom.cavitation.plane.plane_step",
        lambda network, linear, _accuracy: plane_step(network, linear, accurate(linear, 1e-4)),
    )
    if which == "pocket":
        solve(film(pocket, ends=Ends(inlet=1e5, outlet=1e5, sides=(1e5, 1e5))), (cells, cells))
    else:
        solve(joined(eccentric(0.5)), (cells, cells))
    assert max(cycles) <= 30


def accurate(linear, reduction):
    """The norm of the balances times a reduction."""
    return reduction * np.linalg.norm(linear.balance)


def direct(linear):
    nx, ny = linear.kind.shape
    number = np.arange(nx * ny).reshape(nx, ny)
    shifts = {(0, 0): linear.centre, (-1, 0): linear.west, (1, 0): linear.east, (0, -1): linear.south, (0, 1): linear.north}  # fmt: skip  # noqa: E501
    columns = [np.roll(number, (-i, -j), (0, 1)).ravel() for i, j in shifts]
    rows = np.tile(number.ravel(), len(shifts))
    values = np.concatenate([part.ravel() for part in shifts.values()])
    matrix = coo_array((values, (rows, np.concatenate(columns))), shape=(nx * ny, nx * ny)).tocsc()
    return spsolve(matrix, -linear.balance.ravel()).reshape(nx, ny)


def test_loads_converge_at_second_order_starved_too():
    for theta in (1.0, 0.6):
        loads = [solve(film(theta=theta, bulk=7e7), (n, n)).levels[-1].load for n in (32, 64, 128, 256)]
        steps = np.abs(np.diff(loads))
        assert np.polyfit(range(3), np.log2(steps), 1)[0] < -1.6


def test_a_film_that_is_the_same_on_both_sides_stays_so():
    found = solve(film(theta=0.7, bulk=1e9), (48, 48))
    assert found.state.pressure[:, ::-1] == pytest.approx(found.state.pressure, rel=1e-5, abs=1e-3)


def test_units_change_nothing():
    big = solve(film(theta=0.7), (32, 32))
    shape = replace(film().shape, thickness=lambda x, y: parabolic(x / 1e3, y) * 1e3, breaks=(0.0, 1e3 * LENGTH), across=(0.0, 1e3 * LENGTH))  # fmt: skip  # noqa: E501
    small = solve(replace(film(theta=0.7), shape=shape, speed=1e3 * SPEED), (32, 32))
    assert small.levels[-1].load == pytest.approx(1e6 * big.levels[-1].load, rel=1e-8)


def test_odd_and_uneven_grids_agree():
    reference = solve(film(theta=0.7), (128, 128)).levels[-1].load
    for cells in ((127, 131), (96, 200), (64, 31)):
        assert solve(film(theta=0.7), cells).levels[-1].load == pytest.approx(reference, rel=1.5e-2)


def test_before_the_film_begins_a_row_carries_what_the_inlet_brought():
    found = solve(film(theta=0.55), (64, 64))
    torn = (found.kind[:, 1:-1] == CAVITY).cumprod(axis=0).astype(bool)  # from the inlet on, without a break
    before = torn & np.roll(torn, -2, axis=0)  # the last one is partly full, and may be fed by the film beside it
    quiet = before[:, 1:-1] & torn[:, 2:] & torn[:, :-2]
    carried = (found.state.fill * found.faces.mean)[:, 2:-2]
    assert quiet.sum() > 200
    assert carried[quiet] == pytest.approx(np.full(quiet.sum(), 0.55 * 2 * LEAST), rel=1e-9)


def test_a_wide_film_has_the_pressure_of_a_line_in_its_middle():
    plane = solve(film(width=40 * LENGTH, theta=0.7), (64, 64))
    line = solve(replace(film(theta=0.7), shape=replace(film().shape, wide=True), ends=Ends(theta=0.7)), (64, 1))
    assert plane.state.pressure[:, 32] == pytest.approx(line.state.pressure[:, 0], rel=1e-6, abs=1.0)


def test_pockets_tear_the_film_in_many_places():
    def pocketed(x, y):
        return parabolic(x, y) + 12e-6 * np.maximum(0, np.sin(12 * np.pi * x / LENGTH) * np.sin(6 * np.pi * y / LENGTH))

    law = DowsonHigginson.model_validate({"law": "dowson_higginson"})
    found = solve(film(pocketed, theta=0.9, compressibility=law), (96, 96))
    assert found.residual <= 1e-9
    assert (found.kind == CAVITY).any()
    assert found.state.pressure.min() == 0
    assert found.state.fill.max() == 1


def test_the_krylov_method_solves_what_is_not_symmetric_and_says_when_it_cannot():
    from roughfilm.contact.foundation.errors import ConvergenceError

    random = np.random.default_rng(20071)
    matrix = np.eye(30) * 4 + random.uniform(-0.2, 0.2, (30, 30))
    wanted = random.standard_normal((5, 6))

    def product(x):
        return (matrix @ x.ravel()).reshape(5, 6)

    found = bicgstab(product, lambda x: x / 4, wanted, tolerance=1e-12, limit=100)
    assert found.ravel() == pytest.approx(np.linalg.solve(matrix, wanted.ravel()), rel=1e-10)
    with pytest.raises(ConvergenceError, match="its residual went from"):
        bicgstab(product, lambda x: x / 4, wanted, tolerance=1e-12, limit=1)
