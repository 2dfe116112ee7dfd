"""The thin film over a cell in plan against grooves, first-order theory, balances of force and Navier-Stokes."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.pocket.plan.film import solve
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow
from roughfilm.rom.pocket.plan.film.parallel import ParallelFilm
from roughfilm.rom.pocket.plan.film.sheet import sheet, sheet_of
from roughfilm.rom.pocket.plan.film.solve import on_sliding_wall, solve_sheet
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.thin_film import newton, thin_film
from roughfilm.rom.thin_film.basis import gauss_basis, sliding_wall_slope
from roughfilm.rom.thin_film.gap import Gap

FILM_SLOPE = find("pocket", "film_slope")


def smooth_plan(thickness, length=12.0, breadth=9.0):
    """A plan of unit film thickness from h(x, y)."""
    return Plan(
        length=length,
        breadth=breadth,
        film=1.0,
        thickness=thickness,
        breaks_x=(),
        breaks_y=(),
        mirrored=False,
        smallest=1.0,
    )


def profile(phase):
    """A smooth groove over a period of unit length whose middle is at 1/2."""
    return 1 + 0.5 * np.sin(np.pi * phase) ** 4


def groove_load(period, reynolds_number, *, with_slope, cells=400):
    """The mean pressure over a smooth groove by the film of a groove, zero at the ends of the period."""
    gap = Gap(film=1.0, breaks=(0.0, period), corners=(), thickness=lambda x: profile(x / period))
    strip = thin_film.strip(gap, cells)
    found = newton.solve(strip, reynolds_number, tolerance=1e-10, with_slope=with_slope)
    return float(strip.lengths @ (found.pressure[1:] + found.pressure[:-1]) / (2 * period))


def make_cell(reynolds_number=160.0, **dimple):
    """A scene with one dimple."""
    return Pocket.model_validate(
        {
            "name": "cell",
            "kind": "pocket",
            "geometry": {
                "length": "1 mm",
                "breadth": "1 mm",
                "film": "30 um",
                "dimples": [{"shape": "spherical", "width": "300 um", "depth": "15 um", **dimple}],
            },
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": reynolds_number},
        }
    )


@pytest.fixture(scope="module")
def spherical():
    """The film with slope over a spherical dimple on 48 columns."""
    return FILM_SLOPE.solve(make_cell(), Request(resolution=48))


@pytest.mark.parametrize("with_slope", [False, True])
def test_an_oblique_groove_is_one_under_the_sliding_across_it(with_slope):
    """The pressure over a groove at an angle is cos times that at Re cos: the velocity along it carries nothing."""
    length, breadth, reynolds_number = 16.0, 12.0, 60.0
    period = 1 / np.hypot(1 / length, 1 / breadth)
    cosine = period / length
    plan = smooth_plan(lambda x, y: profile(x / length + y / breadth), length, breadth)
    exact = cosine * groove_load(period, cosine * reynolds_number, with_slope=with_slope)
    errors = []
    for cells in (16, 32):
        wall = on_sliding_wall(solve_sheet(sheet(plan, cells), reynolds_number, tolerance=1e-9, with_slope=with_slope))
        errors.append(abs(wall.mean(wall.pressure) - wall.corner - exact) / abs(exact))
    assert errors[1] < 4e-3
    assert errors[1] < errors[0] / 3


def test_a_groove_in_plan_is_that_of_two_dimensions_on_the_same_columns(make_scene):
    scene = make_scene(0.3, 0.5, 160)
    gap, strip = scene.gap(), thin_film.strip(scene.gap(), 60)
    plan = Plan(
        length=gap.length,
        breadth=gap.film * 4,
        film=gap.film,
        thickness=lambda x, y: gap.thickness(x) + 0 * y,
        breaks_x=gap.breaks[1:-1],
        breaks_y=(),
        mirrored=True,
        smallest=gap.film,
    )
    grid = sheet_of(plan, strip.faces, np.linspace(-2, 2, 6), central=0.0)
    for with_slope, relative in ((False, 1e-4), (True, 3e-3)):
        expected = newton.solve(strip, 160.0, tolerance=1e-10, with_slope=with_slope)
        film = solve_sheet(grid, 160.0, tolerance=1e-10, with_slope=with_slope)
        rises = film.flow.pressure - film.flow.pressure[:1]
        assert rises == pytest.approx(
            np.broadcast_to(expected.pressure[:-1, None], rises.shape), abs=relative * np.ptp(expected.pressure)
        )
        assert np.ptp(rises, axis=1) == pytest.approx(0, abs=1e-6)


def test_a_little_inertia_is_that_of_first_order():
    """Against the formulas of docs/theory/thin-film.md, solved with Fourier series."""
    length, breadth, nx, ny = 12.0, 9.0, 21, 15
    plan = smooth_plan(
        lambda x, y: (
            1 + 0.25 * np.sin(2 * np.pi * x / length + 0.5) + 0.2 * np.cos(2 * np.pi * (x / length + y / breadth))
        )
    )
    pressure, stress = _first_order(plan, nx, ny)
    grid = sheet_of(plan, np.linspace(-6, 6, 3 * nx + 1), np.linspace(-4.5, 4.5, 3 * ny + 1))
    film, slower = (solve_sheet(grid, number, tolerance=1e-11, with_slope=False) for number in (0.02, 0.01))
    change = (film.flow.pressure - slower.flow.pressure)[::3, ::3] / 0.01
    change -= change.mean()
    assert change == pytest.approx(pressure - pressure.mean(), abs=0.01 * np.ptp(pressure))
    halfway = [(1 + one.flow.along @ sliding_wall_slope(one.flow.modes)) / grid.thickness[0] for one in (film, slower)]
    shear = (halfway[0] - halfway[1]) / 0.01
    at_nodes = (shear + np.roll(shear, 1, axis=0))[::3, ::3] / 2
    assert at_nodes == pytest.approx(stress, abs=0.03 * np.ptp(stress))


def _first_order(plan, nx, ny):
    """The pressure and the shear stress on the sliding wall that inertia adds per unit of Re, by Fourier series."""
    x = np.arange(nx) * plan.length / nx - plan.length / 2
    y = np.arange(ny) * plan.breadth / ny - plan.breadth / 2
    h = plan.thickness(x[:, None], y).ravel()

    def derivative(number, length):
        waves = 2j * np.pi * np.fft.fftfreq(number, length / number)[:, None]
        return np.fft.ifft(waves * np.fft.fft(np.eye(number), axis=0), axis=0).real

    dx, dy = np.kron(derivative(nx, plan.length), np.eye(ny)), np.kron(np.eye(nx), derivative(ny, plan.breadth))
    operator = dx @ np.diag(h**3 / 12) @ dx + dy @ np.diag(h**3 / 12) @ dy
    p = np.linalg.lstsq(operator, dx @ h / 2)[0]
    a, b, rise = -(h**2) / 12 * (dx @ p), -(h**2) / 12 * (dy @ p), dx @ h
    cx = dx @ (h * (1 / 20 + a / 5 + 9 * a**2 / 35)) + dy @ (h * b * (1 / 10 + 9 * a / 35)) + rise * (1 / 60 + a / 70)
    cy = dx @ (h * b * (1 / 10 + 9 * a / 35)) + dy @ (9 * h * b**2 / 35) + rise * b / 70
    p1 = np.linalg.lstsq(operator, -dx @ (h**2 / 2 * cx) - dy @ (h**2 / 2 * cy))[0]
    d = dx @ (h * (1 / 4 + 3 * a / 5 + 3 * a**2 / 5)) + dy @ (h * b * (3 / 10 + 3 * a / 5)) - rise * (1 / 20 + a / 10)
    return p1.reshape(nx, ny), (h / 2 * (dx @ p1) + d).reshape(nx, ny)


def test_forces_on_the_whole_film_balance():
    """Walls and pressure balance along x and y, which none of the test functions demands."""
    plan = smooth_plan(lambda x, y: 1 + 0.5 * np.sin(np.pi * (x / 12 + y / 9)) ** 4 * np.cos(np.pi * x / 12) ** 2)
    film = solve_sheet(sheet(plan, 64), 80.0, tolerance=1e-9, with_slope=False)
    grid, flow = film.sheet, film.flow
    top = sliding_wall_slope(flow.modes)
    bottom = -top * (-1.0) ** np.arange(flow.modes)
    friction = float((grid.areas[0] / grid.thickness[0]).sum())
    for axis, amplitudes in enumerate((flow.along, flow.across)):
        walls = float((grid.areas[axis] / grid.thickness[axis] * (amplitudes @ (top - bottom))).sum())
        rise = np.roll(flow.pressure, -1, axis=axis) - flow.pressure
        form = float((grid.thickness[axis] * rise * grid.around[1 - axis]).sum())
        assert walls == pytest.approx(form, abs=3e-4 * friction)
        assert abs(walls) > 3e-3 * friction or axis


def test_the_preconditioner_solves_disturbances_of_shear_between_parallel_walls():
    plan = smooth_plan(lambda x, y: 1.3 + 0 * x + 0 * y)
    film = Film(sheet=sheet(plan, 16), basis=gauss_basis(4), reynolds_number=70.0)
    shear = film.still()
    right = SheetFlow(flat=np.random.default_rng(1905).normal(size=shear.flat.size), shape=shear.shape)
    right.pressure[:] -= right.pressure.mean()
    answer = ParallelFilm.of(film).solve(right)
    assert film.change(film.velocities(shear), answer).flat == pytest.approx(right.flat, abs=1e-9)


def test_the_linear_equations_are_the_derivative_of_the_balances():
    plan = smooth_plan(lambda x, y: 1 + 0.4 * np.sin(2 * np.pi * x / 12) * np.cos(2 * np.pi * y / 9))
    film = Film(sheet=sheet(plan, 16), basis=gauss_basis(5), reynolds_number=50.0)
    random = np.random.default_rng(1886)
    flow, change = (SheetFlow(flat=random.normal(size=film.still().flat.size), shape=film.sheet.shape) for _ in "ab")
    velocities = film.velocities(flow)
    linear = film.change(velocities, change).flat
    size = 1e-7
    ahead, behind = (SheetFlow(flat=flow.flat + sign * size * change.flat, shape=flow.shape) for sign in (1, -1))
    difference = (
        film.imbalance(ahead, film.velocities(ahead)).flat - film.imbalance(behind, film.velocities(behind)).flat
    )
    assert linear == pytest.approx(difference / (2 * size), abs=1e-5 * np.abs(linear).max())


def test_with_slope_it_is_close_to_navier_stokes(spherical):
    """Against OpenFOAM on 48 and 96 columns, extrapolated with order 2."""
    assert spherical.quantities["load_plus"].value == pytest.approx(1.0442, rel=0.01)
    assert spherical.quantities["load_from_corner_plus"].value == pytest.approx(0.4815, rel=0.01)
    assert spherical.quantities["friction_plus"].value == pytest.approx(2.97695, rel=3e-4)


def test_the_uncertainty_covers_the_difference_to_a_finer_grid(spherical):
    coarse = FILM_SLOPE.solve(make_cell(), Request(resolution=32))
    for name in ("load_plus", "friction_plus", "pressure_max_plus", "load_from_corner_plus"):
        fine, uncertainty = spherical.quantities[name], coarse.quantities[name].uncertainty
        assert abs(coarse.quantities[name].value - fine.value) < uncertainty
        assert fine.uncertainty < uncertainty < 0.2 * abs(fine.value)


def test_a_mirrored_cell_has_a_mirrored_pressure(spherical):
    pressure = spherical.fields["pressure"].values
    assert pressure == pytest.approx(pressure[:, ::-1], abs=1e-4 * np.abs(pressure).max())


@pytest.mark.parametrize(("scheme", "lowest"), [("linear_upwind", 1.6), ("upwind", 0.7)])
def test_order_of_accuracy_in_load(scheme, lowest):
    plan = smooth_plan(
        lambda x, y: 1 + 0.5 * profile(x / 12) * np.cos(np.pi * y / 9) ** 2 * (1 + 0.5 * np.sin(2 * np.pi * x / 12))
    )
    loads = []
    for cells in (16, 32, 64):
        wall = on_sliding_wall(
            solve_sheet(
                sheet(plan, cells, second_order=scheme == "linear_upwind"), 60.0, tolerance=1e-8, with_slope=False
            )
        )
        loads.append(wall.mean(wall.pressure) - wall.edge_mean)
    assert np.log2(abs((loads[0] - loads[1]) / (loads[1] - loads[2]))) > lowest


def test_a_search_without_end_stops_after_a_number_of_products(monkeypatch):
    monkeypatch.setattr(solve, "MAX_TOTAL_PRODUCTS", 20)
    monkeypatch.setattr(solve.newton, "MAX_PRODUCTS", 10)
    grid = sheet(make_cell(300.0, depth="90 um").plan(), 16)
    with pytest.raises(ConvergenceError, match=r"did not converge to a steady flow at Re = 300 in \d\d iterations"):
        solve_sheet(grid, 300.0, tolerance=1e-8, with_slope=False)


def test_a_film_that_is_not_converged_has_no_uncertainty():
    scene = make_cell(100.0)
    loose, tight = (FILM_SLOPE.solve(scene, Request(resolution=32, tolerance=size)) for size in (1e-2, 1e-8))
    assert abs(loose["load_plus"].value / tight["load_plus"].value - 1) > 1e-3
    assert loose["load_plus"].uncertainty is None
    assert any("the residual is above 1e-07" in one for one in loose.warnings)
    assert tight["load_plus"].uncertainty is not None
