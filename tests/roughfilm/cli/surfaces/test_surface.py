"""``roughfilm surface``: what it prints, what it writes, and how it fails."""

import json
import os
import re

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.parameters.bearing_curve import bearing_core, descending
from roughfilm.contact.parameters.definitions import AREAL, GROUPS
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.words.numbers import percent

PARAMETERS = ["Sa", "Sq", "Sp", "Sv", "Sz", "St", "Ssk", "Sku", "Sk", "Spk", "Svk", "Smr1", "Smr2", "Sxp"]
PARAMETERS += ["Vmp", "Vmc", "Vvc", "Vvv", "Sdq", "Sdr", "Sal", "Str", "Std", "Spd", "Spc", "S5p", "S5v", "S10z"]
PARAMETERS += ["Spm", "Svm"]


@pytest.fixture
def run():
    def call(*arguments):
        return CliRunner().invoke(app, ["surface", *map(str, arguments)])

    return call


@pytest.fixture
def csv(tmp_path):
    """A tilted, rough surface of 80 x 60 points with one that is missing."""
    rng = np.random.default_rng(851)
    smooth = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(128, 128)))[:, :14] * 1, s=(128, 128))[:80, :60]
    heights = smooth / smooth.std() + 0.1 * np.arange(80)[:, None]
    lines = [",".join(f"{value:.6f}" for value in row) for row in heights.T]
    lines[30] = lines[30].replace(lines[30].split(",")[7], "", 1)
    path = tmp_path / "measured.csv"
    path.write_text("# spacing: 2 um, 3 um; heights: um\n" + "\n".join(lines) + "\n")
    return path


def test_json_is_one_object_with_parameters_before_and_after(run, csv, tmp_path):
    done = run(csv, "--json", "--out", tmp_path / "s.h5", "--set", "smoothing=1")
    assert done.exit_code == 0
    message = json.loads(done.stdout)
    assert set(message) == {"quantities", "numerics", "provenance"}
    names = {*PARAMETERS, *(f"raw_{name}" for name in PARAMETERS)}
    fractions = {"invalid_fraction", "outlier_fraction", "filled_fraction"}
    assert names | fractions | {"periodicity_mismatch", "raw_periodicity_mismatch"} == set(message["quantities"])
    assert message["quantities"]["filled_fraction"]["value"] == pytest.approx(1 / 4800)
    assert message["quantities"]["invalid_fraction"]["value"] == pytest.approx(1 / 4800)
    assert message["quantities"]["raw_Sq"] == {"value": pytest.approx(1e-6, rel=0.3), "unit": "m"}
    assert message["numerics"]["residual"] <= 1e-9
    assert message["provenance"]["recipe"]["smoothing"] == 1
    assert message["provenance"]["surface"]["file"] == "measured.csv"
    stored = read_surface(tmp_path / "s.h5")
    assert list(stored.shape) == message["provenance"]["record"]["window"]["pixels"]
    assert stored.heights.std() == pytest.approx(message["quantities"]["Sq"]["value"], rel=1e-12)
    assert stored.source["recipe"] == message["provenance"]["recipe"]


def test_the_bearing_curve_of_the_measurement_is_that_of_its_valid_points(run, tmp_path):
    """A third of the points is invalid, in a deep valley, whose fill would count in Svk."""
    x = np.linspace(-1, 1, 60)
    heights = np.random.default_rng(853).normal(size=(60, 60)) * 0.1 - 5 * np.exp(-((x / 0.4) ** 2))
    invalid = np.broadcast_to(np.abs(x) < 0.3, heights.shape)
    measured = Surface(heights=1e-6 * heights, spacing=(1e-6, 1e-6), invalid=invalid)
    save_surface(measured, tmp_path / "s.h5")
    recipe = ["--set", "form=none", "--set", "outliers.limit=0"]
    found = json.loads(run(tmp_path / "s.h5", "--json", *recipe).stdout)["quantities"]
    core = bearing_core(descending(measured.heights[~invalid]))
    assert found["raw_Sk"]["value"] == pytest.approx(core.height, rel=1e-12)
    assert found["raw_Spk"]["value"] == pytest.approx(core.peak, rel=1e-12)
    assert found["raw_Svk"]["value"] == pytest.approx(core.valley, rel=1e-12)
    assert found["filled_fraction"]["value"] == pytest.approx(invalid.mean())


def test_the_output_counts_what_is_invalid_spiked_and_filled(run, tmp_path):
    invalid, heights = np.zeros((80, 80), bool), np.random.default_rng(854).normal(size=(80, 80))
    invalid[30:36, 40:46] = True
    heights[29, 40:46] = heights[5, 5] = 300
    save_surface(Surface(heights=1e-7 * heights, spacing=(1e-6, 1e-6), invalid=invalid), tmp_path / "s.h5")
    done = run(tmp_path / "s.h5", "--report", tmp_path / "page.html")
    shown, page = " ".join(done.output.split()), " ".join((tmp_path / "page.html").read_text().split())
    assert "spikes: 1 points of spikes, 6 on rims of invalid regions" in shown
    assert "filled: 43 points, 0.67 %, of which 36 were invalid" in shown
    assert "7 are points of spikes or of rims of invalid regions (0.11 %)" in page
    assert "43 points are filled in (0.67 %)" in page


def test_the_recipe_file_decides(run, csv, tmp_path):
    (tmp_path / "r.toml").write_text('form = "tilt"\n[grid]\npoints = "kept"\n[edges]\ndirection = "none"\n')
    done = run(csv, "--json", "--prepare", tmp_path / "r.toml", "--set", "smoothing=5")
    record = json.loads(done.stdout)["provenance"]["record"]
    assert record["grid"]["points"] == [80, 60]
    assert record["edges"]["direction"] == "none"


def test_a_prepared_surface_read_again_stays_as_it_is(run, csv, tmp_path):
    run(csv, "--out", tmp_path / "s.h5")
    done = run(tmp_path / "s.h5", "--out", tmp_path / "t.h5", "--json")
    assert json.loads(done.stdout)["provenance"]["record"]["edges"]["direction"] == "none"
    assert np.array_equal(read_surface(tmp_path / "t.h5").heights, read_surface(tmp_path / "s.h5").heights)


def test_overrides_of_a_prepared_surface_change_nothing_else(run, csv, tmp_path):
    run(csv, "--out", tmp_path / "s.h5")
    done = run(tmp_path / "s.h5", "--json", "--set", "smoothing=3")
    recipe = json.loads(done.stdout)["provenance"]["recipe"]
    assert (recipe["form"], recipe["edges"]["direction"], recipe["smoothing"]) == ("none", "none", 3)


def test_one_output_that_cannot_be_written_leaves_none(run, csv, tmp_path):
    done = run(csv, "--out", tmp_path / "s.h5", "--report", "/proc/nowhere/page.html")
    assert done.exit_code == 2
    assert not (tmp_path / "s.h5").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["measured.csv"]


def test_a_name_of_odd_bytes_does_no_harm(run, csv, tmp_path):
    odd = tmp_path / os.fsdecode(b"odd \xff [bold].csv")
    odd.write_bytes(csv.read_bytes())
    assert run(odd, "--report", tmp_path / "page.html", "--json").exit_code == 0
    assert "[bold]" in (tmp_path / "page.html").read_text()


def test_people_get_a_table_and_the_warnings(run, csv):
    done = run(csv, "--set", "edges.direction=none")
    assert done.exit_code == 0
    assert re.search(r"Sa\b.*µm.*mean absolute height", done.output)
    places = [done.output.index(f"\n{name}") for name in PARAMETERS]
    assert places == sorted(places)
    assert "filled: 1 points, 0.021 %, of which 1 were invalid" in done.output
    assert "warning: periodicity mismatch" in done.output


@pytest.mark.usefixtures("drawn")
def test_the_page_holds_its_pictures_and_nothing_from_elsewhere(run, csv, tmp_path):
    done = run(csv, "--report", tmp_path / "page.html")
    assert done.exit_code == 0
    page = (tmp_path / "page.html").read_text()
    assert page.count("<svg") == 5
    assert "data:image/png" in page or "No picture: " in page
    for title in ("Heights", "Joints", "Bearing curve", "Power spectrum", "Parameters", "Recipe"):
        assert f"<h2>{title}</h2>" in page
    first = page[page.index("<h1>") : page.index("<h2>")]
    quantities = json.loads(run(csv, "--json").stdout)["quantities"]
    for name in ("Sq", "Sa"):
        before, after = (1e6 * quantities[key]["value"] for key in (f"raw_{name}", name))
        assert f"<b>{after:.4g} µm</b>" in first
        assert f"{before:.4g} µm measured" in first
        assert f"{name} changed by {percent(after / before - 1)}" in first
    assert "measured.csv" in page
    assert not re.search(r'(src|href)="http', page)


def test_the_page_groups_the_parameters_and_defines_them(run, csv, tmp_path):
    run(csv, "--report", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    places = [page.index(f">{heading}<") for heading in GROUPS.values()]
    assert places == sorted(places)
    for one in AREAL.values():
        assert f"<td>{one.name}</td>" in page
        assert one.meaning in page
    assert "not scale-limited" in page


def test_a_surface_without_hills_inside_its_edges_is_shown_without_their_parameters(run, tmp_path):
    """A ridge across the whole surface; the periodic cell has one hill."""
    lines = [
        ",".join(f"{np.exp(-(((x - 30) / 9) ** 2)) + 1e-3 * (x * y % 7):.6f}" for x in range(60)) for y in range(50)
    ]
    (tmp_path / "ridge.csv").write_text("# spacing: 1 um, 1 um; heights: um\n" + "\n".join(lines) + "\n")
    done = run(tmp_path / "ridge.csv", "--json", "--report", tmp_path / "page.html")
    quantities = json.loads(done.stdout)["quantities"]
    assert "raw_S10z" not in quantities
    assert quantities["raw_Spd"]["value"] == 0
    assert "<td>S10z</td><td>–</td>" in (tmp_path / "page.html").read_text()
    shown = run(tmp_path / "ridge.csv")
    assert shown.exit_code == 0
    assert "Sdq" in shown.output


def test_a_synthetic_surface_is_made_from_its_description(run, tmp_path):
    (tmp_path / "s.toml").write_text(
        'kind = "self_affine"\nsize = ["1 mm", "1 mm"]\npoints = [64, 64]\nseed = 852\nhurst = 0.8\n'
        'roll_off = "0.25 mm"\ncut_off = "62.5 um"\nrms_height = "2 um"\n'
    )
    done = run(tmp_path / "s.toml", "--json", "--out", tmp_path / "s.h5")
    assert done.exit_code == 0
    message = json.loads(done.stdout)
    assert message["quantities"]["Sq"]["value"] == pytest.approx(2e-6, rel=1e-9)
    assert read_surface(tmp_path / "s.h5").source["prepared_from"]["synthetic"]["seed"] == 852


HEAD = "# spacing: 1 um, 1 um; heights: um\n"
BAD = [
    ("invalid.csv", HEAD + "nan,nan\nnan,nan\n", "every pixel is invalid"),
    ("constant.csv", HEAD + "3,3,3,3\n" * 4, "there is no roughness to prepare"),
    ("row.csv", HEAD + "1,2,3,4\n", "is a profile, which has no cell"),
    ("infinite.csv", HEAD + "1,2\n3,-inf\n", "is infinite"),
    ("letter.csv", "Dear colleague\n", "write numbers with commas between"),
    ("units.csv", "# spacing: 1 um, 1 kg; heights: um\n1,2\n3,4\n", "wrong dimension"),
    ("bare.csv", "1,2\n3,5\n", "gives no spacing"),
    ("few.csv", HEAD + "1,2\n3,5\n", "choose a simpler one"),
    ("description.toml", 'kind = "self_afine"\n', "self_affine"),
]


@pytest.mark.parametrize(("name", "text", "message"), BAD)
def test_a_bad_surface_is_one_line_and_exit_code_2(run, tmp_path, name, text, message):
    (tmp_path / name).write_text(text)
    done = run(tmp_path / name, "--json", "--out", tmp_path / "out.h5", "--report", tmp_path / "out.html")
    assert done.exit_code == 2
    assert done.stdout == ""
    assert len(done.stderr.strip().splitlines()) == 1
    assert re.search(message, done.stderr)
    assert not (tmp_path / "out.h5").exists()
    assert not (tmp_path / "out.html").exists()


@pytest.mark.parametrize("option", ["--out", "--report"])
def test_an_output_never_replaces_its_input(run, tmp_path, option):
    save_surface(Surface(heights=np.eye(9), spacing=(1.0, 1.0)), tmp_path / "s.h5")
    before = (tmp_path / "s.h5").read_bytes()
    done = run(tmp_path / "s.h5", option, tmp_path / "s.h5")
    assert done.exit_code == 2
    assert "is the same file as FILE" in done.stderr
    assert (tmp_path / "s.h5").read_bytes() == before


def test_both_outputs_in_one_file_are_refused(run, csv, tmp_path):
    done = run(csv, "--out", tmp_path / "x", "--report", tmp_path / "x")
    assert done.exit_code == 2
    assert "is the same file as --out" in done.stderr


def profile_file(path, points=900):
    z = np.convolve(np.random.default_rng(4).standard_normal(points + 6), np.ones(7), "valid")
    path.write_text("".join(f"{0.5 * i:.6g},{v:.9g}\n" for i, v in enumerate(z)))
    return z


@pytest.mark.parametrize(("cut_off", "letter"), [(None, "P"), ("50 um", "R")])
def test_a_profile_has_the_parameters_of_a_profile(run, tmp_path, cut_off, letter):
    z = profile_file(tmp_path / "p.csv")
    options = [
        "--set",
        "read.height_unit=um",
        "--set",
        "form=mean",
        *(["--set", f"l_filter={cut_off}"] if cut_off else []),
    ]
    done = run(tmp_path / "p.csv", "--json", *options)
    found = json.loads(done.stdout)["quantities"]
    assert {
        f"{letter}{name}" for name in ("a", "q", "t", "p", "v", "z", "sk", "ku", "k", "pk", "vk", "dq", "sm", "c")
    } <= set(found)
    if cut_off is None:
        assert found["Pq"]["value"] == pytest.approx(1e-6 * z.std(), rel=1e-6)
        assert found["Pt"]["value"] == pytest.approx(1e-6 * np.ptp(z), rel=1e-6)


@pytest.mark.parametrize("option", ["--out", "--report"])
def test_a_profile_has_no_cell(run, tmp_path, option):
    profile_file(tmp_path / "p.csv")
    done = run(tmp_path / "p.csv", "--set", "read.height_unit=um", option, tmp_path / "x")
    assert done.exit_code == 2
    assert "is a profile, which has no cell" in " ".join(done.output.split())
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        (["smoothing=1"], "smoothing: got for a profile"),
        (["edges.direction=x", "outliers.limit=0"], "outliers, edges: got for a profile"),
        (["s_filter=3 um"], None),
    ],
)
def test_steps_that_a_profile_does_not_have_are_refused(run, tmp_path, keys, said):
    profile_file(tmp_path / "p.csv")
    options = [part for key in ("read.height_unit=um", *keys) for part in ("--set", key)]
    done = run(tmp_path / "p.csv", *options)
    assert done.exit_code == (0 if said is None else 2), done.output
    assert said is None or said in " ".join(done.output.split())
