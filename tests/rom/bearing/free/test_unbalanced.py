"""Loads that no film balances: moments that put the centre of the pressure outside of the pad, and remedies."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.free.unbalanced import unbalanced
from roughfilm.rom.ladder.scene import read_scene

PAD = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": 0.6}


def film(geometry=PAD, *, speed="10 m/s", lowest="0 Pa", **load):
    entries = {
        "name": "loaded",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": {"viscosity": "30 mPa*s", "cavitation_pressure": lowest},
        "motion": {"speed": speed},
        "load": {"force": "3 kN"} | load,
    }
    return free_film(read_scene(entries), (16, 8))


@pytest.mark.parametrize(
    ("moment", "inside", "outside"),
    [("moment_y", 47.9, 48.1), ("moment_y", -71.9, -72.1), ("moment_x", 59.9, 60.1), ("moment_x", -59.9, -60.1)],
)
def test_the_centre_of_the_pressure_lies_inside_of_the_pad(moment, inside, outside):
    """3 kN at 16 mm from the pivot to the outlet, 24 mm to the inlet and 20 mm to both sides."""
    for value, refused in ((inside, False), (outside, True)):
        one = film(**{moment: f"{value} N*m"})
        reason = unbalanced(one, one.load)
        assert (reason is not None) is refused
        if reason is not None:
            assert str(reason).startswith(f"load.{moment}: got {value} N*m, which puts the centre of the pressure")
            assert "lower the moment or raise the load" in str(reason)


def test_a_pad_that_slides_backwards_has_the_same_bounds():
    for value, refused in ((47.9, False), (48.1, True)):
        one = film(speed="-10 m/s", moment_y=f"{value} N*m")
        assert (unbalanced(one, one.load) is not None) is refused


def test_tension_down_to_the_cavitation_pressure_balances_larger_moments():
    """The centre of p - p_c lies inside: 1 MPa over 16 cm² are 1600 N in the middle, 4 mm before the pivot."""
    largest = 3000 * 0.016 + 1600 * (0.016 + 0.004)
    for value, refused in ((largest - 0.1, False), (largest + 0.1, True)):
        one = film(lowest="-1 MPa", moment_y=f"{value} N*m")
        assert (unbalanced(one, one.load) is not None) is refused


def test_a_pivot_at_the_outlet_is_refused():
    with pytest.raises(InputError, match=r"^geometry\.pivot: got \[1\.0, 0\.5\]; it lies at an edge"):
        equilibrium(film(PAD | {"pivot": 1.0}), None, tolerance=1e-8)


@pytest.mark.parametrize(
    ("changed", "load", "remedy"),
    [
        ({"slopes": ["2 mrad", "0 rad"]}, {}, "smaller geometry.slopes by which the film narrows"),
        ({}, {"moment_y": "-50 N*m"}, "change load.moment_x or load.moment_y"),
    ],
)
def test_the_remedy_names_the_key_that_the_scene_gives(changed, load, remedy):
    with pytest.raises((InputError, ConvergenceError), match=remedy):
        equilibrium(film(PAD | changed, **load), None, tolerance=1e-8)
