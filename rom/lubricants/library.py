"""Liquids by name: ISO and SAE grades of mineral oils, water and water–glycol, with the sources of their numbers."""

import difflib
import math
import re
import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.lubricants.thermal.index import kinematic_viscosity_100
from roughfilm.rom.lubricants.thermal.law import LIQUID, ZERO_CELSIUS, celsius
from roughfilm.rom.lubricants.thermal.walther import GRADES

DATA = Path(__file__).with_name("library.toml")

VISCOSITY_GRAVITY = 0.815
"""Viscosity–gravity constant of the mineral oils, about 0.80 for paraffinic ones; 0.01 more is 1 % of the density."""

EXPANSION = 0.6278
"""Coefficient of thermal expansion of lubricating oils times their density, both at 15 °C, kg/(m³ K): ASTM D1250."""

REYN = 6894.757293168
"""1 lbf s/in² in Pa s."""

SAE_RANGE = (10.0, 140.0)
"""Temperatures of the chart to which the viscosities of SAE grades are fitted, °C."""

OTHERS = "give thermoviscosity, density, heat_capacity and conductivity of its data sheet in place of oil"
"""The remedy for a liquid that is not in the library."""

MULTIGRADE = re.compile(r"(?:sae)?(?:0|5|10|15|20|25)w(?:\d\d)?")
"""The names of SAE grades for winter, without spaces and dashes."""

INDEX = 95.0
"""Viscosity index of the ISO grades."""


@cache
def _data() -> Mapping[str, list[dict[str, Any]]]:
    return tomllib.loads(DATA.read_text(encoding="utf-8"))


def _iso_grades() -> dict[str, int]:
    """The ISO grades that have a viscosity index, by their names."""
    return {f"ISO VG {grade}": grade for grade, warm in GRADES.items() if kinematic_viscosity_100(warm, INDEX)}


@cache
def sources() -> Mapping[str, str]:
    """The source of the numbers of each liquid, by its name.

    Examples
    --------
    >>> sources()["water"]
    'IAPWS SR6-08(2011), Revised Supplementary Release on Properties of Liquid Water at 0.1 MPa'
    """
    mineral = "density ASTM D2501, expansion ASTM D1250, heat Cragoe 1929 (NBS Miscellaneous Publication 97)"
    return {
        **dict.fromkeys(_iso_grades(), f"viscosity ISO 3448 and ASTM D2270; {mineral}"),
        **{one["name"]: f"viscosity {one['source']}; {mineral}" for one in _data()["sae"]},
        **{one["name"]: one["source"] for one in _data()["liquid"]},
    }


def _plain(name: str) -> str:
    return re.sub(r"[\s_-]+", "", name).lower()


def found_name(name: object) -> str:
    """The name of a liquid in the library, for one that differs in capitals and spaces alone, or lacks "ISO".

    Raises
    ------
    ValueError
        If there is no such liquid, with near names.

    Examples
    --------
    >>> found_name("iso vg32")
    'ISO VG 32'
    """
    names = {_plain(one): one for one in sources()}
    plain = _plain(str(name))
    if isinstance(name, str) and (known := names.get(plain) or names.get(f"iso{plain}")):
        return known
    if re.fullmatch(r"(?:iso)?vg[235]", plain):
        raise ValueError(f"got {name!r:.40}, which is too thin for a viscosity index; {OTHERS}")
    if MULTIGRADE.fullmatch(plain):
        raise ValueError(f"got {name!r:.40}; multigrade oils differ from brand to brand; {OTHERS}")
    near = difflib.get_close_matches(plain, names, n=3, cutoff=0.7)
    choice = " or ".join(repr(names[one]) for one in near)
    hint = f"did you mean {choice}? If not," if near else f"it has {_in_short()};"
    raise ValueError(f"got {name!r:.40}, which is not in the library; {hint} {OTHERS}")


def _in_short() -> str:
    """The names of the library; of grades the first and the last."""
    iso, sae = [*_iso_grades()], [one["name"] for one in _data()["sae"]]
    return ", ".join([f"{iso[0]} to {iso[-1]}", f"{sae[0]} to {sae[-1]}", *(one["name"] for one in _data()["liquid"])])


def entries_of(name: str, temperature: float) -> dict[str, Any]:
    """The entries of a lubricant that is supplied at a temperature.

    They are ``thermoviscosity``, ``density``, ``thermal_expansion``, ``heat_capacity`` and ``conductivity``.

    Parameters
    ----------
    name : name of a liquid in :func:`sources`.
    temperature : temperature of the supplied lubricant, K.

    Raises
    ------
    ValueError
        If the numbers of the liquid do not reach to this temperature.

    Examples
    --------
    >>> entries = entries_of("ISO VG 32", 313.15)
    >>> entries["density"][:6], entries["thermoviscosity"]
    ('854.53', {'law': 'iso_vg', 'grade': 32})
    """
    grades = _iso_grades()
    rows = next((one["rows"] for one in _data()["liquid"] if one["name"] == name), None)
    if rows is not None:
        return _of_rows(name, rows, temperature)
    if not LIQUID[0] <= temperature <= LIQUID[1]:
        raise ValueError(
            f"temperature: got {celsius(temperature)}; it must be from {celsius(LIQUID[0])} to {celsius(LIQUID[1])}, "
            "between which mineral oils are supplied; check the unit"
        )
    if name in grades:
        law: dict[str, Any] = {"law": "iso_vg", "grade": grades[name]}
        return {"thermoviscosity": law, **_of_mineral_oil(density_15(GRADES[grades[name]]), temperature)}
    (grade,) = (one for one in _data()["sae"] if one["name"] == name)
    return _of_sae_grade(grade["a"], grade["b"], temperature)


def density_15(warm: float) -> float:
    """The density of a mineral oil at 15 °C, kg/m³, from its kinematic viscosity at 40 °C, above 5.5 mm²/s.

    It is that of the viscosity–gravity constant 0.815, (G - 0.0664 - 0.1154 lg(ν - 5.5))/(0.94 - 0.109 lg(ν - 5.5))
    with G in g/cm³ and ν in mm²/s. Source: ASTM D2501.

    Examples
    --------
    >>> print(*(f"{density_15(warm):.0f}" for warm in (10, 32, 100, 320)))
    850 870 885 899
    """
    logarithm = math.log10(warm - 5.5)
    return 1e3 * (VISCOSITY_GRAVITY * (0.94 - 0.109 * logarithm) + 0.0664 + 0.1154 * logarithm)


def _of_mineral_oil(density: float, temperature: float) -> dict[str, Any]:
    """Density, expansion and heat of a mineral oil from its density at 15 °C, kg/m³.

    The density follows ASTM D1250 (table 54D), ρ = ρ15 exp(-α Δ (1 + 0.8 α Δ)) with α = 0.6278/ρ15 and Δ from 15 °C.
    Heat capacity (1685 + 3.39 t)/√d J/(kg K) and conductivity 0.1172 (1 - 0.00054 t)/d W/(m K) at t °C are those of
    Cragoe 1929, of the density d over that of water.
    """
    relative = density / 999.1
    root = math.sqrt(relative)
    expansion = EXPANSION / density
    shift = expansion * (temperature - ZERO_CELSIUS - 15)
    capacities = [
        [with_unit(t + ZERO_CELSIUS, "K"), with_unit((1684.8 + 3.391 * t) / root, "J/(kg*K)")] for t in (0.0, 200.0)
    ]
    return {
        "density": with_unit(density * math.exp(-shift * (1 + 0.8 * shift)), "kg/m^3"),
        "thermal_expansion": with_unit(expansion * (1 + 1.6 * shift), "K^-1"),
        "heat_capacity": {"table": capacities},
        "conductivity": with_unit(0.1172 * (1 - 0.00054 * (temperature - ZERO_CELSIUS)) / relative, "W/(m*K)"),
    }


def _of_sae_grade(a: float, b: float, temperature: float) -> dict[str, Any]:
    """The entries of an SAE grade with η = a exp(b/(T + 95 °F)), a in lbf s/in² and b in °F."""
    c = (459.67 - 95) / 1.8
    warm = REYN * a * math.exp(b / 1.8 / (40 + ZERO_CELSIUS - c))
    density = 880.0
    for _ in range(20):  # the density and the kinematic viscosity at 40 °C, of each other
        at_40 = density * math.exp(-EXPANSION / density * 25)
        density = density_15(1e6 * warm / at_40)
    low, high = (with_unit(end + ZERO_CELSIUS, "K") for end in SAE_RANGE)
    law = {
        "law": "vogel",
        "a": with_unit(REYN * a, "Pa*s"),
        "b": with_unit(b / 1.8, "K"),
        "c": with_unit(c, "K"),
        "valid_from": low,
        "valid_to": high,
    }
    return {"thermoviscosity": law, **_of_mineral_oil(density, temperature)}


def _of_rows(name: str, rows: list[list[float]], temperature: float) -> dict[str, Any]:
    """The entries of a liquid from rows; density and conductivity are interpolated between them."""
    from scipy.interpolate import PchipInterpolator  # slow to import

    places = [ZERO_CELSIUS + row[0] for row in rows]
    if not places[0] <= temperature <= places[-1]:
        raise ValueError(
            f"temperature: got {celsius(temperature)}; it must be from {celsius(places[0])} to "
            f"{celsius(places[-1])}, where the library has the numbers of {name}; check the unit, or {OTHERS}"
        )

    def at(column: int) -> float:
        return float(PchipInterpolator(places, [row[column] for row in rows])(temperature))

    kelvin = [with_unit(place, "K") for place in places]
    viscosities = [[t, with_unit(1e-3 * row[1], "Pa*s")] for t, row in zip(kelvin, rows, strict=True)]
    capacities = [[t, with_unit(row[3], "J/(kg*K)")] for t, row in zip(kelvin, rows, strict=True)]
    expansion = math.log(rows[0][2] / rows[-1][2]) / (places[-1] - places[0])
    return {
        "thermoviscosity": {"law": "tabulated", "table": viscosities},
        "density": with_unit(at(2), "kg/m^3"),
        "thermal_expansion": with_unit(expansion, "K^-1"),
        "heat_capacity": {"table": capacities},
        "conductivity": with_unit(at(4), "W/(m*K)"),
    }
