"""Comparison of the numbers that Paper B prints with computed ones, and judgement of its claims."""

from dataclasses import dataclass

import numpy as np

from scripts.studies.paper_b.data import CONSTANT, DOUBLE, HALF, ORIGINAL, SOFT, CavitatingFilm, FilmDifference, PaperB
from scripts.studies.study import Claim, Judgement, claims_of, verdict


@dataclass(frozen=True, kw_only=True)
class PrintedNumber:
    """A relative difference that the paper prints, and the unit of its last digit."""

    figure: str
    case: str
    law: str
    quantity: str
    value: float
    digit: float


PRINTED = (
    PrintedNumber(figure="B.3", case="single", law=SOFT, quantity="p", value=0.12, digit=0.01),
    PrintedNumber(figure="B.5", case="twin", law=SOFT, quantity="p", value=0.15, digit=0.01),
    PrintedNumber(figure="B.6", case="flooded", law=ORIGINAL, quantity="θ", value=0.0061, digit=0.0001),
    PrintedNumber(figure="B.7", case="flooded", law=ORIGINAL, quantity="p", value=0.017, digit=0.001),
    PrintedNumber(figure="B.8", case="starved", law=ORIGINAL, quantity="θ", value=0.0064, digit=0.0001),
    PrintedNumber(figure="B.9", case="starved", law=ORIGINAL, quantity="p", value=0.074, digit=0.001),
    PrintedNumber(figure="B.9", case="starved", law=CONSTANT, quantity="p", value=0.0011, digit=0.0001),
    PrintedNumber(figure="B.10", case="starved, moduli", law=HALF, quantity="p", value=0.084, digit=0.001),
    PrintedNumber(figure="B.10", case="starved, moduli", law=DOUBLE, quantity="p", value=0.048, digit=0.001),
    PrintedNumber(figure="B.11", case="gap", law=ORIGINAL, quantity="p", value=0.22, digit=0.01),
    PrintedNumber(figure="B.11", case="gap", law=CONSTANT, quantity="p", value=0.0054, digit=0.0001),
    PrintedNumber(figure="B.12", case="gap, moduli", law=HALF, quantity="p", value=0.25, digit=0.01),
    PrintedNumber(figure="B.12", case="gap, moduli", law=DOUBLE, quantity="p", value=0.19, digit=0.01),
)
MAXIMA_APART = 1.6e3
"""Left maximum of the paper's Fig. B.5 minus its right one, Pa."""


@dataclass(frozen=True, kw_only=True)
class PrintedDifference:
    """A number of the paper, its computed value by both readings of Eq. B.11, and the difference between both grids."""

    printed: PrintedNumber
    reference: str
    found: FilmDifference
    grids_apart: float

    @property
    def agrees(self) -> tuple[bool, bool]:
        """Whether the printed number is the computed one to its last digit (rounded or cut off), by both readings."""
        digit = self.printed.digit
        return self._to_a_digit(self.found.integrals, digit), self._to_a_digit(self.found.between, digit)

    def _to_a_digit(self, value: float, digit: float) -> bool:
        return -0.5 * digit <= value - self.printed.value < digit


def rows(paper: PaperB) -> list[PrintedDifference]:
    """Return every printed number with the computed one."""
    made = []
    for printed in PRINTED:
        fine, coarse = paper.found[printed.case, printed.law, printed.quantity]
        apart = max(abs(fine.between - coarse.between), abs(fine.integrals - coarse.integrals))
        reference = next(iter(paper.films[printed.case]))
        made.append(PrintedDifference(printed=printed, reference=reference, found=fine, grids_apart=apart))
    return made


def maxima(film: CavitatingFilm) -> tuple[float, float]:
    """Return the greatest pressures of the left and the right half, Pa."""
    left = film.x <= film.x[-1] / 2
    return float(film.pressure[left].max()), float(film.pressure[~left].max())


def judge(paper: PaperB) -> list[Claim]:
    """Judge claims 8 to 10."""
    return claims_of(__file__, {8: laws_differ(paper), 9: constant_modulus(paper), 10: inlet_matters(paper)})


def laws_differ(paper: PaperB) -> Judgement:
    """Judge claim 8, on the loads with two lubricants."""
    said = {"flooded": 0.017, "starved": 0.074, "gap": 0.22}
    found = {case: paper.found[case, ORIGINAL, "p"][0] for case in said}
    near = [abs(found[case].integrals / value - 1) <= 0.1 for case, value in said.items()]
    ordered = bool((np.diff([one.integrals for one in found.values()]) > 0).all())
    flooded = found["flooded"]
    return (
        verdict(all(near), partly=any(near) and ordered),
        "loads with D&H-Orig and D&H-MNL differ by "
        + ", ".join(f"{100 * one.integrals:.3g} % ({case})" for case, one in found.items())
        + f"; the number of the paper for the flooded film is ∫|p* − p| dx / ∫p dx, here {100 * flooded.between:.3g} "
        f"%: excess upstream and deficit downstream add up in it, while they cancel in the load; for starved "
        f"films both agree",
    )


def constant_modulus(paper: PaperB) -> Judgement:
    """Judge claim 9, on the load with a constant bulk modulus."""
    summary, at_fifty = [], []
    for name, sweep in paper.sweeps.items():
        reach = []
        for part in (0.01, 0.02):
            peak = sweep.reach(CONSTANT, part)
            until = f"{sweep.peaks[-1] / 1e6:.0f} MPa at least" if peak is None else f"{peak / 1e6:.0f} MPa"
            reach.append(f"{100 * part:.0f} % up to {until}")
        at_fifty.append(sweep.at(CONSTANT, 50e6))
        summary.append(
            f"{name}: under {', under '.join(reach)}; {100 * at_fifty[-1]:.2g} % at 50 MPa and "
            f"{100 * sweep.at(CONSTANT, 100e6):.2g} % at 100 MPa "
            f"(D&H-Orig: {100 * sweep.at(ORIGINAL, 50e6):.2g} % and {100 * sweep.at(ORIGINAL, 100e6):.2g} %)"
        )
    return (
        verdict(max(at_fifty) < 0.02, partly=min(at_fifty) < 0.02),
        "loads with constant β against D&H-MNL at rising speed: " + "; ".join(summary),
    )


def inlet_matters(paper: PaperB) -> Judgement:
    """Judge claim 10, on the effect of the inlet pressure and of the pattern."""
    full = {name: film.load for (name, inlet), film in paper.patterns.items() if inlet == "pc"}
    pressed = {name: film.load for (name, inlet), film in paper.patterns.items() if inlet == "2 pc"}
    raised = {name: pressed[name] / load - 1 for name, load in full.items()}
    by_pattern = max(full.values()) / min(full.values()) >= 1.5
    by_pressure, somewhere = min(raised.values()) >= 0.1, max(raised.values()) >= 0.1
    loads = ", ".join(f"{name} {load / 1e3:.4g} kN/m" for name, load in full.items())
    rises = ", ".join(f"{name} {100 * rise:+.3g} %" for name, rise in raised.items())
    return (
        verdict(by_pattern and by_pressure, partly=by_pattern or somewhere),
        f"inlet at pc: {loads}, while the plain parallel gap has no load; inlet at 2 pc: {rises}, while the "
        "plain gap has 5 kN/m. The pattern decides: waves about the plain gap rupture the film, and the load grows "
        "with their length; pockets that end in a step do not, and the load does not depend on their length. For "
        "these the inlet pressure adds little more than in the plain gap",
    )
