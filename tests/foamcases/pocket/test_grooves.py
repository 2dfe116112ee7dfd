"""Splined, measured and repeated grooves in OpenFOAM: independent loads, symmetry, and agreement with the arc."""

import numpy as np
import pytest

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.groove import cylindrical

pytestmark = pytest.mark.openfoam

STOKES, NAVIER_STOKES = find("pocket", "stokes"), find("pocket", "navier_stokes")

SPLINED = [
    (0.15, 0.50, -0.3, 0.481),
    (0.15, 0.50, 0.3, 0.327),
    (0.50, 0.25, -0.3, 2.476),
    (0.50, 0.25, 0.3, -0.102),
]
"""w+, d+, xd+ at Re = 40 and the load of an independent solver, to its last digit."""


def scene_of(reynolds_number, length="1 mm", **geometry):
    return read_scene(
        {
            "name": "grooves",
            "kind": "pocket",
            "geometry": {"length": length, "film": "30 um", **geometry},
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": reynolds_number},
        }
    )


def splined(width, depth, shift):
    return {
        "profile": "splined",
        "width": f"{width!r} mm",
        "depth": f"{30 * depth!r} um",
        "shift": f"{shift * width!r} mm",
    }


def value(result, name):
    return result.quantities[name].value


@pytest.mark.slow
@pytest.mark.parametrize(("width", "depth", "shift", "expected"), SPLINED)
def test_splined_loads_are_those_of_an_independent_solver(width, depth, shift, expected):
    result = NAVIER_STOKES.solve(scene_of(40, **splined(width, depth, shift)))
    assert value(result, "load_plus") == pytest.approx(expected, rel=5e-3, abs=6e-4)


def test_half_the_columns_find_the_load_of_a_narrow_spline_to_one_percent():
    result = NAVIER_STOKES.solve(scene_of(40, **splined(0.15, 0.50, -0.3)), Request(resolution=120))
    assert value(result, "load_plus") == pytest.approx(0.481, rel=1e-2)


def test_a_mirrored_spline_has_the_mirrored_pressure_in_stokes_flow():
    left, right = (
        STOKES.solve(scene_of(1, **splined(0.3, 0.75, shift)), Request(resolution=60)) for shift in (-0.3, 0.3)
    )
    p, mirrored = left.fields["pressure"].values, right.fields["pressure"].values[::-1]
    assert np.abs(p + mirrored).max() < 1e-6 * np.abs(p).max()
    assert value(left, "load_plus") == pytest.approx(-value(right, "load_plus"), rel=1e-5)


def test_two_equal_grooves_are_one_in_half_the_period():
    """To the error of the grid; in the longer period, one groove's pressure repeats the other's more closely."""
    groove = {"width": "0.3 mm", "depth": "22.5 um"}
    single = NAVIER_STOKES.solve(scene_of(80, "0.5 mm", **groove), Request(resolution=120))
    grooves = [{"position": position, **groove} for position in ("-0.25 mm", "0.25 mm")]
    double = NAVIER_STOKES.solve(scene_of(80, "1 mm", grooves=grooves), Request(resolution=120))
    for name in ("load_per_area", "friction_per_area"):
        assert value(double, name) == pytest.approx(value(single, name), rel=1e-2)
    pressure, x = (double.fields[name].values for name in ("pressure", "position"))
    later = np.interp(x[x < 0] + 0.5e-3, x, pressure)
    assert np.abs(pressure[x < 0] - later).max() < 1e-3 * np.ptp(pressure)


def test_an_arc_through_points_carries_what_the_arc_carries():
    """The mesh does not follow the points, however many: w+ = 0.30, d+ = 0.25, Re = 160."""
    s = np.linspace(-1.5e-4, 1.5e-4, 301)
    depth = cylindrical(width=3e-4, depth=7.5e-6).depth(s)
    scene = scene_of(160, profile="points", points=np.column_stack([s, depth]).tolist())
    result = NAVIER_STOKES.solve(scene, Request(resolution=120))
    assert value(result, "load_plus") == pytest.approx(3.303, rel=5e-3)
    assert abs(result.fields["position"].values.size - 120) <= 6
