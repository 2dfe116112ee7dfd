"""Random cells of a pocket in plan whose dimples are about as deep as the film, with inertia."""

from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.random_entries import Entries
from scripts.studies.coverage.scenes import dimples

DEPTHS = (0.25, 1.0)
"""Least and largest depth of the deepest dimple over the film."""

MIN_REYNOLDS_NUMBER = 5.0
"""Least Reynolds number."""


def draw(rng: Generator) -> Entries:
    """Return a cell as :func:`scripts.studies.coverage.scenes.dimples.draw` does, d/h = 0.25 to 1 and Re = 5 to 300.

    Raises
    ------
    InputError
        If the dimples are shallower or deeper, inertia is negligible, or the film is not thin.
    """
    entries = dimples.draw(rng)
    scene = read_scene({"name": "cell", **entries})
    assert isinstance(scene, Pocket)
    if not DEPTHS[0] <= scene.depth <= DEPTHS[1] or scene.reynolds_number < MIN_REYNOLDS_NUMBER:
        raise InputError(f"geometry: got d/h = {scene.depth:.3g} at Re = {scene.reynolds_number:.3g}; draw again")
    return entries
