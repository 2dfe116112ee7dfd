"""Butenschön's table of the full journal bearing of finite width that turns under a steady load."""

import math
from collections.abc import Mapping
from statistics import median

from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.journal import (
    CLEARANCE_RATIO,
    RADIUS,
    SPEED,
    THOROUGH,
    USUAL,
    journal,
    method,
    scaled,
    sommerfeld_of_din,
)
from roughfilm.validation.published import Answer, Row, Source, Study, Verdict
from roughfilm.validation.reading import half_digit, published

BAR = 0.005
"""Relative accuracy of an entry, to which half a unit of its last printed digit is added."""

QUANTITIES = {"So": ("Sommerfeld number So", "1"), "attitude": ("attitude angle", "deg"), "Q": ("side flow Q", "1")}
"""The quantities by the name of their column, with their names in words and units."""

SEARCHED = 3
"""Number of entries on either side from which an entry is interpolated."""

Entries = Mapping[tuple[float, float], Mapping[str, str]]
"""The printed rows by eccentricity and by width over diameter."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """Every row of the table, with the entries that the rest of the table contradicts."""
    table = {(float(one["eccentricity_ratio [1]"]), float(one["width_over_diameter [1]"])): one for one in _table()}
    rows: list[Row] = []
    for number, ((eccentricity, width), printed) in enumerate(table.items()):
        progress(number / len(table), f"journal bearing, eccentricity {eccentricity:g}, B/D {width:.3g}")
        rows += _rows(table, eccentricity, width, printed, thorough=thorough)
    return Answer(rows=tuple(rows), remarks=_remarks(rows), studies=(_misprints(table, rows),))


def _table() -> list[dict[str, str]]:
    return published("butenschoen")


def _rows(
    table: Entries, eccentricity: float, width: float, printed: Mapping[str, str], *, thorough: bool
) -> list[Row]:
    result = journal(eccentricity, width, THOROUGH if thorough else USUAL)
    flow_unit = RADIUS**3 * CLEARANCE_RATIO * SPEED / RADIUS
    ours = {
        "So": sommerfeld_of_din(result, width),
        "attitude": result["attitude_angle"],
        "Q": scaled(result["side_leakage"], 1 / flow_unit),
    }
    suspects = printed["suspect"].split()
    rows = []
    for name, (words, unit) in QUANTITIES.items():
        text = printed[f"{name} [{unit}]"]
        value = float(text)
        rows.append(
            Row(
                case=f"ε = {eccentricity:g}, B/D = {width:.3g}",
                series=f"B/D = {width:.3g}",
                at=eccentricity,
                quantity=words,
                unit=unit,
                published=value,
                ours=ours[name].value,
                uncertainty=ours[name].uncertainty,
                bar=BAR * value + half_digit(text),
                evidence=_evidence(table, eccentricity, width, name) if name in suspects else "",
            )
        )
    return rows


def _evidence(table: Entries, eccentricity: float, width: float, name: str) -> str:
    """What the rest of the table says of an entry; "" at its corners, where it says nothing."""
    column = f"{name} [{QUANTITIES[name][1]}]"
    likely = interpolated(table, eccentricity, width, column)
    return "" if likely is None else f"the other entries of the table, interpolated, give {likely:.4g}"


def interpolated(table: Entries, eccentricity: float, width: float, column: str) -> float | None:
    """An entry interpolated from the others: ln y by polynomials in ln(B/D), or, at the ends of these, in ln(1 − ε).

    None at the corners of the table, where neither has entries on both sides.
    """
    widths = sorted({one for _, one in table})
    eccentricities = sorted({one for one, _ in table})
    if widths[0] < width < widths[-1]:
        known = {math.log(one): float(table[eccentricity, one][column]) for one in widths if one != width}
        return _between(known, math.log(width))
    if eccentricities[0] < eccentricity < eccentricities[-1]:
        others = (one for one in eccentricities if one != eccentricity)
        known = {math.log1p(-one): float(table[one, width][column]) for one in others}
        return _between(known, math.log1p(-eccentricity))
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


def _remarks(rows: list[Row]) -> tuple[str, ...]:
    by_quantity = {
        row.quantity: [abs(one.relative or 0) for one in rows if one.quantity == row.quantity] for row in rows
    }
    medians = ", ".join(f"{100 * median(values):.2g} % ({words})" for words, values in by_quantity.items())
    return (f"The median difference is {medians}.",)


def _misprints(table: Entries, rows: list[Row]) -> Study:
    """The entries that are marked as misprints or lie outside of the bar."""
    entries = [(key, name) for key in table for name in QUANTITIES]
    chosen = [
        (row, interpolated(table, *key, f"{name} [{row.unit}]"))
        for (key, name), row in zip(entries, rows, strict=True)
        if name in table[key]["suspect"].split() or row.verdict is not Verdict.WITHIN
    ]
    return Study(
        title="Entries that are suspected as misprints, and entries outside of the bar",
        columns=("entry", "quantity", "printed", "ours", "difference", "interpolated in the table"),
        cells=tuple(
            (
                row.case,
                row.quantity,
                f"{row.published:g}",
                f"{row.ours:.4g} ± {row.uncertainty or 0:.1g}",
                f"{100 * (row.relative or 0):+.2f} %",
                "a corner" if likely is None else f"{likely:.4g}",
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
    bar="0.5 % and half a unit of the last printed digit; the values have 3 to 6 figures",
    abscissa="eccentricity ε",
    cost=(19.0, 92.0),
    answer=answer,
)
