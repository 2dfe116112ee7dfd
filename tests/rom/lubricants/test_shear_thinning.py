"""Laws of shear thinning against their formulas, and the curves of fluidity over stress against the laws."""

import numpy as np
import pytest
from pydantic import ValidationError

from roughfilm.rom.lubricants.shear_thinning import CarreauYasuda, ReeEyring, ThinningLaw

VISCOSITY = 0.05
EYRING = ReeEyring.model_validate({"law": "ree_eyring", "critical_stress": "5 MPa"})
CARREAU = CarreauYasuda.model_validate(
    {
        "law": "carreau_yasuda",
        "index": 0.4,
        "relaxation_time": "2e-6 s",
        "exponent": 0.8,
        "infinite_shear_viscosity": "8 mPa*s",
    }
)
STEEP = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": 0.5, "critical_stress": "10 kPa"})
RATES = np.array([0.0, 1e2, 1e4, 1e6, 1e8])


def test_carreau_and_yasuda() -> None:
    thinned = 0.008 + 0.042 * (1 + (2e-6 * RATES) ** 0.8) ** (-0.6 / 0.8)
    np.testing.assert_allclose(CARREAU.viscosity_at(RATES, VISCOSITY), thinned, rtol=1e-13)


def test_the_exponent_of_carreau_is_two_and_the_time_is_the_critical_stress() -> None:
    time = 1e4 / VISCOSITY
    np.testing.assert_allclose(
        STEEP.viscosity_at(RATES, VISCOSITY), VISCOSITY * (1 + (RATES / time) ** 2) ** -0.25, rtol=1e-13
    )


def test_ree_and_eyring() -> None:
    stress = np.array([1.0, 1e3, 1e6, 3e7])
    rate = 5e6 / VISCOSITY * np.sinh(stress / 5e6)
    np.testing.assert_allclose(EYRING.viscosity_at(rate, VISCOSITY) * rate, stress, rtol=1e-7)
    assert EYRING.viscosity_at(np.zeros(1), VISCOSITY)[0] == VISCOSITY


@pytest.mark.parametrize("law", [EYRING, CARREAU, STEEP], ids=["Ree-Eyring", "Carreau-Yasuda", "Carreau"])
def test_the_curve_gives_the_fluidity_of_the_stress(law: ThinningLaw) -> None:
    curve = law.curve(VISCOSITY)
    rate = np.geomspace(1e-3, 1e9, 2000)
    viscosity = law.viscosity_at(rate, VISCOSITY)
    fluidity, slope = curve.fluidity(viscosity * rate / curve.stress)
    np.testing.assert_allclose(fluidity, VISCOSITY / viscosity, rtol=1e-9)
    by_difference = np.gradient(np.log(fluidity), np.log(viscosity * rate))
    np.testing.assert_allclose(slope[1:-1], by_difference[1:-1], atol=1e-3 * slope.max())
    np.testing.assert_allclose(curve.relative_stress(VISCOSITY * rate / curve.stress), viscosity * rate / curve.stress)


def test_the_curve_of_an_index_of_one_is_one() -> None:
    curve = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": 1, "critical_stress": "1 Pa"}).curve(0.1)
    assert (curve.fluidity(np.geomspace(1e-9, 1e30, 200))[0] == 1).all()


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"law": "carreau_yasuda", "index": 0.5}, "got neither of critical_stress and relaxation_time"),
        ({"law": "carreau_yasuda", "index": 1.5, "critical_stress": "1 kPa"}, "it must be 0.1 to 1"),
        ({"law": "carreau_yasuda", "index": 0.5, "critical_stress": "1 kPa", "exponent": 9}, "it must be 0.2 to 4"),
    ],
)
def test_entries_without_a_meaning_are_refused(entries: dict[str, object], message: str) -> None:
    with pytest.raises(ValidationError, match=message):
        CarreauYasuda.model_validate(entries)


def test_at_another_temperature_the_law_is_the_same_over_the_stress() -> None:
    stress = np.geomspace(1e2, 1e7, 50)
    cold, hot = CARREAU.curve(VISCOSITY), CARREAU.scaled(0.3).curve(0.3 * VISCOSITY)
    assert hot.stress == pytest.approx(cold.stress)
    np.testing.assert_allclose(hot.fluidity(stress / hot.stress)[0], cold.fluidity(stress / cold.stress)[0], rtol=1e-9)
