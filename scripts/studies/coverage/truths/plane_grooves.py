"""The truth of a cell in plan with a groove across it: plane Navier-Stokes flow by finite elements."""

from dataclasses import replace

from roughfilm.ladder import models
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.truth import Truth
from scripts.studies.coverage.truths import pocket

PLANE = ("width", "depth", "position")
"""The keys that a groove in plan shares with the plane one."""


def truth(scene: Pocket) -> Truth:
    """Return the truth of the pocket with the same groove, where the pressure on the edge is that at the corner."""
    entries = scene_entries(scene)
    geometry = entries["geometry"]
    (groove,) = geometry["dimples"]
    plane = {
        "length": geometry["length"],
        "film": geometry["film"],
        "grooves": [{"profile": "cylindrical", **{key: groove[key] for key in PLANE}}],
    }
    same = read_scene({**entries, "geometry": plane})
    assert isinstance(same, Pocket)
    found = pocket.truth(same)
    return replace(
        found,
        values={**found.values, "load_from_corner_plus": found.values["load_plus"]},
        uncertainty={**found.uncertainty, "load_from_corner_plus": found.uncertainty["load_plus"]},
        own={model.name: {} for model in models(scene.kind)},
    )
