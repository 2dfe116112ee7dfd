"""The films of Paper B on two grids, and the differences between lubricants."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.quantities import film_ends
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.evaluation.filling import density_ratio
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.scene import load_entries, read_scene
from scripts.studies.study import Advance

SCENES = Path(__file__).parent / "scenes"
CELLS = 16384
"""Cells of the finer grid; the coarser one has half as many."""

AMBIENT = 1e5
"""Pressure of cavitation, pc in the paper, Pa absolute."""

MNL, ORIGINAL, CONSTANT = "D&H-MNL", "D&H-Orig", "Const β, MNL"
SOFT, HALF, DOUBLE = "β = 0.069 GPa", "β = 3.34/2 GPa", "β = 3.34·2 GPa"
ROUNDED, COARSE = "β = 3.34 GPa", "β = 3.3 GPa"
C1, C2 = 2.22, 1.66
MODULUS = C1 / (C2 - 1)
"""Bulk modulus of D&H-MNL at pc: dp/dθ at θ = 1, GPa."""


def constant(modulus: float) -> dict[str, Any]:
    """Return the entries of the law p = β ln θ, with β in GPa."""
    return {"law": "constant_bulk_modulus", "bulk_modulus": f"{modulus!r} GPa"}


LAWS: dict[str, dict[str, Any]] = {
    MNL: {"law": "dowson_higginson", "c1": f"{C1} GPa", "c2": C2},
    ORIGINAL: {"law": "dowson_higginson", "c1": "0.59 GPa", "c2": 1.34},
    CONSTANT: constant(MODULUS),
    SOFT: constant(0.069),
    HALF: constant(3.34 / 2),
    DOUBLE: constant(3.34 * 2),
    ROUNDED: constant(3.34),
    COARSE: constant(3.3),
}

Inlet = Mapping[str, Any]
FULL: Inlet = {"pressure": "0 MPa"}
PRESSED: Inlet = {"pressure": f"{AMBIENT!r} Pa"}


@dataclass(frozen=True, kw_only=True)
class LubricantCase:
    """A film whose solutions for several lubricants are compared with that for the first one."""

    scene: str
    inlet: Inlet
    laws: tuple[str, ...]


FLOODED: Inlet = {"theta": 1}
STARVED: Inlet = {"theta": 0.55}
GAP_STARVED: Inlet = {"theta": 0.85}
DENSE: Inlet = {"theta": 1.0001}
CASES = {
    "single": LubricantCase(scene="single_parabola", inlet=DENSE, laws=(MNL, SOFT)),
    "twin": LubricantCase(scene="twin_parabola", inlet=DENSE, laws=(MNL, SOFT)),
    "flooded": LubricantCase(scene="thin_parabola", inlet=FLOODED, laws=(MNL, ORIGINAL)),
    "starved": LubricantCase(scene="thin_parabola", inlet=STARVED, laws=(MNL, ORIGINAL, CONSTANT, ROUNDED, COARSE)),
    "starved, moduli": LubricantCase(scene="thin_parabola", inlet=STARVED, laws=(CONSTANT, HALF, DOUBLE)),
    "gap": LubricantCase(scene="converging_gap", inlet=GAP_STARVED, laws=(MNL, ORIGINAL, CONSTANT, ROUNDED, COARSE)),
    "gap, moduli": LubricantCase(scene="converging_gap", inlet=GAP_STARVED, laws=(CONSTANT, HALF, DOUBLE)),
}

READINGS: dict[str, Inlet] = {
    "θ = 1.0001 for each law": DENSE,
    "p = 6.9 kPa for both": {"pressure": "6.9 kPa"},
    "p = 336 kPa for both": {"pressure": "336 kPa"},
    "θ = 1, flooded": FLOODED,
}
"""Possible inlets of Figs. B.3 and B.5, as θ = 1.0001 means 6.9 kPa with one law and 336 kPa with the other."""

PATTERNS = {
    "sinusoidal, 10 mm": "sinusoidal_long",
    "sinusoidal, 5 mm": "sinusoidal_short",
    "cos², 10 mm": "squared_cosine_long",
    "cos², 5 mm": "squared_cosine_short",
}
INLETS = {"pc": FULL, "2 pc": PRESSED}

STEPS = 33
RANGES = {
    "thin parabola, flooded": ("thin_parabola", FLOODED, (0.005, 5.0)),
    "thin parabola, θ = 0.55": ("thin_parabola", STARVED, (0.005, 5.0)),
    "converging gap, θ = 0.85": ("converging_gap", GAP_STARVED, (0.005, 5.0)),
}
"""Scene, inlet and range of the sliding speed (m/s); the greatest pressure is about 1 MPa to several hundred MPa."""


@dataclass(frozen=True, kw_only=True)
class CavitatingFilm:
    """The solution of a film at its n nodes; arrays have the shape (n,).

    Attributes
    ----------
    x, thickness : position and film thickness, m.
    pressure : pressure above pc, Pa.
    theta : density ratio θ.
    weights : weights of the integral over the length, m.
    start, rupture : start of the first full film, and end of the last one, x/L.
    """

    x: Array
    thickness: Array
    pressure: Array
    theta: Array
    weights: Array
    start: float
    rupture: float

    @property
    def load(self) -> float:
        """The load ∫ p dx per width, N/m."""
        return float(self.weights @ self.pressure)

    @property
    def peak(self) -> float:
        """The greatest pressure, Pa."""
        return float(self.pressure.max())


@dataclass(frozen=True, kw_only=True)
class FilmDifference:
    """Relative difference of ψ to a reference: that of the integrals, and the integral of |ψ - ψ_reference|."""

    integrals: float
    between: float


def difference(values: Array, reference: Array, weights: Array) -> FilmDifference:
    """Return the difference of Eq. B.11 in its two readings: |∫(ψ − ψr) dx|/∫ψr dx and ∫|ψ − ψr| dx/∫ψr dx."""
    whole = float(weights @ reference)
    apart = values - reference
    return FilmDifference(integrals=abs(float(weights @ apart)) / whole, between=float(weights @ np.abs(apart)) / whole)


@dataclass(frozen=True, kw_only=True)
class SpeedSweep:
    """One film at rising speeds (m/s): greatest pressures with D&H-MNL (Pa), and relative load differences by law."""

    speeds: Array
    peaks: Array
    differences: dict[str, Array]

    def reach(self, law: str, part: float) -> float | None:
        """Return the greatest pressure, Pa, up to which the load differs by less than the fraction ``part``.

        It is None if the load differs by less at all speeds, and 0 if it differs by more at the first speed.
        """
        values = self.differences[law]
        above = np.flatnonzero(values >= part)
        if not above.size:
            return None
        first = int(above[0])
        if first == 0:
            return 0.0
        pair = slice(first - 1, first + 1)
        return float(np.exp(np.interp(np.log(part), np.log(values[pair]), np.log(self.peaks[pair]))))

    def at(self, law: str, peak: float) -> float:
        """Return the relative load difference at the greatest pressure ``peak``, Pa."""
        return float(np.interp(peak, self.peaks, self.differences[law]))


@dataclass(frozen=True, kw_only=True)
class PaperB:
    """All data of the page; ``coarser`` and ``coarser_patterns`` are solutions on half as many cells."""

    cells: int
    films: dict[str, dict[str, CavitatingFilm]]
    coarser: dict[str, dict[str, CavitatingFilm]]
    readings: dict[tuple[str, str], dict[str, CavitatingFilm]]
    patterns: dict[tuple[str, str], CavitatingFilm]
    coarser_patterns: dict[tuple[str, str], CavitatingFilm]
    sweeps: dict[str, SpeedSweep]

    @cached_property
    def found(self) -> dict[tuple[str, str, str], tuple[FilmDifference, FilmDifference]]:
        """The differences to the first law of each case on the fine and coarse grid, by case, law and "p" or "θ"."""
        return {
            (case, law, quantity): (
                _apart(self.films[case], law, quantity),
                _apart(self.coarser[case], law, quantity),
            )
            for case, entry in CASES.items()
            for law in entry.laws[1:]
            for quantity in ("p", "θ")
        }


def _apart(films: dict[str, CavitatingFilm], law: str, quantity: str) -> FilmDifference:
    name = {"p": "pressure", "θ": "theta"}[quantity]
    reference = next(iter(films.values()))
    return difference(getattr(films[law], name), getattr(reference, name), reference.weights)


def bearing(scene: str, law: str, inlet: Inlet, speed: float | None = None) -> Bearing:
    """Return a scene of the paper with another lubricant, another inlet and, if given, another speed, m/s."""
    entries = load_entries(SCENES / f"{scene}.toml")
    entries["lubricant"]["compressibility"] = LAWS[law]
    entries["boundary"]["inlet"] = dict(inlet)
    if speed is not None:
        entries["motion"]["speed"] = f"{speed!r} m/s"
    made = read_scene(entries)
    assert isinstance(made, Bearing)
    return made


def film(scene: Bearing, cells: int) -> CavitatingFilm:
    """Return the solution of the film of a scene on ``cells`` cells along the sliding."""
    found = solve(scene.problem(), (cells, 1))
    start, rupture = film_ends(found, 0)
    return CavitatingFilm(
        x=found.grid.x,
        thickness=found.faces.thickness[:, 0],
        pressure=found.state.pressure[:, 0],
        theta=density_ratio(found)[:, 0],
        weights=found.grid.areas[:, 0],
        start=start,
        rupture=rupture,
    )


def sweep(scene: str, inlet: Inlet, speeds: Array, cells: int) -> SpeedSweep:
    """Solve one film at rising speeds (m/s) with D&H-MNL and with two other laws."""
    peaks, differences = np.empty(speeds.size), {law: np.empty(speeds.size) for law in (CONSTANT, ORIGINAL)}
    for i, speed in enumerate(speeds):
        reference = film(bearing(scene, MNL, inlet, float(speed)), cells)
        peaks[i] = reference.peak
        for law, values in differences.items():
            values[i] = abs(film(bearing(scene, law, inlet, float(speed)), cells).load / reference.load - 1)
    return SpeedSweep(speeds=speeds, peaks=peaks, differences=differences)


PARTS = 2 * len(CASES) + len(READINGS) + 1 + len(RANGES)


def compute(advance: Advance, *, cells: int = CELLS, steps: int = STEPS) -> PaperB:
    """Solve every film; ``advance`` is called ``PARTS`` times."""
    sizes = (cells, cells // 2)
    grids: list[dict[str, dict[str, CavitatingFilm]]] = []
    for size in sizes:
        films = {}
        for name, case in CASES.items():
            advance(f"{name}, {size} cells")
            films[name] = {law: film(bearing(case.scene, law, case.inlet), size) for law in case.laws}
        grids.append(films)
    readings = {}
    for reading, inlet in READINGS.items():
        advance(reading)
        for name in ("single", "twin"):
            case = CASES[name]
            readings[name, reading] = {law: film(bearing(case.scene, law, inlet), cells) for law in case.laws}
    advance("patterns")
    patterns = [
        {
            (name, label): film(bearing(scene, MNL, inlet), size)
            for name, scene in PATTERNS.items()
            for label, inlet in INLETS.items()
        }
        for size in sizes
    ]
    sweeps = {}
    for name, (scene, inlet, ends) in RANGES.items():
        advance(f"speeds, {name}")
        sweeps[name] = sweep(scene, inlet, np.geomspace(*ends, steps), cells // 4)
    return PaperB(
        cells=cells,
        films=grids[0],
        coarser=grids[1],
        readings=readings,
        patterns=patterns[0],
        coarser_patterns=patterns[1],
        sweeps=sweeps,
    )
