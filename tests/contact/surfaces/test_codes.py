"""Heights that mark missing points are invalid where the recipe names them, in the unit of the file."""

import numpy as np
import pytest
from typer.testing import CliRunner

import roughfilm as rf
from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface

SPACING = (1e-6, 1e-6)


def coded(code, where=np.s_[4:14, 20:27]):
    """Heights of 1 µm with a block of one code, and the mask of the block."""
    heights = 1e-6 * np.random.default_rng(77).normal(size=(40, 50)) + 5e-6
    heights[where] = code
    return heights, heights == code


@pytest.mark.parametrize("code", [-9.999e-3, 0.0, 1e3])
def test_a_code_in_an_npy_is_in_metres(tmp_path, code):
    heights, missing = coded(code)
    np.save(tmp_path / "s.npy", heights)
    read = read_surface(tmp_path / "s.npy", spacing=SPACING, invalid=(code,))
    assert np.array_equal(read.invalid, missing)
    assert read.heights[~missing] == pytest.approx(heights[~missing], rel=1e-15)


def test_a_code_in_a_csv_is_in_its_unit_and_several_are_taken(tmp_path):
    rows = ["1,2,-9999,4", "5,-32768,7,-9999", "9,10,11,12"]
    (tmp_path / "s.csv").write_text("# spacing: 1 um, 1 um; heights: nm\n" + "\n".join(rows) + "\n")
    read = rf.read_surface(tmp_path / "s.csv", invalid=[-9999, -32768])
    assert np.argwhere(read.invalid).tolist() == [[1, 1], [2, 0], [3, 1]]
    assert read.heights[0, 2] == pytest.approx(9e-9)


def test_heights_beside_a_code_are_no_codes(tmp_path):
    heights, _ = coded(0.0)
    heights[0, 0] = 1e-12
    np.save(tmp_path / "s.npy", heights)
    read = read_surface(tmp_path / "s.npy", spacing=SPACING, invalid=(0.0,))
    assert not read.invalid[0, 0]


def test_the_recipe_takes_one_code_or_a_list(tmp_path):
    heights, missing = coded(-9.999e-3)
    np.save(tmp_path / "s.npy", heights)
    options = ["surface", str(tmp_path / "s.npy"), "--set", "read.spacing=1um", "--out", str(tmp_path / "o.h5")]
    for given in ("-9.999e-3", "[-9.999e-3, 7]"):
        done = CliRunner().invoke(app, [*options, "--overwrite", "--set", f"read.invalid={given}"])
        assert done.exit_code == 0, done.output
        assert read_surface(tmp_path / "o.h5").source["record"]["invalid"]["points"] == int(missing.sum())


def test_what_is_no_height_is_refused(tmp_path):
    np.save(tmp_path / "s.npy", coded(0.0)[0])
    with pytest.raises(InputError, match=r"^invalid: got 'none'; give a height, or a list of them$"):
        rf.read_surface(tmp_path / "s.npy", spacing=1e-6, invalid="none")


def test_a_file_of_ones_own_knows_its_invalid_points(tmp_path):
    save_surface(rf.Surface(heights=coded(0.0)[0], spacing=SPACING), tmp_path / "s.h5")
    with pytest.raises(InputError, match=r"holds its own spacing and unit; leave out the recipe's table read$"):
        read_surface(tmp_path / "s.h5", invalid=(0.0,))
