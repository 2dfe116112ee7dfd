"""Greenwood and Williamson: elastic asperities without interaction."""

import math

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.rom.dry_contact.estimated import estimated_model, gaussian, isotropic
from roughfilm.rom.dry_contact.model import Task
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import Effect


def guess(task: Task) -> Estimate:
    """The estimate from the spectral moments of the task's heights; InputError for a flat surface."""
    from roughfilm.contact.mechanics.estimates.greenwood_williamson import (
        greenwood_williamson,  # scipy is slow to import
    )

    scene: DryContact = task.scene
    own = task.heights.shape == scene.surface().shape
    spectrum = scene.spectrum() if own else wave_power(task.heights, task.spacing)
    if spectrum is None:
        raise InputError("greenwood_williamson: got a flat surface, which has no asperities; take elastic")
    return greenwood_williamson(
        spectrum.moments,
        composite_modulus=scene.composite_modulus,
        load=scene.load.pressure,
        hardness=scene.hardness,
        nominal_area=task.heights.size * math.prod(task.spacing),
    )


MODEL = estimated_model(
    name="greenwood_williamson",
    summary="independent elastic asperities from spectral moments",
    what="keeps the elastic deformation of asperities, leaves out their interaction and plasticity",
    keeps=frozenset({Effect.DEFORMATION}),
    complete=False,
    sources=("10.1098/rspa.1966.0242", "10.1016/0043-1648(86)90045-1"),
    guess=guess,
    assumes=(gaussian, isotropic),
)
