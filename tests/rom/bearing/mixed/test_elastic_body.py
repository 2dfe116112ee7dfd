"""Mixed films between bodies that bend: rigid and uniform limits, and the balance by an independent sum."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, balanced
from roughfilm.rom.bearing.mixed.elastic_body import elastic_equilibrium
from roughfilm.rom.bearing.mixed.film import MixedFilm

PAD = {"shape": "linear", "length": "20 mm", "width": "12 mm", "film": "1 um", "rise": "3 um"}
MODULUS = 200e9


def film_of(tips, geometry=PAD, cells=16, **more):
    return MixedFilm(scene=tips.scene(geometry, **more), asperities=tips.table(), cells=cells)


def love(x, y, side_x, side_y):
    """∫∫ dx dy / r over a rectangle with its middle at the origin, from (x, y): displacement for p/(π E*) = 1."""

    def corner(a, b):
        return a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b))

    signs = [(i, j) for i in (1, -1) for j in (1, -1)]
    return sum(i * j * corner(x + i * side_x / 2, y + j * side_y / 2) for i, j in signs)


def test_stiff_bodies_do_not_deform(tips):
    film = film_of(tips)
    rigid = balanced(FilmsAtSpeed(film=film, speed=0.1), 3e6, tolerance=1e-9)
    bent = elastic_equilibrium(film, 1e9 * MODULUS, 3e6, 0.1, tolerance=1e-8)
    assert bent.mixed.scene.geometry.film == pytest.approx(rigid.scene.geometry.film, rel=1e-6)
    assert bent.mixed.friction == pytest.approx(rigid.friction, rel=1e-6)
    assert np.abs(bent.displacement).max() < 1e-6 * rigid.scene.geometry.film


def test_bending_is_the_sum_over_all_elements_and_the_load_is_carried(tips):
    """Of Love's rectangles, added up one by one; contact and film are those of the bent walls."""
    film = film_of(tips, cells=12)
    bent = elastic_equilibrium(film, MODULUS, 5e6, 0.1, tolerance=1e-7)
    x, y = (places.ravel() for places in np.meshgrid(bent.x, bent.y, indexing="ij"))
    dx, dy = bent.x[1] - bent.x[0], bent.y[1] - bent.y[0]
    kernel = love(x[:, None] - x, y[:, None] - y, dx, dy) / (math.pi * MODULUS)
    assert bent.displacement.ravel() == pytest.approx(kernel @ bent.pressure.ravel(), abs=1e-12)
    assert bent.pressure.sum() * dx * dy == pytest.approx(5e6 * 20e-3 * 12e-3, rel=1e-6)
    assert bent.mixed.load == pytest.approx(5e6 * 20e-3 * 12e-3, rel=1e-6)
    rigid = bent.mixed.scene.geometry.film + 3e-6 * (1 - x / 20e-3)
    assert bent.separation.ravel() == pytest.approx(rigid + bent.displacement.ravel(), abs=1e-15)
    contact = float(tips.pressure(bent.separation).sum() * dx * dy)
    assert bent.mixed.contact_load == pytest.approx(contact, rel=1e-9)
    assert bent.mixed.contact_load > 0
    assert bent.residual <= 1e-7
    assert np.ptp(bent.displacement) > 0.05e-6


def test_uniform_pressure_bends_as_one_rectangle(tips):
    """Of a bath at 10 MPa all around; the asperities have a hundred-thousandth of the load."""
    around = {"inlet": {"pressure": "10 MPa"}, "outlet": {"pressure": "10 MPa"}}
    sides = {"sides": {"low": "10 MPa", "high": "10 MPa"}}
    geometry = {"shape": "parallel", "length": "20 mm", "width": "12 mm", "film": "1 um"}
    film = film_of(tips, geometry, boundary=around | sides, motion={"speed": "0 m/s"})
    bent = elastic_equilibrium(film, MODULUS, 10.0001e6, 0.0)
    x, y = np.meshgrid(bent.x - 10e-3, bent.y - 6e-3, indexing="ij")
    expected = 10e6 / (math.pi * MODULUS) * love(x, y, 20e-3, 12e-3)
    assert bent.displacement == pytest.approx(expected, rel=1e-3)


def test_the_softer_the_bodies_the_more_of_a_crown_touches(tips):
    crown = {"shape": "parabolic", "length": "20 mm", "width": "12 mm", "film": "1 um", "rise": "20 um"}
    widths = []
    for modulus in (100 * MODULUS, MODULUS, MODULUS / 3):
        bent = elastic_equilibrium(film_of(tips, crown), modulus, 3e6, 0.0)
        pressure = tips.pressure(bent.separation[:, bent.y.size // 2])
        widths.append(pressure.sum() ** 2 / (pressure**2).sum())
        assert bent.films < 500
    assert 4 < widths[0] < 0.99 * widths[1] < 0.98 * widths[2]


def test_a_load_beyond_the_table_of_elastic_bodies_is_refused(tips):
    with pytest.raises(InputError, match=r"closer than the smallest separation|carry at most"):
        elastic_equilibrium(film_of(tips), MODULUS, 45e6, 0.0)


def test_a_symmetric_pad_bends_symmetrically_whichever_way_it_slides(tips):
    geometry = {"shape": "parabolic", "length": "20 mm", "width": "12 mm", "film": "1 um", "rise": "2 um"}
    film = film_of(tips, geometry, cells=12)
    there, back = (elastic_equilibrium(film, MODULUS, 2e6, speed) for speed in (0.1, -0.1))
    assert back.displacement[::-1] == pytest.approx(there.displacement, rel=1e-5)
    assert there.displacement[:, ::-1] == pytest.approx(there.displacement, rel=1e-5)


@pytest.mark.parametrize(
    ("geometry", "modulus", "words"),
    [
        (PAD, 0.0, r"composite modulus: got 0\.0 Pa"),
        ({key: value for key, value in PAD.items() if key != "width"}, MODULUS, "need a pad over a rectangle"),
        (
            {"shape": "journal", "radius": "10 mm", "width": "10 mm", "clearance": "10 um", "eccentricity": 0.5},
            MODULUS,
            "need a pad over a rectangle",
        ),
    ],
)
def test_bearings_without_elastic_bodies_are_refused(tips, geometry, modulus, words):
    with pytest.raises(InputError, match=words):
        elastic_equilibrium(film_of(tips, geometry), modulus, 1e6, 0.1)
