"""Random films up to and beyond the laminar limit, beyond which no model promises anything."""

import math
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.outside import density
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.parts.laminar import SHEAR_LIMIT
from scripts.studies.coverage.drawing import drawn

KINDS = ("bearing", "free_bearing", "placed_bearing", "pocket", "rough_gap")
"""Sets of random scenes whose Reynolds number can be chosen without another film."""


def at_reynolds_number(kind: str, seed: int, ratio: float) -> Scene:
    """Return a random scene whose Reynolds number is a multiple of the limit of laminar shear flow.

    That of a bearing is ρuh/η of its minimum film thickness: its viscosity falls and its speed grows by the same
    factor, so that its pressure, and the film under a load, stay.

    Raises
    ------
    InputError
        If the scene is not valid with these numbers.
    """
    scene = drawn(kind, seed)
    entries: dict[str, Any] = scene_entries(scene)
    number = ratio * SHEAR_LIMIT
    if not isinstance(scene, Bearing):
        table = "motion" if kind == "pocket" else "flow"
        entries[table] = {"reynolds_number": number if kind == "pocket" else number / 2}
        return read_scene(entries)
    film, speed = expected_scene(scene).geometry.thinnest, abs(scene.motion.speed)
    if speed == 0 or not film > 0:
        raise InputError(f"{scene.name}: does not slide; draw another")
    before = density(scene) * speed * film / scene.lubricant.viscosity
    factor = math.sqrt(number / before)
    entries["lubricant"] |= {"viscosity": f"{scene.lubricant.viscosity / factor!r} Pa*s"}
    entries["motion"] |= {"speed": f"{scene.motion.speed * factor!r} m/s"}
    return read_scene(entries)
