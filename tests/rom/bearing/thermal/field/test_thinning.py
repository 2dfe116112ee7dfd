"""Films that heat and thin with shear, against the developed flow between two walls of one temperature."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

import roughfilm as rf
from roughfilm.contact.foundation.arrays import Array

VISCOSITY, COEFFICIENT, CONDUCTIVITY, SPEED, FILM, STRESS = 0.05, 0.04, 0.14, 20.0, 1e-5, 5e4
WALL = {"kind": "temperature", "temperature": "40 degC"}
SCENE = {
    "name": "thinned",
    "kind": "bearing",
    "geometry": {"shape": "parallel", "film": "10 um", "length": "40 mm"},
    "lubricant": {
        "temperature": "40 degC",
        "viscosity": "0.05 Pa*s",
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.04 1/K"},
        "shear_thinning": {"law": "ree_eyring", "critical_stress": "50 kPa"},
        "density": "870 kg/m^3",
        "heat_capacity": "2000 J/(kg*K)",
        "conductivity": "0.14 W/(m*K)",
    },
    "motion": {"speed": "20 m/s"},
    "heat": {"fixed_wall": WALL, "sliding_wall": WALL},
}


def developed() -> tuple[float, float]:
    """The largest rise of the temperature, K, and the stress, Pa, of k T'' + τ γ̇ = 0 with ∫ γ̇ dz = u."""

    def motion(_z: Array, y: Array, stress: Array) -> Array:
        rate = STRESS / (VISCOSITY * np.exp(-COEFFICIENT * y[0])) * np.sinh(stress[0] / STRESS)
        return np.stack([y[1], -(FILM**2) * stress[0] * rate / CONDUCTIVITY, rate * FILM / SPEED])

    def walls(at: Array, end: Array, _stress: Array) -> Array:
        return np.array([at[0], end[0], at[2], end[2] - 1])

    z = np.linspace(0, 1, 101)
    start = np.stack([4 * z * (1 - z), 4 - 8 * z, z])
    found = solve_bvp(motion, walls, z, start, p=[STRESS], tol=1e-9)
    assert found.success
    return float(found.sol(0.5)[0]), float(found.p[0])


def test_the_developed_film_has_the_temperature_and_the_friction_of_the_flow_between_its_walls() -> None:
    rise, stress = developed()
    found = rf.solve(rf.read_scene(SCENE), model="across", resolution=128)
    assert found["temperature_max"].value - 40 == pytest.approx(rise, rel=1e-3)
    assert found["friction_per_width"].value / 0.04 == pytest.approx(stress, rel=0.03)  # the inlet is cold
    newtonian = rf.replace(rf.read_scene(SCENE), "lubricant.shear_thinning.critical_stress", "1 GPa")
    assert rf.solve(newtonian, model="across", resolution=64)["temperature_max"].value - 40 > 1.15 * rise


def test_thinning_and_heating_of_a_film_between_insulated_walls_agree_by_both_energy_equations() -> None:
    """In a film whose temperature hardly varies across it, both models have one temperature."""
    insulated = {
        **SCENE,
        "heat": {},
        "motion": {"speed": "1 m/s"},
        "geometry": {**SCENE["geometry"], "shape": "linear", "rise": "10 um"},
    }
    thin = {
        **insulated,
        "lubricant": {**SCENE["lubricant"], "shear_thinning": {"law": "ree_eyring", "critical_stress": "2 kPa"}},
    }
    mean, across = (rf.solve(rf.read_scene(thin), model=name, resolution=64) for name in ("adiabatic", "across"))
    assert across["load_per_width"].value == pytest.approx(mean["load_per_width"].value, rel=5e-3)
    assert across["friction_per_width"].value == pytest.approx(mean["friction_per_width"].value, rel=5e-3)
