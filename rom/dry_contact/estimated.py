"""Rungs that estimate a contact from statistics of the surface."""

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

RESIDUAL_MEANING = "mismatch of the load that its pressures carry, relative to the load"

TOLERANCE = 1e-3
"""Of the load; nothing is iterated, so that a mismatch above it is told and not mended."""

Guess = Callable[[Task], Estimate]


def estimate(task: Task, *, guess: Guess) -> Answer:
    """What an estimate says of a scene, as far as it goes."""
    scene: DryContact = task.scene
    found = guess(task)
    edges, mismatch = bin_edges(scene), load_mismatch(scene, found)
    warnings = [] if found.trusted else [f"out of its range, {found.range_of_validity}"]
    if mismatch > task.tolerance:
        warnings.append(f"its pressures carry a load {mismatch:.1e} off")
    quantities = {
        "area_fraction": one(found.area_fraction),
        "plastic_fraction": one(found.plastic_fraction),
        "mean_contact_pressure": Quantity(value=found.mean_contact_pressure, unit="Pa"),
    }
    if found.mean_gap is not None:
        quantities["mean_gap"] = Quantity(value=found.mean_gap, unit="m")
    if found.plastic_fraction:
        quantities["pressure_max"] = Quantity(value=scene.hardness, unit="Pa")
    return Answer(
        quantities={name: quantity for name, quantity in quantities.items() if math.isfinite(quantity.value)},
        fields={
            "bin_edges": Field(values=edges, unit="Pa"),
            "pressure_density": Field(values=density_of_estimate(found, edges), unit="1/Pa"),
        },
        residual=mismatch,
        iterations=1,
        warnings=tuple(warnings),
    )


def prepare(_task: Task) -> None:
    """Import what is slow to import, which is not the cost of a scene."""
    import scipy.interpolate
    import scipy.optimize  # noqa: F401


def applies(scene: DryContact, *, guess: Guess, what: str) -> Applicability:
    """Whether the estimate can be made at all; if so, how far it is to be trusted."""
    surface = scene.surface()
    task = Task(scene=scene, heights=surface.heights, spacing=surface.spacing, tolerance=TOLERANCE)
    try:
        found = guess(task)
    except InputError as error:
        return Applicability(applies=False, reason=str(error))
    kept = "within" if found.trusted else "out of"
    reason = f"{what}; {kept} its range, {found.range_of_validity}; cannot say: {found.cannot_say}"
    return Applicability(applies=True, reason=reason)


def estimated_model(*, what: str, guess: Guess, **about: Unpack[About]) -> Model[DryContact]:
    """A model that estimates; ``what`` says in words what it keeps and leaves out."""
    return contact_model(
        **about,
        residual_meaning=RESIDUAL_MEANING,
        applies=partial(applies, guess=guess, what=what),
        work=partial(estimate, guess=guess),
        prepare=prepare,
        tolerance=TOLERANCE,
        cost=lambda heights: 2e-3 + 3e-7 * heights,
    )
