"""Random bearings whose lubricant heats: given films of every shape, with walls that take heat or not, most smooth."""

import math

from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from scripts.studies.coverage.random_entries import Entries, between, chance, length
from scripts.studies.coverage.scenes.bearing import CHANCES, MAX_PRESSURE, RINGS, SHAPES, fed, lubricant, shaped

SPEEDS = (0.05, 80.0)
"""Least and largest sliding speed, m/s."""

MAX_REYNOLDS_NUMBER = 1000.0
"""Largest Re = ρuh/η."""

HEATING = (0.01, 10.0)
"""Least and largest estimate 2βηuL/(ρch²) of the heating number."""

GRADES = (10, 22, 32, 46, 68, 100, 220, 460)
"""ISO VG grades; the other lubricants have an exponential law."""


def draw(rng: Generator) -> Entries:
    """Return a bearing with a heating number of about 0.01 to 10, h/L = 10⁻⁴ to 3·10⁻³, at 20 to 80 °C.

    Shapes, textures, pressures and laws of density and pressure are those of the kind ``bearing``. Half of the fixed
    and of the sliding walls take no heat; the others have a temperature, conduct, turn or are half-spaces. Of seven
    bearings one has short ridges along or across. A tenth slides backwards.

    Raises
    ------
    InputError
        If speed, Reynolds number or pressure are out of range.
    """
    side = between(rng, 5e-3, 0.1)
    film = side * between(rng, 1e-4, 3e-3)
    shape = str(rng.choice(SHAPES, p=CHANCES))
    geometry = shaped(rng, shape, film, side)
    narrow = shape in RINGS or "width" in geometry
    joined = shape == "washer" or geometry.get("joined", False)
    oil, viscosity, coefficient = _oil(rng)
    capacity = _number(oil["density"]) * _number(oil["heat_capacity"])
    speed = between(rng, *HEATING) * capacity * film**2 / (2 * coefficient * viscosity * side)
    reynolds_number = _number(oil["density"]) * speed * film / viscosity
    pressure = 6 * viscosity * speed * side / film**2
    stiff = min(MAX_PRESSURE, _number(oil["compressibility"].get("bulk_modulus", "inf Pa")))
    if not SPEEDS[0] < speed < SPEEDS[1] or reynolds_number > MAX_REYNOLDS_NUMBER or pressure > stiff:
        raise InputError(f"speed: got {speed:.2g} m/s, Re {reynolds_number:.2g}, {pressure:.2g} Pa; draw again")
    entries: Entries = {
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": oil,
        "motion": {"speed": with_unit(speed * (-1 if chance(rng, 0.1) else 1), "m/s")},
        "boundary": fed(rng, joined, narrow),
        "heat": _walls(rng, shape, _number(oil["temperature"])),
    }
    if chance(rng, 1 / 7):
        entries["roughness"] = {
            "kind": "sinusoid",
            "amplitude": length(film * between(rng, 0.02, 0.8)),
            "wavelength": length(side / between(rng, 100, 1e4)),
            "direction": f"{rng.choice([0, 90])} deg",
        }
    return entries


def _number(text: str) -> float:
    return float(text.partition(" ")[0])


def _oil(rng: Generator) -> tuple[Entries, float, float]:
    """A lubricant with a temperature, its viscosity there, Pa s, and -(dη/dT)/η, 1/K, that of a grade roughly."""
    supplied, density = float(rng.uniform(20, 80)), float(rng.uniform(780, 1000))
    oil = lubricant(rng)
    viscosity = _number(oil["viscosity"])
    oil |= {
        "temperature": f"{supplied:.4g} degC",
        "density": with_unit(density, "kg/m^3"),
        "heat_capacity": with_unit(rng.uniform(1700, 2300), "J/(kg*K)"),
        "conductivity": with_unit(rng.uniform(0.1, 0.16), "W/(m*K)"),
    }
    coefficient = float(rng.uniform(0.01, 0.06))
    if chance(rng, 0.5):
        law: Entries = {"law": "exponential", "temperature_coefficient": with_unit(coefficient, "1/K")}
        return {**oil, "thermoviscosity": law}, viscosity, coefficient
    grade = int(rng.choice(GRADES))
    del oil["viscosity"]
    viscosity = grade * 1e-6 * density * math.exp(-0.035 * (supplied - 40))
    return {**oil, "thermoviscosity": {"law": "iso_vg", "grade": grade}}, viscosity, 0.035


def _walls(rng: Generator, shape: str, supplied: float) -> Entries:
    """The walls, of which half take no heat, and the part of the hot lubricant that enters the next film."""

    def temperature() -> str:
        return f"{supplied + rng.uniform(-10, 30):.4g} degC"

    fixed: list[Entries] = [
        {"kind": "adiabatic"},
        {"kind": "temperature", "temperature": temperature()},
        {"kind": "conducting", "heat_transfer": with_unit(between(rng, 50, 5000), "W/(m^2*K)")},
    ]
    sliding: list[Entries] = [{"kind": "adiabatic"}, {"kind": "temperature", "temperature": temperature()}]
    if shape == "journal":
        sliding.append({"kind": "turning"})
    else:
        steel = {"conductivity": "45 W/(m*K)", "density": "7800 kg/m^3", "heat_capacity": "470 J/(kg*K)"}
        sliding.append({"kind": "half_space", **steel})
    return {
        "fixed_wall": fixed[int(rng.choice(3, p=[0.5, 0.25, 0.25]))],
        "sliding_wall": sliding[int(rng.choice(3, p=[0.5, 0.25, 0.25]))],
        "carried_over": float(rng.choice([1.0, rng.uniform(0, 1)])),
    }
