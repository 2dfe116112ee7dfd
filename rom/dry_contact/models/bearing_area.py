"""The bearing area: the surface truncated where its area carries the load at the hardness."""

from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.estimates.truncation import bearing_area
from roughfilm.rom.dry_contact.estimated import estimated_model
from roughfilm.rom.dry_contact.model import Task
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import Effect


def guess(task: Task) -> Estimate:
    """The bearing area of the task's heights."""
    scene: DryContact = task.scene
    return bearing_area(
        task.heights,
        load=scene.load.pressure,
        hardness=scene.hardness,
        composite_modulus=scene.composite_modulus,
        rms_slope=scene.rms_slope or 1.0,
    )


MODEL = estimated_model(
    name="bearing_area",
    summary="truncation: heights above a plane are flattened at the hardness, the rest is rigid",
    what="keeps plasticity, leaves out elastic deformation",
    keeps=frozenset({Effect.PLASTICITY}),
    sources=("10.1016/j.triboint.2005.11.008",),
    guess=guess,
)
