"""Hydrostatic pads: closed forms of pressure, load, flow and stiffness, and the film that floats under a load."""

import math
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import Drive, full_film, settled
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

ETA, FILM, SUPPLY = 0.03, 30e-6, 2e6
OIL = {"viscosity": "30 mPa*s", "density": "870 kg/m^3"}
INNER, OUTER, BEGIN, END = 20e-3, 60e-3, 35e-3, 45e-3
CAPILLARY = {"capillary": {"diameter": "0.7 mm", "length": "50 mm"}}
ORIFICE = {"orifice": {"diameter": "0.35 mm"}}
TUBE = math.pi * 0.7e-3**4 / (128 * ETA * 50e-3)
HOLE = 0.6 * math.pi * 0.35e-3**2 / 4 * math.sqrt(2 / 870)


def solved(geometry, supply, *, model="reynolds", cells=48, **tables):
    tables = {"lubricant": OIL, "motion": {"speed": "0 m/s"}} | tables
    scene = read_scene({"name": "pad", "kind": "bearing", "geometry": geometry, "supply": supply, **tables})
    return find("bearing", model).solve(scene, Request(resolution=cells))


def washer(**restrictor):
    """A flat washer with a groove all around, from BEGIN to END."""
    groove = {"kind": "groove", "radius": "40 mm", "extent": "10 mm", "pressure": "2 MPa"} | restrictor
    return {"shape": "washer", "inner_radius": "20 mm", "outer_radius": "60 mm", "pockets": 1}, [groove]


def conductance(film):
    """The flow out of the groove over its pressure: π h³/(6 η ln(R/r)) through each land."""
    return math.pi * film**3 / (6 * ETA) * (1 / math.log(BEGIN / INNER) + 1 / math.log(OUTER / END))


AREA = math.pi / 2 * ((OUTER**2 - END**2) / math.log(OUTER / END) - (BEGIN**2 - INNER**2) / math.log(BEGIN / INNER))
"""The load over the pressure of the groove."""


def behind(restrictor, film):
    """The pressure of the groove behind a restrictor."""
    if restrictor is CAPILLARY:
        return SUPPLY / (1 + conductance(film) / TUBE)
    share = (HOLE / conductance(film)) ** 2  # (G p)² = k² (p_s - p)
    return share / 2 * (math.sqrt(1 + 4 * SUPPLY / share) - 1)


@pytest.mark.parametrize("restrictor", [CAPILLARY, ORIFICE])
def test_a_circular_pad_has_the_pressure_the_load_and_the_flow_of_the_closed_form(restrictor):
    geometry, supply = washer(**restrictor)
    result = solved(geometry | {"film": "30 um"}, supply)
    pressure = behind(restrictor, FILM)
    expected = {"supply_1_pressure": pressure, "load": AREA * pressure, "supply_flow": conductance(FILM) * pressure}
    for name, value in expected.items():
        assert result[name].value == pytest.approx(value, rel=2e-3), name
        assert abs(result[name].value - value) <= result[name].uncertainty + 1e-9 * value, name
    assert result["side_leakage"].value == pytest.approx(result["supply_1_flow"].value, rel=1e-9)


@pytest.mark.parametrize("restrictor", [CAPILLARY, ORIFICE])
def test_a_pad_floats_where_its_load_balances(restrictor):
    geometry, supply = washer(**restrictor)
    force = AREA * behind(restrictor, FILM)
    result = solved(geometry, supply, load={"force": f"{force!r} N"}, cells=32)
    assert abs(result["film_min"].value - FILM) <= result["film_min"].uncertainty + 1e-6 * FILM


def test_a_given_flow_sets_the_pressure():
    geometry, supply = washer(flow="2e-6 m^3/s")
    del supply[0]["pressure"]
    result = solved(geometry | {"film": "30 um"}, supply)
    assert result["supply_1_flow"].value == pytest.approx(2e-6, rel=1e-9)
    assert result["supply_1_pressure"].value == pytest.approx(2e-6 / conductance(FILM), rel=2e-3)


def test_a_long_pad_is_exact():
    """p falls linearly beside the recess: W = p (L + l)/2, Q = p h³/(3 η (L - l))."""
    geometry = {"shape": "parallel", "length": "100 mm", "film": "30 um"}
    pocket = {"kind": "groove", "x": "50 mm", "length": "40 mm", "pressure": "1 MPa"}
    result = solved(geometry, [pocket], cells=64)
    assert result["load_per_width"].value == pytest.approx(1e6 * 0.07, rel=1e-9)
    assert result["supply_flow_per_width"].value == pytest.approx(1e6 * FILM**3 / (3 * ETA * 0.06), rel=1e-9)
    assert result["supply_1_flow_per_width"].value == pytest.approx(2 * result["outlet_flow_per_width"].value, rel=1e-9)


def test_a_hole_feeds_a_strip_as_a_source():
    """Far from its ends, a small hole in the middle of a strip of width B gives Q = π h³ p/(6 η ln(4B/(π d)))."""
    geometry = {"shape": "parallel", "length": "150 mm", "width": "50 mm", "film": "30 um"}
    hole = {"kind": "hole", "x": "75 mm", "diameter": "4 mm", "pressure": "1 MPa"}
    result = solved(geometry, [hole], cells=128)
    exact = math.pi * FILM**3 * 1e6 / (6 * ETA * math.log(4 * 50 / (math.pi * 4)))
    assert abs(result["supply_1_flow"].value - exact) <= result["supply_1_flow"].uncertainty + 1e-3 * exact
    assert result["supply_1_flow"].value == pytest.approx(exact, rel=0.02)


def stiffness(restrictor, film):
    """Stiffness of the washer by the derivatives of the discrete film, with its load and pressure."""
    geometry, supply = washer(**restrictor)
    scene = read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": geometry | {"film": f"{film!r} m"},
            "supply": supply,
            "lubricant": OIL,
            "motion": {"speed": "0 m/s"},
        }
    )
    problem = scene.problem()
    at_rest = replace(problem, shape=replace(problem.shape, thickness=lambda x, y: 0.0 * (x + y)))
    moving = MovingFilm(
        problem=at_rest,
        grid=grid(at_rest.shape, (8, 48)),
        normals=(lambda x, y: 1.0 + 0 * (x + y),),
        inflows=problem.inflows,
        ruptures=False,
    )
    start = full_film(moving, np.array([film]))
    drive = Drive(speed=0.0, force=np.zeros(1), stiffness=np.zeros((1, 1)), free=np.zeros(1, dtype=bool))
    instant = settled(moving, start, drive, tolerance=1e-12)
    found = coefficients(moving, instant, speed=0.0)
    return float(found.stiffness[0, 0]), float(moving.force(instant.state.pressure)[0]), float(instant.pressures[0])


def test_the_stiffness_of_a_pad_behind_a_capillary_is_3_w_1_minus_beta_over_h():
    found, load, pressure = stiffness(CAPILLARY, FILM)
    assert found == pytest.approx(3 * load * (1 - pressure / SUPPLY) / FILM, rel=1e-6)


def test_the_stiffness_of_a_pad_behind_an_orifice_is_6_w_1_minus_beta_over_h_2_minus_beta():
    found, load, pressure = stiffness(ORIFICE, FILM)
    ratio = pressure / SUPPLY
    assert found == pytest.approx(6 * load * (1 - ratio) / (FILM * (2 - ratio)), rel=1e-6)


def test_a_deep_pocket_has_the_friction_of_a_closed_recess():
    """ηu/h outside and 4ηu/(h + d) inside, at rest of the pressure."""
    geometry = {"shape": "parallel", "length": "100 mm", "width": "100 mm", "film": "30 um"}
    pocket = {
        "kind": "pocket",
        "x": "50 mm",
        "length": "50 mm",
        "extent": "60 mm",
        "depth": "1 mm",
        "pressure": "1 MPa",
    }
    result = solved(geometry, [pocket], motion={"speed": "2 m/s"}, cells=24)
    inside = 50e-3 * 60e-3
    exact = ETA * 2 * ((0.01 - inside) / FILM + 4 * inside / (FILM + 1e-3))
    assert result["friction"].value == pytest.approx(exact, rel=1e-6)


def test_a_film_that_takes_in_more_than_its_restrictor_passes_is_refused():
    geometry = {"shape": "linear", "length": "50 mm", "width": "50 mm", "film": "30 um", "rise": "90 um"}
    hole = {"kind": "hole", "x": "45 mm", "diameter": "4 mm", "flow": "1e-12 m^3/s"}
    with pytest.raises(ConvergenceError, match="takes in more than the restrictor passes"):
        solved(geometry, [hole], model="reynolds_cavitating", motion={"speed": "-5 m/s"}, cells=24)


RECESS = {"kind": "pocket", "x": "30 mm", "length": "20 mm", "extent": "20 mm", "depth": "1 mm", "pressure": "2 MPa"}


def test_a_pad_about_a_pivot_over_its_recess_floats_parallel_at_rest():
    """The moments of the recess and of the load about the pivot vanish, so that it is the pad without slopes."""
    square = {"length": "60 mm", "width": "60 mm"}
    tables = {"load": {"force": "1 kN"}, "cells": 48}
    pivoted = solved({"shape": "pivoted", "pivot": 0.5, **square}, [RECESS | CAPILLARY], **tables)
    parallel = solved({"shape": "parallel", **square}, [RECESS | CAPILLARY], **tables)
    for name in ("film_min", "supply_flow", "supply_1_pressure"):
        bar = pivoted[name].uncertainty + parallel[name].uncertainty
        assert abs(pivoted[name].value - parallel[name].value) <= bar, name


def test_a_pad_that_approaches_displaces_what_is_not_supplied():
    geometry = {"shape": "linear", "length": "60 mm", "width": "60 mm", "film": "30 um", "rise": "10 um"}
    motion = {"speed": "1 m/s", "approach": "0.5 mm/s"}
    result = solved(geometry, [RECESS | CAPILLARY], model="reynolds_cavitating", motion=motion, cells=24)
    entering = sum(result[name].value for name in ("inlet_flow", "supply_flow", "displaced_flow"))
    leaving = result["outlet_flow"].value + result["side_leakage"].value
    assert entering == pytest.approx(leaving, rel=1e-9)


STOPPED = {"viscosity": "1 Pa*s", "piezoviscosity": {"law": "barus", "pressure_coefficient": "2e-8 Pa^-1"}}
"""With this law no pressure passes more than G/α through a land, π h³/(6 η α ln(R/r)) in all: 1.1e-6 m³/s of 20 μm."""


def flooded():
    """A thin washer with a given flow of 100 l/min."""
    geometry, supply = washer(flow="100 l/min")
    del supply[0]["pressure"]
    return geometry | {"film": "20 um"}, supply


def test_a_given_flow_that_a_law_of_viscosity_stops_is_refused_in_one_line():
    with pytest.raises(ConvergenceError, match=r"^supply\.0: no pressure passes its flow through [^\n]*$"):
        solved(*flooded(), model="reynolds_cavitating", lubricant=STOPPED, cells=16)


def test_a_model_without_that_law_has_the_pressure_of_the_viscosity_at_ambient_pressure():
    result = solved(*flooded(), model="reynolds_incompressible", lubricant=STOPPED, cells=16)
    pressure = 0.1 / 60 / (conductance(20e-6) * ETA / 1.0)
    for name, value in (("supply_1_pressure", pressure), ("load", AREA * pressure)):
        assert abs(result[name].value - value) <= result[name].uncertainty <= 5e-3 * value, name


def test_a_pocket_of_given_flow_under_a_load_that_fixed_pressures_exceed_says_so():
    geometry = {"shape": "parallel", "length": "30.38 mm", "width": "217.3 mm", "film": "24 um"}
    supply = [
        {
            "kind": "pocket",
            "x": "7.42 mm",
            "length": "3.25 mm",
            "extent": "150.8 mm",
            "depth": "0.617 mm",
            "flow": "1.396e-5 m^3/s",
        },
        {"kind": "hole", "x": "20.66 mm", "diameter": "2.05 mm", "pressure": "831.3 kPa"},
    ]
    oil = {
        "viscosity": "0.2845 Pa*s",
        "cavitation_pressure": "-70 kPa",
        "piezoviscosity": {"law": "barus", "pressure_coefficient": "3.911e-10 Pa^-1"},
    }
    tables = {"lubricant": oil, "motion": {"speed": "0.396 m/s"}, "load": {"force": "123 N"}}
    with pytest.raises(InputError, match=r"load: got .* the film carries at least"):
        solved(geometry, supply, model="reynolds_cavitating", cells=16, **tables)
