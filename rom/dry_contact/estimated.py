"""Models that estimate a contact from statistics of the surface."""

import math
from collections.abc import Callable
from functools import partial
from typing import Unpack

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model, one
from roughfilm.rom.dry_contact.pressures import bin_edges, density_of_estimate, load_mismatch
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import About, Applicability, Model
from roughfilm.rom.ladder.result import Field

RESIDUAL_MEANING = "relative difference of the load of the pressures from the load"

LOAD_TOLERANCE = 1e-3
"""Default relative load difference above which there is a warning; nothing is iterated."""

Estimator = Callable[[Task], Estimate]


def estimate(task: Task, *, guess: Estimator) -> Answer:
    """The quantities and fields that an estimate has, with warnings outside of its range."""
    scene: DryContact = task.scene
    contact = guess(task)
    edges, mismatch = bin_edges(scene), load_mismatch(scene, contact)
    warnings = [] if contact.trusted else [f"out of its range, {contact.range_of_validity}"]
    if mismatch > task.tolerance:
        warnings.append(f"the load of its pressures has a relative error of {mismatch:.1e}")
    quantities = {
        "area_fraction": one(contact.area_fraction),
        "plastic_fraction": one(contact.plastic_fraction),
        "mean_contact_pressure": Quantity(value=contact.mean_contact_pressure, unit="Pa"),
    }
    if contact.mean_gap is not None:
        quantities["mean_gap"] = Quantity(value=contact.mean_gap, unit="m")
    if contact.plastic_fraction:
        quantities["pressure_max"] = Quantity(value=scene.hardness, unit="Pa")
    return Answer(
        quantities={name: quantity for name, quantity in quantities.items() if math.isfinite(quantity.value)},
        fields={
            "bin_edges": Field(values=edges, unit="Pa"),
            "pressure_density": Field(values=density_of_estimate(contact, edges), unit="1/Pa"),
        },
        residual=mismatch,
        iterations=1,
        warnings=tuple(warnings),
    )


def prepare(_task: Task) -> None:
    """Import modules whose import time is not part of the cost."""
    import scipy.interpolate
    import scipy.optimize  # noqa: F401


def applies(scene: DryContact, *, guess: Estimator, what: str) -> Applicability:
    """Whether the estimate exists for a scene, with its range of validity."""
    surface = scene.surface()
    task = Task(scene=scene, heights=surface.heights, spacing=surface.spacing, tolerance=LOAD_TOLERANCE)
    try:
        contact = guess(task)
    except InputError as error:
        return Applicability(applies=False, reason=str(error))
    inside = "within" if contact.trusted else "out of"
    reason = f"{what}; {inside} its range, {contact.range_of_validity}; cannot say: {contact.cannot_say}"
    return Applicability(applies=True, reason=reason)


def estimated_model(*, what: str, guess: Estimator, **about: Unpack[About]) -> Model[DryContact]:
    """A model from an estimate; ``what`` describes the effects that it keeps and leaves out."""
    return contact_model(
        **about,
        residual_meaning=RESIDUAL_MEANING,
        applies=partial(applies, guess=guess, what=what),
        work=partial(estimate, guess=guess),
        prepare=prepare,
        tolerance=LOAD_TOLERANCE,
        cost=lambda heights: 2e-3 + 3e-7 * heights,
    )
