"""A dry contact that the tests of its scene and of its rungs share."""

from pathlib import Path
from typing import Any

import pytest

from rom.dry_contact import DryContact
from rom.scene import read_scene

ROUGH = {
    "kind": "self_affine",
    "size": ["100 um", "100 um"],
    "points": [64, 64],
    "seed": 20071,
    "hurst": 0.8,
    "roll_off": "25 um",
    "cut_off": "12.5 um",
    "rms_slope": 0.1,
}


@pytest.fixture
def make_contact():
    """A dry contact from its surface (a description or a file), E*, P and H, Pa; the body is rigid but for E*."""

    def make(
        surface: object = ROUGH,
        *,
        modulus: float = 1e11,
        pressure: float = 1e8,
        hardness: float | None = None,
        **geometry: Any,
    ) -> DryContact:
        surface = str(surface) if isinstance(surface, Path) else surface
        solid = {"modulus": f"{modulus!r} Pa", "poisson": 0.0}
        if hardness is not None:
            solid["hardness"] = f"{hardness!r} Pa"
        scene = read_scene(
            {
                "name": "test",
                "kind": "dry_contact",
                "geometry": {"surface": surface, **geometry},
                "solid": solid,
                "load": {"pressure": f"{pressure!r} Pa"},
            }
        )
        assert isinstance(scene, DryContact)
        return scene

    return make
