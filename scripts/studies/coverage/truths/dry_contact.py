"""The truth of a dry contact: every model on its surface at two and four times as many points, extrapolated."""

from roughfilm.rom.dry_contact.scene import DryContact
from scripts.studies.coverage.finer import on_finer_surface
from scripts.studies.coverage.truth import Truth


def truth(scene: DryContact) -> Truth:
    """Return the values of all quantities by every model that runs in this process."""
    return on_finer_surface(scene)
