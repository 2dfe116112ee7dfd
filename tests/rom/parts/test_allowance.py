"""The work of films is counted, and they end where it exceeds what is allowed."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.parts.allowance import allowance

PLENTY = 1e12
MODEL = find("bearing", "reynolds_cavitating")


def pad(**load):
    geometry = {"shape": "linear", "length": "50 mm", "width": "40 mm", "rise": "20 um"}
    entries = {"geometry": geometry if load else {**geometry, "film": "20 um"}, "motion": {"speed": "2 m/s"}}
    lubricant = {"viscosity": "0.05 Pa*s"}
    return read_scene({"name": "pad", "kind": "bearing", "lubricant": lubricant, **entries, **load})


@pytest.mark.parametrize("scene", [pad(), pad(load={"force": "2 kN"})], ids=["given film", "under a load"])
def test_a_film_ends_where_its_work_is_spent(scene):
    with allowance(1) as little, pytest.raises(ConvergenceError):
        MODEL.solve(scene, Request(resolution=16))
    assert little.spent
    with allowance(PLENTY) as work:
        MODEL.solve(scene, Request(resolution=16))
    assert PLENTY - work.left >= 16 * 16  # a step at least
    assert not work.spent
