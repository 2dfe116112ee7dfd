"""Surfaces of Paper F pressed until they seal: thresholds, area and leakage, each surface kept in its own file."""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import Solid, composite_modulus
from roughfilm.contact.parameters.peaks import lowest_valleys
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.seal.leakage.direct import direct_leakage
from roughfilm.rom.seal.leakage.percolation import thresholds
from scripts.studies.paper_f.surfaces import Made, Numbers, numbers_of
from scripts.studies.study import kept

MODULUS = composite_modulus(Solid(modulus=10e6, poisson=0.5), Solid(modulus=210e9, poisson=0.3))
"""E*, Pa, of the elastomer against steel."""

PARTS = (*np.geomspace(1e-4, 0.3, 9).tolist(), 0.45, 0.6, 0.75, 0.85, 0.92, 0.97)
"""Loads at which leakage is computed, divided by the load that seals both directions."""

THRESHOLD_PRECISION = 2e-3
"""Relative difference between the last load with an open path and the first without."""

CONTACT_TOLERANCE = 1e-6
"""Tolerance of the contact solver, see ``Press.at``."""

OFFSET = 1e-8
"""Height of the slit that the source adds where the contact is closed, m."""

FIRST_LOAD, MAX_LOAD = 0.3, 10.0
"""First and last load of the search for sealing, in units of E* g′."""


CODE_DIGEST = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]
"""Digest of this file: kept surfaces are those of the same code."""


@dataclass(frozen=True, kw_only=True)
class Pressed:
    """One surface from the first touch until it is sealed; arrays are (loads, 2) where a direction counts.

    Attributes
    ----------
    size : m, along x and y.
    loads : W, Pa.
    area : real over nominal area, corrected for whole pixels.
    mean_gap : m.
    valley : Svm of the surface under load, m.
    flow : A₁₁ and A₂₂ of the cell, m³: HNS.
    direct : K between two reservoirs one period apart, in x and in y, m³: DNS.
    offset : as ``flow``, with 10 nm added everywhere; nan where the solver failed.
    threshold : the least load that leaves no path from end to end, Pa, in x and in y; sides are joined.
    round_threshold : the least load that leaves none round the cell, as ``flow`` has it; never above the other.
    sealed_area, round_area : area at ``threshold`` and at ``round_threshold``.
    sealed_offset : as ``offset`` at ``threshold``, in its direction, m³.
    spots : contact at ``threshold``, shape (2, nx, ny).
    """

    family: str
    seed: int
    size: tuple[float, float]
    numbers: Numbers
    loads: Array
    area: Array
    mean_gap: Array
    valley: Array
    flow: Array
    direct: Array
    offset: Array
    threshold: Array
    round_threshold: Array
    sealed_area: Array
    round_area: Array
    sealed_offset: Array
    spots: Array

    @property
    def name(self) -> str:
        """Family and seed."""
        return f"{self.family} {self.seed}"


class Series:
    """A surface under many loads; each contact is solved once, from the solution at the nearest load."""

    def __init__(self, heights: Array, spacing: tuple[float, float]) -> None:
        self._press = Press(heights, spacing, MODULUS)
        self._known: dict[float, Contact] = {}

    def at(self, load: float, _start: Contact | None = None) -> Contact:
        """Return the contact under a load, Pa."""
        if load not in self._known:
            nearest = min(self._known, key=lambda one: abs(np.log(one / load)), default=None)
            start = None if nearest is None else self._known[nearest]
            self._known[load] = self._press.at(load, tolerance=CONTACT_TOLERANCE, start=start)
        return self._known[load]


def sealed_contacts(series: Series, slope: float) -> list[Contact]:
    """Contacts at the least loads that seal a surface of a rms slope: between ends in x and y, and round the cell.

    Raises InputError where a path stays open up to ``MAX_LOAD``.
    """
    loads = (FIRST_LOAD * MODULUS * slope, MAX_LOAD * MODULUS * slope)
    sealed = [one.sealed for one in thresholds(series.at, *loads, precision=THRESHOLD_PRECISION)]
    if None in sealed:
        raise InputError(f"surface: stays open up to {loads[1]:.3g} Pa; press a surface whose valleys close")
    return [series.at(one.load) for one in sealed if one is not None]


def press(made: Made, parts: Sequence[float] = PARTS) -> Pressed:
    """Return thresholds, and area, gap and leakage at fractions of the greater threshold."""
    surface, numbers = made.surface, numbers_of(made.surface)
    series = Series(surface.heights, surface.spacing)
    *ends, first_round, second_round = sealed_contacts(series, numbers.slope)
    loads = [part * max(one.load for one in ends) for part in parts]
    contacts = [series.at(load) for load in loads]
    flows = [flow_factors(one.gap, surface.spacing) for one in contacts]

    def valley(contact: Contact) -> float:
        return float(lowest_valleys(surface.with_heights(contact.loaded_heights), numbers.decay).mean())

    return Pressed(
        family=made.family,
        seed=made.seed,
        size=surface.size,
        numbers=numbers,
        loads=np.array(loads),
        area=np.array([one.area_fraction for one in contacts]),
        mean_gap=np.array([one.mean_gap for one in contacts]),
        valley=np.array([valley(one) for one in contacts]),
        flow=np.array([np.diag(one.factors.pressure) for one in flows]),
        direct=np.array([direct_leakage(one.gap, surface.spacing).permeability for one in contacts]),
        offset=np.array([_with_offset(one) for one in contacts]),
        threshold=np.array([one.load for one in ends]),
        round_threshold=np.array([first_round.load, second_round.load]),
        sealed_area=np.array([one.area_fraction for one in ends]),
        round_area=np.array([first_round.area_fraction, second_round.area_fraction]),
        sealed_offset=np.array([_with_offset(one)[i] for i, one in enumerate(ends)]),
        spots=np.array([one.in_contact for one in ends]),
    )


def _with_offset(contact: Contact) -> Array:
    try:
        return np.diag(flow_factors(contact.gap, contact.spacing, offset=OFFSET).factors.pressure)
    except ConvergenceError:
        return np.full(2, np.nan)


def press_all(
    surfaces: Sequence[Made],
    folder: Path | None,
    advance: Callable[[str], None],
    parts: Sequence[float] = PARTS,
) -> list[Pressed]:
    """Press each surface, or read it from the folder where it is kept; ``advance`` is called for each."""
    pressed = []
    for one in surfaces:
        advance(one.name)
        settings = {
            "own": CODE_DIGEST,
            "modulus": MODULUS,
            "parts": list(parts),
            "near": THRESHOLD_PRECISION,
            "offset": OFFSET,
        }
        inputs = Inputs(heights=one.surface.heights, spacing=one.surface.spacing, settings=settings)
        path = folder and folder / f"{one.name.replace(' ', '_')}.json"
        pressed.append(_restored(kept(path, {"digest": inputs.digest}, partial(_stored, one, parts))))
    return pressed


def _stored(made: Made, parts: Sequence[float]) -> dict[str, Any]:
    pressed = press(made, parts)
    spots = [np.packbits(one).tobytes().hex() for one in pressed.spots]
    return {**vars(pressed), "spots": spots, "nodes": pressed.spots.shape[1:]}


def _restored(entries: dict[str, Any]) -> Pressed:
    nx, ny = entries.pop("nodes")
    bits = [np.unpackbits(np.frombuffer(bytes.fromhex(one), dtype=np.uint8)) for one in entries.pop("spots")]
    spots = np.array([one[: nx * ny].reshape(nx, ny) for one in bits], dtype=bool)
    numbers = Numbers(**entries.pop("numbers"))
    family, seed, (length, width) = entries.pop("family"), entries.pop("seed"), entries.pop("size")
    arrays = {name: np.array(values, dtype=float) for name, values in entries.items()}
    return Pressed(family=family, seed=seed, size=(length, width), numbers=numbers, spots=spots, **arrays)
