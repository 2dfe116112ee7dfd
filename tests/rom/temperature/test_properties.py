"""Tables of a liquid over its heat, against its laws."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.properties import over_heat

T0, LOWEST, RISE = 313.15, 1.5e6, 2e3


def walther(temperature: Array) -> tuple[Array, Array]:
    """ν + 0.7 = 10^(10^(9 - 3.5 log₁₀ T)), of about an ISO VG 46 oil, as η = 860 ν."""
    inner = 10 ** (9.0 - 3.5 * np.log10(temperature))
    power = 10**inner
    return 860e-6 * (power - 0.7), -860e-6 * power * np.log(10) * inner * 3.5 / temperature


def warm(temperature: Array) -> tuple[Array, Array]:
    """ρ c that rises linearly."""
    rise = temperature - T0
    return LOWEST * rise + RISE * rise**2 / 2, LOWEST + RISE * rise


OIL = Liquid(temperature=T0, viscosity=walther, heat=warm, conductivity=0.13)


def test_temperature_and_viscosity_over_heat() -> None:
    temperature = np.linspace(293.0, 393.0, 5000).reshape(50, 100)
    heat, capacity = warm(temperature)
    table = over_heat(OIL, heat)
    assert table.contains(heat)
    found, warming, viscosity, thinning = table(heat)
    exact, slope = walther(temperature)
    np.testing.assert_allclose(found, temperature, rtol=1e-12)
    np.testing.assert_allclose(viscosity, exact, rtol=1e-9)
    np.testing.assert_allclose(warming, 1 / capacity, rtol=1e-7)
    np.testing.assert_allclose(thinning, slope / capacity, rtol=1e-6)


def test_a_table_of_one_temperature_has_a_margin() -> None:
    table = over_heat(OIL, np.zeros((3, 4)))
    assert table.contains(warm(np.array([T0 - 1.9, T0 + 1.9]))[0])
    assert not table.contains(warm(np.array([T0 + 3.0]))[0])
