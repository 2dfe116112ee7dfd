"""Lists of coordinates become the grid or the profile that they list, and nothing is taken for what it is not."""

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.files import read_measurement, read_surface
from roughfilm.contact.surfaces.profile import Profile

HEIGHTS = np.random.default_rng(5).normal(size=(12, 9))


def lines(order="xy", dx=1.0, dy=1.0, start=(0.0, 0.0)):
    """Lines of x, y, z over the grid, with the first of the two axes varying slowest."""
    places = [(i, j) for i in range(12) for j in range(9)]
    if order == "yx":
        places.sort(key=lambda place: place[::-1])
    return [f"{start[0] + i * dx:.9g},{start[1] + j * dy:.9g},{HEIGHTS[i, j]:.9g}" for i, j in places]


def write(tmp_path, rows, name="s.csv"):
    (tmp_path / name).write_text("\n".join(rows) + "\n")
    return tmp_path / name


@pytest.mark.parametrize("order", ["xy", "yx", "shuffled"])
def test_a_list_is_its_grid_in_any_order(tmp_path, order):
    rows = lines("yx" if order == "yx" else "xy", dx=0.5, dy=0.25, start=(-3.0, 7.1))
    if order == "shuffled":
        np.random.default_rng(3).shuffle(rows)
    read = read_surface(write(tmp_path, rows), height_unit="um")
    assert read.heights == pytest.approx(1e-6 * HEIGHTS, rel=1e-7)
    assert read.spacing == pytest.approx((0.5e-6, 0.25e-6))


def test_a_given_spacing_takes_the_place_of_the_coordinates(tmp_path):
    read = read_surface(write(tmp_path, lines()), spacing=(2e-6, 3e-6), height_unit="nm")
    assert read.spacing == (2e-6, 3e-6)
    assert read.heights == pytest.approx(1e-9 * HEIGHTS, rel=1e-7)


def test_points_that_a_list_leaves_out_are_invalid(tmp_path):
    rows = lines()
    del rows[17], rows[40]
    read = read_surface(write(tmp_path, rows), height_unit="um")
    assert np.argwhere(read.invalid).tolist() == [[1, 8], [4, 5]]


BAD = {
    "no unit": (lines(), "gives no unit of its coordinates and heights; set read.height_unit"),
    "scattered": (
        [",".join(f"{v:.6f}" for v in one) for one in np.random.default_rng(8).random((40, 3))],
        "whose x are not equidistant, so that it has no grid",
    ),
    "two heights at a point": ([*lines(), "0,0,5"], "with several heights at one point"),
    "a line in space": ([f"{i},{i},0.5" for i in range(20)], "most of which are missing"),
    "one x": ([f"3,{i},0.5" for i in range(20)], "has one x in all lines"),
    "a missing coordinate": ([*lines(), "nan,3,1"], "in which a coordinate is missing"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_list_without_a_grid_is_refused_in_one_line(tmp_path, kind):
    rows, message = BAD[kind]
    unit = None if kind == "no unit" else "um"
    with pytest.raises(InputError, match=message) as raised:
        read_surface(write(tmp_path, rows), height_unit=unit)
    assert "\n" not in str(raised.value)


def test_three_lines_of_three_columns_are_a_matrix(tmp_path):
    assert read_surface(write(tmp_path, ["1,2,3", "4,5,7", "7,8,9"]), spacing=(1, 1), height_unit="um").shape == (3, 3)


def test_a_header_makes_a_matrix_of_three_columns(tmp_path):
    rows = ["# spacing: 1 um, 2 um; heights: um", *lines()]
    assert read_surface(write(tmp_path, rows)).shape == (3, 108)


def test_x_and_z_are_a_profile(tmp_path):
    z = np.sin(np.arange(30))
    found = read_measurement(write(tmp_path, [f"{0.2 * i:.6g},{v:.9g}" for i, v in enumerate(z)]), height_unit="um")
    assert isinstance(found, Profile)
    assert found.spacing == pytest.approx(0.2e-6)
    assert found.heights == pytest.approx(1e-6 * z, abs=1e-14)


@pytest.mark.parametrize("along", ["row", "column", "npy", "npy row"])
def test_one_line_of_heights_is_a_profile_in_any_file(tmp_path, along):
    z = np.random.default_rng(2).normal(size=25)
    if along.startswith("npy"):
        np.save(tmp_path / "s.npy", z[None] if along == "npy row" else z)
        path, z = tmp_path / "s.npy", 1e6 * z
    else:
        path = write(tmp_path, [f"{v:.17g}" for v in z] if along == "column" else [",".join(f"{v:.17g}" for v in z)])
    found = read_measurement(path, spacing=(3e-6, 3e-6), height_unit=None if along.startswith("npy") else "um")
    assert isinstance(found, Profile)
    assert found.spacing == 3e-6
    assert found.heights == pytest.approx(1e-6 * z, rel=1e-12)
    with pytest.raises(InputError, match="is a profile of 25 points, where a surface is needed"):
        read_surface(path, spacing=(3e-6, 3e-6), height_unit="um")


def test_a_profile_with_missing_points_says_how_many(tmp_path):
    found = read_measurement(write(tmp_path, ["1,2,nan,4,5"]), spacing=(1e-6, 1e-6), height_unit="um")
    assert isinstance(found, Profile)
    assert found.source["filled"] == 1
    assert found.heights[2] == pytest.approx(3e-6)


def test_a_list_is_pressed_as_its_grid(tmp_path):
    done = CliRunner().invoke(
        app,
        ["contact", str(write(tmp_path, lines())), "--modulus", "1GPa", "--poisson", "0.3", "--loads", "1MPa"],
    )
    assert done.exit_code == 2
    assert "gives no unit of its coordinates" in done.output.replace("\n", " ").replace("  ", " ")
