"""The uncertainties and warnings of the models of a rough gap against exact Stokes flow over ridges."""

from functools import cache

import numpy as np
import pytest

from roughfilm.ladder import find, models
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.rough_gap.flow.corrected import slope_corrected
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from roughfilm.rom.rough_gap.kind import KIND
from roughfilm.rom.rough_gap.walls import Walls

NAMES = ("smooth_gap", "homogenized", "slope_corrected")
SILENT_ERROR = 0.011
"""Largest relative error beyond the uncertainty that may have no warning, a little above the threshold of warnings."""


def gap(amplitude, wavelength):
    geometry = {"surface": "sinusoid", "amplitude": f"{10 * amplitude} um", "wavelength": f"{10 * wavelength} um"}
    return read_scene(
        {
            "name": "wave",
            "kind": "rough_gap",
            "geometry": geometry | {"mean_gap": "10 um"},
            "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
            "flow": {"reynolds_number": 0.01},
        }
    )


def solved(name, amplitude, wavelength):
    return find("rough_gap", name).solve(gap(amplitude, wavelength))


exact_flow = cache(sinusoidal_ridge_flow)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    ("amplitude", "wavelength"), [(0.04, 40.0), (0.05, 5.0), (0.3, 20.0), (0.3, 2.5), (0.5, 10.0), (0.5, 1.5)]
)
def test_an_error_beyond_the_uncertainty_has_a_warning(name, amplitude, wavelength):
    exact = exact_flow(amplitude, wavelength, tolerance=1e-5)
    result = solved(name, amplitude, wavelength)
    true = {"A11": exact.across, "A22": exact.along, "B1": exact.drag, "friction": exact.friction}
    silent = {
        quantity: (result[quantity].value, value)
        for quantity, value in true.items()
        if abs(result[quantity].value - value) > (result[quantity].uncertainty or 0.0) + SILENT_ERROR * value
    }
    assert any("out of its range" in warning for warning in result.warnings) or not silent


@pytest.mark.parametrize("name", NAMES)
def test_long_and_low_waves_cause_no_warning(name):
    assert solved(name, 0.04, 40.0).warnings == ()


def test_the_warning_names_the_model_that_suffices():
    steep, mild = (solved("homogenized", 0.3, length).warnings for length in (2.0, 5.0))
    assert steep[0].endswith("out of its range, take stokes")
    assert mild[0].endswith("out of its range, take slope_corrected")
    assert "slope adds" in steep[0]
    assert solved("slope_corrected", 0.3, 2.0).warnings[0].endswith("out of its range, take stokes")


def test_the_uncertainty_of_the_slope_correction_is_a_few_times_its_error():
    ratios = []
    for amplitude in (0.2, 0.3, 0.5):
        for length in (3.0, 5.0, 10.0):
            exact = sinusoidal_ridge_flow(amplitude, length, tolerance=1e-6)
            wave = np.tile(-amplitude * np.cos(2 * np.pi * np.arange(256) / 256)[:, None], (1, 2))
            found = slope_corrected(Walls(lower=wave, upper=np.ones_like(wave), spacing=(length / 256, length / 64)))
            for i, true in enumerate((exact.across, exact.along)):
                ratios.append(found.uncertainty.pressure[i, i] / abs(found.corrected.pressure[i, i] - true))
    assert min(ratios) > 1
    assert np.median(ratios) < 5


@pytest.mark.parametrize("model", models("rough_gap"), ids=lambda model: model.name)
def test_no_model_of_a_gap_holds_beyond_the_laminar_limit(model):
    """Re = ρq/η above 1300 (Carlson et al. 1982), or 2ρq/η of the sliding that has the same flow above 1440."""
    scene = gap(0.05, 40.0)
    for number, words in ((700, []), (730, ["shear flow"]), (1310, ["pressure drives", "shear flow"])):
        fast = scene.model_copy(update={"flow": scene.flow.model_copy(update={"reynolds_number": float(number)})})
        found = KIND.outside(fast, model, None)
        assert len(found) == len(words)
        assert all(word in one for word, one in zip(words, found, strict=True))


@pytest.mark.parametrize("name", ["homogenized", "slope_corrected"])
def test_friction_between_walls_that_touch_has_no_error(name):
    """The mean of 1/h diverges where a gap closes; below a hundredth of the mean gap it counts as contact."""
    model, touching, open_gap = find("rough_gap", name), gap(0.995, 40.0), gap(0.5, 40.0)
    coarse, fine = (model.solve(touching, Request(resolution=n)) for n in (32, 128))
    assert fine["friction"].value > 1.1 * coarse["friction"].value
    assert fine["friction"].uncertainty is None
    assert fine["A22"].uncertainty is not None
    for scene, known in ((touching, False), (open_gap, True)):
        result = with_errors(model.solve(scene), scene, model, models("rough_gap"))
        assert ("friction" in result.expected_error) is known
        assert any("friction does not converge" in warning for warning in result.warnings) is not known


def of_fluid(density, viscosity, gradient, **boundary):
    entries = {
        "name": "wave",
        "kind": "rough_gap",
        "geometry": {"surface": "sinusoid", "amplitude": "1 um", "wavelength": "100 um", "mean_gap": "10 um"},
        "lubricant": {"viscosity": f"{viscosity} Pa*s", "density": f"{density} kg/m^3"},
        "flow": {"pressure_gradient": f"{gradient} Pa/m"},
    }
    return read_scene(entries | ({"boundary": boundary} if boundary else {}))


@pytest.mark.parametrize(("gradient", "ambient"), [(1e8, 1e5), (5e7, 1e5), (1e8, 1e6)])
def test_a_gas_is_outside_by_the_flow_of_an_ideal_gas(gradient, ambient):
    """The isothermal flow of an ideal gas, whose pressure p has d(p dp/dx)/dx = 0, over that of a liquid."""
    scene = of_fluid(1.2, 1.8e-5, gradient, ambient_pressure=f"{ambient} Pa")
    drop = gradient * 100e-6
    gas = ((ambient + drop) ** 2 - ambient**2) / 2
    (reason,) = (one for one in KIND.outside(scene, None, None) if "is a gas" in one)
    assert f"{drop / ambient:.3g} times the ambient pressure" in reason
    assert f"at the outlet leaks {gas / (drop * ambient):.4g} times" in reason
    assert f"at the inlet {gas / (drop * (ambient + drop)):.4g} times" in reason


def test_a_liquid_and_a_gas_of_a_small_pressure_drop_are_inside():
    assert KIND.outside(of_fluid(870, 0.01, 1e8), None, None) == ()
    assert KIND.outside(of_fluid(1.2, 1.8e-5, 1e5), None, None) == ()


def test_a_result_says_that_its_liquid_is_a_gas():
    scene, model = of_fluid(1.2, 1.8e-5, 1e7), find("rough_gap", "homogenized")
    result = with_errors(model.solve(scene), scene, model, models("rough_gap"))
    assert any("is a gas" in one for one in result.outside)
