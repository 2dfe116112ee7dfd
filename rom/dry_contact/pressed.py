"""Rungs that press the surface itself: elastic, or elastic and plastic."""

import math
from collections.abc import Callable
from functools import cache, partial
from typing import Unpack

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model, one
from roughfilm.rom.dry_contact.pressures import bin_edges, density_of_contact
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import About, Applicability, Effect, Model
from roughfilm.rom.ladder.result import Field

RESIDUAL_MEANING = "largest break of the conditions of contact, computed afresh, relative to the rms height"


TOLERANCE = 1e-8
"""Of the residual."""


def prepare(task: Task) -> None:
    """Compile the kernels and plan the transforms, which is done once on a machine."""
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import

    _compile()
    Press(task.heights, task.spacing, task.scene.composite_modulus)


@cache
def _compile() -> None:
    """Press a wave on a small grid."""
    from roughfilm.contact.mechanics.press import Press

    wave = np.cos(2 * np.pi * np.arange(8) / 8)
    Press(np.outer(wave, wave), (1.0, 1.0), 1.0).at(0.05)


def press(task: Task, *, plastic: bool) -> Answer:
    """The contact of a scene, its hardness left out if it is to stay elastic."""
    from roughfilm.contact.mechanics.press import Press

    scene: DryContact = task.scene
    hardness = scene.hardness if plastic else math.inf
    found = Press(task.heights, task.spacing, scene.composite_modulus, hardness=hardness).at(
        scene.load.pressure, tolerance=task.tolerance
    )
    edges = bin_edges(scene)
    return Answer(
        quantities={
            "area_fraction": one(found.area_fraction),
            "area_fraction_pixel": one(found.area_fraction_pixel),
            "plastic_fraction": one(found.plastic_fraction),
            "mean_gap": Quantity(value=found.mean_gap, unit="m"),
            "approach": Quantity(value=found.approach, unit="m"),
            "pressure_max": Quantity(value=float(found.pressure.max()), unit="Pa"),
            "mean_contact_pressure": Quantity(value=scene.load.pressure / found.area_fraction, unit="Pa"),
        },
        fields={
            "pressure": Field(values=found.pressure, unit="Pa"),
            "gap": Field(values=found.gap, unit="m"),
            "bin_edges": Field(values=edges, unit="Pa"),
            "pressure_density": Field(values=density_of_contact(found, edges), unit="1/Pa"),
        },
        residual=found.complementarity,
        iterations=max(found.iterations, 1),
    )


def cost(heights: int) -> float:
    """CPU seconds for so many heights at a tenth of contact."""
    return 5e-3 + 6e-7 * heights


def pressed_model(*, applies: Callable[[DryContact], Applicability], **about: Unpack[About]) -> Model[DryContact]:
    """A model that presses the surface; plastic if it keeps plasticity."""
    return contact_model(
        **about,
        residual_meaning=RESIDUAL_MEANING,
        applies=applies,
        work=partial(press, plastic=Effect.PLASTICITY in about["keeps"]),
        prepare=prepare,
        tolerance=TOLERANCE,
        cost=cost,
    )
