"""Closed forms of hydrostatic pads: by quadrature, and by the balance of the flows."""

import math

import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.closed_forms.hydrostatic import (
    behind_capillary,
    behind_orifice,
    circular_recess_pad,
    compensated_stiffness,
    long_recess_pad,
)

FILM, VISCOSITY, PRESSURE, SUPPLY = 30e-6, 0.04, 2e6, 5e6


def test_pads_are_integrals_of_their_pressure():
    pad = circular_recess_pad(film=FILM, recess_radius=0.02, radius=0.05, recess_pressure=PRESSURE, viscosity=VISCOSITY)
    fall = quad(lambda r: 6 * VISCOSITY / (math.pi * r * FILM**3), 0.02, 0.05)[0]
    assert pad.flow == pytest.approx(PRESSURE / fall, rel=1e-10)

    def pressure(r):
        return quad(lambda at: pad.flow * 6 * VISCOSITY / (math.pi * at * FILM**3), r, 0.05)[0]

    land = quad(lambda r: 2 * math.pi * r * pressure(r), 0.02, 0.05)[0]
    assert pad.load == pytest.approx(math.pi * 0.02**2 * PRESSURE + land, rel=1e-9)

    long = long_recess_pad(film=FILM, recess_length=0.03, length=0.08, recess_pressure=PRESSURE, viscosity=VISCOSITY)
    assert long.load == pytest.approx(PRESSURE * 0.03 + 2 * PRESSURE / 2 * 0.025, rel=1e-12)
    assert long.flow == pytest.approx(2 * FILM**3 / (12 * VISCOSITY) * PRESSURE / 0.025, rel=1e-12)


@pytest.mark.parametrize("orifice", [False, True])
def test_the_flow_through_a_restrictor_is_that_out_of_the_pad(orifice):
    def of_film(film):
        unit = circular_recess_pad(film=film, recess_radius=0.02, radius=0.05, recess_pressure=1.0, viscosity=VISCOSITY)
        if orifice:
            recess = behind_orifice(supply=SUPPLY, pad_conductance=unit.flow, area=1e-6, discharge=0.6, density=870.0)
        else:
            recess = behind_capillary(
                supply=SUPPLY, pad_conductance=unit.flow, diameter=8e-4, length=0.05, viscosity=VISCOSITY
            )
        return recess, recess * unit.flow, recess * unit.load

    recess, flow, load = of_film(FILM)

    def through(pressure):
        if orifice:
            return 0.6 * 1e-6 * math.sqrt(2 * (SUPPLY - pressure) / 870.0)
        return math.pi * 8e-4**4 / (128 * VISCOSITY * 0.05) * (SUPPLY - pressure)

    assert through(recess) == pytest.approx(flow, rel=1e-10)
    assert recess == pytest.approx(brentq(lambda p: through(p) - flow / recess * p, 0, SUPPLY), rel=1e-9)
    slope = (of_film(FILM * 1.0001)[2] - of_film(FILM * 0.9999)[2]) / (2e-4 * FILM)
    stiffness = compensated_stiffness(load=load, film=FILM, pressure_ratio=recess / SUPPLY, orifice=orifice)
    assert stiffness == pytest.approx(-slope, rel=1e-6)


def test_recesses_larger_than_the_pad_are_refused():
    with pytest.raises(InputError, match="recess_radius"):
        circular_recess_pad(film=1e-5, recess_radius=0.1, radius=0.1, recess_pressure=1.0, viscosity=1.0)
    with pytest.raises(InputError, match="recess_length"):
        long_recess_pad(film=1e-5, recess_length=0.1, length=0.1, recess_pressure=1.0, viscosity=1.0)
    with pytest.raises(InputError, match="pressure_ratio"):
        compensated_stiffness(load=1.0, film=1e-5, pressure_ratio=1.1, orifice=True)
