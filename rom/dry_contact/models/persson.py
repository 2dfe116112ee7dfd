"""Persson: diffusion of contact pressure as roughness of smaller scales is added."""

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.rom.dry_contact.estimated import estimated_model, gaussian
from roughfilm.rom.dry_contact.model import Task
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import Effect


def guess(task: Task) -> Estimate:
    """The estimate from the spectrum of the task's heights; InputError for a flat surface."""
    from roughfilm.contact.mechanics.estimates.persson import persson  # scipy is slow to import

    scene: DryContact = task.scene
    own = task.heights.shape == scene.surface().shape
    spectrum = scene.spectrum() if own else wave_power(task.heights, task.spacing)
    if spectrum is None:
        raise InputError("persson: got a flat surface, which has no spectrum; take elastic")
    return persson(
        spectrum, composite_modulus=scene.composite_modulus, load=scene.load.pressure, hardness=scene.hardness
    )


MODEL = estimated_model(
    name="persson",
    summary="elastic contact of all scales, bounded by the hardness, in closed form from the spectrum",
    what="keeps deformation and plasticity on average over all surfaces of this spectrum",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY}),
    complete=False,
    sources=("10.1063/1.1388626", "10.1088/0953-8984/20/21/215214"),
    guess=guess,
    assumes=(gaussian,),
)
