"""Curves over speed of bearings without asperities: the film under a load, its friction, and refusals."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.mixed.stribeck import stribeck
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm"}
WEDGE = {"shape": "linear", "length": "20 mm", "rise": "12 um"}
RIDGES = {"kind": "sinusoid", "amplitude": "2 um", "wavelength": "0.5 mm"}


def scene(geometry, speed="2 m/s", **tables):
    oil, load = {"viscosity": "0.02 Pa*s"}, {"pressure": "1 MPa"}
    given = {"lubricant": oil, "motion": {"speed": speed}, "load": load, "geometry": geometry}
    return read_scene({"name": "bearing", "kind": "bearing"} | given | tables)


@pytest.mark.parametrize(
    ("geometry", "tables", "model"),
    [
        (JOURNAL, {}, "reynolds_cavitating"),
        (WEDGE | {"width": "20 mm"}, {}, "reynolds_cavitating"),
        (WEDGE, {"roughness": RIDGES}, "homogenized"),
    ],
)
def test_a_curve_without_asperities_is_the_film_under_the_load_at_each_speed(geometry, tables, model):
    (curve,) = stribeck(scene(geometry, **tables), [0.5, 2.0, 5.0], [1e6], resolution=32)
    assert [point.speed for point in curve.points] == [0.5, 2.0, 5.0]
    assert curve.lift_off.speed == 0
    for point in curve.points:
        own = scene(geometry, f"{point.speed} m/s", **tables)
        one = find("bearing", model).solve(own, Request(resolution=32)).quantities
        assert point.least_gap == pytest.approx(one["film_min"].value, rel=1e-5)
        assert point.friction_coefficient == pytest.approx(one["friction_coefficient"].value, rel=1e-5)
        assert point.pressure_max == pytest.approx(one["pressure_max"].value, rel=1e-4)
        assert point.cavitated_fraction == pytest.approx(one["cavitated_fraction"].value, abs=1e-3)
        assert point.contact_share == point.contact_load == point.contact_area == 0
    assert (np.diff([point.least_gap for point in curve.points]) > 0).all()


def test_without_cavitation_pressure_film_and_friction_depend_on_speed_over_load_alone():
    """All pressures are proportional to ηu at a given film, so that u/p fixes the film and the friction coefficient."""
    slow, fast = stribeck(scene(WEDGE), [1.0, 2.0], [1e6, 2e6], resolution=32)
    assert fast.points[1].least_gap == pytest.approx(slow.points[0].least_gap, rel=1e-5)
    assert fast.points[1].friction_coefficient == pytest.approx(slow.points[0].friction_coefficient, rel=1e-5)


def test_the_uncertainty_covers_a_finer_grid():
    coarse, fine = (stribeck(scene(JOURNAL), [1.0, 3.0], [1e6], resolution=cells)[0] for cells in (32, 128))
    for one, other in zip(coarse.points, fine.points, strict=True):
        for name in ("separation", "friction", "pressure_max"):
            assert 0 < abs(getattr(one, name) - getattr(other, name)) <= one.uncertainty[name], name


def test_a_speed_of_zero_and_a_load_that_no_speed_carries_are_refused():
    with pytest.raises(InputError, match=r"^speeds: got 0; without sliding"):
        stribeck(scene(JOURNAL), [0.0, 1.0], [1e6], resolution=16)
    flat = scene({"shape": "parallel", "length": "20 mm"})
    with pytest.raises(InputError, match="no film carries a load"):
        stribeck(flat, [1.0], [1e6], resolution=16)


def test_speeds_too_low_for_the_load_are_left_out():
    (curve,) = stribeck(scene(WEDGE), [1e-3, 1.0], [1e6], resolution=32)
    assert [point.speed for point in curve.points] == [1.0]


def test_a_curve_of_a_shaft_below_its_arc_is_refused_in_one_line():
    arc = {"shape": "lobes", "radius": "13 mm", "clearance": "2 um", "arc": "110 deg", "first": "50 deg"}
    below = scene(arc | {"preload": 0.5, "eccentricity": [-0.001, -0.003]}, "-1 m/s").model_copy(update={"load": None})
    with pytest.raises((InputError, ConvergenceError), match=r"^load: "):
        stribeck(below, [0.5, 1.0], [1e3], resolution=16)
