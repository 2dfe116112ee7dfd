"""Journals in a march: the film of their scene in coordinates of the bore, and the steady film in the end."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.geometry.open_bore import OpenBore
from roughfilm.rom.bearing.march.in_time import in_time, steady
from roughfilm.rom.bearing.march.journals import with_coordinates
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "40 um", "width": "25 mm"}
POCKETS = {"length": "3 mm", "depth": "20 um", "start": "60 mm", "width": "5 mm", "profile": "box"}
CELLS = (24, 12)


def bare(geometry=JOURNAL, **tables):
    """A journal without a load."""
    entries = {"lubricant": {"viscosity": "15 mPa*s", "cavitation_pressure": "-0.05 MPa"}, "geometry": geometry}
    return read_scene({"name": "journal", "kind": "bearing", "motion": {"speed": "3000 rpm"}, **entries, **tables})


def scene(geometry=JOURNAL, **tables):
    return bare(geometry, **({"load": {"force": "600 N"}} | tables))


def over_time(**columns):
    return {"speed": "3000 rpm", "over_time": {"time": ["0 ms", "5 ms", "10 ms"]} | columns}


def marched(bearing, **more):
    return march_bearing(bearing, cells=CELLS, uncertain=False, **more)


@pytest.mark.parametrize("first", [-1.2, 0.0, 2.9])
def test_the_film_of_a_bore_is_that_of_its_journal(first):
    journal = scene(JOURNAL | {"eccentricity": 0.7, "texture": POCKETS}).geometry
    x, y = np.meshgrid(np.linspace(0, journal.length, 97), np.linspace(0, 25e-3, 5), indexing="ij")
    ours, theirs = OpenBore.of(journal, first).film_shape(), journal.film_shape()
    assert ours.thickness(x, y) == pytest.approx(theirs.thickness(x, y), rel=1e-9)
    assert ours.breaks == pytest.approx(theirs.breaks)
    assert ours.joined == theirs.joined == (False, False)


@pytest.mark.parametrize(
    "tables",
    [
        {"boundary": {"inlet": {"pressure": "2 bar"}}},
        {"boundary": {"inlet": {"theta": 0.6}}},
        {"geometry": JOURNAL | {"texture": POCKETS}},
        {"supply": [{"kind": "hole", "diameter": "4 mm", "angle": "-80 deg", "pressure": "3 bar"}]},
        {"motion": {"speed": "-3000 rpm"}},
    ],
    ids=["pressurised", "starved", "textured", "supplied", "backwards"],
)
def test_a_march_from_anywhere_ends_in_the_steady_journal(tables):
    """On the same cells, by the search over one eccentricity on the film over the whole width."""
    march = march_bearing(
        scene(**tables, body={"start": {"eccentricity": [0.5, 0.2]}}), cells=(20, 20), uncertain=False, end=0.12
    )
    result = find("bearing", "reynolds_cavitating").solve(scene(**tables), Request(resolution=20))
    assert march.settled
    for name in ("pressure_max", "friction"):
        assert march[name][-1] == pytest.approx(result[name].value, rel=1e-3), name
    assert march["film_min"][-1] == pytest.approx(result["film_min"].value, rel=2e-3)
    shaft = np.arctan2(march["eccentricity_y"][-1], march["eccentricity_x"][-1])
    assert abs(np.cos(np.radians(march.quantities["inlet_angle"].value) - shaft) + 1) < 1e-6
    assert np.degrees(np.abs(shaft + np.pi / 2)) == pytest.approx(result["attitude_angle"].value, rel=1e-3)
    assert np.abs(march["flow_imbalance"]).max() < 1e-9


def test_a_journal_whose_supply_outweighs_its_load_has_its_inlet_opposite_to_the_load():
    """Its eccentricity turns with the inlet, to which no angle of the inlet is opposite."""
    pocket = {"kind": "pocket", "angle": "-60 deg", "pressure": "2 bar", "length": "3 mm", "extent": "3 mm"} | {
        "depth": "1 mm"
    }
    small = JOURNAL | {"radius": "5 mm", "width": "30 mm"}
    oil = {"viscosity": "0.1 Pa*s", "cavitation_pressure": "-0.1 MPa"}
    fed = scene(small, lubricant=oil, motion={"speed": "1 m/s"}, load={"pressure": "2 kPa"}, supply=[pocket])
    march = marched(fed, steps=4, end=1e-3)
    assert march.quantities["inlet_angle"].value == pytest.approx(90)
    assert 0 < march["film_min"].min() < march["film_min"].max() <= 40e-6 * (1 + 1e-9)
    assert np.abs(march["flow_imbalance"]).max() < 1e-9


def test_a_load_that_changes_moves_the_shaft_but_not_the_inlet_and_turns_with_the_bearing():
    moved = []
    for turned in (0.0, 50.0):
        size, angle = ["600 N", "900 N", "300 N"], [f"{a + turned} deg" for a in (-90, -60, -100)]
        march = marched(scene(motion=over_time(load=size, angle=angle)), steps=12)
        assert np.abs(march["flow_imbalance"]).max() < 1e-9
        moved.append(march)
    one, other = moved
    assert np.ptp(one["film_min"]) > 0.1 * one["film_min"][0]
    for name in ("film_min", "pressure_max", "inlet_flow", "film_min_x"):
        assert other[name] == pytest.approx(one[name], rel=1e-6), name
    turned = other.quantities["inlet_angle"].value - one.quantities["inlet_angle"].value
    assert np.mod(turned, 360) == pytest.approx(50)


def test_a_journal_at_rest_at_first_has_its_inlet_opposite_to_its_load():
    columns = {"speed": ["0 m/s", "2 m/s", "-2 m/s"], "load_x": ["0 N", "300 N", "0 N"], "load_y": ["-600 N"] * 3}
    body = {"start": {"eccentricity": [0.0, -0.5]}}
    march = marched(scene(motion=over_time(**columns), body=body), steps=20)
    assert march.quantities["inlet_angle"].value == pytest.approx(90)
    assert np.abs(march["flow_imbalance"]).max() < 1e-9
    assert march["speed"][-1] < 0 < march["speed"][5]


def test_given_paths_begin_at_their_first_position():
    columns = {"eccentricity_x": [0.3, 0.4, 0.3], "eccentricity_y": [0.0, 0.1, 0.2]}
    march = marched(bare(motion=over_time(**columns)), steps=6)
    assert march.quantities["inlet_angle"].value == pytest.approx(180)
    assert march["eccentricity_x"][0] == pytest.approx(0.3)
    closing = {"speed": "0 rpm", "approach": "1 mm/s"}
    squeezed = marched(bare(JOURNAL | {"eccentricity": 0.2}, motion=closing), steps=10, end=0.02)
    assert squeezed["film_min"] == pytest.approx(32e-6 - 1e-3 * squeezed.time, rel=1e-6)


def test_changing_loads_are_judged_as_those_of_the_bore():
    bearing = scene(motion=over_time(load=["600 N", "700 N", "600 N"], angle=["-90 deg", "-80 deg", "-90 deg"]))
    judged = in_time(bearing, 0.05)
    assert judged.entries["quasi_static"]["squeeze_number"] > 0
    assert steady(bearing).load_pressure == pytest.approx(700 / (50e-3 * 25e-3), rel=1e-6)
    path = bare(motion=over_time(eccentricity_x=[0.3, 0.4, 0.3], eccentricity_y=[0.0, 0.1, 0.2]))
    assert 0.3 < steady(path).geometry.eccentricity < np.hypot(0.4, 0.1) * 1.01
    assert with_coordinates(steady(bearing), (16, 8)).geometry.single


def test_a_path_beyond_the_bore_is_one_line():
    with pytest.raises(InputError, match=r"eccentricity_x: got \[1.1, 0.0\] in row 2"):
        bare(motion=over_time(eccentricity_x=[0.3, 1.1, 0.3], eccentricity_y=[0, 0, 0]))
    with pytest.raises(InputError, match=r"load\.angle: got one for the shape 'journal'"):
        scene(load={"force": "1 kN", "angle": "0 deg"})
