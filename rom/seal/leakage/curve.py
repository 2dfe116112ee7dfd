"""Leakage of a seal over the load: contacts at increasing loads and the flow through their gaps.

The solution of each contact starts from that at the load before.
"""

import math
import time
from collections.abc import Callable, Collection, Sequence
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
from roughfilm.rom.seal.leakage.kept import kept_series
from roughfilm.rom.seal.leakage.percolation import Threshold, thresholds
from roughfilm.rom.seal.leakage.pixels import with_pixels
from roughfilm.rom.seal.leakage.series import SOUGHT, UNITS, LeakageSeries, Row, save_series, stored_series
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal

DEFAULT_LOADS = 25
"""Default number of loads."""

FIRST_AREA = 0.005
"""Contact area fraction at the first default load."""

LAST_LOAD_RATIO = 1.02
"""Ratio of the last default load to the largest load at which a gap seals."""

LIGHT_CONTACT_RATIO = 2.1
"""The ratio A E* g'/P in light contact, with the contact area fraction A, the rms slope g' and the mean pressure P."""

START_AREA = 0.3
"""Contact area fraction, computed with ``LIGHT_CONTACT_RATIO``, at which the search for thresholds starts."""

SAVE_INTERVAL_S = 2.0
"""Shortest time between two writings of the files, s."""

Advance = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class SealSetup:
    """A surface with its contact solver and the files of the results.

    Attributes
    ----------
    surface : the undeformed surface.
    press : solver of the contact.
    inputs : inputs of both files.
    contacts, series : files of the contacts and of the leakage.
    spread : E* g' with the rms slope g', Pa; E* for a flat surface.
    most : largest load, Pa.
    name : name of the surface for people.
    stored_loads : loads, Pa, whose contacts are stored; None for all.
    """

    surface: Surface
    press: Press
    inputs: Inputs
    contacts: Path
    series: Path
    spread: float
    most: float
    name: str = ""
    stored_loads: Collection[float] | None = None

    def stores(self, load: float) -> bool:
        """Whether the contact at a load, Pa, is stored."""
        return self.stored_loads is None or load in self.stored_loads


def setup(surface: Surface, press: Press, inputs: Inputs, directory: Path, name: str = "") -> SealSetup:
    """The setup of a surface with result files in a directory; the largest load is the smaller of hardness and E*."""
    flat = float(np.ptp(surface.heights)) == 0
    slope = 1.0 if flat else wave_power(surface.heights, surface.spacing).moments.rms_slope
    return SealSetup(
        surface=surface,
        press=press,
        inputs=inputs,
        contacts=directory / "contacts.h5",
        series=directory / "leakage.h5",
        spread=press.composite_modulus * slope,
        most=min(press.hardness, press.composite_modulus),
        name=name,
    )


def seal_setup(scene: Seal, directory: Path) -> SealSetup:
    """The setup of the surface and the solids of a scene, with result files in a directory."""
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
    inputs = Inputs(heights=surface.heights, spacing=surface.spacing, settings=settings)
    return setup(surface, press, inputs, directory, scene.geometry.name)


def sealing(body: SealSetup, advance: Advance) -> dict[str, Threshold]:
    """The sealing thresholds by the names in ``SOUGHT``, from the file, the cache or computed, then kept in both."""
    stored = stored_series(body.series, body.inputs)
    if stored.thresholds:
        return dict(stored.thresholds)
    kept = kept_series(body.inputs, (), body.name)
    named = dict(kept.series.thresholds)
    if not named:
        begin = min(START_AREA / LIGHT_CONTACT_RATIO * body.spread, body.most / 2)
        by_case = thresholds(_pressed(body), begin, body.most, progress=advance)
        named = dict(zip(SOUGHT, by_case, strict=True))
        kept.save({}, named)
    save_series(body.series, body.inputs, LeakageSeries(rows=stored.rows, thresholds=named))
    return named


def chosen_loads(body: SealSetup, by_flow: dict[str, Threshold]) -> tuple[float, ...]:
    """The default loads, Pa, in increasing order.

    They reach from a contact area of 0.5 % to just above all thresholds in equal ratios, and include the largest loads
    at which the direct flows are open. Raises InputError for a flat surface.
    """
    if float(np.ptp(body.surface.heights)) == 0:
        raise InputError("geometry.surface: is flat and sealed under any load; give loads for its numbers")
    at, load = _pressed(body), FIRST_AREA / LIGHT_CONTACT_RATIO * body.spread
    for _ in range(4):
        area = at(load, None).area_fraction
        if 0.8 < area / FIRST_AREA < 1.25:
            break
        load *= min(max(FIRST_AREA / area, 0.1), 10.0)
    sealed = [threshold.sealed.load for threshold in by_flow.values() if threshold.sealed is not None]
    last = max(sealed) * LAST_LOAD_RATIO if len(sealed) == len(by_flow) else body.most
    last = max(min(last, body.most), load * LAST_LOAD_RATIO)
    opened = [by_flow[name].open for name in SOUGHT[:2]]
    more = {side.load for side in opened if side is not None and load < side.load < last}
    return tuple(sorted({*(float(one) for one in np.geomspace(load, last, DEFAULT_LOADS)), *more}))


def columns_of(scene: Seal, rows: Sequence[Row]) -> dict[str, tuple[str, list[float]]]:
    """The units and values, by name, of all numbers of the rows and of the leakage of the scene's liquid."""
    columns = {name: (UNITS.get(name, "1"), [getattr(row, name) for row in rows]) for name in asdict(rows[0])}
    for name in SOUGHT:
        columns[f"leakage_{name}"] = "kg/(m*s)", [leakage_of(scene, getattr(row, name)) for row in rows]
    return columns


def _pressed(body: SealSetup) -> Callable[[float, Contact | None], Contact]:
    def at(load: float, start: Contact | None) -> Contact:
        try:
            return body.press.at(load, start=start)
        except ConvergenceError as error:
            message = f"at {load / 1e6:.6g} MPa: {error}"
            raise ConvergenceError(message, outcome=error.outcome, iterations=error.iterations) from None

    return at


def solved(body: SealSetup, loads: tuple[float, ...], threads: int, advance: Advance) -> tuple[dict[float, Row], int]:
    """The rows by load, and the number of rows that were known already.

    Rows of the same surface, solids and loads are taken from the cache, where all are kept; their contacts are solved
    again if the file of contacts lacks them. Finished rows are saved even if the computation is interrupted.

    Parameters
    ----------
    body : the setup.
    loads : mean pressures, Pa.
    threads : number of gaps whose flow is solved at the same time.
    advance : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If a file was damaged, holds other data or cannot be written.
    ConvergenceError
        If the contact at a load does not converge; the files keep the loads below it.
    """
    stored = stored_series(body.series, body.inputs)
    pressed = finished(body.contacts, body.inputs)
    kept = kept_series(body.inputs, loads, body.name)
    pure = all(load in kept.series.rows for load in stored.rows)
    rows = dict(kept.series.rows)
    rows |= {load: row for load, row in stored.rows.items() if load in pressed or not body.stores(load)}
    known = sum(load in rows for load in loads)
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
        save_series(body.series, body.inputs, LeakageSeries(rows=rows, thresholds=stored.thresholds))
        if pure and len(rows) > len(kept.series.rows):
            kept.save({load: rows[load] for load in loads if load in rows}, {})
        saved = time.monotonic()

    def collect(limit: int) -> None:
        while len(pending) > limit:
            for future in wait(pending, return_when=FIRST_COMPLETED).done:
                rows[pending[future]] = future.result()
                del pending[future]
                advance(sum(load in rows for load in loads) / len(loads), f"{len(rows)} loads")
                save(SAVE_INTERVAL_S)

    try:
        with workers(threads) as pool:
            before: Contact | None = None
            flow = _flow_of(body)
            for load in (one for one in loads if one not in rows or (body.stores(one) and one not in pressed)):
                if load in pressed:
                    before = load_contact(body.contacts, load)
                else:
                    cpu = time.process_time()
                    before = _pressed(body)(load, before)
                    if body.stores(load):
                        fresh.append((row_of(before, time.process_time() - cpu), before))
                    advance(sum(one in rows for one in loads) / len(loads), f"contact at {load / 1e6:.4g} MPa")
                if load in rows:
                    save(SAVE_INTERVAL_S)
                    continue
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
    return {load: rows[load] for load in loads}, known


def _succeeded(future: Future[Row]) -> bool:
    return future.done() and not future.cancelled() and future.exception() is None


def _flow_of(body: SealSetup) -> Callable[[Contact], Row]:
    flat = float(np.ptp(body.surface.heights)) == 0
    apart = math.nan if flat else decay_lengths(autocorrelation(body.surface), body.surface.spacing).shortest

    def flow(contact: Contact) -> Row:
        cpu = time.thread_time()
        direct = direct_leakage(contact.gap, contact.spacing)
        cell = homogenized_leakage(contact.gap, contact.spacing)
        numbers = {}
        passages = (direct.along, direct.across, cell.along, cell.across)
        for number, (name, one) in enumerate(zip(SOUGHT, passages, strict=True)):
            passage = with_pixels(one, contact, number % 2)
            numbers[name] = passage.permeability
            numbers[f"{name}_uncertainty"] = passage.uncertainty
            numbers[f"{name}_sealed"] = float(passage.sealed)
        return Row(
            load=contact.load,
            area_fraction=contact.area_fraction,
            plastic_fraction=contact.plastic_fraction,
            mean_gap=contact.mean_gap,
            pressure_max=float(contact.pressure.max()),
            valley_depth=math.nan if flat else _valley_depth(contact, apart),
            cpu_s=time.thread_time() - cpu,
            **numbers,
        )

    return flow


def _valley_depth(contact: Contact, apart: float) -> float:
    """The valley depth Svm of the surface under load, m."""
    loaded = contact.loaded_heights
    if float(np.ptp(loaded)) == 0:
        return math.nan
    surface = Surface(heights=loaded, spacing=contact.spacing, periodic=True)
    return float(lowest_valleys(surface, apart).mean())
