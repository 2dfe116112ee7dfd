"""The exact film: an independent source's table, closed forms, and what the default solver must come near to."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.closed_forms.sliding import barus_pressure, linear_slider
from roughfilm.rom.bearing.geometry.shapes import Linear, Parabolic
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.exact import exact
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson
from roughfilm.rom.lubricants.viscosity import Barus

FILM, LENGTH, SPEED, VISCOSITY = 25.4e-6, 76.2e-3, 4.57, 0.039
SHAPE = Parabolic(shape="parabolic", length="76.2 mm", film="25.4 um", rise="25.4 um").film_shape()
LINEAR = Linear(shape="linear", length="50 mm", film="20 um", rise="24 um").film_shape()


def liquid(gigapascals):
    return ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus=f"{gigapascals} GPa")


def slider(theta=1.0, modulus=None, inlet=None, **given):
    law = {} if modulus is None else {"compressibility": liquid(modulus)}
    ends = Ends(theta=theta, inlet=inlet)
    return Problem(**{"shape": SHAPE, "ends": ends, "speed": SPEED, "viscosity": VISCOSITY, **law, **given})


@pytest.mark.parametrize(
    ("modulus", "theta", "load", "pressure", "start", "rupture"),
    [
        (0.069, 1.0, "108785.05", "3715098.3", "0.00000", "0.70277"),
        (0.069, 0.55, "41640.25", "1942332.4", "0.15624", "0.65811"),
        (10, 1.0, "101403.97", "3592809.4", "0.00000", "0.67909"),
    ],
)
def test_the_table_of_another_source_is_met_in_all_its_digits(modulus, theta, load, pressure, start, rupture):
    found = exact(slider(theta, modulus))
    assert f"{found.load:.2f}" == load
    assert f"{found.pressure_max:.1f}" == pressure
    assert (f"{found.film_start:.5f}", f"{found.rupture:.5f}") == (start, rupture)


@pytest.mark.parametrize("modulus", [0.05, 0.3, 10, 100])
@pytest.mark.parametrize("theta", [0.52, 0.55])
def test_a_starved_film_ruptures_where_it_is_as_thick_as_what_was_brought(theta, modulus):
    """h(x) = θ h(0), whatever the bulk modulus: (2x - 1)² = 2 θ - 1 on the widening side."""
    found = exact(slider(theta, modulus))
    assert found.rupture == pytest.approx((1 + math.sqrt(2 * theta - 1)) / 2, abs=1e-13)
    assert found.flow == pytest.approx(SPEED / 2 * theta * 2 * FILM, rel=1e-15)


def test_without_enough_for_the_narrowest_place_there_is_no_film():
    for theta in (0.05, 0.5):
        found = exact(slider(theta, 0.07))
        assert (found.load, found.film_start, found.rupture) == (0.0, 1.0, 1.0)


def test_a_film_that_reaches_the_inlet_is_not_starved():
    assert exact(slider(0.8, 0.3)) == exact(slider(1.0, 0.3)) == exact(slider(modulus=0.3, inlet=0.0))
    assert exact(slider(0.55, 0.3)).load < 0.9 * exact(slider(1.0, 0.3)).load


def test_density_matters_the_less_the_stiffer_the_liquid():
    stiff = exact(slider())
    apart = [exact(slider(modulus=modulus)).load / stiff.load - 1 for modulus in (10, 100, 1000)]
    assert apart[0] > 0
    assert apart[0] / apart[1] == pytest.approx(10, rel=0.01)
    assert apart[1] / apart[2] == pytest.approx(10, rel=0.01)


def test_an_incompressible_film_is_an_integral():
    """dp/dx = 12 η/h³ (u h/2 - m), with the m of its own rupture, by quadrature."""
    found = exact(slider(0.55))

    def slope(x):
        h = FILM * (1 + (2 * x - 1) ** 2)
        return 12 * VISCOSITY / h**3 * (SPEED * h / 2 - SPEED / 2 * 0.55 * 2 * FILM) * LENGTH

    rise = quad(slope, found.film_start, found.rupture, epsabs=1e-6)[0]
    assert abs(rise) < 1e-11 * found.pressure_max
    moment = quad(lambda x: -x * slope(x), found.film_start, found.rupture, epsabs=0, epsrel=1e-13)[0]
    assert found.load == pytest.approx(moment * LENGTH, rel=1e-11)


def test_a_linear_slider_is_known_in_closed_form():
    problem = slider(shape=LINEAR)
    known = linear_slider(film=20e-6, rise=24e-6, length=0.05, speed=SPEED, viscosity=VISCOSITY)
    found = exact(problem)
    assert found.load == pytest.approx(known.load, rel=1e-12)
    assert found.pressure_max == pytest.approx(known.pressure_max, rel=1e-12)
    assert (found.film_start, found.rupture) == pytest.approx((0, 1), abs=1e-12)


@pytest.mark.parametrize("part", [0.5, 0.9])
def test_barus_law_has_a_reduced_pressure(part):
    known = linear_slider(film=20e-6, rise=24e-6, length=0.05, speed=SPEED, viscosity=VISCOSITY).pressure_max
    law = Barus(law="barus", pressure_coefficient=f"{part / known} Pa^-1")
    found = exact(slider(shape=LINEAR, piezoviscosity=law))
    assert found.pressure_max == pytest.approx(barus_pressure(known, part / known), rel=1e-10)


def test_where_barus_law_has_no_pressure_there_is_no_film():
    known = linear_slider(film=20e-6, rise=24e-6, length=0.05, speed=SPEED, viscosity=VISCOSITY).pressure_max
    law = Barus(law="barus", pressure_coefficient=f"{2 / known} Pa^-1")
    with pytest.raises(ConvergenceError, match="unbounded or too steep"):
        exact(slider(shape=LINEAR, piezoviscosity=law))


def test_a_pressurised_inlet_adds_the_flow_it_drives():
    """Pressure at the inlet, where the film thickness is even: p falls evenly, m = u h/2 + h³ p/(12 η L)."""
    even = Linear(shape="linear", length="50 mm", film="20 um", rise="1 fm").film_shape()
    found = exact(slider(shape=even, inlet=2e5))
    assert found.load == pytest.approx(2e5 * 0.05 / 2, rel=1e-6)
    assert found.flow == pytest.approx(SPEED * 20e-6 / 2 + (20e-6) ** 3 * 2e5 / (12 * VISCOSITY * 0.05), rel=1e-6)


@pytest.mark.parametrize(
    ("given", "match"),
    [
        ({"speed": 0.0}, "speed"),
        ({"ends": Ends(outlet=1e5)}, "outlet"),
        (
            {
                "shape": Parabolic(
                    shape="parabolic", length="76.2 mm", film="25.4 um", rise="25.4 um", count=2
                ).film_shape()
            },
            "one narrowest",
        ),
        (
            {
                "shape": Parabolic(
                    shape="parabolic", length="76 mm", film="25 um", rise="25 um", width="1 m"
                ).film_shape()
            },
            "line",
        ),
    ],
)
def test_other_films_are_refused(given, match):
    with pytest.raises(InputError, match=match):
        exact(slider(**given))


@pytest.mark.parametrize(
    ("theta", "law"), [(1.0, liquid(0.069)), (0.55, liquid(0.069)), (0.55, DowsonHigginson(law="dowson_higginson"))]
)
def test_the_default_solver_comes_nearer_by_the_square_of_the_cells(theta, law):
    """Where the rupture lies in its cell comes and goes: the slope is that of a line through all sizes."""
    problem = slider(theta, compressibility=law)
    known = exact(problem).load
    cells = [250, 500, 1000, 2000, 4000, 8000, 16000]
    errors = [abs(solve(problem, (n, 1)).levels[-1].load / known - 1) for n in cells]
    slope = np.polyfit(np.log(cells), np.log(errors), 1)[0]
    assert -2.5 < slope < -1.7
    assert all(error < 20 / n**2 for n, error in zip(cells, errors, strict=True))


@pytest.mark.parametrize("theta", [1.0, 0.55])
@pytest.mark.parametrize("modulus", [0.05, 100])
def test_the_default_solver_is_right_to_a_millionth_on_100000_cells(theta, modulus):
    problem = slider(theta, modulus)
    found = solve(problem, (100_000, 1))
    known = exact(problem)
    assert found.levels[-1].load == pytest.approx(known.load, rel=1e-6)
    assert found.state.pressure.max() == pytest.approx(known.pressure_max, rel=1e-6)
