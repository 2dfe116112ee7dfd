"""The truth of a pocket."""

from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.truth import Truth


def truth(scene: Pocket) -> Truth:
    """Return load, friction and peak pressures of a pocket by finite elements on two meshes."""
    raise NotImplementedError
