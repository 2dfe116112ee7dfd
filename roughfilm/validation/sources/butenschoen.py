"""Butenschön's table of the full journal bearing of finite width that turns under a steady load."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from statistics import median

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.journal import THOROUGH, USUAL, journal, method, side_flow_of_din, sommerfeld_of_din
from roughfilm.validation.obstacle import ObstacleFilm, journal_by_obstacle
from roughfilm.validation.published import Answer, Row, Source, Study, Verdict
from roughfilm.validation.reading import half_digit, published

BAR = 0.003
"""Relative accuracy of an entry, to which half a unit of its last printed digit is added."""

QUANTITIES = {"So": ("Sommerfeld number So", "1"), "attitude": ("attitude angle", "deg"), "Q": ("side flow Q", "1")}
"""The quantities by the name of their column, with their names in words and units."""

SEARCHED = 3
"""Number of entries on either side from which an entry is interpolated."""

SECOND_CELLS = ((32, 16), (64, 32))
"""Cells of the second method, over the circumference or half of it and over half of the width; extrapolated."""

Entries = Mapping[tuple[float, float], Mapping[str, str]]
"""The printed rows by eccentricity and by width over diameter."""

Ours = Callable[[float, float], Mapping[str, Quantity]]
"""ours(eccentricity, width over diameter), our quantities by the name of their column."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """Every row of the table, with the entries that the rest of the table or a second method contradicts."""
    grids = THOROUGH if thorough else USUAL

    def ours(eccentricity: float, width: float) -> Mapping[str, Quantity]:
        result = journal(eccentricity, width, grids)
        return {
            "So": sommerfeld_of_din(result, width),
            "attitude": result["attitude_angle"],
            "Q": side_flow_of_din(result),
        }

    return answered("butenschoen", ours, progress, turns=True)


def answered(name: str, ours: Ours, progress: Progress, *, turns: bool) -> Answer:
    """The answer to a table of eccentricities and widths.

    Parameters
    ----------
    name : name of the table.
    ours : ours(eccentricity, width over diameter).
    turns : whether the shaft turns, and does not move straight at the bore.
    """
    printed = published(name)
    table = {(float(one["eccentricity_ratio [1]"]), float(one["width_over_diameter [1]"])): one for one in printed}
    rows: dict[tuple[float, float, str], Row] = {}
    for number, (eccentricity, width) in enumerate(table):
        progress(number / len(table), f"journal bearing, eccentricity {eccentricity:g}, B/D {width:.3g}")
        found, second = ours(eccentricity, width), None
        for quantity, (words, unit) in QUANTITIES.items():
            if quantity not in found:
                continue
            text = table[eccentricity, width][f"{quantity} [{unit}]"]
            row = Row(
                case=f"ε = {eccentricity:g}, B/D = {width:.3g}",
                series=f"B/D = {width:.3g}",
                at=eccentricity,
                quantity=words,
                unit=unit,
                published=float(text),
                ours=found[quantity].value,
                uncertainty=found[quantity].uncertainty,
                bar=BAR * float(text) + half_digit(text),
            )
            if row.verdict is not Verdict.WITHIN:
                second = second or _by_second_method(eccentricity, width, turns=turns)
                row = replace(row, evidence=_evidence(table, (eccentricity, width), quantity, row, second))
            rows[eccentricity, width, quantity] = row
    every = tuple(rows.values())
    return Answer(rows=every, remarks=_remarks(every), studies=(_contradicted(table, rows),))


def _by_second_method(eccentricity: float, width: float, *, turns: bool) -> dict[str, float]:
    """The quantities by finite volumes without common code, extrapolated from two grids at second order."""
    coarse, fine = (journal_by_obstacle(eccentricity, width, cells, turns=turns) for cells in SECOND_CELLS)

    def limit(of: Callable[[ObstacleFilm], float]) -> float:
        return (4 * of(fine) - of(coarse)) / 3

    return {
        "So": limit(lambda film: film.sommerfeld),
        "attitude": limit(lambda film: film.attitude),
        "Q": limit(lambda film: film.side_flow),
    }


def _evidence(table: Entries, key: tuple[float, float], quantity: str, row: Row, second: Mapping[str, float]) -> str:
    """What the rest of the table and a second method give for an entry, as far as they contradict it."""
    found = []
    likely = interpolated(table, *key, f"{quantity} [{row.unit}]")
    if quantity in table[key]["suspect"].split() and likely is not None:
        found.append(f"the other entries of the table, interpolated, give {likely:.4g}")
    if abs(second[quantity] - row.ours) < abs(second[quantity] - row.published) / 2:
        found.append(f"finite volumes without common code, extrapolated, give {second[quantity]:.5g}")
    return "; ".join(found)


def interpolated(table: Entries, eccentricity: float, width: float, column: str) -> float | None:
    """An entry interpolated from the others: ln y by polynomials in ln(B/D), or, at the ends of these, in ln(1 − ε).

    None at the corners of the table, where neither has entries on both sides.
    """
    others = {key: float(printed[column]) for key, printed in table.items() if key != (eccentricity, width)}
    over_widths = {math.log(one): value for (at, one), value in others.items() if at == eccentricity}
    over_eccentricities = {math.log1p(-at): value for (at, one), value in others.items() if one == width}
    for known, at in ((over_widths, math.log(width)), (over_eccentricities, math.log1p(-eccentricity))):
        if known and min(known) < at < max(known):
            return _between(known, at)
    return None


def _between(known: Mapping[float, float], at: float) -> float:
    """The value at a place by Lagrange's polynomial of ln y through the nearest places on both sides."""
    below = sorted(place for place in known if place < at)[-SEARCHED:]
    above = sorted(place for place in known if place > at)[:SEARCHED]
    places = below + above
    total = 0.0
    for place in places:
        weight = math.prod((at - other) / (place - other) for other in places if other != place)
        total += weight * math.log(known[place])
    return math.exp(total)


def _remarks(rows: tuple[Row, ...]) -> tuple[str, ...]:
    by_quantity = {
        row.quantity: [abs(one.relative or 0) for one in rows if one.quantity == row.quantity] for row in rows
    }
    medians = ", ".join(f"{100 * median(values):.2g} % ({words})" for words, values in by_quantity.items())
    return (f"The median difference is {medians}.",)


def _contradicted(table: Entries, rows: Mapping[tuple[float, float, str], Row]) -> Study:
    """The entries that are marked as misprints or lie outside of the bar."""
    chosen = [
        (row, interpolated(table, eccentricity, width, f"{quantity} [{row.unit}]"))
        for (eccentricity, width, quantity), row in rows.items()
        if quantity in table[eccentricity, width]["suspect"].split() or row.verdict is not Verdict.WITHIN
    ]
    return Study(
        title="Entries that are suspected as misprints, and entries outside of the bar",
        columns=("entry", "quantity", "printed", "ours", "difference", "interpolated in the table", "evidence"),
        cells=tuple(
            (
                row.case,
                row.quantity,
                f"{row.published:g}",
                f"{row.ours:.4g} ± {row.uncertainty or 0:.1g}",
                f"{100 * (row.relative or 0):+.2f} %",
                "a corner" if likely is None else f"{likely:.4g}",
                row.evidence or "within the bar",
            )
            for row, likely in chosen
        ),
    )


SOURCE = Source(
    name="butenschoen",
    title="Butenschön 1976: journal bearing, 14 × 8 cases",
    citation="H. J. Butenschön, Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter instationärer "
    "Belastung, thesis, Karlsruhe 1976, the basis of DIN 31652",
    obtained="Read in the tests of mboct-mbdyn-pkg (GPL-3), not in the thesis; entries stand as found there.",
    methods=(method(USUAL), method(THOROUGH)),
    bar="0.3 % and half a unit of the last printed digit; the values have 3 to 6 figures",
    abscissa="eccentricity ε",
    cost=(19.0, 92.0),
    answer=answer,
)
