"""Raimondi and Boyd's table of the full journal bearing."""

import math
from collections.abc import Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.result import Result
from roughfilm.validation.journal import CLEARANCE_RATIO, RADIUS, SPEED, THOROUGH, USUAL, journal, method, scaled
from roughfilm.validation.published import Answer, Row, Source
from roughfilm.validation.reading import half_digit, published

BAR = 0.01
"""Relative accuracy of an entry, to which half a unit of its last printed digit is added."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """Every row of the table."""
    table = published("raimondi_boyd")
    others = {
        (float(one["eccentricity_ratio [1]"]), float(one["width_over_diameter [1]"])): one
        for one in published("butenschoen")
    }
    rows: list[Row] = []
    for number, printed in enumerate(table):
        width, eccentricity = float(printed["width_over_diameter [1]"]), float(printed["eccentricity_ratio [1]"])
        progress(number / len(table), f"journal bearing, eccentricity {eccentricity:g}, B/D {width:g}")
        result = journal(eccentricity, width, THOROUGH if thorough else USUAL)
        for column, (words, unit, ours) in _numbers(result, width).items():
            text = printed[column]
            rows.append(
                Row(
                    case=f"ε = {eccentricity:g}, B/D = {width:g}",
                    series=f"B/D = {width:g}",
                    at=eccentricity,
                    quantity=words,
                    unit=unit,
                    published=float(text),
                    ours=ours.value,
                    uncertainty=ours.uncertainty,
                    bar=BAR * float(text) + half_digit(text),
                    evidence=_evidence(others, eccentricity, width, column, text),
                )
            )
    return Answer(rows=tuple(rows), remarks=_REMARKS)


def _evidence(
    others: Mapping[tuple[float, float], Mapping[str, str]], eccentricity: float, width: float, column: str, text: str
) -> str:
    """What Butenschön's table says of an entry that it contradicts; "" where it does not, or has no such number."""
    printed = others[eccentricity, width]
    known = {"S [1]": 1 / (2 * math.pi * float(printed["So [1]"])), "attitude [deg]": float(printed["attitude [deg]"])}
    if column not in known or abs(known[column] - float(text)) <= BAR * float(text) + half_digit(text):
        return ""
    return f"Butenschön's table gives {known[column]:.4g}"


def _numbers(result: Result, width: float) -> dict[str, tuple[str, str, Quantity]]:
    """Our numbers by the column of the table, with their names in words and units."""
    turns, length = SPEED / (2 * math.pi * RADIUS), 2 * RADIUS * width
    inlet, side = result["inlet_flow"], result["side_leakage"]
    area = 2 * RADIUS * length
    load, largest = result["load"], result["pressure_max"]
    return {
        "S [1]": ("Sommerfeld number S", "1", result["sommerfeld_number"]),
        "attitude [deg]": ("attitude angle", "deg", result["attitude_angle"]),
        "Q [1]": ("inlet flow Q/(R c N B)", "1", scaled(inlet, 1 / (RADIUS**2 * CLEARANCE_RATIO * turns * length))),
        "side_flow_over_Q [1]": ("side flow over inlet flow", "1", _ratio(side, inlet, 1.0)),
        "mean_over_largest_pressure [1]": ("mean over largest pressure", "1", _ratio(load, largest, 1 / area)),
    }


def _ratio(part: Quantity, whole: Quantity, factor: float) -> Quantity:
    """The ratio of two quantities times a factor; their relative uncertainties add in squares."""
    value = part.value / whole.value * factor
    relative = math.hypot(*((one.uncertainty or 0.0) / abs(one.value) for one in (part, whole)))
    return Quantity(value=value, unit="1", uncertainty=abs(value) * relative)


_REMARKS = (
    "The friction variable is left out: the table counts the shear of a full film also where the film is ruptured, "
    "while the model has streamers over the filled fraction of the gap.",
)

SOURCE = Source(
    name="raimondi_boyd",
    title="Raimondi and Boyd 1958: journal bearing",
    citation="A. A. Raimondi, J. Boyd, A Solution for the Finite Journal Bearing and its Application to Analysis and "
    "Design III, ASLE Transactions 1 (1958) 194-209",
    obtained="The table as textbooks of machine design reprint it, entered from memory, not compared with the paper; "
    "every flow agrees with ours within 0.5 %, so that slips are unlikely.",
    methods=(method(USUAL), method(THOROUGH)),
    bar="1 % and half a unit of the last printed digit; the values have two or three figures",
    abscissa="eccentricity ε",
    cost=(3.0, 11.0),
    answer=answer,
)
