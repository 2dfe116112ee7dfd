"""The truth of a seal: every model on its surface at two and four times as many points, extrapolated."""

from roughfilm.rom.seal.scene import Seal
from scripts.studies.coverage.finer import on_finer_surface
from scripts.studies.coverage.truth import Truth


def truth(scene: Seal) -> Truth:
    """Return the values of all quantities by every model that runs in this process."""
    return on_finer_surface(scene)
