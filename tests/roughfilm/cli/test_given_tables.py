"""Tables that are given to a sweep: those of the scene's own surface and solids, and no others."""

import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.bearing.mixed.curves import wall_of
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.homogenization.table.store import load_table, save_table
from roughfilm.rom.ladder.model import silent
from roughfilm.rom.ladder.scene import load_scene

SCENE = SCENES / "rough_washer.toml"
COARSE = (
    "roughness.surface.points=[16, 16]",
    "roughness.surface.correlation_length=0.4 mm",
    "roughness.surface.anisotropy=1",
)
MODULUS, HARDNESS = 210e9 / (1 - 0.3**2), 5e9


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """A table of the scene's surface and solids, as written down here."""
    path = tmp_path_factory.mktemp("table") / "T.h5"
    roughness = load_scene(SCENE, COARSE).roughness
    heights, spacing = roughness.scaled_heights(), roughness.scaled_spacing()
    table = tabulate_pressed(heights, spacing, MODULUS, hardness=HARDNESS, tolerance=0.05).factors
    settings = {"composite_modulus": MODULUS, "hardness": HARDNESS}
    save_table(path, Inputs(heights=heights, spacing=spacing, settings=settings), table)
    return path


def wall(stored, tmp_path, *overrides):
    return wall_of(load_scene(SCENE, [*COARSE, *overrides]), 1e6, stored, tmp_path / "own.h5", silent, 16)


def test_the_table_of_the_scene_is_taken_as_it_is(stored, tmp_path):
    taken = wall(stored, tmp_path)
    assert taken.points == taken.known_points == len(load_table(stored).points)
    assert not (tmp_path / "own.h5").exists()


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("roughness.surface.seed=505", "another surface, with a highest point"),
        ("roughness.scale=1.01", "another surface, with a highest point"),
        ("roughness.stretch=2", "another surface, with a spacing along x"),
        ("asperities.solid.modulus=1 GPa", "another pair of solids, with a composite modulus"),
        ("asperities.solid.poisson=0.5", "another pair of solids, with a composite modulus"),
        ("asperities.solid.hardness=6 GPa", "another pair of solids, with a hardness of 5e\\+09 Pa"),
    ],
)
def test_tables_of_other_surfaces_and_solids_are_refused(stored, tmp_path, override, words):
    with pytest.raises(InputError, match=words):
        wall(stored, tmp_path, override)


def test_a_table_of_no_asperities_is_refused(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        wall(tmp_path / "none.h5", tmp_path)
    (tmp_path / "empty.h5").touch()
    with pytest.raises(InputError, match="is no table"):
        wall(tmp_path / "empty.h5", tmp_path)
