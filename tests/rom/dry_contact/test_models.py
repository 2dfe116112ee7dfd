"""Rungs of a dry contact: closed forms, limits in which they agree, and the contract that all of them keep."""

import math

import numpy as np
import pytest

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.dry_contact.kind import KIND
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.store import as_bytes, load

RUNGS = of_kind(ladder(rom), "dry_contact")
KNOWN = {
    "area_fraction",
    "area_fraction_pixel",
    "plastic_fraction",
    "mean_gap",
    "approach",
    "pressure_max",
    "mean_contact_pressure",
    "rms_height",
}


def solved(name, scene, **options):
    return find("dry_contact", name).solve(scene, Request(**options))


def value(result, quantity):
    return result.quantities[quantity].value


def wave(points=256, amplitude=1e-7):
    return {
        "kind": "sinusoid",
        "size": ["100 um", "100 um"],
        "points": [points, 8],
        "amplitude": f"{amplitude!r} m",
        "wavelength_x": "100 um",
    }


def binned(result):
    """Part of the nominal area with pressures in the bins, and the load they carry, Pa."""
    edges, density = (result.fields[name].values for name in ("bin_edges", "pressure_density"))
    parts = density * np.diff(edges)
    return parts.sum(), (parts * (edges[1:] + edges[:-1]) / 2).sum()


@pytest.mark.parametrize("model", RUNGS, ids=lambda model: model.name)
def test_contract(model, make_contact, tmp_path):
    scene = make_contact(hardness=3e9)
    seen = []
    resolution = model.resolutions_of(scene)[1]
    result = model.solve(scene, Request(resolution=resolution), progress=lambda done, words: seen.append((done, words)))
    assert set(result.quantities) <= KNOWN
    assert {"area_fraction", "plastic_fraction", "mean_contact_pressure", "rms_height"} <= set(result.quantities)
    assert {"bin_edges", "pressure_density"} <= set(result.fields)
    numbers = result.numerics
    assert 0 <= numbers.residual <= numbers.tolerance
    assert min(numbers.wall_s, numbers.degrees_of_freedom, numbers.iterations) > 0
    assert numbers.resolution == resolution
    assert result.provenance["keeps"] == sorted(model.keeps)
    assert result.provenance["sources"] == list(model.sources)
    assert result.provenance["heights"]["used"] == [resolution, resolution]
    assert all(0 <= done <= 1 for done, _ in seen)
    assert model.applies(scene).reason
    assert model.cost(scene, resolution) > 0
    assert value(result, "mean_contact_pressure") * value(result, "area_fraction") == pytest.approx(1e8)
    for bad, words in (({"scheme": "upwind"}, "scheme: got"), ({"processes": 2}, "processes: got 2")):
        with pytest.raises(InputError, match=words):
            model.solve(scene, Request(**bad))
    for size in (4, 65):
        with pytest.raises(InputError, match=f"^resolution: got {size}; {model.name} takes 8 to 64 points"):
            model.solve(scene, Request(resolution=size))
    with pytest.raises(InputError, match=r"^tolerance: got 2"):
        model.solve(scene, Request(tolerance=2))
    (tmp_path / "r.h5").write_bytes(as_bytes(result))
    assert load(tmp_path / "r.h5").quantities == result.quantities


def test_a_wave_under_load_is_that_of_westergaard(make_contact):
    """sin²(πa/L) = P/p*, p* = π E* D/L for h = D cos(2πx/L); A/A0 = 2a/L."""
    full = math.pi * 1e11 * 1e-7 / 1e-4
    result = solved("elastic", make_contact(wave(), pressure=0.3 * full))
    half = math.asin(math.sqrt(0.3))
    assert value(result, "area_fraction_pixel") == pytest.approx(2 * half / math.pi, abs=2 / 256)
    angle = half
    gap = 2e-7 * (math.cos(angle) ** 2 / 2 + math.sin(angle) ** 2 * math.log(math.sin(angle)))
    assert value(result, "mean_gap") == pytest.approx(gap, rel=2e-3)


def test_a_soft_surface_is_its_bearing_area(make_contact):
    scene = make_contact(pressure=3e6, hardness=1e7)
    exact, truncated = (solved(name, scene) for name in ("elastic_plastic", "bearing_area"))
    assert value(truncated, "area_fraction") == pytest.approx(0.3)
    assert value(exact, "area_fraction_pixel") == pytest.approx(0.3, rel=0.01)
    assert value(exact, "mean_gap") == pytest.approx(value(truncated, "mean_gap"), rel=0.01)


def test_the_hardness_is_what_parts_elastic_from_elastic_plastic(make_contact):
    elastic, both = (solved(name, make_contact()) for name in ("elastic", "elastic_plastic"))
    assert elastic.quantities == both.quantities
    scene = make_contact(hardness=3e9)
    elastic, both = (solved(name, scene) for name in ("elastic", "elastic_plastic"))
    assert value(elastic, "pressure_max") > 3e9 == value(both, "pressure_max")
    assert value(both, "area_fraction") > value(elastic, "area_fraction")
    assert value(elastic, "plastic_fraction") == 0 < value(both, "plastic_fraction")


@pytest.mark.parametrize("hardness", [None, 3e9])
@pytest.mark.parametrize("model", RUNGS, ids=lambda model: model.name)
def test_pressures_add_up_to_area_and_load(model, hardness, make_contact):
    scene = make_contact(hardness=hardness, pressure=2e8)
    if not model.applies(scene).applies:
        assert (model.name, hardness) == ("bearing_area", None)
        return
    result = model.solve(scene)
    area, load = binned(result)
    plastic = value(result, "plastic_fraction")
    whole = result.quantities.get("area_fraction_pixel", result.quantities["area_fraction"]).value
    assert area + plastic == pytest.approx(whole, rel=1e-3)
    assert load + plastic * (hardness or 0) == pytest.approx(2e8, rel=0.01)


def test_bins_are_those_of_the_scene_for_all(make_contact):
    scene = make_contact(hardness=3e9)
    edges = {result.fields["bin_edges"].values.tobytes() for result in (model.solve(scene) for model in RUNGS)}
    assert len(edges) == 1


def test_persson_is_the_error_function_of_the_load(make_contact):
    """A/A0 = erf(√2 P/(E* g')) for an elastic solid."""
    result = solved("persson", make_contact(pressure=2e9))
    assert value(result, "area_fraction") == pytest.approx(math.erf(math.sqrt(2) * 0.2), rel=1e-9)
    assert "mean_gap" in result.quantities


def test_coarser_grids_of_a_smooth_surface_say_the_same(make_contact):
    """Its waves are 8 points long and more: half the points hold them all."""
    scene = make_contact(wave(512), pressure=1e7)
    fine, coarse = (solved("elastic", scene, resolution=n) for n in (512, 128))
    assert coarse.provenance["heights"] == {**fine.provenance["heights"], "used": [128, 2]}
    assert value(coarse, "mean_gap") == pytest.approx(value(fine, "mean_gap"), rel=1e-3)
    assert value(coarse, "rms_height") == pytest.approx(1e-7 / math.sqrt(2))


def test_a_flat_surface_is_all_contact(make_contact, tmp_path):
    np.save(tmp_path / "flat.npy", np.zeros((16, 16)))
    scene = make_contact(tmp_path / "flat.npy", spacing="1 um", hardness=1e9)
    for name in ("elastic", "elastic_plastic"):
        result = solved(name, scene)
        assert (value(result, "area_fraction"), value(result, "mean_gap")) == (1, 0)
        assert any("one period" in warning for warning in result.warnings)
    for name in ("persson", "greenwood_williamson"):
        fits = find("dry_contact", name).applies(scene)
        assert not fits.applies
        assert "flat surface" in fits.reason


def test_rungs_say_where_they_leave_their_range(make_contact):
    heavy = solved("greenwood_williamson", make_contact(pressure=4e8))
    assert any("out of its range" in warning for warning in heavy.warnings)
    assert "out of its range" in find("dry_contact", "greenwood_williamson").applies(make_contact(pressure=4e8)).reason
    beyond = find("dry_contact", "greenwood_williamson").applies(make_contact(pressure=2e9))
    assert not beyond.applies
    assert "got 2e+09 Pa; it must be" in beyond.reason
    assert "P/H = 0.05" in find("dry_contact", "elastic").applies(make_contact(hardness=2e9)).reason
    assert "plasticity index E* g'/H = 5" in find("dry_contact", "elastic").applies(make_contact(hardness=2e9)).reason
    assert "give a finite one" in find("dry_contact", "bearing_area").applies(make_contact()).reason


@pytest.mark.parametrize("resolution", [16, 32])
def test_a_light_contact_states_what_a_coarse_grid_misses_of_its_highest_points(resolution, make_contact):
    scene = make_contact(pressure=5e6)
    coarse, fine = (solved("elastic", scene, resolution=points) for points in (resolution, 64))
    error = abs(value(coarse, "mean_gap") - value(fine, "mean_gap"))
    uncertainty = coarse.quantities["mean_gap"].uncertainty
    assert 0.1 * uncertainty < error < uncertainty


def test_persson_gives_a_peak_pressure_only_where_some_contact_is_plastic(make_contact):
    """The mean over all surfaces has a plastic area at any load; on this surface no pressure reaches the hardness."""
    hard, soft = make_contact(hardness=2e10), make_contact(hardness=1e9, pressure=3e8)
    assert value(solved("elastic_plastic", hard), "pressure_max") < 1.5e10
    found = solved("persson", hard)
    assert value(found, "plastic_fraction") > 0
    assert "pressure_max" not in found.quantities
    assert value(solved("persson", soft), "pressure_max") == value(solved("elastic_plastic", soft), "pressure_max")


@pytest.mark.parametrize("name", ["persson", "greenwood_williamson"])
def test_theories_of_gaussian_surfaces_warn_of_plateaus(name, make_contact, tmp_path):
    heights = make_contact().surface().heights
    heights = np.minimum(heights, 0.3 * heights.std())
    np.save(tmp_path / "worn.npy", heights)
    scene = make_contact(tmp_path / "worn.npy", spacing="1.5625 um", pressure=2e7)
    skewness = np.mean((heights - heights.mean()) ** 3) / heights.std() ** 3
    found = solved(name, scene)
    assert any(f"the skewness of the heights is {skewness:.2g}" in warning for warning in found.warnings)
    assert "out of its range" in find("dry_contact", name).applies(scene).reason
    assert not any("skewness" in warning for warning in solved(name, make_contact(pressure=2e7)).warnings)


@pytest.mark.parametrize("name", ["persson", "elastic"])
def test_pressures_that_are_all_alike_fall_into_bins(name, make_contact):
    """Full contact at forty times what the roughness adds: nearly all pressures would lie within one bin from 0."""
    scene = make_contact(wave(64, 1e-10) | {"points": [64, 64]}, pressure=2e7)
    assert scene.load.pressure > 20 * scene.pressure_unit
    area, load = binned(solved(name, scene))
    assert area == pytest.approx(1, abs=1e-4)  # four deviations lie within the bins
    assert load == pytest.approx(2e7, rel=1e-3)


@pytest.mark.parametrize("name", ["elastic", "elastic_plastic"])
def test_a_contact_states_its_uncertainty_by_the_pixels_on_its_own_grid_only(name, make_contact):
    """A coarser grid omits waves, whose effect its pixels do not show; the mean gap changes by about their height."""
    scene = make_contact(hardness=2e9)
    result = solved(name, scene)
    for quantity in ("area_fraction", "mean_contact_pressure", "mean_gap", "approach"):
        assert 0 < result.quantities[quantity].uncertainty < 0.5 * value(result, quantity), quantity
    assert result.quantities["area_fraction_pixel"].uncertainty is None
    coarser = solved(name, scene, resolution=max(scene.surface().shape) // 8)
    stated = {quantity for quantity, one in coarser.quantities.items() if one.uncertainty is not None}
    assert stated == {"mean_gap"}
    error = abs(value(coarser, "mean_gap") - value(result, "mean_gap"))
    assert 0.02 * coarser.quantities["mean_gap"].uncertainty < error < coarser.quantities["mean_gap"].uncertainty


def test_an_elastic_contact_above_the_hardness_warns_with_the_area(make_contact):
    soft, hard = (solved("elastic", make_contact(hardness=hardness)) for hardness in (2e9, 1e13))
    above = np.mean(soft.fields["pressure"].values > 2e9)
    assert above > 0
    assert any(f"exceeds the hardness on {above:.3g} of the nominal area" in warning for warning in soft.warnings)
    assert not hard.warnings
    assert not solved("elastic_plastic", make_contact(hardness=2e9)).warnings


@pytest.mark.parametrize(("hardness", "beyond"), [(None, True), (3.2e10, True), (2.9e10, False)])
def test_a_peak_pressure_beyond_linear_elasticity_is_outside_the_range(make_contact, hardness, beyond):
    """A wave with Δ/λ = 0.05 is pressed flat at W = π E* Δ/λ, with the peak 2 W = 0.314 E* (Westergaard 1939)."""
    name, load = ("elastic" if hardness is None else "elastic_plastic"), 1.0001 * np.pi * 0.05 * 1e11
    scene = make_contact(wave(64, amplitude=5e-6), modulus=1e11, pressure=load, hardness=hardness)
    outside = solved(name, scene).outside
    assert bool(outside) == beyond
    assert all("exceeds 0.3 E* = 3e+04 MPa, beyond which linear elasticity does not hold" in one for one in outside)


def test_a_mean_pressure_beyond_linear_elasticity_is_outside_the_range_before_the_solution(make_contact):
    scene = make_contact(modulus=1e11, pressure=3.1e10)
    elastic, area = (find("dry_contact", name) for name in ("elastic", "bearing_area"))
    assert "mean pressure 3.1e+04 MPa exceeds" in KIND.outside(scene, elastic, None)[0]
    assert KIND.outside(scene, area, None) == ()
