"""The report on rough gaps: closed forms, laws found again from flows that obey them, verdicts, and the page."""

import csv
import json
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest
from batches import Threads

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.sinusoids import sinusoid
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from scripts.studies import runs as studies_runs
from scripts.studies.rough_gaps import __main__ as rough_gaps
from scripts.studies.rough_gaps import inertia as rough_gaps_inertia
from scripts.studies.rough_gaps.claims import judge, words
from scripts.studies.rough_gaps.data import asked_of, compare, resolved, values_of
from scripts.studies.rough_gaps.map import ModelErrors, serves
from scripts.studies.rough_gaps.range_of_validity import ReynoldsError, SurfaceValidity, coarse, off, reach
from scripts.studies.rough_gaps.scenes import over_random, over_waves, peak_over_rms
from scripts.studies.rough_gaps.study import RoughGapStudy, bounds_hold, mesh_meets_exact
from scripts.studies.rough_gaps.waves import Waves, bare_coefficient, thin_ratios, waves
from scripts.studies.runs import ModelRun, answers

DESCRIPTION = """
kind = "gaussian"
size = ["40 um", "40 um"]
points = [32, 32]
seed = 20071
rms_height = "0.2 um"
correlation_length = "8 um"
"""

SMALL = {
    "amplitudes": (0.3,),
    "lengths": (5.0,),
    "drawn": (4.0, 20.0),
    "roughnesses": (0.2,),
    "wavelengths": (5.0,),
    "slopes": (0.05, 0.3),
    "map_lengths": (5.0, 20.0),
    "points": 32,
    "thicknesses": (10.0,),
    "mesh": False,
}


@contextmanager
def here(_count, _scratch):
    with Threads(1) as executor:
        yield executor


@pytest.fixture(scope="module")
def base():
    return find("rough_gap", "smooth_gap").solve(over_waves(0.3, 5.0), Request(resolution=32))


def stated(base, scale=1.0, **numbers):
    return replace(base, quantities={name: Quantity(value=scale * one, unit="1") for name, one in numbers.items()})


@pytest.mark.parametrize("amplitude", [0.1, 0.3, 0.6])
def test_the_closed_forms_of_waves_are_their_integrals(amplitude):
    x = 2 * np.pi * np.arange(400) / 400
    h, square = 1 + amplitude * np.cos(x), (amplitude * np.sin(x)) ** 2
    m1, m2, m3 = ((h**-n).mean() for n in (1, 2, 3))
    thin = thin_ratios(amplitude)
    assert [thin[name] for name in ("A11", "A22", "B1", "friction")] == pytest.approx(
        [1 / m3, (h**3).mean(), m2 / m3, 4 * m1 - 3 * m2**2 / m3]
    )
    assert bare_coefficient(amplitude) == pytest.approx(0.8 * (square / h**3).mean() / m3 / square.mean())
    along = (square * h**3).mean() / (h**3).mean() / square.mean()
    assert bare_coefficient(amplitude, across=False) == pytest.approx(along)


def test_exact_flow_over_long_waves_follows_the_bare_law():
    amplitude, length = 0.3, 30.0
    flow, thin = sinusoidal_ridge_flow(amplitude, length, tolerance=1e-7), thin_ratios(amplitude)
    square = (2 * np.pi * amplitude / length) ** 2 / 2
    assert (1 - flow.across / thin["A11"]) / square == pytest.approx(bare_coefficient(amplitude), rel=0.02)
    assert (1 - flow.along / thin["A22"]) / square == pytest.approx(bare_coefficient(amplitude, across=False), rel=0.02)


@pytest.mark.parametrize("lay", [False, True])
def test_random_gaps_have_the_roughness_and_the_wavelength_asked_for(lay):
    scene = over_random(0.2, 5.0, lay=lay, points=48)
    assert scene.rms_height / scene.mean_gap == pytest.approx(0.2)
    assert 1 / scene.gap_over_wavelength == pytest.approx(5.0)
    heights = scene.surface().heights
    along, across = (np.diff(heights, axis=axis).std() for axis in (0, 1))
    assert (across / along > 1.5) == lay


def test_meshes_that_converge_are_extrapolated_over_reynolds_on_their_nodes(base):
    scene, grids, part = over_waves(0.3, 5.0), (32, 48, 64), 0.93
    thin = thin_ratios(0.3)
    found = {one.key: stated(base, part + 2 / one.resolution**2, **thin) for one in asked_of(scene, grids)}
    for name, one in resolved(scene, grids, found).items():
        assert one.value == pytest.approx(part, abs=2e-5), name
        assert one.order == pytest.approx(2, abs=0.05)
    assert resolved(scene, grids, {}) == {}


def law(scene, passed):
    reynolds_number = scene.reynolds_number * passed
    return 6e-4 * (reynolds_number * scene.rms_slope) ** 2 / (1 + 0.3 * reynolds_number * scene.gap_over_wavelength)


def test_the_beginning_of_inertia_is_found_again(base):
    shapes, reynolds = ((0.1, 5.0), (0.3, 5.0), (0.5, 20.0)), (3.0, 10.0, 30.0)
    found = {}
    for one in rough_gaps_inertia.asked(shapes, reynolds, {}):
        passed = 1 - (one.scene.rms_height / one.scene.mean_gap) ** 2
        lost = law(one.scene, passed)
        found[one.key] = stated(base, passed * (1 - lost * (one.model == "navier_stokes")), A11=1.0)
    inertia = rough_gaps_inertia.inertia(found, shapes, reynolds, {})
    (found_law,) = inertia.laws
    assert found_law.group == "waves"
    assert found_law.coefficient == pytest.approx(6e-4, rel=1e-2)
    assert found_law.saturation == pytest.approx(0.3, rel=2e-2)
    assert found_law.worst == pytest.approx(1, abs=1e-2)
    crossings = inertia.crossings(0.01)
    assert "a = 0.1, L = 5" not in crossings
    assert crossings
    for name, (_, measure) in crossings.items():
        own = next(one for one in inertia.flows if one.name == name)
        there = 6e-4 * measure**2 / (1 + 0.3 * measure / own.slope / own.wavelength)
        assert there == pytest.approx(0.01, rel=0.05)


def test_reynolds_over_ridges_is_off_by_what_the_exact_flow_says():
    amplitude, length = 0.3, 10.0
    size = (length * 1e-6, length * 1e-6)
    ridges = sinusoid(size=size, points=(64, 32), amplitude=amplitude * 1e-6, wavelength_x=size[0])
    found = off(ridges, 1 / (amplitude / np.sqrt(2)))
    flow, thin = sinusoidal_ridge_flow(amplitude, length, tolerance=1e-6), thin_ratios(amplitude)
    excess = {"A11": thin["A11"] / flow.across - 1, "A22": thin["A22"] / flow.along - 1}
    assert found.direction == 1
    assert abs(found.error - excess["A22"]) < found.bar < 0.2 * found.error
    assert found.error < found.bound
    assert found.wavelength == pytest.approx(length, rel=1e-3)


def made(name, error, *, measured=True):
    gaps = tuple(
        ReynoldsError(thickness=t, wavelength=5.0, error=error / t, bar=0.1 * error / t, bound=error, direction=0)
        for t in (2.0, 4.0, 8.0)
    )
    return SurfaceValidity(
        name=name, measured=measured, shape=(8, 8), spacing=(1e-6, 1e-6), rms_height=1e-6, slope=0.1, peak=2.0,
        mismatch=0.0, found=gaps, coarser=(),
    )  # fmt: skip


def test_a_surface_is_good_from_the_thinnest_film_on_above_which_all_are():
    assert made("a", 0.017).within(0.01) == 2.0
    assert made("a", 0.02).within(0.01) == 4.0
    assert made("a", 0.1).within(0.01) is None


def study(reached):
    nothing = rough_gaps_inertia.Inertia(flows=(), laws=())
    return RoughGapStudy(
        waves=Waves(resolved=(), drawn=()), surfaces=(), inertia=nothing, reach=tuple(reached), map=(), runs=0,
        cpu_s=0.0, failed={},
    )  # fmt: skip


@pytest.mark.parametrize(
    ("errors", "verdict"), [([0.01, 0.09], "true"), ([0.01, 0.2], "partly"), ([0.2, 0.3], "false")]
)
def test_the_claim_is_judged_by_measured_surfaces_alone(errors, verdict):
    reached = [made(f"s{k}", error) for k, error in enumerate(errors)]
    assert [claim.verdict for claim in judge(study([*reached, made("made", 0.9, measured=False)]))] == [verdict]
    assert judge(study([made("made", 0.9, measured=False)])) == []


def test_the_cheapest_rung_within_a_level():
    one = ModelErrors(slope=0.2, length=5.0, smooth_gap=0.2, homogenized=0.03, slope_corrected=0.002)
    assert [one.cheapest(level) for level in (0.3, 0.05, 0.01, 0.001)] == [
        "smooth_gap", "homogenized", "slope_corrected", "stokes",
    ]  # fmt: skip
    steeper = replace(one, slope=0.4, homogenized=0.1)
    assert serves([one, steeper], "homogenized", 0.05) == 0.2
    assert serves([one, steeper], "homogenized", 0.01) == 0


def test_answers_are_used_again_and_failures_are_told(tmp_path, monkeypatch):
    asked = [ModelRun(scene=over_waves(0.3, 5.0), model="homogenized", resolution=n) for n in (32, 64, 32)]
    found, failed = answers(asked, tmp_path, here)
    assert len(found) == 2
    assert not failed
    assert all(one.fields == {} for one in found.values())
    monkeypatch.setattr(studies_runs, "run", None)
    again, _ = answers(asked, tmp_path, here)
    assert {key: one.quantities for key, one in again.items()} == {key: one.quantities for key, one in found.items()}
    monkeypatch.undo()
    wrong = ModelRun(scene=over_waves(0.3, 5.0), model="homogenized", resolution=1)
    found, failed = answers([wrong], tmp_path, here)
    assert not found
    assert "resolution" in failed[wrong.key]


def test_surfaces_are_kept_by_their_heights(tmp_path, monkeypatch):
    surface = over_random(0.2, 5.0, points=32).surface()
    first = reach({"one": surface}, measured=True, folder=tmp_path, thicknesses=(6.0,), coarser=(1, 2))
    monkeypatch.setattr("scripts.studies.rough_gaps.range_of_validity.off", None)
    assert reach({"one": surface}, measured=True, folder=tmp_path, thicknesses=(6.0,), coarser=(1, 2)) == first
    assert first[0].found[0].thickness == pytest.approx(1.05 * peak_over_rms(surface))
    other = Surface(heights=2 * surface.heights, spacing=surface.spacing, periodic=True)
    with pytest.raises(TypeError):
        reach({"one": other}, measured=True, folder=tmp_path, thicknesses=(6.0,), coarser=(1, 2))


def test_a_coarser_surface_keeps_its_size_and_loses_slope():
    surface = over_random(0.2, 5.0, points=48).surface()
    less = coarse(surface, 12)
    assert less.shape == (12, 12)
    assert less.size == pytest.approx(surface.size)
    assert coarse(surface, 48) is surface


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rough_gaps")
    (folder / "made").mkdir()
    (folder / "made" / "gentle_hills.toml").write_text(DESCRIPTION, encoding="utf-8")
    plan = rough_gaps.Plan(**SMALL, made=folder / "made")
    return rough_gaps.compute(folder / "found", None, plan), folder


def test_the_page_is_one_file_with_its_numbers_beside_it(small):
    found, folder = small
    rough_gaps.write(folder, found, as_json=True)
    page = (folder / "rough_gaps.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 6
    assert "milled_NT1100.opd is not here" in page
    assert "OpenFOAM was not run" in page
    assert "gentle hills (made)" in page
    numbers = json.loads((folder / "rough_gaps.json").read_text(encoding="utf-8"))
    assert numbers["claims"] == []
    assert numbers["findings"]["reach"].startswith("The flow by Reynolds' equation is too large by about")
    rows = list(csv.DictReader((folder / "waves.csv").read_text(encoding="utf-8").splitlines()))
    flow = sinusoidal_ridge_flow(0.3, 5.0, tolerance=1e-6).across / thin_ratios(0.3)["A11"]
    assert float(rows[0]["A11_exact"]) == pytest.approx(flow, rel=1e-4)


def test_words_and_tables_state_what_meshes_found(small, base):
    """Of answers that are made up: the exact flow, with an error that falls as the square of the cells."""
    found, folder = small
    exact, thin = found.waves.resolved[0].exact, thin_ratios(0.3)
    told_of = {
        one.key: replace(
            base,
            quantities={
                name: Quantity(value=thin[name] * exact[name] * (1 + 1 / one.resolution**2), unit="1") for name in thin
            },
        )
        for one in asked_of(over_waves(0.3, 5.0), (32, 48, 64))
    }
    again = replace(found, waves=waves(told_of, folder / "found", (0.3,), (5.0,), (4.0, 20.0)), runs=3)
    meeting = mesh_meets_exact(again.waves.resolved)
    assert meeting.count == meeting.within == 4
    assert meeting.worst < 1e-4
    assert bounds_hold([wave.found for wave in again.waves.resolved]).within == 2
    assert "OpenFOAM meets the exact flow within" in words(again)["waves"]
    row = rough_gaps.tables(again)["waves"][0]
    assert row["A11_stokes"] == pytest.approx(exact["A11"], rel=1e-4)


@pytest.mark.openfoam
def test_openfoam_meets_the_exact_flow_within_its_error_bar(tmp_path):
    scene, grids = over_waves(0.3, 5.0), (16, 24)
    found, failed = answers(asked_of(scene, grids), tmp_path, here)
    assert not failed
    one = compare("", "", scene, grids, found).resolved["A11"]
    exact = sinusoidal_ridge_flow(0.3, 5.0, tolerance=1e-6).across / thin_ratios(0.3)["A11"]
    assert abs(one.value - exact) < one.uncertainty < 0.02


def test_theory_without_a_mesh_names_the_ladders_quantities(base):
    from roughfilm.rom.rough_gap.flow.corrected import slope_corrected

    assert set(values_of(slope_corrected(over_waves(0.3, 5.0).walls(64)).thin)) <= set(base.quantities)
