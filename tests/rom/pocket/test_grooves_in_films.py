"""What the shape of the wall does to a film: exact symmetries, limits, and independent sums, by quadrature."""

import numpy as np
import pytest

from roughfilm import rom
from roughfilm.rom.ladder.model import ladder
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.closed_form import inertia_pressure
from roughfilm.rom.pocket.groove import cylindrical

MODELS = {model.name: model for model in ladder(rom)}
QUADRATURE = pytest.mark.parametrize("model", [MODELS["reynolds"], MODELS["inertial_reynolds"]], ids=lambda m: m.name)
GROOVES = [
    {"width": "0.3 mm", "depth": "22.5 um"},
    {"profile": "splined", "width": "0.4 mm", "depth": "15 um", "shift": "-0.12 mm"},
    {"profile": "points", "points": [[-2e-4, 0.0], [-1.95e-4, 1.5e-6], [-1e-4, 2e-5], [0.0, 1e-5], [1.5e-4, 0.0]]},
]


def scene_of(length="1 mm", **geometry):
    return read_scene(
        {
            "name": "grooves",
            "kind": "pocket",
            "geometry": {"length": length, "film": "30 um", **geometry},
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"speed": "13 m/s"},
        }
    )


def value(result, name):
    return result.quantities[name].value


@QUADRATURE
@pytest.mark.parametrize("groove", GROOVES, ids=["cylindrical", "splined", "points"])
def test_two_equal_grooves_are_one_in_half_the_period(model, groove):
    one = scene_of("0.5 mm", **groove)
    two = scene_of("1 mm", grooves=[{"position": position, **groove} for position in ("-0.25 mm", "0.25 mm")])
    single, double = model.solve(one), model.solve(two)
    for name in ("load_per_area", "friction_per_area", "backflow"):
        assert value(double, name) == pytest.approx(value(single, name), rel=1e-10, abs=1e-9)
    for name in ("pressure_max_plus", "pressure_min_plus"):
        assert value(double, name) / two.plus_factor == pytest.approx(value(single, name) / one.plus_factor, rel=1e-10)


@QUADRATURE
def test_moving_a_groove_along_the_period_changes_no_friction_and_no_pressure_difference(model):
    """Only the place where p = 0 moves: load minus a constant, the same range of pressure."""
    here, there = (model.solve(scene_of(position=place, **GROOVES[0])) for place in ("0 m", "0.21 mm"))
    assert value(here, "friction_per_area") == pytest.approx(value(there, "friction_per_area"), rel=1e-12)
    ranges = [value(one, "pressure_max_plus") - value(one, "pressure_min_plus") for one in (here, there)]
    assert ranges[0] == pytest.approx(ranges[1], rel=1e-9)


def test_a_mirrored_spline_has_the_mirrored_pressure_without_inertia():
    """x to -x turns the speed round, and creeping pressure with it."""
    left, right = (
        MODELS["reynolds"].solve(scene_of(**{**GROOVES[1], "shift": shift})) for shift in ("-0.12 mm", "0.12 mm")
    )
    x, p = (left.fields[name].values for name in ("position", "pressure"))
    assert right.fields["position"].values[::-1] == pytest.approx(-x, abs=1e-15)
    assert right.fields["pressure"].values[::-1] == pytest.approx(-p, abs=1e-10 * np.abs(p).max())
    assert value(left, "load_per_area") == pytest.approx(-value(right, "load_per_area"), rel=1e-9)


@pytest.mark.parametrize("groove", GROOVES, ids=["cylindrical", "splined", "points"])
def test_pressure_extremes_are_those_of_the_densest_sampling(groove):
    """Also where the least creeping pressure, but not the least pressure, falls on an inner break of the gap."""
    scene = scene_of(**groove)
    gap, count = scene.gap(), 2_000_000
    x = ((np.arange(count) + 0.5) / count - 0.5) * gap.length
    h = gap.thickness(x) / gap.film
    q = (h**-2.0).mean() / (2 * (h**-3.0).mean())
    creeping = np.cumsum(6 / h**2 - 12 * q / h**3) / count * 100
    inertia = scene.reynolds_number * inertia_pressure(h, q) * scene.plus_factor
    for name, pressure in (("reynolds", creeping), ("inertial_reynolds", creeping + inertia)):
        result = MODELS[name].solve(scene)
        assert value(result, "pressure_max_plus") == pytest.approx(pressure.max(), rel=1e-4)
        assert value(result, "pressure_min_plus") == pytest.approx(pressure.min(), rel=1e-4)


@QUADRATURE
@pytest.mark.parametrize(("interpolation", "error", "order"), [("monotone", 1e-6, 3), ("linear", 2e-5, 1.9)])
def test_an_arc_through_points_carries_what_the_arc_carries(model, interpolation, error, order):
    """Straight lines leave out 1/n² of the area of a shallow arc, cubics a hundredth of that."""
    arc = cylindrical(width=3e-4, depth=2.25e-5)
    exact = model.solve(scene_of(**GROOVES[0]))
    errors = []
    for count in (20, 40):
        s = np.linspace(-1.5e-4, 1.5e-4, count + 1)
        points = np.column_stack([s, arc.depth(s)]).tolist()
        result = model.solve(scene_of(profile="points", interpolation=interpolation, points=points))
        errors.append(abs(value(result, "friction_per_area") / value(exact, "friction_per_area") - 1))
        lost = count**-2.0 if interpolation == "linear" else 1e-2 * count**-2.0
        assert value(result, "load_per_area") == pytest.approx(value(exact, "load_per_area"), rel=lost, abs=1e-6)
    assert errors[1] < error
    assert np.log2(errors[0] / errors[1]) > order


V = {"profile": "points", "points": [[-2.5e-4, 0.0], [0.5e-4, 2.25e-5], [2.5e-4, 0.0]]}


def wedge_integrals():
    """The integrals of h⁻² and h⁻³ over the period of the V, by hand: over a wedge from h1 to h2 their primitives."""
    land, film, deep, length = 20 * 25 / 30, 1.0, 1.75, 100 / 3
    wedge = 500 / 30  # both sides of the V, in film thicknesses
    assert land == pytest.approx(length - wedge)
    squared = land + wedge * (1 / film - 1 / deep) / (deep - film)
    cubed = land + wedge * (1 / film**2 - 1 / deep**2) / 2 / (deep - film)
    return squared, cubed, wedge, length


@QUADRATURE
def test_points_of_a_v_are_the_v_exactly(model):
    """Friction (1 - 6a)/h with a = q/h - 1/2 integrates to 4 <1/h> - 6q <1/h²>; 1/h over the wedges is a logarithm."""
    squared, cubed, wedge, length = wedge_integrals()
    flow = squared / (2 * cubed)
    inverse = (length - wedge) + wedge * np.log(1.75) / 0.75
    friction = (4 * inverse - 6 * flow * squared) / length
    scene = scene_of(**V)
    assert value(model.solve(scene), "friction_plus") == pytest.approx(friction * scene.plus_factor, rel=1e-12)


def test_the_load_of_a_v_is_that_of_an_independent_solution():
    """2.509 by Taylor-Hood finite elements of the Navier-Stokes equations over the V: w+ = 0.3, d+ = 0.5, Re = 100."""
    points = [[-1.5e-4, 0.0], [0.0, 1.5e-5], [1.5e-4, 0.0]]
    scene = scene_of(profile="points", points=points)
    scene = scene.model_copy(update={"motion": scene.motion.model_copy(update={"speed": 100 / 3.0})})
    assert scene.reynolds_number == pytest.approx(100)
    assert value(MODELS["film_slope"].solve(scene), "load_plus") == pytest.approx(2.509, rel=1e-3)


@pytest.mark.parametrize("model", [MODELS["film"], MODELS["film_slope"]], ids=lambda m: m.name)
def test_films_over_a_v_converge_at_second_order(model):
    loads, frictions = (
        np.array([value(model.solve(scene_of(**V), Request(resolution=n)), name) for n in (100, 200, 400)])
        for name in ("load_plus", "friction_plus")
    )
    for values in (loads, frictions):
        first, second = np.abs(np.diff(values))
        assert np.log2(first / second) > 1.7
    assert np.ptp(loads) < 3e-3 * abs(loads[-1])
