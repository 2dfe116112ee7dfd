"""roughfilm factors of a set of windows."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner
from window_sets import surface_of_seed, write_set

from roughfilm.cli.main import app
from roughfilm.rom.homogenization.table.store import load_table


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def asked(*arguments):
    done = run(*arguments, "--json")
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("factors")
    write_set(folder / "seeds", [surface_of_seed(seed, 24) for seed in (1, 2, 3, 4)])
    write_set(folder / "equal", [surface_of_seed(5, 24)] * 3)
    return folder


def test_equal_windows_give_the_plain_command_without_scatter(place):
    plain = asked("factors", place / "equal" / "cells" / "0001.h5", "--gap", "0.2um")["quantities"]
    equal = asked("factors", place / "equal", "--gap", "0.2um")["quantities"]
    for name, entry in plain.items():
        assert equal[name]["value"] == pytest.approx(entry["value"], rel=1e-9, abs=1e-12), name
        if "uncertainty" in entry:
            assert equal[name]["uncertainty"] == pytest.approx(entry["uncertainty"], rel=1e-6)
            assert equal[name]["scatter"] == pytest.approx(0, abs=1e-12)


def test_one_mean_gap_gives_the_mean_of_the_windows(place):
    found = asked("factors", place / "seeds", "--gap", "0.2um")
    own = [
        asked("factors", place / "seeds" / "cells" / f"000{number}.h5", "--gap", "0.2um")["quantities"]["A11"]["value"]
        for number in (1, 2, 3, 4)
    ]
    entry = found["quantities"]["A11"]
    assert entry["value"] == pytest.approx(np.mean(own), rel=1e-9)
    assert entry["scatter"] > entry["uncertainty"]
    assert entry["window_interval"][0] < min(own) < max(own) < entry["window_interval"][1]
    assert found["windows"]["count"] == 4
    assert "(windows)" in run("factors", place / "seeds", "--gap", "0.2um").stdout


def test_a_table_holds_the_scatter_and_a_bearing_takes_it_as_its_roughness(place):
    found = asked("factors", place / "seeds", "--out", place / "t.h5", "--report", place / "f.html")
    table = load_table(place / "t.h5")
    assert len(found["points"]) == len(table.points)
    assert all(point.scatter is not None for point in table.points)
    assert asked("factors", place / "seeds", "--out", place / "t.h5")["numerics"]["separations_found"] == len(
        table.points
    )
    page = (place / "f.html").read_text(encoding="utf-8")
    assert "means over 4 windows" in page
    assert "light, one window" in page
    (place / "slider.toml").write_text(
        'name = "slider"\nkind = "bearing"\n[geometry]\nshape = "linear"\nlength = "1 mm"\nfilm = "0.6 um"\n'
        'rise = "0.6 um"\n[lubricant]\nviscosity = "0.01 Pa*s"\n[motion]\nspeed = "1 m/s"\n'
        '[roughness]\nkind = "table"\ntable = "t.h5"\n',
        encoding="utf-8",
    )
    solved = asked("solve", place / "slider.toml", "--model", "homogenized")
    assert any("over windows" in one for one in solved["warnings"])


def test_a_spacing_beside_a_set_is_refused(place):
    done = run("factors", place / "seeds", "--gap", "0.2um", "--spacing", "1um")
    assert done.exit_code == 2
    assert "hold their spacing" in done.stderr
