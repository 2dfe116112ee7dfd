"""Seals: the rungs against closed forms and each other, and what leaks exactly nothing."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.special import ndtr

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.ladder import find
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.ladder.model import Effect, best, ladder, of_kind, one_effect_away
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.ladder.store import load, save
from roughfilm.rom.seal.kind import KIND
from roughfilm.rom.seal.leakage.effective_medium import SEALING_AREA, effective_medium
from roughfilm.rom.seal.leakage.passage import dimensionless, mass_flow

RUNGS = of_kind(ladder(rom), "seal")
ROUGH = {
    "kind": "self_affine",
    "size": ["40 um", "40 um"],
    "points": [64, 64],
    "seed": 20071,
    "hurst": 0.8,
    "roll_off": "10 um",
    "cut_off": "5 um",
    "rms_height": "0.1 um",
}


def seal(surface=ROUGH, *, pressure="50 kPa", direction="x", hardness=None, **geometry):
    solid = {"modulus": "10 MPa", "poisson": 0.5}
    return read_scene(
        {
            "name": "test",
            "kind": "seal",
            "geometry": {"surface": surface, **geometry},
            "solid": solid if hardness is None else solid | {"hardness": hardness},
            "load": {"pressure": pressure},
            "liquid": {"density": "1000 kg/m^3", "viscosity": "1 mPa*s"},
            "flow": {"pressure_drop": "1 MPa", "length": "1 mm", "direction": direction},
        }
    )


def values(name, scene, **options):
    found = find("seal", name).solve(scene, Request(**options))
    return {quantity: entry.value for quantity, entry in found.quantities.items()}


def test_the_lattice_of_seals():
    assert [model.name for model in RUNGS] == ["effective_medium", "homogenized_leakage", "direct_leakage"]
    assert {(a.name, b.name): e for a in RUNGS for b, e in one_effect_away(a, RUNGS)} == {
        ("homogenized_leakage", "direct_leakage"): Effect.FINITE_WAVES
    }
    assert best(RUNGS).name == "direct_leakage"


@pytest.mark.parametrize("model", RUNGS, ids=lambda model: model.name)
def test_contract(model, tmp_path):
    scene = seal()
    seen = []
    resolution = model.resolutions_of(scene)[1]
    result = model.solve(scene, Request(resolution=resolution), progress=lambda done, words: seen.append((done, words)))
    assert set(result.quantities) == {
        "leakage_per_width",
        "sealed",
        "permeability",
        "area_fraction",
        "smooth_leakage",
        "dimensionless_leakage",
        "mean_gap",
        "rms_height",
    }
    assert all(math.isfinite(quantity.value) for quantity in result.quantities.values())
    numbers = result.numerics
    assert 0 <= numbers.residual < 1e-3
    assert min(numbers.cpu_s, numbers.wall_s, numbers.iterations) > 0
    assert (numbers.resolution, numbers.degrees_of_freedom) == (resolution, resolution**2)
    assert result.provenance["keeps"] == sorted(model.keeps)
    assert result.provenance["sources"] == list(model.sources)
    assert model.applies(scene).applies
    assert model.applies(scene).reason
    assert model.cost(scene, 64) > 0
    assert all(0 <= done <= 1 for done, _ in seen)
    save(result, tmp_path / "r.h5")
    assert load(tmp_path / "r.h5").quantities == result.quantities
    with pytest.raises(InputError, match=r"^scheme: got"):
        model.solve(scene, Request(scheme="upwind"))
    with pytest.raises(InputError, match=r"^processes: got"):
        model.solve(scene, Request(processes=2))


def test_a_smooth_gap_leaks_as_a_slit_does():
    """ρ h³ Δp/(12ηL): water through 1 µm by 1 MPa over 1 mm is 0.3 kg/h for each metre."""
    leak = mass_flow(1e-18, density=1e3, viscosity=1e-3, pressure_drop=1e6, length=1e-3)
    assert leak * 3600 == pytest.approx(0.3, rel=1e-12)
    assert dimensionless(8e-18, 1e-6) == pytest.approx(8.0, rel=1e-12)


def test_units_are_those_of_the_scene():
    numbers = values("direct_leakage", seal())
    assert numbers["leakage_per_width"] == pytest.approx(
        1e3 * numbers["permeability"] * 1e6 / (12 * 1e-3 * 1e-3), rel=1e-12
    )
    assert numbers["dimensionless_leakage"] == pytest.approx(
        numbers["permeability"] / numbers["rms_height"] ** 3, rel=1e-12
    )
    assert numbers["smooth_leakage"] * numbers["dimensionless_leakage"] == pytest.approx(numbers["leakage_per_width"])


def test_the_longer_a_seal_the_nearer_is_averaging():
    """Its ends take the same off the resistance of any number of periods: (1 − A/K) n is what it is of one."""

    def ends(count):
        drive = seal().flow.model_copy(update={"length": count * 40e-6})
        scene = seal().model_copy(update={"flow": drive})
        direct, averaged = (values(name, scene)["permeability"] for name in ("direct_leakage", "homogenized_leakage"))
        return count * (1 - averaged / direct)

    one, two, ten = (ends(count) for count in (1, 2, 10))
    assert one > 0.1
    assert two == pytest.approx(one, rel=0.05)
    assert ten == pytest.approx(one, rel=0.05)


def test_the_cost_of_a_direct_solution_grows_with_the_length():
    direct, averaged = (find("seal", name) for name in ("direct_leakage", "homogenized_leakage"))
    assert direct.cost(seal(), 64) == pytest.approx(25 * averaged.cost(seal(), 64))


def test_directions_are_those_of_the_surface(tmp_path):
    ridges = 1e-7 * np.repeat(np.cos(2 * np.pi * np.arange(32) / 16)[:, None], 32, axis=1)
    path = tmp_path / "ridges.npy"
    np.save(path, ridges)
    scenes = {axis: seal(str(path), spacing="1 um", direction=axis, pressure="10 kPa") for axis in "xy"}
    for name in ("direct_leakage", "homogenized_leakage"):
        assert values(name, scenes["x"])["sealed"] == 1
        assert values(name, scenes["x"])["leakage_per_width"] == 0
        assert values(name, scenes["y"])["sealed"] == 0
    along = [values(name, scenes["y"])["permeability"] for name in ("direct_leakage", "homogenized_leakage")]
    assert along[0] == pytest.approx(along[1], rel=1e-6)


def test_full_contact_is_sealed_and_stated_as_a_number():
    for name in ("direct_leakage", "homogenized_leakage"):
        result = values(name, seal(pressure="100 MPa"))
        assert result["sealed"] == 1.0
        assert result["leakage_per_width"] == result["permeability"] == result["mean_gap"] == 0.0
    assert values("effective_medium", seal(pressure="100 MPa"))["sealed"] == 1.0


def test_a_flat_surface_is_sealed(tmp_path):
    np.save(tmp_path / "flat.npy", np.zeros((16, 16)))
    scene = seal(str(tmp_path / "flat.npy"), spacing="1 um")
    assert values("direct_leakage", scene)["sealed"] == 1
    medium = find("seal", "effective_medium")
    assert not medium.applies(scene).applies
    with pytest.raises(InputError, match="flat"):
        medium.solve(scene)


@pytest.fixture(scope="module")
def towards_sealing():
    """Scenes and results of ``direct_leakage`` from 0.1 to 0.5 E* g'."""
    scenes = [seal(pressure=f"{part * seal().pressure_unit} Pa") for part in np.geomspace(0.1, 0.5, 33)]
    return [(scene, find("seal", "direct_leakage").solve(scene)) for scene in scenes]


def test_errors_are_relative_to_the_answer_near_sealing(towards_sealing):
    """Where the uncertainty is above half the leakage no model is within 20 %; with light loads one is."""
    for _, result in towards_sealing:
        leakage = result["leakage_per_width"]
        if leakage.value > 0:
            assert KIND.scale_of(result, "leakage_per_width") == leakage.value
    scene, _ = next(
        (scene, one)
        for scene, one in towards_sealing
        if one["permeability"].uncertainty > 0.5 * one["permeability"].value
    )
    assert advise(scene, RUNGS, quantity="leakage_per_width", within=0.2).chosen is None
    assert advise(seal(pressure="10 kPa"), RUNGS, quantity="leakage_per_width", within=0.2).chosen is not None


def test_a_sealed_gap_that_is_open_on_coarser_grids_has_an_uncertainty(towards_sealing):
    """Near sealing every second node of some sealed gaps leaves a path; at 0.5 E* g' all grids are sealed."""
    leakages = [result["leakage_per_width"] for _, result in towards_sealing if result["sealed"].value]
    assert {one.value for one in leakages} == {0.0}
    assert max(one.uncertainty for one in leakages) > 1e-15
    assert leakages[-1].uncertainty < 1e-17


@pytest.mark.parametrize("name", ["homogenized_leakage", "direct_leakage"])
def test_waves_that_a_grid_lacks_count_in_the_uncertainty(name):
    """With waves of 2.2 pixels of the coarser grid; the finer grid has all of them."""
    rough = ROUGH | {"cut_off": "1.4 um", "hurst": 0.5}
    scene = seal(rough, pressure="60 kPa")
    coarse, fine = (find("seal", name).solve(scene, Request(resolution=n))["permeability"] for n in (32, 64))
    assert abs(coarse.value - fine.value) <= coarse.uncertainty
    sealed = find("seal", name).solve(seal(rough, pressure="400 kPa"), Request(resolution=32))
    assert sealed["permeability"].value == 0
    assert sealed["permeability"].uncertainty is None
    assert any("raise the resolution" in warning for warning in sealed.warnings)


def test_the_effective_medium_says_where_it_does_not_hold():
    """It has an uncertainty, which contains the flow through the gap, for light loads without a lay only."""
    light = seal(pressure="20 kPa")
    found, true = (find("seal", name).solve(light)["permeability"] for name in ("effective_medium", "direct_leakage"))
    assert abs(found.value - true.value) < found.uncertainty < found.value
    lay = {"kind": "gaussian", "correlation_length": "2 um", "anisotropy": 4.0, "rms_height": "0.1 um"}
    lay |= {key: ROUGH[key] for key in ("size", "points", "seed")}
    for scene, words in ((seal(pressure="150 kPa"), "mean sealing load"), (seal(lay, pressure="10 kPa"), "has a lay")):
        result = find("seal", "effective_medium").solve(scene)
        assert result["permeability"].uncertainty is None
        assert words in result.warnings[0]


def test_a_softer_limit_of_pressure_seals_sooner():
    soft, elastic = (values("direct_leakage", seal(hardness=hardness)) for hardness in ("150 kPa", None))
    assert soft["area_fraction"] > elastic["area_fraction"]
    assert soft["permeability"] < elastic["permeability"]


def test_a_scene_is_read_back_as_it_was_written():
    scene = seal(hardness="1 MPa", direction="y")
    assert read_scene(scene_entries(scene)) == scene


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ({"direction": "z"}, "scene.flow.direction"),
        ({"length": "0 m"}, "scene.flow.length"),
        ({"pressure_drop": "-1 Pa"}, "scene.flow.pressure_drop"),
        ({"lenght": "1 mm"}, "did you mean 'length'"),
    ],
)
def test_bad_keys_are_named(entries, words):
    scene = scene_entries(seal())
    scene["flow"] |= entries
    with pytest.raises(InputError, match=words):
        read_scene(scene)


def test_a_bad_joint_is_warned_of(tmp_path):
    x = np.arange(64) / 64
    heights = 1e-6 * (np.cos(2 * np.pi * 7.5 * x)[:, None] + 0.2 * np.cos(2 * np.pi * 5 * x)[None, :])
    heights[-4:] = 2e-6
    np.save(tmp_path / "stepped.npy", heights)
    result = find("seal", "direct_leakage").solve(
        seal(str(tmp_path / "stepped.npy"), spacing="1 um", pressure="200 kPa")
    )
    assert any("is not periodic" in warning for warning in result.warnings)
    assert not find("seal", "direct_leakage").solve(seal()).warnings


@pytest.fixture(scope="module")
def spectrum():
    heights = self_affine(
        size=(4e-5, 4e-5), points=(128, 128), seed=307, hurst=0.8, roll_off=1e-5, cut_off=2.5e-6, rms_height=1e-7
    ).heights
    return wave_power(heights, (4e-5 / 128,) * 2)


def test_the_gaps_of_the_medium_and_its_contact_fill_the_area(spectrum):
    for pressure in (1e3, 3e4, 3e5):
        found = effective_medium(spectrum, composite_modulus=1.3e7, load=pressure)
        assert found.fractions.sum() + found.area_fraction == pytest.approx(1.0, abs=1e-9)
        mean = (found.gaps * found.fractions).sum()
        assert found.mean_gap * (1 - 1e-9) <= mean <= found.mean_gap + math.sqrt(2 / math.pi) * 1e-7


def test_the_gaps_of_a_medium_hardly_pressed_are_gaussian_as_its_heights_are(spectrum):
    found = effective_medium(spectrum, composite_modulus=1.3e7, load=100.0)
    order = np.argsort(found.gaps)
    below, gaps = np.cumsum(found.fractions[order]), found.gaps[order]
    assert np.abs(below - ndtr((gaps - found.mean_gap) / 1e-7)).max() < 0.02


def test_the_medium_leaks_less_the_harder_it_is_pressed_and_seals_at_its_threshold(spectrum):
    loads = np.geomspace(1e3, 2e6, 30)
    found = [effective_medium(spectrum, composite_modulus=1.3e7, load=float(pressure)) for pressure in loads]
    leaks = [one.permeability for one in found]
    assert all(a > b or a == b == 0 for a, b in pairwise(leaks))
    assert [one.sealed for one in found] == [one.area_fraction >= SEALING_AREA for one in found]
    assert all(one.residual < 1e-9 for one in found)
    assert found[-1].sealed


def test_a_medium_of_one_gap_is_a_smooth_gap():
    """Under a load that hardly touches, roughness of vanishing height leaves a gap that is the same everywhere."""
    wave = np.cos(2 * np.pi * np.arange(32) / 32)
    power = wave_power(1e-7 * np.add.outer(wave, wave), (1e-6, 1e-6))
    found = effective_medium(power, composite_modulus=1e7, load=1e-25)
    assert found.mean_gap > 15 * 1e-7
    assert found.permeability == pytest.approx(found.mean_gap**3, rel=0.03)


def test_a_direction_that_is_sealed_has_nothing_left_to_solve(tmp_path):
    """Ridges across seal; what the solver leaves open along them is no residual of that."""
    path = tmp_path / "ridges.npy"
    noise = np.random.default_rng(20071).standard_normal((16, 16))
    np.save(path, 1e-7 * np.where((np.arange(16) % 8 < 2)[:, None], 9.0, noise))
    across, along = (seal(str(path), spacing="1 um", direction=direction, pressure="0.5 MPa") for direction in "xy")
    model = find("seal", "homogenized_leakage")
    sealed, open_ = model.solve(across), model.solve(along)
    assert (sealed.quantities["sealed"].value, open_.quantities["sealed"].value) == (1, 0)
    assert sealed.numerics.residual <= sealed.numerics.tolerance


@pytest.mark.parametrize("name", ["homogenized_leakage", "direct_leakage"])
def test_an_answer_without_error_bar_says_so(name, tmp_path):
    path = tmp_path / "odd.npy"
    np.save(path, 1e-7 * np.random.default_rng(20071).standard_normal((6, 6)))
    found = find("seal", name).solve(seal(str(path), spacing="1 um", pressure="1 kPa"))
    assert found.quantities["leakage_per_width"].uncertainty is None
    assert found.quantities["permeability"].uncertainty is None
    assert any("no coarser grid" in warning for warning in found.warnings)


@pytest.mark.parametrize("model", RUNGS, ids=lambda model: model.name)
def test_a_gas_in_a_seal_is_not_taken_as_a_liquid_in_silence(model):
    """An isothermal gas leaks ρ K (p₁² - p₂²)/(2 η L p) with the density ρ at the pressure p."""
    helium = scene_entries(seal()) | {"liquid": {"density": "0.166 kg/m^3", "viscosity": "19.6 uPa*s"}}
    for drop, ratios in ((2e5, (1 + 2e5 / 2 / 101325, (2 * 101325 + 2e5) / 2 / (101325 + 2e5))), (100.0, None)):
        scene = read_scene({**helium, "flow": {**helium["flow"], "pressure_drop": f"{drop} Pa"}})
        found = model.solve(scene, Request(resolution=32 if model.name != "effective_medium" else None))
        if ratios is None:
            assert found.outside == ()
            continue
        (reason,) = found.outside
        assert f"{ratios[0]:.4g} times as much, with this density at the inlet {ratios[1]:.4g} times" in reason
        assert advise(scene, [model], quantity="leakage_per_width", within=0.5).chosen is None


def test_a_leakage_beyond_the_laminar_limit_promises_nothing():
    thin = scene_entries(seal(pressure="20 kPa")) | {"liquid": {"density": "1000 kg/m^3", "viscosity": "1 nPa*s"}}
    found = find("seal", "effective_medium").solve(read_scene(thin))
    number = found["leakage_per_width"].value / 1e-9
    assert number > 1300
    assert found.outside == (
        f"Re = ρq/η = {number:.4g} exceeds 1300, above which the flow that pressure drives is turbulent",
    )


def test_pressures_beyond_linear_elasticity_are_named_and_their_mean_is_outside_the_range_of_a_seal():
    """A wave is pressed flat at the mean pressure W = π E* Δ/λ, with the peak 2 W (Westergaard 1939)."""
    wave = {"kind": "sinusoid", "size": ["64 um", "8 um"], "points": [64, 8], "wavelength_x": "64 um"}
    stiffness = 10e6 / (1 - 0.25)
    for slope, peak, mean in ((0.1, True, True), (0.05, True, False), (0.045, False, False)):
        load = 1.0001 * math.pi * slope * stiffness
        scene = seal({**wave, "amplitude": f"{slope * 64} um"}, pressure=f"{load!r} Pa", direction="y")
        found = find("seal", "homogenized_leakage").solve(scene, Request())
        assert any("peak pressure" in one and "0.3 E*" in one for one in found.warnings) == peak
        assert any("mean pressure of the contacts" in one and "0.3 E*" in one for one in found.outside) == mean
