"""A series of leakage: contacts upward, each begun from the one before, and the flow through the gaps beside them."""

import math
import time
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import workers
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import COMPLEMENTARITY_TOLERANCE, Press
from roughfilm.contact.mechanics.store import Row as ContactRow
from roughfilm.contact.mechanics.store import add, finished, load_contact, row_of
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.parameters.peaks import lowest_valleys
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.seal.leakage.direct import direct_leakage
from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage
from roughfilm.rom.seal.leakage.percolation import Threshold, thresholds
from roughfilm.rom.seal.leakage.series import SOUGHT, UNITS, Kept, Row, kept_series, save_series
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal

COUNT = 25
"""Loads, where nobody says which."""

LIGHTEST = 0.005
"""Contact area at the first of them."""

BEYOND = 1.02
"""The last of them is so many times the last threshold's load."""

PER_LOAD = 2.1
"""A E* g'/P of light contact."""

PROBABLE = 0.3
"""Contact area, guessed from that, at which the search for thresholds begins."""

KEPT_EVERY_S = 2.0
"""Between two writings of files that grow."""

Advance = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class Ready:
    """A surface ready to be pressed, and where what is found is kept.

    Attributes
    ----------
    contacts, series : files.
    inputs : what the numbers of both come from.
    spread : E* g', Pa; E* of a flat surface.
    most : the largest load that is tried, Pa.
    """

    surface: Surface
    press: Press
    inputs: Inputs
    contacts: Path
    series: Path
    spread: float
    most: float


def ready(surface: Surface, press: Press, inputs: Inputs, directory: Path) -> Ready:
    """Loads are tried up to the hardness, and to E*, where linear elasticity means nothing any more."""
    flat = float(np.ptp(surface.heights)) == 0
    slope = 1.0 if flat else wave_power(surface.heights, surface.spacing).moments.rms_slope
    return Ready(
        surface=surface,
        press=press,
        inputs=inputs,
        contacts=directory / "contacts.h5",
        series=directory / "leakage.h5",
        spread=press.composite_modulus * slope,
        most=min(press.hardness, press.composite_modulus),
    )


def ready_seal(scene: Seal, directory: Path) -> Ready:
    """The surface of a scene ready to be pressed between its solids, with the files of a directory."""
    surface = scene.surface()
    settings = {
        "model": "elastic" if scene.solid.hardness is None else "elastic_plastic",
        "modulus": scene.solid.modulus,
        "poisson": scene.solid.poisson,
        "hardness": scene.solid.hardness,
        "counter_modulus": scene.counter and scene.counter.modulus,
        "counter_poisson": scene.counter and scene.counter.poisson,
        "composite_modulus": scene.composite_modulus,
        "boundary": "periodic",
        "tolerance": COMPLEMENTARITY_TOLERANCE,
        "code": code(),
    }
    press = Press(surface.heights, surface.spacing, scene.composite_modulus, hardness=scene.hardness)
    return ready(surface, press, Inputs(heights=surface.heights, spacing=surface.spacing, settings=settings), directory)


def sealing(body: Ready, advance: Advance) -> dict[str, Threshold]:
    """Where it seals, by what is ``SOUGHT``; from the file, if that has it."""
    kept = kept_series(body.series, body.inputs)
    if kept.thresholds:
        return dict(kept.thresholds)
    begin = min(PROBABLE / PER_LOAD * body.spread, body.most / 2)
    found = thresholds(_pressed(body), begin, body.most, progress=advance)
    told = dict(zip(SOUGHT, found, strict=True))
    save_series(body.series, body.inputs, Kept(rows=kept.rows, thresholds=told))
    return told


def chosen_loads(body: Ready, found: dict[str, Threshold]) -> tuple[float, ...]:
    """From about half a per cent of contact to just beyond all thresholds, and the last ones seen open between ends."""
    if float(np.ptp(body.surface.heights)) == 0:
        raise InputError("geometry.surface: is flat, and sealed under any load; give loads to see that")
    at, load = _pressed(body), LIGHTEST / PER_LOAD * body.spread
    for _ in range(4):
        area = at(load, None).area_fraction
        if 0.8 < area / LIGHTEST < 1.25:
            break
        load *= min(max(LIGHTEST / area, 0.1), 10.0)
    sealed = [threshold.sealed.load for threshold in found.values() if threshold.sealed is not None]
    last = max(sealed) * BEYOND if len(sealed) == len(found) else body.most
    last = max(min(last, body.most), load * BEYOND)
    opened = [found[name].open for name in SOUGHT[:2]]
    more = {side.load for side in opened if side is not None and load < side.load < last}
    return tuple(sorted({*(float(one) for one in np.geomspace(load, last, COUNT)), *more}))


def columns_of(scene: Seal, rows: Sequence[Row]) -> dict[str, tuple[str, list[float]]]:
    """All numbers of the rows, and the leakage of the scene's liquid: unit and values, by name."""
    columns = {name: (UNITS.get(name, "1"), [getattr(row, name) for row in rows]) for name in asdict(rows[0])}
    for name in SOUGHT:
        columns[f"leakage_{name}"] = "kg/(m*s)", [leakage_of(scene, getattr(row, name)) for row in rows]
    return columns


def _pressed(body: Ready) -> Callable[[float, Contact | None], Contact]:
    def at(load: float, start: Contact | None) -> Contact:
        try:
            return body.press.at(load, start=start)
        except ConvergenceError as error:
            told = f"at {load / 1e6:.6g} MPa: {error}"
            raise ConvergenceError(told, outcome=error.outcome, iterations=error.iterations) from None

    return at


def solved(body: Ready, loads: tuple[float, ...], threads: int, advance: Advance) -> tuple[dict[float, Row], int]:
    """The rows of all loads, and how many of them the file had; what was finished is kept whenever this ends.

    Raises
    ------
    InputError
        If a file was damaged, holds something else or cannot be written.
    ConvergenceError
        At the first load that does not converge; those below it stay in the files.
    """
    kept = kept_series(body.series, body.inputs)
    pressed = finished(body.contacts, body.inputs)
    rows = {load: row for load, row in kept.rows.items() if load in pressed}
    found = sum(load in rows for load in loads)
    fresh: list[tuple[ContactRow, Contact | None]] = []
    pending: dict[Future[Row], float] = {}
    saved = time.monotonic()

    def save(every: float) -> None:
        nonlocal saved
        if time.monotonic() - saved < every:
            return
        if fresh:
            add(body.contacts, body.inputs, fresh)
            fresh.clear()
        save_series(body.series, body.inputs, Kept(rows=rows, thresholds=kept.thresholds))
        saved = time.monotonic()

    def collect(most: int) -> None:
        while len(pending) > most:
            for future in wait(pending, return_when=FIRST_COMPLETED).done:
                rows[pending[future]] = future.result()
                del pending[future]
                advance(sum(load in rows for load in loads) / len(loads), f"{len(rows)} loads")
                save(KEPT_EVERY_S)

    try:
        with workers(threads) as pool:
            before: Contact | None = None
            flow = _flow_of(body)
            for load in (one for one in loads if one not in rows):
                if load in pressed:
                    before = load_contact(body.contacts, load)
                else:
                    cpu = time.process_time()
                    before = _pressed(body)(load, before)
                    fresh.append((row_of(before, time.process_time() - cpu), before))
                collect(threads)
                pending[pool.submit(flow, before)] = load
            collect(0)
    except (KeyboardInterrupt, SystemExit) as stop:
        done = sum(load in rows for load in loads)
        stop.add_note(f"stopped: {done} of {len(loads)} loads; the same command goes on")
        raise
    finally:
        rows |= {load: future.result() for future, load in pending.items() if _succeeded(future)}
        save(0.0)
    return {load: rows[load] for load in loads}, found


def _succeeded(future: Future[Row]) -> bool:
    return future.done() and not future.cancelled() and future.exception() is None


def _flow_of(body: Ready) -> Callable[[Contact], Row]:
    flat = float(np.ptp(body.surface.heights)) == 0
    apart = math.nan if flat else decay_lengths(autocorrelation(body.surface), body.surface.spacing).shortest

    def flow(contact: Contact) -> Row:
        cpu = time.thread_time()
        direct = direct_leakage(contact.gap, contact.spacing)
        cell = homogenized_leakage(contact.gap, contact.spacing)
        numbers = {}
        for name, passage in zip(SOUGHT, (direct.along, direct.across, cell.along, cell.across), strict=True):
            numbers[name] = passage.permeability
            numbers[f"{name}_uncertainty"] = passage.uncertainty
            numbers[f"{name}_sealed"] = float(passage.sealed)
        return Row(
            load=contact.load,
            area_fraction=contact.area_fraction,
            plastic_fraction=contact.plastic_fraction,
            mean_gap=contact.mean_gap,
            valley_depth=math.nan if flat else _valley_depth(contact, apart),
            cpu_s=time.thread_time() - cpu,
            **numbers,
        )

    return flow


def _valley_depth(contact: Contact, apart: float) -> float:
    """Svm of the surface under load."""
    loaded = contact.loaded_heights
    if float(np.ptp(loaded)) == 0:
        return math.nan
    surface = Surface(heights=loaded, spacing=contact.spacing, periodic=True)
    return float(lowest_valleys(surface, apart).mean())
