"""Shafts in lobes under a load: published static points, symmetry, limits, and conservation."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.bearing.free import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.free.solve import solve_free
from roughfilm.rom.bearing.free.walls import wall_of
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

OIL, SPEED = {"viscosity": "20 mPa*s"}, {"speed": "3000 rpm"}
SIDES = {"sides": {"low": "1 bar", "high": "1 bar"}}
BORE = {"shape": "lobes", "radius": "50 mm", "clearance": "50 um", "width": "50 mm"}
GROOVED = BORE | {"lobes": 2, "arc": "160 deg"}


def solved(geometry, *, cells=64, model="reynolds_cavitating", **tables):
    tables = {"lubricant": OIL, "motion": SPEED, "load": {"force": "5 kN"}} | tables
    tables = {name: table for name, table in tables.items() if table is not None}
    scene = read_scene({"name": "lobes", "kind": "bearing", "geometry": geometry, **tables})
    return find("bearing", model).solve(scene, Request(resolution=cells))


def close(one, other, *names, factor=1.0):
    for name in names:
        bar = one[name].uncertainty + other[name].uncertainty
        assert abs(one[name].value - factor * other[name].value) <= bar + 1e-9 * abs(one[name].value), name


@pytest.mark.parametrize(
    ("preload", "number", "eccentricity", "attitude"),
    [(0.0, 0.991, 0.15, 70.58), (0.0, 0.235, 0.46, 49.27), (0.0, 0.108, 0.65, 39.72), (0.5, 0.12, 0.35, 81.8)],
)
def test_static_points_are_those_of_lund_and_thomsen(preload, number, eccentricity, attitude):
    """Bores with two axial grooves, L/D = 1 (ASME 1978, as in the literature tests of ROSS)."""
    force = 0.02 * 50 * 0.1 * 0.1 * 1e6 / number
    result = solved(GROOVED | {"width": "100 mm", "preload": preload}, load={"force": f"{force!r} N"}, cells=72)
    assert result["eccentricity"].value == pytest.approx(eccentricity, abs=2e-3)
    assert result["attitude_angle"].value == pytest.approx(attitude, abs=0.3)


def test_a_given_eccentricity_and_the_load_that_it_carries_are_the_same_film():
    loaded = solved(GROOVED)
    place = [loaded["eccentricity_x"].value, loaded["eccentricity_y"].value]
    scene = {"name": "lobes", "kind": "bearing", "geometry": GROOVED | {"eccentricity": place}}
    given = find("bearing", "reynolds_cavitating").solve(
        read_scene({**scene, "lubricant": OIL, "motion": SPEED}), Request(resolution=64)
    )
    for name in ("load", "film_min", "friction", "pressure_max", "side_leakage", "inlet_flow"):
        assert given[name].value == pytest.approx(loaded[name].value, rel=1e-6), name


def test_the_load_turns_the_shaft_with_it_in_a_full_bore():
    down = solved(BORE, boundary=SIDES)
    aside = solved(BORE, boundary=SIDES, load={"force": "5 kN", "angle": "17 deg"})
    close(down, aside, "eccentricity", "friction", "pressure_max", "film_min")
    assert aside["attitude_angle"].value == pytest.approx(down["attitude_angle"].value, abs=0.2)


def test_a_shaft_that_turns_back_is_the_mirror_image():
    forth, back = solved(GROOVED), solved(GROOVED, motion={"speed": "-3000 rpm"})
    for name in ("load", "film_min", "friction", "pressure_max", "side_leakage", "eccentricity_y"):
        assert back[name].value == pytest.approx(forth[name].value, rel=1e-7), name
    assert back["eccentricity_x"].value == pytest.approx(-forth["eccentricity_x"].value, rel=1e-7)


@pytest.mark.parametrize("pads", [{}, {"pivot": 0.5, "tilts": ["0.2 mrad", "0.1 mrad"]}])
def test_a_given_shaft_that_turns_back_is_the_mirror_image(pads):
    """Mirrored in the vertical plane, in which both pads, below and above, are their own images."""
    tables = {"cells": 32, "load": None}
    forth = solved(GROOVED | pads | {"eccentricity": [0.3, -0.4]}, **tables)
    turned = {"tilts": ["-0.2 mrad", "-0.1 mrad"]} if pads else {}
    back = solved(GROOVED | pads | turned | {"eccentricity": [-0.3, -0.4]}, motion={"speed": "-3000 rpm"}, **tables)
    for name in ("load", "film_min", "friction", "pressure_max", "side_leakage", "attitude_angle"):
        assert back[name].value == pytest.approx(forth[name].value, rel=1e-7), name


def test_what_enters_from_the_gaps_leaves_into_them_or_through_the_sides():
    result = solved(GROOVED)
    flows = {name: result[name].value for name in ("inlet_flow", "outlet_flow", "side_leakage")}
    assert flows["inlet_flow"] == pytest.approx(flows["outlet_flow"] + flows["side_leakage"], rel=1e-9)
    assert flows["side_leakage"] > 0
    finer = solved(GROOVED, cells=128)
    close(result, finer, *flows)


def test_flows_around_corners_of_grooves_whose_pressure_jumps_are_infinite_and_said_so():
    fed = solved(GROOVED, boundary={"inlet": {"pressure": "1 bar"}})
    assert fed["inlet_flow"].uncertainty is None
    assert fed["film_min"].uncertainty is not None
    (warning,) = fed.warnings
    assert warning.startswith("the pressure jumps between gaps and low side (+1e+05 Pa), gaps and high side")
    assert solved(GROOVED).warnings == ()


def test_the_uncertainties_cover_a_finer_film():
    coarse, fine = solved(GROOVED | {"preload": 0.3}), solved(GROOVED | {"preload": 0.3}, cells=192)
    names = [name for name, one in coarse.quantities.items() if np.isfinite(one.uncertainty or np.inf)]
    outside = [
        name
        for name in names
        if abs(coarse[name].value - fine[name].value) > coarse[name].uncertainty + 1e-7 * abs(fine[name].value)
    ]
    assert len(names) > 15
    assert len(outside) <= 1, outside


def test_a_misaligned_film_is_solved_over_the_whole_width():
    level = solved(GROOVED)
    tilted = solved(GROOVED | {"misalignment": ["0.2 mrad", "-0.1 mrad"]})
    assert tilted["film_min"].value < level["film_min"].value
    one, other = tilted["side_leakage_low"].value, tilted["side_leakage_high"].value
    assert abs(one - other) > 0.01 * abs(one)
    assert level["side_leakage_low"].value == pytest.approx(level["side_leakage_high"].value, rel=1e-9)


def test_a_partial_arc_is_one_film_with_an_inlet_and_an_outlet():
    result = solved(BORE | {"arc": "150 deg"})
    assert 0 < result["rupture"].value <= 1
    assert result["inlet_flow"].value == pytest.approx(
        result["outlet_flow"].value + result["side_leakage"].value, rel=1e-9
    )


def test_an_infinitely_wide_bore_has_the_load_per_width():
    wide = {name: value for name, value in GROOVED.items() if name != "width"}
    result = solved(wide, cells=256, load={"force_per_width": "200 kN/m"})
    assert result["load_per_width"].value == pytest.approx(2e5, rel=1e-8)
    line = solved(GROOVED | {"width": "5 m"}, cells=64, model="infinitely_wide", load={"force": "1 MN"})
    close(line, result, "film_min", "attitude_angle")


def test_a_coarse_film_has_an_uncertainty_too():
    result = solved(GROOVED, cells=32)
    assert 0 < result["film_min"].uncertainty < 0.1 * result["film_min"].value


def test_the_uncertainty_contains_the_motion_of_the_shaft_along_the_film():
    """A component of a motion may be small by chance; the least film is as uncertain as the film is anywhere."""
    entries = {"name": "lobes", "kind": "bearing", "geometry": GROOVED, "lubricant": OIL, "motion": SPEED}
    scene = read_scene({**entries, "load": {"force": "30 kN", "angle": "-120 deg"}})
    free = solve_free(scene, 36, tolerance=1e-8)
    fine, coarse = (one.geometry for one in free.scenes[:2])
    x, y = np.linspace(0.0, fine.length, 2000), np.zeros(2000)
    change = np.abs(coarse.thickness(x, y) / fine.thickness(x, y) - 1)[~fine.in_gap(x)].max()
    assert free.apart["film_min"] == pytest.approx(change * fine.least_film, rel=0.1)
    apart = np.hypot(*np.subtract(fine.eccentricity, coarse.eccentricity))
    assert free.apart["eccentricity_x"] == pytest.approx(apart, rel=1e-9)
    result = find("bearing", "reynolds_cavitating").solve(scene, Request(resolution=36))
    assert min(result[name].uncertainty for name in ("eccentricity_x", "eccentricity_y", "eccentricity")) >= apart
    assert result["film_min"].uncertainty >= free.apart["film_min"] * (1 - 1e-9)


def test_a_film_of_one_coordinate_that_does_not_settle_is_one_line(monkeypatch):
    """It has a force without a direction, unlike a shaft."""
    monkeypatch.setattr(equilibrium, "MAX_STEPS", 0)
    pad = {"shape": "linear", "length": "20 mm", "film": "10 um", "rise": "10 um"}
    entries = {"geometry": pad, "lubricant": OIL, "motion": {"speed": "1 m/s"}, "load": {"pressure": "1 MPa"}}
    scene = read_scene({"name": "pad", "kind": "bearing", **entries})
    film = free_film(scene, (16, 1), wall=wall_of(scene, None))
    with pytest.raises(ConvergenceError, match=r"^load: the motion towards the equilibrium does not settle"):
        equilibrium.equilibrium(film, None, tolerance=1e-9, load=np.array([-2e4]))


@pytest.mark.parametrize("bore", [{"lobes": 1}, {"lobes": 5, "preload": 0.3, "offset": 0.6}])
def test_a_cavity_around_a_bore_fills_and_its_film_is_that_of_nearly_smooth_walls(bore):
    """Its filling is not determined by the flow along it; liquid that the film drives into it stays there."""
    small = {"shape": "lobes", "radius": "2 mm", "clearance": "1 um", "width": "60 mm", "eccentricity": [0.24, 0.0]}
    ridges = {"kind": "sinusoid", "amplitude": "0.03 um", "wavelength": "5 mm", "direction": "90 deg"}
    tables = {"lubricant": {"viscosity": "0.2 Pa*s", "cavitation_pressure": "-20 kPa"}, "motion": {"speed": "-1 m/s"}}
    rough = solved(small | bore, cells=16, model="direct", load=None, roughness=ridges, **tables)
    smooth = solved(small | bore, cells=16, load=None, **tables)
    for one in (rough, smooth):
        assert 0 < one["theta_min"].value < 1
        assert abs(one["side_leakage"].value) < 1e-7 * 1e-6 * 60e-3  # of h u B: nothing supplies the film
    for name in ("load", "friction"):
        assert rough[name].value == pytest.approx(smooth[name].value, rel=0.02)


def test_a_pad_through_the_shaft_at_its_edge_is_no_equilibrium():
    """The film of the node at the edge of a pad is the mean of those of the pad and of the gap beside it."""
    pads = {"shape": "lobes", "radius": "1.73 mm", "clearance": "4.96 um", "lobes": 3, "preload": 0.171, "pivot": 0.5}
    oil = {"viscosity": "0.176 Pa*s", "cavitation_pressure": "-50 kPa"}
    tables = {"motion": {"speed": "0.316 m/s"}, "load": {"pressure": "1.3333 MPa", "angle": "50.3 deg"}}
    with pytest.raises(ConvergenceError, match=r"^load: the walls touch between the nodes of the grid, where .* take"):
        solved(pads | {"arc": "97.68 deg", "width": "1.0034 mm"}, cells=16, lubricant=oil, **tables)
