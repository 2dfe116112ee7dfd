"""Models that solve the contact of the surface itself, elastic or elastic-plastic."""

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
from roughfilm.rom.ladder.result import Field, with_uncertainties

RESIDUAL_MEANING = "largest recomputed violation of the contact conditions, relative to the rms height"

RESIDUAL_TOLERANCE = 1e-8
"""Default tolerance of the residual."""

GAP_PER_LOST_RMS = 2.0
"""Uncertainty of the mean gap on a coarser grid over the rms height of the waves that the grid omits.

It covers 93 of 100 of 490 contacts on 2 to 8 times fewer points a side than the surface has
(``scripts.studies.coverage``).
"""


def prepare(task: Task) -> None:
    """Compile the kernels and plan the transforms."""
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import

    _compile()
    Press(task.heights, task.spacing, task.scene.composite_modulus)


@cache
def _compile() -> None:
    """Solve the contact of a wave on a small grid."""
    from roughfilm.contact.mechanics.press import Press

    wave = np.cos(2 * np.pi * np.arange(8) / 8)
    Press(np.outer(wave, wave), (1.0, 1.0), 1.0).at(0.05)


def press(task: Task, *, plastic: bool) -> Answer:
    """The contact of a scene, elastic unless ``plastic``.

    The uncertainty is that by the pixels. On a coarser grid than the surface's own, which omits waves, only that of the
    mean gap is known: ``GAP_PER_LOST_RMS`` times the rms height of these waves is added in squares.
    """
    from roughfilm.contact.mechanics.discretisation import uncertainties
    from roughfilm.contact.mechanics.press import Press

    scene: DryContact = task.scene
    hardness = scene.hardness if plastic else math.inf
    contact = Press(task.heights, task.spacing, scene.composite_modulus, hardness=hardness).at(
        scene.load.pressure, tolerance=task.tolerance
    )
    edges, mean = bin_edges(scene), scene.load.pressure / contact.area_fraction
    beyond = np.count_nonzero(contact.pressure > scene.hardness) / contact.pressure.size
    warnings = (
        (
            f"the pressure exceeds the hardness on {beyond:.3g} of the nominal area, up to "
            f"{contact.pressure.max() / scene.hardness:.3g} times; take elastic_plastic",
        )
        if beyond
        else ()
    )
    quantities = {
        "area_fraction": one(contact.area_fraction),
        "area_fraction_pixel": one(contact.area_fraction_pixel),
        "plastic_fraction": one(contact.plastic_fraction),
        "mean_gap": Quantity(value=contact.mean_gap, unit="m"),
        "approach": Quantity(value=contact.approach, unit="m"),
        "pressure_max": Quantity(value=float(contact.pressure.max()), unit="Pa"),
        "mean_contact_pressure": Quantity(value=mean, unit="Pa"),
    }
    by_pixels = uncertainties(contact)
    own = scene.surface().heights
    if task.heights.shape == own.shape:
        by_pixels["mean_contact_pressure"] = mean * by_pixels["area_fraction"] / contact.area_fraction
    else:
        lost = math.sqrt(max(float(own.var() - task.heights.var()), 0.0))
        by_pixels = {"mean_gap": math.hypot(by_pixels["mean_gap"], GAP_PER_LOST_RMS * lost)}
    return Answer(
        quantities=with_uncertainties(quantities, by_pixels),
        fields={
            "pressure": Field(values=contact.pressure, unit="Pa"),
            "gap": Field(values=contact.gap, unit="m"),
            "bin_edges": Field(values=edges, unit="Pa"),
            "pressure_density": Field(values=density_of_contact(contact, edges), unit="1/Pa"),
        },
        residual=contact.complementarity,
        iterations=max(contact.iterations, 1),
        warnings=warnings,
    )


def cost(heights: int) -> float:
    """The CPU time for a number of heights at a contact area of a tenth, s."""
    return 5e-3 + 6e-7 * heights


def pressed_model(*, applies: Callable[[DryContact], Applicability], **about: Unpack[About]) -> Model[DryContact]:
    """A model that solves the contact, plastic if it keeps plasticity."""
    return contact_model(
        **about,
        residual_meaning=RESIDUAL_MEANING,
        applies=applies,
        work=partial(press, plastic=Effect.PLASTICITY in about["keeps"]),
        prepare=prepare,
        tolerance=RESIDUAL_TOLERANCE,
        cost=cost,
    )
