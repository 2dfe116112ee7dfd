"""Commands, scenes and the Python interface warn of a file whose lateral unit is wrong by a factor of a million."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import roughfilm as rf
from roughfilm.cli.main import app
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface


@pytest.fixture
def large(tmp_path):
    """A file of a measurement of 160 m x 160 m."""
    x = 2 * np.pi * np.arange(64) / 64
    heights = 1e-6 * np.add.outer(np.cos(3 * x), np.sin(2 * x))
    surface = Surface(heights=heights, spacing=(2.5, 2.5), periodic=True, source={"file": "m.opd"})
    save_surface(surface, tmp_path / "large.h5")
    return tmp_path / "large.h5"


SCENE = """name = "large"
kind = "dry_contact"
[geometry]
surface = "{file}"
[solid]
modulus = "210 GPa"
poisson = 0.3
[load]
pressure = "1 MPa"
"""


@pytest.mark.parametrize(
    "command",
    [
        ("surface",),
        ("contact", "--loads", "1MPa", "--modulus", "210GPa", "--poisson", "0.3"),
        ("factors", "--gap", "5um"),
    ],
)
def test_commands_warn_of_a_measurement_of_160_m(large, command):
    name, *options = command
    done = CliRunner().invoke(app, [name, str(large), *options, "--json"])
    assert done.exit_code == 0, done.output
    warnings = json.loads(done.stdout)["provenance"]["warnings"]
    assert any("the pixel spacing is 2.5 x 2.5 m" in warning for warning in warnings)


def test_a_scene_warns_of_a_measurement_of_160_m(large, tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE.format(file=large))
    result = rf.solve(rf.load_scene(tmp_path / "scene.toml"))
    assert any("the pixel spacing is 2.5 x 2.5 m" in warning for warning in result.warnings)


def test_an_export_warns_of_a_measurement_of_160_m(large, tmp_path):
    done = CliRunner().invoke(app, ["export", str(large), "--out", str(tmp_path / "mesh.vtu")])
    assert done.exit_code == 0, done.output
    assert "the pixel spacing is 2.5 x 2.5 m" in " ".join(done.stderr.split())


def test_the_python_interface_warns_of_a_measurement_of_160_m(large):
    with pytest.warns(UserWarning, match="the pixel spacing is 2.5 x 2.5 m"):
        assert rf.read_surface(large).spacing == (2.5, 2.5)
