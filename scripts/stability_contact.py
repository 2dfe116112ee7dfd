"""Where the contact solver converges: loads, hardnesses, awkward surfaces; every answer recomputed by NumPy alone."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from contact.errors import ConvergenceError, InputError
from contact.mechanics.contact import Contact
from scripts import stability_spots as spots_of
from scripts.common import progress_bar
from scripts.contact_check import broken_conditions
from scripts.contact_probes import ALL_PLASTIC, MODULUS, REFUSED, Probe, probes
from scripts.stability_made import Made
from scripts.stability_spots import MEANING as ALWAYS
from scripts.stability_spots import State, columns_of, count, entries_of, in_groups, in_rows, table_of

SLOW = 100
"""More iterations than this are slow."""

ALLOWED = 1.01e-8
"""Of the conditions recomputed: what is asked of the solver, and a hundredth for additions in another order."""


MEANING: Mapping[State, str] = {
    State.CONVERGED: f"the conditions of contact, recomputed, hold within {ALLOWED:g} of the rms height",
    State.SLOW: f"the same, after more than {SLOW} iterations",
    **ALWAYS,
}


@dataclass(frozen=True, kw_only=True)
class Spot(spots_of.Spot):
    """What became of one probe; None where there was no answer. ``broken`` is recomputed, ``complementarity`` told."""

    complementarity: float | None = None
    broken: float | None = None
    area_fraction: float | None = None
    plastic_fraction: float | None = None


def pressed(probe: Probe) -> Contact:
    """The solver's answer to a probe."""
    from contact.mechanics.press import Press  # numba is slow to import

    press = Press(np.asarray(probe.heights), probe.spacing, MODULUS, hardness=probe.hardness)
    return press.at(probe.load)


def tried(probe: Probe) -> Spot:
    """Put a probe to the solver and judge the answer."""
    spot = partial(Spot, group=probe.group, row=probe.row, column=probe.column)
    cpu = time.process_time()
    try:
        found = pressed(probe)
    except InputError as error:
        state = State.REFUSED if probe.expected == REFUSED else State.WRONG
        return spot(state=state, cpu_s=time.process_time() - cpu, message=str(error))
    except ConvergenceError as error:
        spent = time.process_time() - cpu
        return spot(state=State.STALLED, iterations=error.iterations, cpu_s=spent, message=str(error))
    spent = time.process_time() - cpu
    broken = float("inf") if probe.expected == REFUSED else _broken(probe, found)
    right = broken <= ALLOWED and (probe.expected != ALL_PLASTIC or bool((found.pressure == probe.hardness).all()))
    slow = State.SLOW if found.iterations > SLOW else State.CONVERGED
    return spot(
        state=slow if right else State.WRONG,
        iterations=found.iterations,
        complementarity=abs(found.complementarity),
        broken=broken if np.isfinite(broken) else None,
        area_fraction=found.area_fraction_pixel,
        plastic_fraction=found.plastic_fraction,
        cpu_s=spent,
        message="" if right else f"expected: {probe.expected}; conditions broken by {broken:.2g}",
    )


def _broken(probe: Probe, found: Contact) -> float:
    return broken_conditions(
        found.pressure,
        np.asarray(probe.heights, dtype=float),
        probe.spacing,
        composite_modulus=MODULUS,
        hardness=probe.hardness,
        load=probe.load,
    )


@dataclass(frozen=True, kw_only=True)
class ContactFamily:
    """The probes of the contact solver."""

    resolution: int = 128
    resolution_meaning: str = "points along a side of the surfaces"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Made:  # noqa: ARG002
        """Try every probe, one after the other: all of them take less time than to start a process for each."""
        if resolution < 32:
            raise InputError(f"--resolution: got {resolution}; the surfaces need at least 32 points along a side")
        asked = list(probes(resolution))
        spots: list[Spot] = []
        with progress_bar(len(asked)) as advance:
            for probe in asked:
                advance(len(spots), f"{probe.group}: {probe.row}, {probe.column}")
                spots.append(tried(probe))
        groups = in_groups(spots)
        return Made(
            entries=entries_of("contact", resolution, spots, told(spots)),
            columns=columns_of(spots, ("complementarity", "broken", "area_fraction", "plastic_fraction")),
            table=table_of(groups),
            template="stability_contact.html.j2",
            page={
                "tables": {name: _as_table(found) for name, found in groups.items()},
                "states": [(state, MEANING[state], count(spots, state)) for state in State],
                "told": told(spots),
            },
        )


def told(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know, in words."""
    answered = [spot for spot in spots if spot.iterations is not None]
    good = [spot for spot in answered if spot.state in (State.CONVERGED, State.SLOW)]
    lines = [f"{len(good)} of {len(answered)} answers hold, {count(spots, State.REFUSED)} questions are refused."]
    if good:
        slowest, worst = max(good, key=lambda spot: spot.iterations or 0), max(good, key=lambda spot: spot.broken or 0)
        lines += [
            f"The most iterations: {slowest.iterations}, {slowest.group}: {slowest.row}, {slowest.column}.",
            f"The worst node of all breaks the conditions by {worst.broken:.1e}, in {worst.group}: {worst.row}, "
            f"{worst.column}.",
        ]
    return lines + [
        f"{spot.state.capitalize()}: {spot.group}: {spot.row}, {spot.column}"
        + (f" ({spot.iterations} iterations)" if spot.iterations else "")
        + (f": {spot.message}" if spot.message else "")
        for spot in spots
        if spot.state in (State.SLOW, State.STALLED, State.WRONG)
    ]


def _as_table(spots: Sequence[Spot]) -> dict[str, Any]:
    rows = in_rows(spots)
    same = len({tuple(cells) for cells in rows.values()}) == 1
    return {"columns": list(next(iter(rows.values()))) if same else [], "rows": rows}


CONTACT = ContactFamily()
