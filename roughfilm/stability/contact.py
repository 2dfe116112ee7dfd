"""The map of the contact solver: loads, hardnesses and difficult surfaces, judged by the conditions of contact."""

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.stability.checks.contact import broken_conditions
from roughfilm.stability.form import (
    BAD,
    GOOD,
    Judgement,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_turn,
    listed,
)
from roughfilm.stability.questions.contact import MODULUS, Pressing, pressings

ALLOWED_VIOLATION = 1.01e-8
"""Allowed violation of the conditions of contact over the rms height: the solver's tolerance plus 1 % for round-off."""


def contact_of(pressing: Pressing) -> Contact:
    """The contact of a surface at its load, as the solver computes it; raises what ``Press`` raises."""
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import

    press = Press(np.asarray(pressing.heights), pressing.spacing, MODULUS, hardness=pressing.hardness)
    return press.at(pressing.load)


def judged(pressing: Pressing, contact: Contact) -> Judgement:
    """The judgement of a contact by the conditions of contact, which are recomputed without the solver."""
    violation = broken_conditions(
        contact.pressure,
        np.asarray(pressing.heights, dtype=float),
        pressing.spacing,
        composite_modulus=MODULUS,
        hardness=pressing.hardness,
        load=pressing.load,
    )
    plastic = not pressing.all_plastic or bool((contact.pressure == pressing.hardness).all())
    right = plastic and violation <= ALLOWED_VIOLATION
    expected = "all at the hardness" if pressing.all_plastic else "solved"
    return Judgement(
        iterations=contact.iterations,
        right=right,
        error=violation,
        numbers={
            "complementarity": abs(contact.complementarity),
            "area_fraction": contact.area_fraction_pixel,
            "plastic_fraction": contact.plastic_fraction,
        },
        message="" if right else f"expected: {expected}; conditions broken by {violation:.2g}",
    )


def probe(pressing: Pressing) -> Probe:
    """The probe that presses a surface."""
    return Probe(
        group=pressing.group,
        row=pressing.row,
        column=pressing.column,
        ask=lambda: contact_of(pressing),
        judge=partial(judged, pressing),
        refused=pressing.refused,
    )


def probes(points: int) -> Iterator[Probe]:
    """All probes of the contact solver on grids of about ``points`` along a side."""
    return map(probe, pressings(points))


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: the number of right answers, the most iterations, and the largest violation."""
    answered = [spot for spot in spots if spot.iterations is not None]
    good = [spot for spot in answered if spot.outcome in GOOD]
    refused = count(spots, MapOutcome.REFUSED)
    lines = [f"{len(good)} of {len(answered)} answers are right, {refused} questions are refused."]
    if good:
        slowest, worst = max(good, key=lambda spot: spot.iterations or 0), max(good, key=lambda spot: spot.error or 0)
        lines += [
            f"The most iterations: {slowest.iterations}, {slowest.place}.",
            f"The largest violation of the conditions at a node is {worst.error:.1e}, in {worst.place}.",
        ]
    return lines + listed(spots, MapOutcome.SLOW, *BAD)


CONTACT = StabilityMap(
    name="contact",
    title="Pressing a rough surface",
    axes="Periodic contact, from loads that hold one point to full contact: hardness from 0.01 to 3 E* g' and "
    "without, P/H to 0.999, amplitudes, lays, odd and prime grids, pixels a hundred times as long as wide, "
    "waves of one pixel, steps, spikes, and invalid input.",
    judge="Displacements recomputed in double precision by NumPy alone. The error is the largest violation of the "
    f"conditions of contact at a node, over the rms height: at most {ALLOWED_VIOLATION:g}.",
    resolution=128,
    resolution_meaning="points along a side of the surfaces",
    least=32,
    allowed="the surfaces need at least 32 points along a side",
    solve=in_turn(probes),
    summary=summary,
)
