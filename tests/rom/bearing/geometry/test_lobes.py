"""Bores of circular arcs: their film by geometry, faults of scenes."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import read_scene

PLAIN = {"shape": "lobes", "radius": "50 mm", "clearance": "50 um", "width": "40 mm"}
HALVES = {"lobes": 2, "arc": "160 deg"}


def bearing(**geometry):
    entries = {"name": "lobes", "kind": "bearing", "geometry": PLAIN | geometry}
    oil, sides = {"viscosity": "20 mPa*s"}, {"low": "1 bar", "high": "1 bar"}
    rest = {"lubricant": oil, "motion": {"speed": "3000 rpm"}, "boundary": {"sides": sides}}
    return read_scene({**entries, **rest, **({} if "eccentricity" in geometry else {"load": {"force": "5 kN"}})})


def gap(geometry, angle, across=0.02):
    """The distance from the shaft to a circular lobe along a ray from the centre of the bearing, to first order."""
    x = geometry.radius * np.mod(angle - geometry.start, 2 * np.pi)
    return geometry.thickness(np.atleast_1d(x), np.full(1, across))[0]


def test_a_shaft_off_centre_is_nearer_to_the_bore_where_it_moved():
    geometry = bearing(eccentricity=[0.3, -0.4]).geometry
    nearest = np.arctan2(-0.4, 0.3)
    assert gap(geometry, nearest) == pytest.approx(50e-6 * 0.5)
    assert gap(geometry, nearest + np.pi) == pytest.approx(50e-6 * 1.5)
    assert geometry.thinnest == pytest.approx(25e-6, rel=1e-4)


def test_lobes_with_a_preload_are_circles_about_their_own_centres():
    geometry = bearing(**HALVES, preload=0.5, eccentricity=[0.0, 0.0]).geometry
    radius, clearance, far = geometry.radius, geometry.clearance, 0.5 * geometry.clearance
    for angle in np.radians([-100, -90, -45, -20]):
        # the lower lobe: a circle of radius R + c about a centre half a clearance above that of the bearing
        ray = np.array([np.cos(angle), np.sin(angle)])
        centre = np.array([0.0, far])
        along = ray @ centre + np.sqrt((radius + clearance) ** 2 - centre @ centre + (ray @ centre) ** 2)
        assert gap(geometry, angle) == pytest.approx(along - radius, abs=2e-3 * clearance)
    assert gap(geometry, np.pi / 2) == pytest.approx(far)


def test_the_offset_places_the_nearest_point_along_the_rotation():
    geometry = bearing(**HALVES, preload=0.4, offset=0.75, eccentricity=[0.0, 0.0]).geometry
    angles = geometry.start + np.linspace(0, geometry.turn, 1001)
    films = [gap(geometry, angle) for angle in angles]
    assert np.argmin(films) == 750


def test_a_misaligned_shaft_is_tilted_about_the_middle_of_the_width():
    geometry = bearing(misalignment=["0.2 mrad", "0 rad"], eccentricity=[0.0, 0.0]).geometry
    assert gap(geometry, 0.0, 0.02) == pytest.approx(50e-6)
    assert gap(geometry, 0.0, 0.04) == pytest.approx(50e-6 - 0.2e-3 * 0.02)
    assert gap(geometry, np.pi, 0.0) == pytest.approx(50e-6 - 0.2e-3 * 0.02)


def test_pads_turn_about_their_pivots():
    pads = {"lobes": 4, "arc": "70 deg", "pivot": 0.5, "eccentricity": [0.0, 0.0]}
    level = bearing(**pads).geometry
    tilted = bearing(**pads, tilts=["0.1 mrad", "0 rad", "0 rad", "0 rad"]).geometry
    pivot = level.first
    for angle in np.radians([-30, 0, 20]):
        closing = 50e-3 * 0.1e-3 * np.sin(angle)
        assert gap(level, pivot + angle) - gap(tilted, pivot + angle) == pytest.approx(closing, abs=1e-18)
    assert gap(tilted, pivot + np.pi / 2 + 0.3) == gap(level, pivot + np.pi / 2 + 0.3)


def test_another_least_film_keeps_the_direction_of_the_shaft():
    geometry = bearing(**HALVES, preload=0.3, eccentricity=[0.1, -0.2]).geometry
    nearer = geometry.at_film(5e-6)
    assert nearer.thinnest == pytest.approx(5e-6, rel=1e-9)
    x, y = nearer.eccentricity
    assert y / x == pytest.approx(-2.0)


@pytest.mark.parametrize("place", [{}, {"eccentricity": [-0.001, -0.003]}])
def test_another_least_film_in_an_arc_that_the_shaft_would_leave_is_towards_the_arc(place):
    above = bearing(arc="110 deg", first="50 deg", preload=0.5, **place).geometry.at_film(5e-6)
    assert above.thinnest == pytest.approx(5e-6, rel=1e-9)
    assert np.degrees(np.arctan2(*above.eccentricity[::-1])) == pytest.approx(50)


@pytest.mark.parametrize(
    ("geometry", "message"),
    [
        ({"arc": "200 deg", "lobes": 2}, r"geometry\.arc: got 200 degrees; 2 equal lobes have at most 180 degrees"),
        (
            {"eccentricity": [0.9, 0.9]},
            r"geometry\.eccentricity: got \[0\.9, 0\.9\]; the shaft reaches 1\.36e-05 m",
        ),
        ({"pivot": 0.5}, r"geometry\.pivot: got one for lobes without gaps"),
        ({**HALVES, "pivot": 0.5, "tilts": ["0 rad"]}, r"geometry\.tilts: got 1; give one for each of the lobes"),
        ({"preload": 1.0}, r"geometry\.preload: got 1\.0; it must be 0 or more and below 1"),
        ({"lobes": 0}, r"geometry\.lobes"),
    ],
)
def test_faults_are_one_line(geometry, message):
    with pytest.raises(InputError, match=message):
        bearing(**geometry)


def test_lobes_without_gaps_are_fed_through_their_sides():
    wide = {name: value for name, value in PLAIN.items() if name != "width"}
    entries = {"name": "lobes", "kind": "bearing", "geometry": wide, "load": {"force_per_width": "5 kN/m"}}
    with pytest.raises(
        InputError, match=r"geometry\.width: is missing, but lobes without gaps are fed through their sides"
    ):
        read_scene({**entries, "lubricant": {"viscosity": "20 mPa*s"}, "motion": {"speed": "3000 rpm"}})
