"""Models that estimate a contact from statistics of the surface."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Unpack

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.rom.dry_contact.gaussian import skewed, with_lay
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model, one
from roughfilm.rom.dry_contact.pressures import bin_edges, density_of_estimate, load_mismatch
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import About, Applicability, Model
from roughfilm.rom.ladder.result import Field

RESIDUAL_MEANING = "relative difference of the load of the pressures from the load"

LOAD_TOLERANCE = 1e-3
"""Default relative load difference above which there is a warning; nothing is iterated."""

MIN_PLASTIC_WAVES = 1.0
"""Smallest plastic area, in squares of the wavelength 2π Sq/g', with which the peak pressure is the hardness.

A theory of the mean over many surfaces gives every surface a plastic area above 0; a single surface has contacts of
about this size or none.
"""

Estimator = Callable[[Task], Estimate]

Assumption = Callable[[Task], str | None]
"""assumption(task): a sentence on how the surface deviates from those that the estimate describes, or None."""


def gaussian(task: Task) -> str | None:
    """The assumption of Gaussian heights."""
    return skewed(task.heights)


def isotropic(task: Task) -> str | None:
    """The assumption of a surface without a lay."""
    return with_lay(task.heights, task.spacing)


def estimate(task: Task, *, guess: Estimator, assumes: Sequence[Assumption]) -> Answer:
    """The quantities and fields that an estimate has, with warnings outside of its range.

    The peak pressure is given, as the hardness, only where the estimate is within its range and the plastic area at
    least ``MIN_PLASTIC_WAVES``.
    """
    scene: DryContact = task.scene
    contact = guess(task)
    edges, mismatch = bin_edges(scene), load_mismatch(scene, contact)
    warnings = [] if contact.trusted else [f"out of its range, {contact.range_of_validity}"]
    remedy = "elastic" if math.isinf(scene.hardness) else "elastic_plastic"
    warnings += [f"{sentence}: out of its range, take {remedy}" for sentence in deviations(task, assumes)]
    if mismatch > task.tolerance:
        warnings.append(f"the load of its pressures has a relative error of {mismatch:.1e}")
    quantities = {
        "area_fraction": one(contact.area_fraction),
        "plastic_fraction": one(contact.plastic_fraction),
        "mean_contact_pressure": Quantity(value=contact.mean_contact_pressure, unit="Pa"),
    }
    if contact.mean_gap is not None:
        quantities["mean_gap"] = Quantity(value=contact.mean_gap, unit="m")
    if not warnings and contact.plastic_fraction * _waves(task) >= MIN_PLASTIC_WAVES:
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


def deviations(task: Task, assumes: Sequence[Assumption]) -> list[str]:
    """The sentences on the assumptions that a task's surface does not meet."""
    return [sentence for assumption in assumes if (sentence := assumption(task)) is not None]


def _waves(task: Task) -> float:
    """The nominal area in squares of the wavelength λ = 2π Sq/g'; 0 for a flat surface."""
    slope = task.scene.rms_slope or 0.0
    wavelength = 2 * math.pi * float(task.heights.std()) / slope if slope else math.inf
    return task.heights.size * math.prod(task.spacing) / wavelength**2


def prepare(_task: Task) -> None:
    """Import modules whose import time is not part of the cost."""
    import scipy.interpolate
    import scipy.optimize  # noqa: F401


def applies(scene: DryContact, *, guess: Estimator, assumes: Sequence[Assumption], what: str) -> Applicability:
    """Whether the estimate exists for a scene, with its range of validity."""
    surface = scene.surface()
    task = Task(scene=scene, heights=surface.heights, spacing=surface.spacing, tolerance=LOAD_TOLERANCE)
    try:
        contact = guess(task)
    except InputError as error:
        return Applicability(applies=False, reason=str(error))
    inside = "within" if contact.trusted and not deviations(task, assumes) else "out of"
    reason = f"{what}; {inside} its range, {contact.range_of_validity}; cannot say: {contact.cannot_say}"
    return Applicability(applies=True, reason=reason)


def estimated_model(
    *, what: str, guess: Estimator, assumes: Sequence[Assumption] = (), **about: Unpack[About]
) -> Model[DryContact]:
    """A model from an estimate; ``what`` describes the effects that it keeps and leaves out."""
    return contact_model(
        **about,
        residual_meaning=RESIDUAL_MEANING,
        applies=partial(applies, guess=guess, assumes=assumes, what=what),
        work=partial(estimate, guess=guess, assumes=assumes),
        prepare=prepare,
        tolerance=LOAD_TOLERANCE,
        cost=lambda heights: 2e-3 + 3e-7 * heights,
    )
