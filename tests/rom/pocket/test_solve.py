"""The thin-film rungs against exact solutions, the rungs below, and full Navier-Stokes."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import airy

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.thin_film import thin_film
from roughfilm.rom.thin_film.basis import gauss_basis
from roughfilm.rom.thin_film.newton import MODES

MODELS = of_kind(ladder(rom), "pocket")
FILM, FILM_SLOPE, REYNOLDS = (find("pocket", name) for name in ("film", "film_slope", "reynolds"))
INERTIAL_REYNOLDS = find("pocket", "inertial_reynolds")


def value(result, name="load_plus"):
    return result.quantities[name].value


def solved(scene, resolution, reynolds_number, modes=MODES):
    """The cells, the basis and the flow of the film equations by Newton's method from creeping flow."""
    film, across = thin_film.strip(scene.gap(), resolution), gauss_basis(modes)
    state = thin_film.creeping(film, modes)
    for _ in range(8):
        linear = thin_film.linearise(film, across, reynolds_number, state)
        change, _ = thin_film.step(film, across, linear, linear.imbalance)
        state = thin_film.StripFlow(amplitudes=state.amplitudes + change.amplitudes, flow=state.flow + change.flow)
    return film, across, state


def test_without_inertia_it_is_the_reynolds_equation(make_scene):
    scene = make_scene(0.3, 0.75, 1e-6)
    film, reynolds = FILM.solve(scene), REYNOLDS.solve(scene, Request(resolution=400))
    for name in ("friction_plus", "pressure_max_plus", "pressure_min_plus", "backflow"):
        assert value(film, name) == pytest.approx(value(reynolds, name), rel=3e-3, abs=1e-9)
    assert abs(value(film)) < 1e-5


@pytest.mark.parametrize("depth", [0.25, 1.0])
def test_a_little_inertia_is_that_of_first_order(make_scene, depth):
    scene = make_scene(0.3, depth, 0.01)
    assert value(FILM.solve(scene)) == pytest.approx(value(INERTIAL_REYNOLDS.solve(scene)), rel=1e-3)


def test_behind_a_groove_the_flow_returns_to_shear_as_the_exact_eigenfunction_does(make_scene):
    """u - Y ~ exp(-κx/Re) f(Y), f' = g with g'' + κ Y g = 0, ∫g = ∫Yg = 0: Airy functions of -κ^(1/3) Y."""

    def determinant(kappa):
        def moment(which, power):
            return quad(lambda y: y**power * airy(-(kappa ** (1 / 3)) * y)[which], 0, 1)[0]

        return moment(0, 0) * moment(2, 1) - moment(0, 1) * moment(2, 0)

    places = np.linspace(10, 150, 141)
    signs = np.sign([determinant(kappa) for kappa in places])
    turn = int(np.flatnonzero(np.diff(signs))[0])
    kappa = brentq(determinant, places[turn], places[turn + 1])

    reynolds_number = 100.0
    film, _, state = solved(make_scene(0.15, 1e-3, reynolds_number), 2000, reynolds_number)
    behind = (film.centres > 12) & (film.centres < 15)
    decay = np.polyfit(film.centres[behind], np.log(np.abs(state.amplitudes[behind, 0])), 1)[0]
    assert -decay * reynolds_number == pytest.approx(kappa, rel=5e-3)


def test_forces_on_the_whole_film_balance(make_scene):
    """∫(shear on the sliding wall - shear on the still wall - p h') dx = 0, which none of the test functions knows."""
    errors = []
    for modes in (4, 10):
        film, across, state = solved(make_scene(0.4, 0.5, 80), 800, 80.0, modes)
        linear = thin_film.linearise(film, across, 80.0, state)
        pressure = np.cumsum(thin_film.pressure_rise(film, across, linear.imbalance))
        k = np.arange(modes)
        slope = np.sqrt(4 * k + 6)
        a = thin_film.all_amplitudes(film, across, state)
        top, bottom = 1 - a @ slope, 1 + a @ (slope * (-1.0) ** k)
        shear = (film.lengths / film.thickness * (top - bottom)).sum()
        drag = (pressure[:-1] * np.diff(film.thickness)).sum()
        errors.append(abs(shear + drag) / (film.lengths / film.thickness * top).sum())
    assert errors[1] < 2e-4
    assert errors[1] < errors[0] / 5


@pytest.mark.parametrize(("scheme", "lowest", "highest"), [("linear_upwind", 1.6, 2.6), ("upwind", 0.7, 1.3)])
def test_order_of_accuracy_in_load(make_scene, scheme, lowest, highest):
    scene = make_scene(0.3, 0.5, 120)
    loads = [value(FILM.solve(scene, Request(resolution=n, scheme=scheme))) for n in (100, 200, 400)]
    order = np.log2(abs((loads[0] - loads[1]) / (loads[1] - loads[2])))
    assert lowest < order < highest


@pytest.mark.parametrize("width", [0.15, 0.5])
@pytest.mark.parametrize("depth", [0.25, 1.25])
@pytest.mark.parametrize("reynolds_number", [40, 160])
def test_it_converges_at_the_ends_of_the_published_sweep(make_scene, width, depth, reynolds_number):
    result = FILM.solve(make_scene(width, depth, reynolds_number), Request(resolution=800))
    assert result.numerics.residual < 1e-11
    assert result.numerics.iterations <= 6


@pytest.mark.parametrize(
    ("width", "depth", "reynolds_number", "load"),
    [
        (0.15, 0.5, 160, 1.603),
        (0.3, 0.25, 160, 3.303),
        (0.3, 0.5, 40, 1.261),
        (0.3, 0.75, 160, 4.179),
        (0.5, 0.75, 160, 9.750),
        (0.5, 1.0, 40, 2.900),
    ],
)
def test_slope_to_second_order_takes_most_of_what_separates_the_film_from_navier_stokes(
    make_scene, width, depth, reynolds_number, load
):
    scene = make_scene(width, depth, reynolds_number)
    film, corrected = (value(model.solve(scene)) for model in (FILM, FILM_SLOPE))
    assert load < film < 1.05 * load
    assert abs(corrected - load) < 0.25 * abs(film - load)


def test_slope_in_creeping_flow_agrees_with_resolved_stokes_flow(make_scene):
    """Reference: an independent Stokes solver, w+ = 0.3, d+ = 0.25: friction 2.9172, greatest pressure 6.98."""
    result = FILM_SLOPE.solve(make_scene(0.3, 0.25, 1e-6))
    assert value(result, "friction_plus") == pytest.approx(2.9172, abs=1e-4)
    assert value(result, "pressure_max_plus") == pytest.approx(6.98, rel=3e-3)


def test_newton_without_convergence_is_an_error(make_scene):
    from roughfilm.contact.foundation.errors import ConvergenceError

    with pytest.raises(ConvergenceError, match=r"did not converge to a steady flow above Re = .*requested: 5000"):
        FILM.solve(make_scene(0.3, 3.0, 5000), Request(resolution=100))


@pytest.mark.parametrize("options", [{"resolution": 3}, {"tolerance": 0.0}, {"scheme": "central"}, {"processes": 2}])
def test_numbers_out_of_range_are_refused(make_scene, options):
    with pytest.raises(InputError, match=f"{next(iter(options))}: got"):
        FILM.solve(make_scene(0.3, 0.5, 40), Request(**options))
