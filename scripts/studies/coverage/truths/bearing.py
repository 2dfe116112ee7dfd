"""The truth of a bearing: every model on grids two, four and eight times finer than the judged one, extrapolated.

The film of a model is judged by its own finer solutions, its expected error by that of the most complete model.
"""

from roughfilm.rom.bearing.scene import Bearing
from scripts.studies.coverage.finer import finer_truth
from scripts.studies.coverage.truth import Truth


def truth(scene: Bearing) -> Truth:
    """Return the values of all quantities by every model that runs in this process."""
    return finer_truth(scene)
