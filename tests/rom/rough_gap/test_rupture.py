"""A rough gap says where sliding would rupture its film."""

import numpy as np
import pytest

from roughfilm import rom
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.rom.ladder.model import ladder
from roughfilm.rom.ladder.scene import read_scene

MODELS = [model for model in ladder(rom, kind="rough_gap") if model.keeps]
GAP, AMPLITUDE, WAVELENGTH = 10e-6, 3e-6, 500e-6


def lowest_over_gradient():
    """The lowest pressure under sliding over the gradient, m, of long waves: dp/dx = 6ηu (h - c)/h³, by summation."""
    x = (np.arange(200_000) + 0.5) / 200_000 * WAVELENGTH
    h = GAP + AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH)
    carried = (h**-2).mean() / (h**-3).mean()
    pressure = np.cumsum((h - carried) / h**3) * WAVELENGTH / x.size
    speed_over_gradient = GAP**2 / 6  # ηu/G at which a smooth gap has the flow of the gradient
    return float(6 * speed_over_gradient * (pressure.min() - pressure.mean()))


def gap(gradient):
    return read_scene(
        {
            "name": "waves",
            "kind": "rough_gap",
            "geometry": {
                "surface": "sinusoid",
                "amplitude": f"{AMPLITUDE} m",
                "wavelength": f"{WAVELENGTH} m",
                "mean_gap": f"{GAP} m",
            },
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "870 kg/m^3", "cavitation_pressure": "-50 kPa"},
            "flow": {"pressure_gradient": f"{gradient!r} Pa/m"},
        }
    )


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_sliding_ruptures_the_film_above_a_gradient_and_not_below(model):
    limit = -50e3 / lowest_over_gradient()
    assert not [one for one in model.solve(gap(0.998 * limit)).warnings if "ruptures" in one]
    (warning,) = [one for one in model.solve(gap(1.002 * limit)).warnings if "ruptures" in one]
    assert warning.startswith("pressure: falls under sliding to -50.")


def of(scene, quantity):
    """The effect that a model leaves out of a quantity."""
    return kind_of_name("rough_gap").omitted(scene, MODELS[0], quantity)


def test_the_advice_on_sliding_is_refused_and_that_on_flow_is_not():
    ruptured = gap(-60e3 / lowest_over_gradient())
    assert of(ruptured, "friction").part == of(ruptured, "B1").part == float("inf")
    assert of(ruptured, "A11") is None
    assert of(gap(-40e3 / lowest_over_gradient()), "friction") is None
