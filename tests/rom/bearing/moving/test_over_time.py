"""Tables over time: how they repeat, and one line for every fault."""

import math

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import read_scene, scene_entries

SHAFT = {"shape": "lobes", "radius": "25 mm", "clearance": "25 um", "width": "25 mm"}
PAD = {"shape": "linear", "length": "20 mm", "width": "20 mm", "rise": "20 um"}


def scene(table, geometry=SHAFT, **others):
    return read_scene(
        {
            "name": "changing",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": "10 mPa*s", "cavitation_pressure": "-0.1 MPa"},
            "motion": {"speed": "5 m/s", "over_time": table},
            **others,
        }
    )


def test_a_repeating_column_and_its_slope_are_continuous_over_the_seam():
    table = {"time": ["0 s", "1 s", "3 s"], "load": ["1 N", "5 N", "2 N"], "period": "4 s"}
    curve = scene(table).motion.over_time.table.curves["load"]
    for time in (0.0, 4.0, 8.0):
        assert curve(time) == pytest.approx(1.0)
        assert curve(time - 1e-7, 1) == pytest.approx(curve(time + 1e-7, 1), abs=1e-5)
    assert curve(1.7) == pytest.approx(curve(9.7))


def test_an_angle_gains_whole_turns_in_a_period():
    table = {
        "time": ["0 s", "1 s", "2 s"],
        "load": ["1 N"] * 3,
        "angle": ["0 deg", "180 deg", "360 deg"],
        "period": "2 s",
    }
    curve = scene(table).motion.over_time.table.curves["angle"]
    assert curve(7.0) == pytest.approx(7 * math.pi)
    assert curve(6.0, 1) == pytest.approx(math.pi)


def test_the_integral_of_a_column_counts_whole_periods():
    table = {"time": ["0 s", "1 s", "2 s"], "speed": ["1 m/s", "3 m/s", "1 m/s"], "load": ["1 N"] * 3, "period": "2 s"}
    curve = scene(table).motion.over_time.table.curves["speed"]
    times = np.linspace(0, 5, 20001)
    assert curve.since_first(5.0) == pytest.approx(np.trapezoid([curve(time) for time in times], times), rel=1e-6)


@pytest.mark.parametrize("small", ["2.4e-17", "-1e-300", "0"])
def test_numbers_below_their_range_are_rounding_errors_of_computed_ones(tmp_path, small):
    """A sine at whole turns; a number above the range, or one that is not finite, is refused."""
    path = tmp_path / "path.csv"
    head = "time (s), eccentricity_x, eccentricity_y, speed (rad/s)\n0, 0.1, 0, 1\n"
    path.write_text(f"{head}1, 0.2, {small}, {small}\n")
    in_file = scene({"file": str(path)}).motion.over_time.table
    lists = {"time": ["0 s", "1 s"], "eccentricity_x": [0.1, 0.2], "eccentricity_y": [0, float(small)]}
    in_lists = scene(lists | {"speed": ["0.025 m/s", f"{small} m/s"]}).motion.over_time.table
    for table in (in_file, in_lists):
        assert table.columns["eccentricity_y"].tolist() == [0.0, 0.0]
        assert abs(table.columns["speed"][1]) <= abs(float(small))
    path.write_text(f"time (s), load (N), moment_x (N m)\n0, 5, 1\n1, 5, {small}\n")
    pivoted = {"shape": "pivoted", "length": "50 mm", "width": "50 mm", "pivot": [0.58, 0.5]}
    assert abs(scene({"file": str(path)}, pivoted).motion.over_time.table.columns["moment_x"][1]) <= abs(float(small))
    for wrong in ("1e40", "inf", "nan"):
        path.write_text(f"{head}1, 0.2, {wrong}, 1\n")
        with pytest.raises(InputError, match="line 3: eccentricity_y"):
            scene({"file": str(path)})


def test_a_file_gives_the_columns_in_si_units_and_its_digest_is_kept(tmp_path):
    path = tmp_path / "duty.csv"
    path.write_text("load (kN), time (ms), speed (rpm)\n1, 0, 60\n2, 10, 120\n")
    made = scene({"file": str(path)})
    table = made.motion.over_time.table
    assert table.time.tolist() == [0.0, 0.01]
    assert table.columns["load"].tolist() == [1000.0, 2000.0]
    assert table.columns["speed"] == pytest.approx([2 * math.pi, 4 * math.pi])
    assert read_scene(scene_entries(made)) == made
    entries = scene_entries(made)
    path.write_text("load (kN), time (ms), speed (rpm)\n1, 0, 60\n2.5, 10, 120\n")
    with pytest.raises(InputError, match=r"digest: got .* now have"):
        read_scene(entries)


TIMES = ["0 s", "1 s"]
FAULTS = {
    "unsorted": ({"time": ["0 s", "2 s", "1 s"], "load": ["1 N"] * 3}, {}, "row 3 after"),
    "one row": ({"time": ["0 s"], "load": ["1 N"]}, {}, "2 entries or more"),
    "other length": ({"time": TIMES, "load": ["1 N"]}, {}, "got 1 rows, but time has 2"),
    "no column": ({"time": TIMES}, {}, "no column beside it"),
    "unknown column": ({"time": TIMES, "lod": ["1 N"] * 2}, {}, "unknown key"),
    "no time": ({"load": ["1 N"] * 2}, {}, "time: is missing"),
    "one component": ({"time": TIMES, "load_x": ["1 N"] * 2}, {}, "load_y: is missing"),
    "two loads": (
        {"time": TIMES, "load": ["1 N"] * 2, "load_x": ["1 N"] * 2, "load_y": ["1 N"] * 2},
        {},
        "beside load",
    ),
    "load and path": (
        {"time": TIMES, "load": ["1 N"] * 2, "eccentricity_x": [0, 0.1], "eccentricity_y": [0, 0]},
        {},
        "got it beside load",
    ),
    "free load and path": (
        {"time": TIMES, "eccentricity_x": [0, 0.1], "eccentricity_y": [0, 0]},
        {"load": {"force": "1 kN"}},
        "got a path beside",
    ),
    "beyond the bore": ({"time": TIMES, "eccentricity_x": [0, 0.8], "eccentricity_y": [0, 0.7]}, {}, "into the bore"),
    "negative film": ({"time": TIMES, "film": ["1 um", "-1 um"]}, {"geometry": PAD}, "above zero"),
    "film of a shaft": ({"time": TIMES, "film": ["1 um", "2 um"]}, {}, "give eccentricity_x"),
    "open period": ({"time": TIMES, "load": ["1 N", "2 N"], "period": "1 s"}, {}, "ends where it begins"),
    "short period": ({"time": TIMES, "load": ["1 N", "2 N"], "period": "0.5 s"}, {}, "the rows span"),
    "no file": ({"file": "/nowhere.csv"}, {}, "no such file"),
    "unbalance without load": (
        {"time": TIMES, "eccentricity_x": [0, 0.1], "eccentricity_y": [0, 0]},
        {"body": {"mass": "1 kg"}},
        "no load acts on",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_of_a_table_is_one_line(name):
    table, others, words = FAULTS[name]
    with pytest.raises(InputError, match=words) as error:
        scene(table, **others)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("load (kN)\n1\n2\n", "no column time"),
        ("time (ms), load (quark)\n0, 1\n1, 2\n", "not known"),
        ("time (ms), load (mm)\n0, 1\n1, 2\n", "wrong dimension"),
        ("time (ms), load\n0, 1\n1, 2\n", "without a unit"),
        ("time (ms), load (N)\n0, 1\n1\n", "line 3: got 1 columns"),
        ("time (ms), load (N)\n0, 1\nx, 2\n", "line 3: time"),
        ("time (ms), load (N), load (N)\n0, 1, 1\n1, 2, 2\n", "got load twice"),
        ("time (ms), load (N)\n0, nan\n1, 2\n", "line 2: load"),
    ],
)
def test_every_fault_of_a_file_is_one_line(tmp_path, text, words):
    path = tmp_path / "duty.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=words) as error:
        scene({"file": str(path)})
    assert "\n" not in str(error.value)


def test_a_steady_film_carries_the_load_of_the_scene_and_no_load_of_its_table():
    table = {"time": ["0 s", "1 s"], "load": ["1 kN", "2 kN"]}
    fed = {"lobes": 2, "arc": "150 deg"}
    assert rf.solve(scene(table, SHAFT | fed, load={"force": "500 N"}))["load"].value == pytest.approx(500, rel=1e-6)
    with pytest.raises(InputError, match=r"^load: is missing; .* \[load\], or take roughfilm march$"):
        rf.solve(scene(table, SHAFT | fed))
