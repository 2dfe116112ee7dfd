"""Pads about a pivot: closed forms, quadrature, limits, symmetry and errors."""

import math
from functools import cache

import numpy as np
import pytest
import scipy

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.sliding import centre_of_pressure, linear_slider
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

LENGTH, VISCOSITY, SPEED, PRESSURE = 0.04, 0.03, 10.0, 2e6
WIDE = {"shape": "pivoted", "length": "40 mm"}
PAD = WIDE | {"width": "40 mm"}
CELLS = (32, 16)


def scene(geometry, *, load=None, speed=SPEED):
    return read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": "30 mPa*s"},
            "motion": {"speed": f"{speed!r} m/s"},
            "load": load or {"pressure": "2 MPa"},
        }
    )


def settled(geometry, *, cells=CELLS, **entries):
    film = free_film(scene(geometry, **entries), cells)
    return film, equilibrium(film, None, tolerance=1e-10)


def placed(geometry, **entries):
    return settled(geometry, **entries)[1].place


@cache
def wide_pad(pivot, cells):
    """The ratio of the films at the ends of an infinitely wide flat pad, and the film at its outlet, m."""
    film, at, slope = scene(WIDE | {"pivot": pivot}), *placed(WIDE | {"pivot": pivot}, cells=(cells, 1))
    assert film.geometry.pivot == (pivot, 0.5)
    inlet, outlet = at - slope * pivot * LENGTH, at + slope * (1 - pivot) * LENGTH
    return inlet / outlet, outlet


@pytest.mark.parametrize("pivot", [0.52, 0.58, 0.65])
def test_a_wide_flat_pad_is_that_of_the_closed_form_to_second_order(pivot):
    """The pivot is at the centre of pressure, and the load is that of the slider at its film."""
    exact = scipy.optimize.brentq(lambda a: centre_of_pressure(a) - pivot, 1.001, 1e3, xtol=1e-13)
    load = linear_slider(film=1.0, rise=exact - 1, length=LENGTH, speed=SPEED, viscosity=VISCOSITY).load
    film = math.sqrt(load / (PRESSURE * LENGTH))
    (coarse, coarse_film), (fine, fine_film) = wide_pad(pivot, 64), wide_pad(pivot, 128)
    assert fine == pytest.approx(exact, rel=2e-3)
    assert fine_film == pytest.approx(film, rel=1e-3)
    assert (coarse - exact) / (fine - exact) == pytest.approx(4, abs=0.2)
    assert (coarse_film - film) / (fine_film - film) == pytest.approx(4, abs=0.2)


@pytest.mark.parametrize("ratio", [1 + 1e-6, 1.0099, 1.0101, 1.6, 30.0])
def test_the_centre_of_pressure_is_that_of_the_quadrature_of_the_slider(ratio):
    weights = [lambda s: s, lambda s: 1.0]
    moment, load = (
        scipy.integrate.quad(lambda s, w=w: w(s) * s * (1 - s) / (ratio - (ratio - 1) * s) ** 2, 0, 1)[0]
        for w in weights
    )
    assert centre_of_pressure(ratio) == pytest.approx(moment / load, rel=1e-8)


def test_a_film_that_does_not_narrow_has_no_centre_of_pressure():
    with pytest.raises(InputError, match="above 1"):
        centre_of_pressure(1.0)


def line(at, slope, pivot, crown):
    """The load over 6ηuL² and the moment about the pivot over it and L of a wide crowned pad, by quadrature."""
    s, weights = np.polynomial.legendre.leggauss(200)
    s, weights = (s + 1) / 2, weights / 2

    def film(s):
        return at + slope * LENGTH * (s - pivot) + crown * ((2 * s - 1) ** 2 - (2 * pivot - 1) ** 2)

    def integral(power):
        """∫ h⁻ᵖ ds from 0 to each s, and to 1."""
        t, w = np.polynomial.legendre.leggauss(60)
        ends = np.append(s, 1.0)
        return (film(ends[:, None] * (t + 1) / 2) ** -power @ w) / 2 * ends

    square, cube = integral(2.0), integral(3.0)
    p = square[:-1] - square[-1] / cube[-1] * cube[:-1]
    return np.array([weights @ p, weights @ (p * (s - pivot))])


def test_a_crowned_wide_pad_is_that_of_the_quadrature():
    """A crown places the pad in equilibrium about its middle, where a flat one has none."""
    crown, pivot = 10e-6, 0.5

    def excess(place):
        load, moment = 6 * VISCOSITY * SPEED * LENGTH * line(place[0] * 1e-5, place[1] * 1e-3, pivot, crown)
        return load / PRESSURE - 1, moment / PRESSURE

    exact = scipy.optimize.root(excess, [3.0, -0.7], tol=1e-12)
    assert exact.success
    film, slope = exact.x * [1e-5, 1e-3]
    geometry = WIDE | {"pivot": pivot, "crown": "10 um"}
    coarse, fine = (placed(geometry, cells=(cells, 1)) - [film, slope] for cells in (64, 128))
    assert fine / [film, slope] == pytest.approx(0, abs=2e-3)
    assert coarse / fine == pytest.approx(4, abs=0.4)


def test_the_slopes_narrow_the_film_towards_the_pivot_and_the_equilibrium_is_stable():
    film, instant = settled(PAD | {"pivot": [0.6, 0.45]})
    assert instant.place[1] < 0 < instant.place[2]
    stiff = coefficients(film.solved, instant, speed=film.solved.problem.speed)
    rates = scipy.linalg.eigvals(stiff.stiffness, stiff.damping)
    assert rates.real.min() > 0


def test_pads_that_are_mirror_images_have_mirrored_slopes():
    here, there = placed(PAD | {"pivot": [0.6, 0.45]}), placed(PAD | {"pivot": [0.6, 0.55]})
    assert there == pytest.approx(here * [1, 1, -1], rel=1e-8)
    back = placed(PAD | {"pivot": [0.4, 0.45]}, speed=-SPEED)
    assert back == pytest.approx(here * [1, -1, 1], rel=1e-8)


def test_a_pad_in_the_middle_of_its_width_does_not_tilt_across():
    point, line = placed(PAD | {"pivot": 0.6}), placed(PAD | {"pivot": [0.6, 0.45], "line": True})
    assert point == pytest.approx(line, rel=1e-10)
    beside = placed(PAD | {"pivot": [0.6, 0.5 + 1e-9]})
    assert beside[:2] == pytest.approx(point, rel=1e-6)
    assert abs(beside[2]) < 1e-6 * abs(point[1])


def test_moments_move_the_pivot():
    """With the force F, a moment M_y about the middle is a pivot M_y/F behind it, and M_x one M_x/F below it."""
    force, length = PRESSURE * LENGTH**2, LENGTH
    moments = {"moment_y": f"{force * 0.1 * length!r} N*m", "moment_x": f"{force * 0.05 * length!r} N*m"}
    loaded = placed(PAD | {"pivot": 0.5}, load={"pressure": "2 MPa"} | moments)
    moved = placed(PAD | {"pivot": [0.6, 0.45]})
    assert loaded[1:] == pytest.approx(moved[1:], rel=1e-7)
    assert loaded[0] == pytest.approx(moved[0] - moved[1] * 0.1 * length + moved[2] * 0.05 * length, rel=1e-7)


def test_a_sector_on_a_large_radius_is_a_rectangle():
    radius = 40.0
    sector = {
        "shape": "pivoted_sector",
        "inner_radius": f"{radius - LENGTH / 2!r} m",
        "outer_radius": f"{radius + LENGTH / 2!r} m",
        "angle": f"{LENGTH / radius!r} rad",
        "pivot": [0.6, 0.45],
    }
    assert placed(sector) == pytest.approx(placed(PAD | {"pivot": [0.6, 0.45]}), rel=3e-3)


def test_the_film_of_a_sector_is_a_plane_over_its_pivot():
    sector = {
        "shape": "pivoted_sector",
        "inner_radius": "50 mm",
        "outer_radius": "100 mm",
        "angle": "50 deg",
        "pivot": [0.6, 0.5],
    }
    geometry = scene(sector).geometry.at(np.array([50e-6, -4e-4, 2e-4]))
    angle, radius = np.meshgrid(np.linspace(0, geometry.angle, 301), np.linspace(0.05, 0.1, 201), indexing="ij")
    turned = angle - 0.6 * geometry.angle
    plane = 50e-6 - 4e-4 * radius * np.sin(turned) + 2e-4 * (radius * np.cos(turned) - 0.075)
    assert geometry.thickness(angle, radius) == pytest.approx(plane, rel=1e-12)
    assert geometry.film == pytest.approx(plane.min(), rel=1e-6)
    assert geometry.wall.place == pytest.approx([50e-6, -4e-4, 2e-4], rel=1e-12)


@pytest.fixture(scope="module")
def solved():
    geometry = PAD | {"pivot": [0.6, 0.45]}
    return find("bearing", "reynolds_cavitating").solve(scene(geometry), Request(resolution=48))


def test_given_slopes_have_the_moments_of_the_pressure(solved):
    """The film in equilibrium has none about its pivot; with another slope they are the integrals of the pressure."""
    geometry = PAD | {"pivot": [0.6, 0.45], "film": f"{solved['film_min'].value!r} m"}
    slopes = [solved["slope_x"].value, solved["slope_y"].value]
    assert abs(solved["moment_y"].value) < 1e-6 * solved["load"].value * LENGTH

    def given(factor):
        slope = [f"{factor * value!r} rad" for value in slopes]
        entries = {"name": "pad", "kind": "bearing", "geometry": geometry | {"slopes": slope}}
        entries |= {"lubricant": {"viscosity": "30 mPa*s"}, "motion": {"speed": "10 m/s"}}
        return find("bearing", "reynolds_cavitating").solve(read_scene(entries), Request(resolution=48))

    same, steeper = given(1.0), given(1.5)
    assert same["load"].value == pytest.approx(solved["load"].value, rel=1e-6)
    x, y, p = (steeper.fields[name].values for name in ("x", "y", "pressure"))
    area = np.trapezoid(np.trapezoid((x - 0.6 * LENGTH) * p, y[0], axis=1), x[:, 0])
    across = np.trapezoid(np.trapezoid((y - 0.45 * LENGTH) * p, y[0], axis=1), x[:, 0])
    assert steeper["moment_y"].value == pytest.approx(-area, rel=1e-9)
    assert steeper["moment_x"].value == pytest.approx(across, rel=1e-9)


@pytest.mark.parametrize(
    ("geometry", "message"),
    [
        (PAD | {"pivot": 0.45}, "closes at its inlet"),
        (PAD | {"pivot": 0.5}, "behind its middle"),
        (PAD | {"pivot": [0.7, 0.25]}, "middle of the width"),
        (PAD | {"pivot": 0.95}, "closes at its outlet"),
    ],
)
def test_pads_without_an_equilibrium_say_where_the_film_closes(geometry, message):
    with pytest.raises(InputError, match=message) as error:
        placed(geometry, cells=(24, 12))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"geometry": PAD | {"pivot": [0.6, 1.2]}}, "geometry.pivot"),
        ({"geometry": PAD | {"pivot": [0.6, 0.5, 0.1]}}, "geometry.pivot"),
        ({"geometry": PAD | {"pivot": 0.6, "line": True, "slopes": ["0 rad", "1 mrad"]}}, "geometry.slopes|slopes"),
        ({"geometry": WIDE | {"pivot": 0.6}, "load": {"pressure": "1 MPa", "moment_y": "1 N*m"}}, "load.moment_y"),
        (
            {"geometry": PAD | {"pivot": 0.6, "line": True}, "load": {"pressure": "1 MPa", "moment_x": "1 N*m"}},
            "load.moment_x",
        ),
        (
            {
                "geometry": PAD | {"pivot": 0.6, "slopes": ["-0.5 mrad", "0 rad"]},
                "load": {"pressure": "1 MPa", "moment_y": "1 N*m"},
            },
            "load.moment_y: got one beside geometry.slopes",
        ),
    ],
)
def test_faults_of_pads_are_one_line(entries, message):
    with pytest.raises(InputError, match=message):
        scene(**entries)


def test_a_pad_with_a_film_and_no_load_needs_its_slopes():
    entries = {"name": "pad", "kind": "bearing", "geometry": PAD | {"pivot": 0.6, "film": "20 um"}}
    with pytest.raises(InputError, match=r"geometry\.slopes"):
        read_scene({**entries, "lubricant": {"viscosity": "30 mPa*s"}, "motion": {"speed": "10 m/s"}})
