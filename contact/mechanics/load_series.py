"""Contacts at increasing loads, each started from the one before; loads that the file holds are not solved again."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.discretisation import uncertainties
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.gap_map import GapMap, gap_map
from roughfilm.contact.mechanics.store import Row, add, finished, load_contact, row_of

MIN_HISTOGRAM_POINTS = 25
"""Smallest number of contact points below the hardness for a histogram of pressures."""

MAX_BINS = 60
"""Largest number of bins of a histogram of pressures."""

Solver = Callable[[float, Contact | None], Contact]


@dataclass(frozen=True, kw_only=True)
class PressureDensity:
    """The distribution of contact pressure at one load.

    Attributes
    ----------
    load : mean pressure on the nominal area, Pa.
    pressure : contact pressures p, Pa, shape (n,).
    density : fraction of the nominal area per pressure, 1/Pa, shape (n,), without the area at the hardness.
    """

    load: float
    pressure: Array
    density: Array


@dataclass(frozen=True, kw_only=True)
class ContactSeries:
    """Contacts at the requested loads.

    Attributes
    ----------
    rows : results at each load.
    reused : number of loads taken from the file.
    densities : distributions of pressure at the loads that are drawn.
    last : the contact at the largest load; None for a statistical model.
    gap_maps : gaps at the loads that are drawn.
    uncertainties : uncertainties of the numbers of a row by their names, at the loads that are drawn, by load; empty
        for a statistical model and for a surface that stands alone, whose uncertainties are unknown.
    untrusted : loads outside the range of a statistical model, Pa.
    """

    rows: tuple[Row, ...]
    reused: int
    densities: tuple[PressureDensity, ...]
    last: Contact | None
    gap_maps: tuple[GapMap, ...] = ()
    uncertainties: Mapping[float, Mapping[str, float]] = field(default_factory=dict)
    untrusted: tuple[float, ...] = ()


@imports_apart()
def solved(
    at: Solver,
    inputs: Inputs,
    loads: tuple[float, ...],
    shown: tuple[float, ...],
    out: Path | None,
    advance: Callable[[float, str], None],
) -> ContactSeries:
    """Solve the loads that the file does not hold, in increasing order, and add each to the file when it is done.

    Parameters
    ----------
    at : at(load, start), the contact at a load, started from another contact if one is given.
    inputs : inputs of the file.
    loads : mean pressures on the nominal area, Pa, increasing.
    shown : loads whose pressures are drawn.
    out : the file; None to store nothing.
    advance : called with the number of loads done and a few words.

    Raises
    ------
    InputError
        If the file is damaged, holds something else or cannot be written.
    ConvergenceError
        At the first load that does not converge; the lower loads stay in the file.
    """
    stored = {} if out is None else finished(out, inputs)
    rows: list[Row] = []
    densities: list[PressureDensity] = []
    gap_maps: list[GapMap] = []
    known: dict[float, Mapping[str, float]] = {}
    before: Contact | None = None
    reused = sum(load in stored for load in loads)
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
                cpu = working_time()
                before = _at(at, load, before)
                row = row_of(before, working_time() - cpu)
                if out is not None:
                    add(out, inputs, [(row, before)])
            rows.append(row)
            if load in shown and before is not None:
                densities += _histogram(before)
                gap_maps.append(gap_map(before))
                if inputs.settings["boundary"] == "periodic":
                    known[load] = uncertainties(before)
    except (KeyboardInterrupt, SystemExit) as stop:
        stored_note = "; the same command goes on" if out is not None else ", none kept, as no file was named"
        stop.add_note(f"stopped: {len(rows)} of {len(loads)} loads{stored_note}")
        raise
    return ContactSeries(
        rows=tuple(rows),
        reused=reused,
        densities=tuple(densities),
        last=before,
        gap_maps=tuple(gap_maps),
        uncertainties=known,
    )


def _at(at: Solver, load: float, start: Contact | None) -> Contact:
    try:
        return at(load, start)
    except ConvergenceError as error:
        message = f"at {load / 1e6:.6g} MPa: {error}"
        raise ConvergenceError(message, outcome=error.outcome, iterations=error.iterations) from None


def estimated(
    at: Callable[[float], tuple[Row, Estimate]],
    inputs: Inputs,
    loads: tuple[float, ...],
    shown: tuple[float, ...],
    out: Path | None,
) -> ContactSeries:
    """The rows of a statistical model, which are cheap and therefore written at once."""
    hardness = inputs.settings["hardness"] or math.inf
    answers = [at(load) for load in loads]
    if out is not None:
        add(out, inputs, [(row, None) for row, _ in answers])
    return ContactSeries(
        rows=tuple(row for row, _ in answers),
        reused=0,
        densities=tuple(
            density for _, answer in answers if answer.load in shown for density in _estimated_density(answer, hardness)
        ),
        last=None,
        untrusted=tuple(answer.load for _, answer in answers if not answer.trusted),
    )


def _histogram(contact: Contact) -> list[PressureDensity]:
    """A histogram of the pressures between 0 and H; the number of bins grows with the number of points."""
    inside = contact.pressure[contact.in_contact & ~contact.plastic]
    if inside.size < MIN_HISTOGRAM_POINTS:
        return []
    bins = min(int(inside.size**0.5), MAX_BINS)
    count, edges = np.histogram(inside, bins=bins, range=(0.0, float(contact.pressure.max())))
    density = count / contact.pressure.size / (edges[1] - edges[0])
    return [PressureDensity(load=contact.load, pressure=(edges[:-1] + edges[1:]) / 2, density=density)]


def _estimated_density(answer: Estimate, hardness: float) -> list[PressureDensity]:
    """The pressure density of a statistical model, up to five times the mean pressure in contact."""
    if answer.pressure_density is None:
        return []
    pressure = min(5 * answer.mean_contact_pressure, hardness) * np.linspace(0.005, 0.999, 200)
    return [PressureDensity(load=answer.load, pressure=pressure, density=answer.pressure_density(pressure))]
