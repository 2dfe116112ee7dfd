"""Films and liquids from which tests of temperatures start: plates, and a journal with a supply and a cavity."""

import numpy as np

from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Inflow, Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.liquid import Liquid

GAP, SPEED, VISCOSITY, SUPPLY = 2e-5, 5.0, 0.05, 313.0
"""Those of all plates, in SI units, and the temperature of the supplied liquid."""

CONDUCTIVITY, CAPACITY = 0.13, 1.7e6
"""Conductivity, W/(m K), and heat capacity of a volume, J/(m³ K), of the liquid unless others are given."""


def liquid(*, viscosity=VISCOSITY, slope=0.0, capacity=CAPACITY, growth=0.0, conductivity=CONDUCTIVITY):
    """A liquid of viscosity η exp(-slope (T - T₀)) and heat capacity ρc (1 + growth (T - T₀))."""

    def law(temperature):
        value = viscosity * np.exp(-slope * (temperature - SUPPLY))
        return value, -slope * value

    def heat(temperature):
        rise = temperature - SUPPLY
        return capacity * rise * (1 + growth / 2 * rise), capacity * (1 + growth * rise)

    return Liquid(
        temperature=SUPPLY,
        viscosity=law,
        heat=heat,
        conductivity=conductivity,
    )


def plates(cells, *, length=0.05, speed=SPEED, inlet=0.0, outlet=0.0, viscosities=None):
    """The film between parallel plates, infinitely wide."""
    shape = Shape(thickness=lambda x, y: GAP + 0 * x + 0 * y, breaks=(0.0, length))
    ends = Ends(inlet=inlet, outlet=outlet)
    problem = Problem(shape=shape, ends=ends, speed=speed, viscosity=VISCOSITY, viscosities=viscosities)
    return solve(problem, (cells, 1))


RADIUS, CLEARANCE, WIDTH = 0.05, 5e-5, 0.05
"""Those of the journal, m."""


def journal(cells, *, viscosity=0.02, eccentricity=0.6, supply=1e5):
    """A journal bearing with a pocket in which lubricant is supplied, and with a cavity."""
    round_length = 2 * np.pi * RADIUS
    shape = Shape(
        thickness=lambda x, y: CLEARANCE * (1 + eccentricity * np.cos(x / RADIUS)) + 0 * y,
        breaks=(0.0, round_length),
        across=(0.0, WIDTH),
        wide=False,
        joined=(True, False),
    )
    pocket = Inflow(covers=lambda x, y: (x < 0.02) & (np.abs(y - WIDTH / 2) < 0.3 * WIDTH), pressure=supply)
    ends = Ends(sides=(0.0, 0.0))
    problem = Problem(shape=shape, ends=ends, speed=20.0, viscosity=viscosity, inflows=(pocket,))
    return solve(problem, (cells, cells))


def imbalance(balance):
    """What the heat flows lack over the dissipation."""
    out = balance.leaving + balance.sliding_wall + balance.fixed_wall + balance.stored
    return (balance.dissipation + balance.entering - out) / balance.dissipation
