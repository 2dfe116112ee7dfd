"""The truth of a bearing whose lubricant heats: every model on finer grids, extrapolated."""

from roughfilm.rom.bearing.scene import Bearing
from scripts.studies.coverage.finer import finer_truth
from scripts.studies.coverage.truth import Truth


def truth(scene: Bearing) -> Truth:
    """Return the values of all quantities by every model that runs in this process."""
    return finer_truth(scene)
