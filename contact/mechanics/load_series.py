"""A series of contacts, load by load: each begins from the one before, and those already in the file are kept."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.gap_map import GapMap, gap_map
from roughfilm.contact.mechanics.store import Row, add, finished, load_contact, row_of

FEWEST_POINTS, MOST_BINS = 25, 60
"""Of a histogram of pressures."""

Solver = Callable[[float, Contact | None], Contact]


@dataclass(frozen=True, kw_only=True)
class Spread:
    """How pressures spread at one load.

    Attributes
    ----------
    pressure : shape (n,), Pa.
    density : shape (n,), 1/Pa: f dp of the nominal area carries p ... p + dp, without what carries the hardness.
    """

    load: float
    pressure: Array
    density: Array


@dataclass(frozen=True, kw_only=True)
class Series:
    """Rows for the loads asked, how many of them were found in the file, and what pictures need."""

    rows: tuple[Row, ...]
    found: int
    spreads: tuple[Spread, ...]
    last: Contact | None
    gap_maps: tuple[GapMap, ...] = ()
    untrusted: tuple[float, ...] = ()


def solved(
    at: Solver,
    inputs: Inputs,
    loads: tuple[float, ...],
    shown: tuple[float, ...],
    out: Path | None,
    advance: Callable[[float, str], None],
) -> Series:
    """Solve what the file does not hold yet, upward, and add each load to it as it comes.

    Parameters
    ----------
    at : gives the contact at a load, from the one before if that helps.
    shown : the loads whose pressures are drawn.
    out : the file; None to keep nothing.

    Raises
    ------
    InputError
        If the file was damaged, holds something else or cannot be written.
    ConvergenceError
        At the first load that does not converge; those below it stay in the file.
    """
    stored = {} if out is None else finished(out, inputs)
    rows: list[Row] = []
    spreads: list[Spread] = []
    gap_maps: list[GapMap] = []
    before: Contact | None = None
    found = sum(load in stored for load in loads)
    try:
        for done, load in enumerate(loads):
            advance(done, f"{load / 1e6:.4g} MPa")
            if out is not None and load in stored:
                before, row = None, stored[load]
                if load in shown or load == loads[-1]:
                    before = load_contact(out, load)
            else:
                if before is None and out is not None and done:
                    before = load_contact(out, loads[done - 1])
                cpu = time.process_time()
                before = _at(at, load, before)
                row = row_of(before, time.process_time() - cpu)
                if out is not None:
                    add(out, inputs, [(row, before)])
            rows.append(row)
            if load in shown and before is not None:
                spreads += _spread(before)
                gap_maps.append(gap_map(before))
    except (KeyboardInterrupt, SystemExit) as stop:
        kept = "; the same command goes on" if out is not None else ", none kept, as no file was named"
        stop.add_note(f"stopped: {len(rows)} of {len(loads)} loads{kept}")
        raise
    return Series(rows=tuple(rows), found=found, spreads=tuple(spreads), last=before, gap_maps=tuple(gap_maps))


def _at(at: Solver, load: float, start: Contact | None) -> Contact:
    try:
        return at(load, start)
    except ConvergenceError as error:
        told = f"at {load / 1e6:.6g} MPa: {error}"
        raise ConvergenceError(told, outcome=error.outcome, iterations=error.iterations) from None


def estimated(
    at: Callable[[float], tuple[Row, Estimate]],
    inputs: Inputs,
    loads: tuple[float, ...],
    shown: tuple[float, ...],
    out: Path | None,
) -> Series:
    """The rows of a statistical rung; they cost nothing, so that all are written at once."""
    hardness = inputs.settings["hardness"] or math.inf
    answers = [at(load) for load in loads]
    if out is not None:
        add(out, inputs, [(row, None) for row, _ in answers])
    return Series(
        rows=tuple(row for row, _ in answers),
        found=0,
        spreads=tuple(
            spread for _, answer in answers if answer.load in shown for spread in _spread_of(answer, hardness)
        ),
        last=None,
        untrusted=tuple(answer.load for _, answer in answers if not answer.trusted),
    )


def _spread(contact: Contact) -> list[Spread]:
    """A histogram of the pressures above 0 and below H, with more bins the more points there are."""
    inside = contact.pressure[contact.in_contact & ~contact.plastic]
    if inside.size < FEWEST_POINTS:
        return []
    bins = min(int(inside.size**0.5), MOST_BINS)
    count, edges = np.histogram(inside, bins=bins, range=(0.0, float(contact.pressure.max())))
    density = count / contact.pressure.size / (edges[1] - edges[0])
    return [Spread(load=contact.load, pressure=(edges[:-1] + edges[1:]) / 2, density=density)]


def _spread_of(answer: Estimate, hardness: float) -> list[Spread]:
    """The density that a statistical rung gives, up to five times the mean pressure in contact."""
    if answer.pressure_density is None:
        return []
    pressure = min(5 * answer.mean_contact_pressure, hardness) * np.linspace(0.005, 0.999, 200)
    return [Spread(load=answer.load, pressure=pressure, density=answer.pressure_density(pressure))]
