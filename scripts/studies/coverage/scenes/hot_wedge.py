"""Random wedges whose temperature varies across them, over the Péclet and the Nahme–Griffith number."""

import math

from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from scripts.studies.coverage.random_entries import Entries, between, chance, length

PECLET, NAHME = (0.05, 300.0), (0.03, 60.0)
"""Least and largest ρ c u h²/(k L) and β η u²/k."""

DENSITY, CAPACITY, CONDUCTIVITY = 870.0, 2000.0, 0.13
"""Density, kg/m³, heat capacity, J/(kg K), and thermal conductivity, W/(m K), of the oil."""

MAX_REYNOLDS_NUMBER = 1000.0
"""Largest Re = ρuh/η."""

MAX_RISE = 80.0
"""Largest temperature of a film that conducts its heat, above its walls, ln(1 + Na/8)/β, K."""


def draw(rng: Generator) -> Entries:
    """Return an infinitely wide wedge, h_in/h_out = 1.1 to 1.9, with an exponential law of the viscosity.

    Half of the wedges have walls that take no heat, the others one or two walls at the temperature of the supply.

    Raises
    ------
    InputError
        If the Reynolds number or the heating is out of range.
    """
    side, coefficient = between(rng, 5e-3, 0.1), float(rng.uniform(0.02, 0.06))
    film, peclet, nahme = side * between(rng, 2e-4, 3e-3), between(rng, *PECLET), between(rng, *NAHME)
    speed = peclet * CONDUCTIVITY * side / (DENSITY * CAPACITY * film**2)
    viscosity = nahme * CONDUCTIVITY / (coefficient * speed**2)
    reynolds_number, rise = DENSITY * speed * film / viscosity, math.log1p(nahme / 8) / coefficient
    if reynolds_number > MAX_REYNOLDS_NUMBER or rise > MAX_RISE:
        raise InputError(f"speed: got {speed:.2g} m/s, Re {reynolds_number:.2g}, {rise:.2g} K; draw again")
    oil: Entries = {
        "viscosity": with_unit(viscosity, "Pa*s"),
        "density": with_unit(DENSITY, "kg/m^3"),
        "heat_capacity": with_unit(CAPACITY, "J/(kg*K)"),
        "conductivity": with_unit(CONDUCTIVITY, "W/(m*K)"),
        "temperature": "40 degC",
        "thermoviscosity": {
            "law": "exponential",
            "temperature_coefficient": with_unit(coefficient, "1/K"),
            "valid_from": "0 degC",
            "valid_to": "300 degC",
        },
    }
    entries: Entries = {
        "kind": "bearing",
        "geometry": {
            "shape": "linear",
            "length": length(side),
            "film": length(film),
            "rise": length(film * float(rng.uniform(0.1, 0.9))),
        },
        "lubricant": oil,
        "motion": {"speed": with_unit(speed, "m/s")},
    }
    if chance(rng, 0.5):
        cold = {"kind": "temperature", "temperature": "40 degC"}
        walls = [("fixed_wall",), ("sliding_wall",), ("fixed_wall", "sliding_wall")][int(rng.integers(3))]
        entries["heat"] = dict.fromkeys(walls, cold)
    return entries
