"""Where the contact solver converges: loads, hardnesses, awkward surfaces; every answer recomputed by NumPy alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.stability.checks.contact import broken_conditions
from roughfilm.stability.form import BAD, GOOD, Judged, Map, Outcome, Spot, count, named, tried
from roughfilm.stability.questions.contact import ALL_PLASTIC, MODULUS, REFUSED, Probe, probes
from roughfilm.terminal.console import progress_bar

ALLOWED = 1.01e-8
"""Of the conditions recomputed: what is asked of the solver, and a hundredth for additions in another order."""


def pressed(probe: Probe) -> Contact:
    """The solver's answer to a probe."""
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import

    press = Press(np.asarray(probe.heights), probe.spacing, MODULUS, hardness=probe.hardness)
    return press.at(probe.load)


def judged(found: Contact, probe: Probe) -> Judged:
    """By the conditions of contact, recomputed."""
    broken = broken_conditions(
        found.pressure,
        np.asarray(probe.heights, dtype=float),
        probe.spacing,
        composite_modulus=MODULUS,
        hardness=probe.hardness,
        load=probe.load,
    )
    whole = probe.expected != ALL_PLASTIC or bool((found.pressure == probe.hardness).all())
    right = whole and broken <= ALLOWED
    return Judged(
        iterations=found.iterations,
        right=right,
        error=broken,
        numbers={
            "complementarity": abs(found.complementarity),
            "area_fraction": found.area_fraction_pixel,
            "plastic_fraction": found.plastic_fraction,
        },
        message="" if right else f"expected: {probe.expected}; conditions broken by {broken:.2g}",
    )


def put(probe: Probe) -> Spot:
    """A probe put to the solver."""
    spot = partial(Spot, group=probe.group, row=probe.row, column=probe.column)
    return tried(spot, lambda: pressed(probe), partial(judged, probe=probe), refused=probe.expected == REFUSED)


@dataclass(frozen=True, kw_only=True)
class ContactFamily:
    """The probes of the contact solver."""

    resolution: int = 128
    resolution_meaning: str = "points along a side of the surfaces"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:  # noqa: ARG002
        """Try every probe, one after the other: all of them take less time than to start a process for each."""
        if resolution < 32:
            raise InputError(f"--resolution: got {resolution}; the surfaces need at least 32 points along a side")
        asked = list(probes(resolution))
        spots: list[Spot] = []
        with progress_bar(len(asked)) as advance:
            for probe in asked:
                advance(len(spots), f"{probe.group}: {probe.row}, {probe.column}")
                spots.append(put(probe))
        return Map(
            family="contact",
            title="Pressing a rough surface",
            axes="Periodic contact, from loads that hold one point to full contact: hardness from 0.01 to 3 E* g' and "
            "without, P/H to 0.999, amplitudes, lays, odd and prime grids, pixels a hundred times as long as wide, "
            "waves of one pixel, steps, spikes, and what makes no sense.",
            judge=f"Displacements computed afresh, in double precision, by NumPy alone; the error is by how much the "
            f"worst node breaks the conditions of contact, over the rms height: at most {ALLOWED:g}.",
            resolution=resolution,
            resolution_meaning=self.resolution_meaning,
            spots=spots,
            told=told(spots),
        )


def told(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know, in words."""
    answered = [spot for spot in spots if spot.iterations is not None]
    good = [spot for spot in answered if spot.outcome in GOOD]
    lines = [f"{len(good)} of {len(answered)} answers hold, {count(spots, Outcome.REFUSED)} questions are refused."]
    if good:
        slowest, worst = max(good, key=lambda spot: spot.iterations or 0), max(good, key=lambda spot: spot.error or 0)
        lines += [
            f"The most iterations: {slowest.iterations}, {slowest.place}.",
            f"The worst node of all breaks the conditions by {worst.error:.1e}, in {worst.place}.",
        ]
    return lines + named(spots, Outcome.SLOW, *BAD)


CONTACT = ContactFamily()
