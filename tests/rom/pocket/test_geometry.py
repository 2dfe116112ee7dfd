"""The grooves of a scene file: every kind is read and written back, every fault is one line that names the key."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

SINGLE = {"width": "0.3 mm", "depth": "7.5 um"}
POINTS = [[-1e-4, 0.0], [0.0, 1e-5], [5e-5, 8e-6], [2e-4, 0.0]]


def entries_of(**geometry):
    return {
        "name": "grooves",
        "kind": "pocket",
        "geometry": {"length": "1 mm", "film": "30 um", **geometry},
        "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
        "motion": {"reynolds_number": 40},
    }


def placed(position, **others):
    return {"position": position, **SINGLE, **others}


@pytest.mark.parametrize(
    "path",
    [path for path in sorted(SCENES.glob("*.toml")) if 'kind = "pocket"' in path.read_text()],
    ids=lambda path: path.stem,
)
def test_the_examples_are_read(path):
    scene = load_scene(path)
    assert (scene.plan() if scene.in_plan else scene.gap()).length == pytest.approx(scene.geometry.length)


def test_a_single_groove_may_stand_beside_length_and_film():
    flat, listed = read_scene(entries_of(**SINGLE)), read_scene(entries_of(grooves=[SINGLE]))
    assert flat == listed
    assert scene_entries(listed)["geometry"]["depth"] == "7.5e-06 m"
    (groove,) = flat.grooves
    assert (groove.profile, groove.position, groove.width, groove.depth) == ("cylindrical", 0, 3e-4, 7.5e-6)


def test_each_groove_lies_where_it_says():
    scene = read_scene(
        entries_of(
            grooves=[
                placed("0.2 mm", profile="splined", shift="-45 um"),
                {"position": "-0.3 mm", "profile": "points", "points": POINTS},
            ]
        )
    )
    gap = scene.gap()
    x = np.linspace(-0.5e-3, 0.5e-3, 20_001)
    depth = gap.thickness(x) - 3e-5
    assert x[depth.argmax()] == pytest.approx(-0.3e-3, abs=1e-7)
    right = x > 0
    assert x[right][depth[right].argmax()] == pytest.approx(0.2e-3 - 45e-6, abs=1e-7)
    grooved = x[depth > 1e-12]
    assert (grooved[0], grooved[-1]) == pytest.approx((-0.4e-3, 0.35e-3), abs=2e-7)
    assert scene.grooves[1].width == pytest.approx(3e-4)
    assert scene.grooves[1].depth == 1e-5


def test_inertia_is_judged_by_the_narrowest_groove_and_slope_by_the_steepest():
    shallow = {"position": "-0.35 mm", "width": "0.1 mm", "depth": "0.1 um"}
    wide = {"position": "0 mm", "width": "0.4 mm", "depth": "8 um"}
    leaning = {"position": "0.35 mm", "profile": "splined", "width": "0.2 mm", "depth": "5 um", "shift": "-60 um"}
    drawn = {"position": "0.35 mm", "profile": "points", "points": [[-1e-4, 0], [5e-5, 4e-6], [8e-5, 1e-6], [1e-4, 0]]}
    for grooves, slope in (
        ([shallow], 0.002),
        ([shallow, wide], 0.04),
        ([wide, leaning], 0.125),
        ([wide, drawn], 0.08),
    ):
        scene = read_scene(entries_of(grooves=grooves))
        narrowest = 100 if shallow in grooves else 200
        assert scene.reduced_reynolds_number == pytest.approx(40 * 30 / narrowest)
        assert scene.slope == pytest.approx(slope)


GROOVE_FAULTS = [
    ({**SINGLE, "profile": "square"}, r"geometry\.profile: got 'square'; it must be one of 'cylindrical', 'splined'"),
    ({**SINGLE, "profile": 7}, r"geometry\.profile: got "),
    ({**SINGLE, "profile": ["splined"]}, r"geometry\.profile: got "),
    ({}, r"geometry\.width: missing"),
    ({"width": "0.3 mm", "dept": "1 um"}, r"geometry\.dept: unknown key; did you mean 'depth'\?"),
    ({**SINGLE, "lenght": "1 mm"}, r"geometry\.lenght: unknown key; did you mean 'length'\?"),
    ({**SINGLE, "shift": "1 um"}, r"geometry\.shift: no key of profile 'cylindrical'"),
    ({**SINGLE, "profile": "splined", "shift": "0.15 mm"}, r"geometry\.shift: got 0\.00015 m; .* outside"),
    ({**SINGLE, "profile": "splined", "shift": "-0.2 mm"}, r"geometry\.shift: got -0\.0002 m; .* outside"),
    ({**SINGLE, "profile": "splined", "shift": 0}, r"geometry\.shift: got 0, a number without a unit"),
    ({**SINGLE, "profile": "splined", "depth": "1 km"}, r"geometry\.depth: got .* film thicknesses"),
    ({**SINGLE, "profile": "splined", "width": "1 mm"}, r"geometry\.width: .* below length"),
    ({**SINGLE, "position": "0.4 mm"}, r"geometry\.position: got 0\.0004 m; .* reaches 5e-05 m over the end"),
    ({**SINGLE, "profile": "points", "points": POINTS}, r"geometry\.width: no key of profile 'points'"),
    ({"profile": "points"}, r"geometry\.points: missing"),
    ({"profile": "points", "points": [[0, 0], [6e-4, 1e-5], [1.2e-3, 0]]}, r"geometry\.points: .* below length"),
    ({**SINGLE, "grooves": [placed("0 m")]}, r"geometry: got width and depth beside grooves; give either one groove"),
    ({"grooves": []}, r"geometry\.grooves: got \[\]; write 1 to 100 tables"),
    ({"grooves": 7}, r"geometry\.grooves: got 7; write 1 to 100 tables"),
    ({"grooves": [7]}, r"geometry\.grooves\.0: got 7"),
    ({"grooves": [placed("0 m")] * 101}, r"geometry\.grooves: got .* write 1 to 100 tables"),
    ({"grooves": [placed("-0.3 mm"), placed("0.3 mm", width="1 Pa")]}, r"geometry\.grooves\.1\.width: .* dimension"),
    ({"grooves": [placed("-0.3 mm"), placed("0.3 mm", shift="1 um")]}, r"geometry\.grooves\.1\.shift: no key of"),
    ({"grooves": [placed("-0.3 mm"), placed("0.3 mm", depth="1 mm")]}, r"geometry\.grooves\.1\.depth: .* half circle"),
    ({"grooves": [placed("-0.3 mm"), placed("0.3 mm", depth="1 fm")]}, r"geometry\.grooves\.1\.depth: .* thicknesses"),
    ({"grooves": [placed("-0.36 mm"), placed("0.1 mm")]}, r"geometry\.grooves\.0\.position: .* 1e-05 m over the end"),
    ({"grooves": [placed("0.12 mm"), placed("-0.16 mm")]}, r"geometry\.grooves: got 2e-05 m of overlap .* 1 and 0"),
    (
        {"grooves": [placed("0 m", width="0.9 mm"), placed("0.1 mm", width="0.1 mm")]},
        r"geometry\.grooves: got 0\.0001 m of overlap between numbers 0 and 1",
    ),
]


@pytest.mark.parametrize(("geometry", "words"), GROOVE_FAULTS)
def test_every_fault_of_a_groove_is_one_line_that_names_the_key(geometry, words):
    with pytest.raises(InputError, match=r"^scene\." + words) as caught:
        read_scene(entries_of(**geometry))
    assert all(line.startswith("scene.geometry") for line in str(caught.value).splitlines())


def test_grooves_may_touch_each_other_and_the_ends_of_the_period():
    third = {"width": f"{1e-3 / 3!r} m", "depth": "7.5 um"}
    grooves = [{"position": f"{n * 1e-3 / 3!r} m", **third} for n in (-1, 0, 1)]
    assert len(read_scene(entries_of(grooves=grooves)).gap().breaks) == 4


def test_an_override_reaches_a_groove_of_several():
    path = SCENES / "two_grooves.toml"
    changed = load_scene(path, ["geometry.grooves.1.depth=9um"])
    assert [groove.depth for groove in changed.grooves] == [7.5e-6, 9e-6]
    for key in ("geometry.grooves.2.depth", "geometry.grooves.-1.depth", "geometry.grooves.depth"):
        with pytest.raises(InputError, match=r"as a number in the list 'geometry\.grooves'; it must be 0 to 1"):
            load_scene(path, [f"{key}=9um"])
    with pytest.raises(InputError, match="'grooves' is not a table"):
        load_scene(path, ["geometry.grooves.1=9um"])
    with pytest.raises(InputError, match="beside grooves"):
        load_scene(path, ["geometry.depth=9um"])


widths, depths = st.floats(0.01, 0.2), st.floats(1e-3, 0.4)
shapes = st.one_of(
    st.builds(lambda w, d: {"width": f"{w!r} mm", "depth": f"{w * d!r} mm"}, widths, depths),
    st.builds(
        lambda w, d, s: {"profile": "splined", "width": f"{w!r} mm", "depth": f"{d!r} mm", "shift": f"{s * w!r} mm"},
        widths,
        depths,
        st.floats(-0.49, 0.49).filter(lambda s: s == 0 or abs(s) > 1e-9),
    ),
    st.builds(
        lambda places, d: {"profile": "points", "points": [[1e-4 * s, d * 1e-5 * (n % 3)] for n, s in places]},
        st.sampled_from([list(enumerate(row)) for row in ([-1, 0.3, 0.5, 1], [-0.2, -0.1, 0.4, 0.41, 0.5, 0.7, 1])]),
        depths,
    ),
)


@settings(deadline=None)
@given(st.lists(shapes, min_size=1, max_size=4), st.floats(-0.01, 0.01))
def test_every_scene_is_written_out_and_read_back_unchanged(grooves, offset):
    tables = [{**one, "position": f"{0.23 * n - 0.35 + offset!r} mm"} for n, one in enumerate(grooves)]
    scene = read_scene(entries_of(grooves=tables))
    written = scene_entries(scene)
    assert json.loads(json.dumps(written)) == written
    assert read_scene(written) == scene
    x = np.linspace(-5e-4, 5e-4, 301)
    assert np.array_equal(read_scene(written).gap().thickness(x), scene.gap().thickness(x))
