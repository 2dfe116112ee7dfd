"""The least thickness of a film and its place, where both are known in closed form."""

import math

import numpy as np
import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.totals.least_film import least_film
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene

OIL = {"viscosity": "0.02 Pa*s"}


def bearing(motion="1 m/s", **geometry) -> Bearing:
    entries = {"name": "b", "kind": "bearing", "geometry": geometry, "lubricant": OIL, "motion": {"speed": motion}}
    scene = read_scene(entries)
    assert isinstance(scene, Bearing)
    return scene


def sector(**changes) -> Bearing:
    ring = {"inner_radius": "20 mm", "outer_radius": "40 mm", "film": "20 um", "rise": "20 um"}
    return bearing(shape="sector", **ring | {"angle": "45 deg"} | changes)


def test_a_journal_is_thinnest_at_half_a_turn():
    journal = bearing(shape="journal", radius="20 mm", clearance="40 um", eccentricity=0.7, width="30 mm")
    least = least_film(journal.geometry)
    assert least.thickness == pytest.approx(12e-6, rel=1e-9)
    assert (least.x, least.y) == pytest.approx((math.pi * 0.02, 0.015), rel=1e-9)


def test_a_wave_at_the_inlet_is_thinnest_in_its_trough():
    wave = {"amplitude": "3 um", "wavelength": "7 mm", "extent": "10 mm"}
    least = least_film(bearing(shape="sinusoidal_inlet", length="20 mm", film="10 um", **wave).geometry)
    assert least.thickness == pytest.approx(7e-6, rel=1e-9)
    assert least.x == pytest.approx(0.75 * 7e-3, rel=1e-4)


def test_on_a_land_the_place_is_the_first_one_along_the_sliding_and_in_the_middle_of_the_width():
    step = bearing(shape="step", length="20 mm", width="10 mm", film="10 um", rise="8 um", step="12 mm").geometry
    forwards, backwards = least_film(step), least_film(step, turned=True)
    assert forwards.thickness == backwards.thickness == pytest.approx(10e-6)
    assert (forwards.x, forwards.y) == pytest.approx((12e-3, 5e-3), rel=1e-6)
    assert (backwards.x, backwards.y) == pytest.approx((20e-3, 5e-3), rel=1e-6)


def test_pockets_that_cover_the_whole_film_leave_its_edges_as_the_thinnest_places():
    texture = {"profile": "cylindrical", "length": "2 mm", "depth": "5 um", "columns": 10, "pitch": "2 mm"}
    assert least_film(
        bearing(shape="parallel", length="20 mm", film="10 um", texture=texture).geometry
    ).thickness == pytest.approx(10e-6, rel=1e-6)


def test_the_least_film_of_points_in_a_file_is_the_given_one(tmp_path):
    above = np.full((41, 31), 5e-6)
    above[17, 23] = 1e-6
    np.save(tmp_path / "film.npy", above)
    sides = {"length": "20 mm", "width": "15 mm", "film": "10 um"}
    least = least_film(bearing(shape="given", thickness=str(tmp_path / "film.npy"), **sides).geometry)
    assert least.thickness == pytest.approx(10e-6, rel=1e-9)
    assert (least.x, least.y) == pytest.approx((17 * 0.5e-3, 23 * 0.5e-3), rel=1e-6)


def test_a_result_has_the_least_film_exactly_and_its_place_in_the_coordinates_of_the_scene():
    scene = sector(taper=0.6)
    result = find("bearing", "reynolds_cavitating").solve(scene, Request(resolution=32))
    film, angle, radius = (result.quantities[name] for name in ("film_min", "film_min_x", "film_min_y"))
    assert (film.value, angle.value, radius.value) == pytest.approx((20e-6, 0.6 * math.pi / 4, 0.03), rel=1e-6)
    assert (film.unit, angle.unit, radius.unit) == ("m", "rad", "m")
    assert film.uncertainty == angle.uncertainty == radius.uncertainty == 0


def test_the_specific_load_is_the_load_over_the_projected_area():
    scene = bearing(shape="journal", radius="20 mm", clearance="40 um", eccentricity=0.7, width="30 mm")
    result = find("bearing", "reynolds_cavitating").solve(scene, Request(resolution=32))
    assert result["specific_load"].value == pytest.approx(result["load"].value / (0.04 * 0.03))


def test_the_pieces_of_a_ring_are_its_pockets_or_its_pads():
    assert bearing(shape="linear", length="20 mm", film="20 um", rise="20 um").pieces == 1
    assert sector().pieces is None
    assert sector(pads=6).pieces == 6
    washer = load_scene(SCENES / "washer.toml")
    assert isinstance(washer, Bearing)
    assert washer.pieces == 30


def test_joined_pads_fill_the_ring():
    sides = {"sides": {"low": "1 bar"}}
    entries = {"name": "b", "kind": "bearing", "lubricant": OIL, "motion": {"speed": "1 m/s"}, "boundary": sides}
    ring = {"shape": "sector", "inner_radius": "20 mm", "outer_radius": "40 mm", "film": "20 um", "rise": "20 um"}
    scene = read_scene(entries | {"geometry": ring | {"angle": "45 deg", "joined": True}})
    assert isinstance(scene, Bearing)
    assert scene.pieces == 8


def test_more_pads_than_fit_are_refused():
    with pytest.raises(InputError, match=r"pads: got 9; at most 8 pads"):
        sector(pads=9)
