"""Closed forms of plates that approach each other: by quadrature, and what the solver makes of them."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.squeeze import (
    closing_time,
    squeezed_annulus,
    squeezed_disc,
    squeezed_rectangle,
    squeezed_strip,
)
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

PLATES = {"film": 20e-6, "approach": 2e-4, "viscosity": 0.03}
SCALE = 12 * PLATES["viscosity"] * PLATES["approach"] / PLATES["film"] ** 3


def solve(geometry, cells, motion=None, boundary=None):
    entries = {
        "name": "squeezed",
        "kind": "bearing",
        "geometry": {"film": "20 um", **geometry},
        "lubricant": {"viscosity": "0.03 Pa*s"},
        "motion": {"speed": "0 m/s", "approach": "0.2 mm/s", **(motion or {})},
        "boundary": boundary or {},
    }
    return find("bearing", "reynolds_cavitating").solve(read_scene(entries), Request(resolution=cells))


def test_strip_disc_and_annulus_are_integrals_of_the_displaced_flow():
    strip = squeezed_strip(length=0.04, **PLATES)

    def pressure(x):
        return quad(lambda at: SCALE * at, x, 0.02)[0]

    assert strip.load == pytest.approx(2 * quad(pressure, 0, 0.02)[0], rel=1e-10)
    assert strip.pressure_max == pytest.approx(pressure(0), rel=1e-10)
    disc = squeezed_disc(radius=0.02, **PLATES)
    assert disc.load == pytest.approx(quad(lambda r: 2 * math.pi * r * pressure(r) / 2, 0, 0.02)[0], rel=1e-10)
    assert disc.pressure_max == pytest.approx(pressure(0) / 2, rel=1e-10)
    inner, outer = 0.01, 0.03
    turn = quad(lambda r: r / 2, inner, outer)[0] / quad(lambda r: 1 / r, inner, outer)[0]

    def ring(r):
        return quad(lambda at: SCALE * (at / 2 - turn / at), r, outer)[0]

    annulus = squeezed_annulus(inner_radius=inner, outer_radius=outer, **PLATES)
    assert annulus.load == pytest.approx(quad(lambda r: 2 * math.pi * r * ring(r), inner, outer)[0], rel=1e-9)
    assert annulus.pressure_max == pytest.approx(ring(math.sqrt(2 * turn)), rel=1e-9)


def test_the_rectangle_is_the_solution_of_poissons_equation():
    """A sum over both directions, by which the series over one is not obtained."""
    length, width = 0.04, 0.025
    m, n = np.meshgrid(np.arange(1, 800, 2), np.arange(1, 800, 2), indexing="ij")
    eigen = math.pi**2 * ((m / length) ** 2 + (n / width) ** 2)
    load = SCALE * (64 * length * width / math.pi**4 / (m * n) ** 2 / eigen).sum()
    signs = np.where((m + n) // 2 % 2 == 1, 1.0, -1.0)
    peak = SCALE * (16 / math.pi**2 / (m * n) / eigen * signs).sum()
    known = squeezed_rectangle(length=length, width=width, **PLATES)
    assert known.load == pytest.approx(load, rel=1e-6)
    assert known.pressure_max == pytest.approx(peak, rel=1e-4)
    assert known == squeezed_rectangle(length=width, width=length, **PLATES)


def test_a_long_rectangle_is_a_strip():
    strip, long = squeezed_strip(length=0.04, **PLATES), squeezed_rectangle(length=0.04, width=40.0, **PLATES)
    assert long.load / 40.0 == pytest.approx(strip.load, rel=1e-3)
    assert long.pressure_max == pytest.approx(strip.pressure_max, rel=1e-9)


def test_the_time_to_close_is_the_integral_over_the_film():
    disc, load = squeezed_disc(radius=0.02, **PLATES), 30.0
    exact = quad(lambda h: disc.resistance / h**3 / load, 5e-6, 20e-6)[0]
    assert closing_time(disc.resistance, load, (20e-6, 5e-6)) == pytest.approx(exact, rel=1e-9)
    assert closing_time(disc.resistance, load, (20e-6, 0.0)) == math.inf
    with pytest.raises(InputError, match="films"):
        closing_time(disc.resistance, load, (5e-6, 20e-6))
    with pytest.raises(InputError, match="load"):
        closing_time(disc.resistance, 0.0, (20e-6, 5e-6))
    with pytest.raises(InputError, match="inner_radius"):
        squeezed_annulus(inner_radius=0.0, outer_radius=0.1, **PLATES)


def test_the_solver_meets_the_strip_and_its_flows():
    known = squeezed_strip(length=0.04, **PLATES)
    result = solve({"shape": "parallel", "length": "40 mm"}, 64)
    assert result["load_per_width"].value == pytest.approx(known.load, rel=1e-3)
    assert abs(result["load_per_width"].value - known.load) <= result["load_per_width"].uncertainty
    assert result["pressure_max"].value == pytest.approx(known.pressure_max, rel=1e-9)
    displaced = 0.04 * PLATES["approach"]
    assert result["displaced_flow_per_width"].value == pytest.approx(displaced, rel=1e-9)
    assert result["outlet_flow_per_width"].value == pytest.approx(displaced / 2, rel=1e-9)
    assert result["inlet_flow_per_width"].value == pytest.approx(-displaced / 2, rel=1e-9)
    assert result["power_loss_per_width"].value == 0
    assert abs(result["friction_per_width"].value) < 1e-12 * known.load
    assert result["hersey_number"].value == 0


def test_the_solver_meets_rectangle_and_ring_at_second_order():
    rectangle = squeezed_rectangle(length=0.04, width=0.025, **PLATES).load
    ring = squeezed_annulus(inner_radius=0.01, outer_radius=0.03, **PLATES)
    washer = {"shape": "washer", "inner_radius": "10 mm", "outer_radius": "30 mm", "pockets": 6}
    fed = {"sides": {"low": "1 Pa", "high": "1 Pa"}}  # joined pieces need a side above the cavitation pressure
    errors = {"rectangle": [], "ring": []}
    for cells in (16, 32, 64):
        result = solve({"shape": "parallel", "length": "40 mm", "width": "25 mm"}, cells)
        errors["rectangle"].append(abs(result["load"].value / rectangle - 1))
        whole = solve(washer, cells, boundary=fed)
        load = whole["bearing_load"].value - math.pi * (0.03**2 - 0.01**2)
        errors["ring"].append(abs(load / ring.load - 1))
    for values in errors.values():
        assert all(3.5 < coarse / fine < 4.5 for coarse, fine in pairwise(values))
    assert abs(result["load"].value - rectangle) <= result["load"].uncertainty
    assert result["side_leakage"].value + 2 * result["outlet_flow"].value == pytest.approx(
        0.04 * 0.025 * PLATES["approach"], rel=1e-9
    )
    assert whole["pressure_max"].value - 1 == pytest.approx(ring.pressure_max, rel=1e-3)
    out = whole["side_leakage_low"].value + whole["side_leakage_high"].value
    assert out == pytest.approx(whole["displaced_flow"].value, rel=1e-8)


def test_sliding_adds_to_squeeze_of_parallel_plates_only_friction():
    plain = solve({"shape": "parallel", "length": "40 mm", "width": "25 mm"}, 32)
    sliding = solve({"shape": "parallel", "length": "40 mm", "width": "25 mm"}, 32, {"speed": "0.5 m/s"})
    assert sliding["load"].value == pytest.approx(plain["load"].value, rel=1e-6)
    assert sliding["friction"].value == pytest.approx(0.03 * 0.5 / 20e-6 * 0.04 * 0.025, rel=0.02)


def test_walls_that_part_open_a_cavity_and_suck_nothing_through_it():
    result = solve({"shape": "parallel", "length": "40 mm", "width": "25 mm"}, 32, {"approach": "-0.2 mm/s"})
    assert result["load"].value == 0
    assert result["theta_min"].value == 0
    assert result["side_leakage"].value == pytest.approx(0, abs=1e-20)


def test_plates_under_a_load_have_the_film_at_which_they_approach_so_fast():
    disc = squeezed_rectangle(length=0.04, width=0.04, **PLATES)
    entries = {
        "name": "plates",
        "kind": "bearing",
        "geometry": {"shape": "parallel", "length": "40 mm", "width": "40 mm"},
        "lubricant": {"viscosity": "0.03 Pa*s"},
        "motion": {"speed": "0 m/s", "approach": "0.2 mm/s"},
        "load": {"force": f"{disc.load} N"},
    }
    result = find("bearing", "reynolds_cavitating").solve(read_scene(entries), Request(resolution=32))
    assert result["film_min"].value == pytest.approx(20e-6, rel=2e-3)
    assert abs(result["film_min"].value - 20e-6) <= result["film_min"].uncertainty
