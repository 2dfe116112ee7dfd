"""The gallery: each program runs, draws, and has the numbers of its text, judged by closed forms and published ones."""

import contextlib
import inspect
import re
import runpy
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any
from unittest import mock

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.special import erf

import roughfilm as rf
from roughfilm.figures.rendering import probe
from scripts.manual.outcomes import GALLERY, Outcome, kept_outcome, outcome

PROGRAMS = sorted(path.relative_to(GALLERY).with_suffix("").as_posix() for path in GALLERY.glob("*/*.py"))
LINES = 40
LIBRARIES = {"to_dataframe": "pandas", "to_xarray": "xarray"}
LABEL_WITH_UNIT = re.compile(r"\(.+\)")


def text_of(program: str) -> str:
    return (GALLERY / f"{program}.py").read_text(encoding="utf-8")


def marked(program: str) -> Any:
    marks = [pytest.mark.openfoam] if "openfoam" in program else []
    marks += [pytest.mark.slow] if Path(program).name.startswith("long_") else []
    return pytest.param(program, marks=marks, id=program)


@cache
def ran(program: str) -> Outcome:
    """The outcome that a build of the manual has kept; else run a program in its folder, as sphinx-gallery does."""
    path = GALLERY / f"{program}.py"
    if (kept := kept_outcome(path)) is not None:
        return kept
    plt.close("all")
    try:
        with mpl.rc_context(), contextlib.chdir(path.parent), mock.patch.object(plt, "show"):
            plt.switch_backend("agg")
            return outcome(path, runpy.run_path(str(path), run_name="__main__"))
    finally:
        plt.close("all")


def values_of(program: str) -> Mapping[str, Any]:
    for name, library in LIBRARIES.items():
        if name in text_of(program):
            pytest.importorskip(library)
    if "pyvista" in text_of(program) and not (drawing := probe()).available:
        pytest.skip(drawing.detail)
    return ran(program).values


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_program_is_short_and_begins_with_a_title_and_a_few_sentences(program: str) -> None:
    text = text_of(program)
    title, underline, blank, *sentences = text.removeprefix('"""').partition('"""')[0].splitlines()
    assert len(text.splitlines()) <= LINES
    assert underline == "=" * len(title)
    assert not blank
    assert 2 <= len(re.findall(r"[.?](?=\s|$)", "\n".join(sentences))) <= 6


@pytest.mark.parametrize("program", [marked(program) for program in PROGRAMS])
def test_a_program_draws_labelled_axes_and_leaves_no_files(program: str) -> None:
    values_of(program)
    outcome = ran(program)
    assert outcome.figures
    assert not outcome.left
    for figure in outcome.figures:
        assert figure.width == 6
        assert figure.labels
        assert [label for label in figure.labels if not LABEL_WITH_UNIT.search(label)] == []
        assert not figure.covered


def test_each_section_has_a_title() -> None:
    for path in [GALLERY / "README.rst", *(folder / "README.rst" for folder in GALLERY.iterdir() if folder.is_dir())]:
        title, underline, *_ = path.read_text(encoding="utf-8").splitlines()
        assert len(title) == len(underline)


def test_every_public_function_has_an_example() -> None:
    used = set(re.findall(r"\brf\.(\w+)", "\n".join(map(text_of, PROGRAMS))))
    functions = {name for name in rf.__all__ if inspect.isfunction(getattr(rf, name))}
    assert functions - used == set()


# Pockets


def cylindrical_film(width: float, depth: float, film: float, length: float) -> np.ndarray:
    """The gap, m, over one period with a groove that is a circular arc."""
    x = (np.arange(200_000) + 0.5) / 200_000 * length - length / 2
    radius = (width**2 / 4 + depth**2) / (2 * depth)
    return film + np.where(np.abs(x) < width / 2, np.sqrt(np.maximum(radius**2 - x**2, 0)) - radius + depth, 0)


def test_the_load_grows_with_the_reynolds_number_and_vanishes_without_inertia() -> None:
    values = values_of("pockets/load_over_reynolds_number")
    load, numbers = values["load"], values["numbers"]
    assert np.abs(load["reynolds"]).max() < 1e-9
    assert load["inertial_reynolds"] == pytest.approx(numbers * load["inertial_reynolds"][0], rel=1e-9)
    assert load["inertial_reynolds"][numbers == 40] == pytest.approx(0.890, rel=1e-3)  # of an independent solver
    assert load["film"][0] == pytest.approx(load["inertial_reynolds"][0], rel=0.02)
    assert values["linear_too_high"] == pytest.approx(0.071, abs=5e-4)
    assert values["by_slope"] == pytest.approx(0.005, abs=5e-4)


def test_cavitation_begins_at_its_pressure_and_opposes_inertia() -> None:
    values = values_of("pockets/inertia_and_cavitation")
    speeds, load = values["speeds"], values["load"]
    assert np.abs(load["reynolds"]).max() < 1e-9
    assert load["film_slope"][1] / load["film_slope"][0] == pytest.approx(2.5**2, rel=0.01)
    falls = 13.05  # kPa for each m/s: 652.5 kPa at 50 m/s by quadrature
    assert ((values["ruptured"] > 0) == (falls * speeds > 101.325)).all()
    whole = values["ruptured"] == 0
    assert load["reynolds_cavitating"][whole] == pytest.approx(0, abs=1e-9)
    assert values["cavitation"] == pytest.approx(-32.327, abs=2e-3)  # by quadrature between rupture and reformation
    assert values["inertia"] == pytest.approx(38.2, abs=0.1)


def test_dimples_cover_what_their_shapes_cover() -> None:
    covered = values_of("pockets/shapes_of_dimples")["covered"]
    expected = {
        "spherical": np.pi / 4 * 0.5**2,
        "ellipsoidal": np.pi / 4 * 0.5 * 0.8,
        "conical": np.pi / 4 * 0.5**2,
        "box": 0.5 * 0.7,
        "chevron": 0.25 * 0.8,
        "groove": 0.5,
        "points": 0.7**2,
    }
    assert covered == pytest.approx(expected, abs=6e-3)


def test_a_dimple_carries_by_inertia_alone_what_openfoam_finds() -> None:
    values = values_of("pockets/dimple_over_reynolds_number")
    load, numbers = values["load"], values["numbers"]
    assert np.abs(load["reynolds"]).max() < 1e-9
    assert load["inertial_reynolds"] == pytest.approx(numbers * load["inertial_reynolds"][0], rel=1e-9)
    assert load["film"][0] == pytest.approx(load["inertial_reynolds"][0], rel=0.02)
    assert load["film_slope"][-1] == pytest.approx(0.6777, rel=0.01)  # navier_stokes on 96 columns
    friction = values["friction"]["film_slope"][-1]
    assert friction == pytest.approx(2.9829, abs=2e-4)  # the same
    assert friction / values["friction"]["reynolds"][-1] - 1 == pytest.approx(3e-4, abs=1e-4)
    assert values["first_order_too_high"] == pytest.approx(0.05, abs=5e-3)
    assert values["by_slope"] == pytest.approx(-0.007, abs=2e-3)


def test_a_dimple_carries_less_than_a_groove_per_area_and_a_short_one_more_per_volume() -> None:
    values = values_of("pockets/groove_or_dimple")
    assert (np.diff(values["over_area"]) < 0).all()
    assert values["over_area"][[0, -1]] == pytest.approx([0.93, 0.81], abs=0.01)
    assert values["over_volume"][[0, -1]] == pytest.approx([1.24, 1.08], abs=0.01)


def test_staggered_dimples_save_more_friction_where_they_are_close() -> None:
    saved = {name: np.array(values) for name, values in values_of("pockets/staggered_dimples")["saved"].items()}
    more = saved["staggered"] / saved["aligned"] - 1
    assert (np.diff(more) < 0).all()
    assert more[0] == pytest.approx(0.076, abs=0.01)
    assert (np.abs(more[3:]) < 0.02).all()


def test_the_load_of_one_flow_depends_on_the_place_of_zero_pressure() -> None:
    values = values_of("pockets/zero_of_pressure")
    assert values["ratio"] == pytest.approx(3.5, abs=0.05)
    found = [1e-3 * values["load"][place] for place in ("corner", "mean of the edge", "middle of the edge")]
    assert found == pytest.approx([1.890, 4.016, 6.653], rel=0.01)  # navier_stokes on 96 columns


def test_wider_grooves_have_deeper_optima_in_the_range_of_the_source() -> None:
    best = np.array(values_of("pockets/best_depth")["best"])
    assert (np.diff(best) > 0).all()
    assert ((best > 0.49 * 30e-6) & (best < 0.89 * 30e-6)).all()  # Sahlin et al. 2005
    assert 1e6 * best[[0, 2]] == pytest.approx([18, 25], abs=0.5)


def test_two_grooves_carry_more_than_twice_as_much_as_one() -> None:
    values = values_of("pockets/two_grooves")
    assert values["ratio"] == pytest.approx(2.185, abs=0.01)
    film = cylindrical_film(0.2e-3, 7.5e-6, 30e-6, 1e-3)
    for grooves, saved in zip((1, 2, 2, 2), values["saved"], strict=True):
        gap = film if grooves == 1 else cylindrical_film(0.2e-3, 7.5e-6, 30e-6, 0.5e-3)
        friction = 4 * np.mean(1 / gap) - 3 * np.mean(gap**-2) ** 2 / np.mean(gap**-3)  # without inertia, over ηu
        assert saved == pytest.approx(1 - friction * 30e-6, abs=2e-3)


def test_the_back_flow_begins_where_thin_film_theory_says() -> None:
    values = values_of("pockets/vortex")

    def excess(depth: float) -> float:
        gap = cylindrical_film(0.3e-3, depth, 30e-6, 1e-3)
        return float(gap.max() - 1.5 * np.mean(gap**-2.0) / np.mean(gap**-3.0))

    for onset in values["onset"].values():
        assert excess(onset - 0.5e-6) < 0 < excess(onset)
    assert np.ptp(values["flow"]) < 2e-3 * values["flow"].mean()
    assert values["largest"] == pytest.approx(0.030, abs=5e-4)


def test_a_mirrored_groove_carries_the_opposite_load_without_inertia() -> None:
    values = values_of("pockets/lowest_point")
    plain, load = values["load"]["reynolds"], values["load"]["film_slope"]
    assert plain == pytest.approx(-plain[::-1], rel=1e-6, abs=1e-6)
    assert (np.diff(load) < 0).all()
    assert values["best_shift"] == pytest.approx(-0.15e-3)
    assert (load[0], load[0] / load[-1]) == (pytest.approx(5.0e3, rel=0.01), pytest.approx(11.5, abs=0.5))


def test_straight_lines_approach_an_arc_with_second_order() -> None:
    missing = values_of("pockets/profile_from_file")["missing"]
    assert [part * (count - 1) ** 2 for count, part in missing.items()] == pytest.approx([0.64] * 4, rel=0.05)
    assert (missing[5], missing[33]) == (pytest.approx(0.039, abs=5e-4), pytest.approx(0.0006, abs=5e-5))


@pytest.mark.openfoam
def test_the_film_model_agrees_with_openfoam() -> None:
    values = values_of("pockets/flow_by_openfoam")
    assert values["load"] == pytest.approx(values["load_of_film"], rel=0.01)


@pytest.mark.openfoam
def test_the_cases_of_a_study_are_collected() -> None:
    values = values_of("pockets/study_by_openfoam")
    assert len(values["cases"]) == 3
    assert set(values["table"]["outcome"].tolist()) == {"solved"}
    assert values["difference"].max() < 0.0215


# Bearings


def test_a_plane_slider_agrees_with_the_closed_form_within_its_uncertainty() -> None:
    values = values_of("bearings/slider_ratio")
    a = 1 + values["rises"] / values["film"]
    scale = values["viscosity"] * values["speed"] * (values["length"] / values["film"]) ** 2
    exact = 6 * scale / (a - 1) ** 2 * (np.log(a) - 2 * (a - 1) / (a + 1))
    assert (np.abs(values["load"] - exact) <= values["uncertainty"]).all()
    assert values["best_ratio"] == pytest.approx(2.189, abs=0.01)  # Rayleigh 1918
    assert values["best_load"] == pytest.approx(0.1602 * scale, rel=1e-3)


def test_the_best_step_is_that_of_rayleigh() -> None:
    values = values_of("bearings/step")
    assert values["best_load"] == pytest.approx(4 / 9 * (2 * np.sqrt(3) - 3), rel=1e-4)
    assert values["best_load"] >= values["load"].max()
    assert values["best_load"] / 0.1602 - 1 == pytest.approx(0.287, abs=1e-3)
    assert values["best_on_map"] == (pytest.approx(1.866, abs=0.15), pytest.approx(0.718, abs=0.034))


def test_a_lemon_bore_whirls_at_a_far_higher_speed_than_plain_halves() -> None:
    values = values_of("bearings/rotor_whirl")
    assert values["onset"]["plain halves"] == pytest.approx(4461, rel=5e-3)
    assert values["onset"]["lemon bore"] == pytest.approx(16390, rel=0.01)
    masses = {name: [p["critical_mass"].value for p in curve.points] for name, curve in values["curves"].items()}
    assert (np.array(masses["lemon bore"]) > 2 * np.array(masses["plain halves"])).all()
    assert values["curves"]["plain halves"].points[-1]["whirl_ratio"].value == pytest.approx(0.5, abs=0.002)


def test_a_whirl_in_hot_oil_begins_to_whirl_later() -> None:
    values = values_of("bearings/whirl_in_hot_oil")
    assert values["onset"]["oil as supplied"] == pytest.approx(4970, rel=5e-3)
    assert values["onset"]["oil that heats"] == pytest.approx(5590, rel=5e-3)
    cold, hot = (curve.points for curve in values["curves"].values())
    assert [hot[place]["temperature"].value for place in (0, -1)] == pytest.approx([57.4, 72.1], abs=0.2)
    for one, other in zip(cold, hot, strict=True):
        assert other["eccentricity"].value > one["eccentricity"].value
        assert other["critical_mass"].value > one["critical_mass"].value


def test_sommerfeld_numbers_agree_with_raimondi_and_boyd_and_with_ocvirk() -> None:
    values = values_of("bearings/sommerfeld_number")
    assert values["largest_difference"] < 0.0145
    assert values["ours"][0.25][0] == pytest.approx(values["ocvirk"][0], rel=0.03)


def test_the_pressure_of_a_journal_adds_up_to_its_load() -> None:
    values = values_of("bearings/pressure_map")
    assert values["integral"] == pytest.approx(values["load"].value, rel=1e-3)
    unit = 0.05 * 0.05 * 0.02 * 80 / 1e-6  # B D η ω/ψ², N
    assert values["load"].value / unit == pytest.approx(1.3146, rel=3e-3)  # Butenschön 1976, as is the angle
    assert values["attitude"] == pytest.approx(50.536, abs=0.1)


def test_a_hydrostatic_pad_has_the_stiffness_of_its_restrictor() -> None:
    values = values_of("bearings/hydrostatic_pad")
    for name, tolerance in (("capillary", 0.005), ("orifice", 0.015)):
        inner = slice(1, -1)  # the slopes at both ends are differences to one side
        assert values["stiffness"][name][inner] == pytest.approx(values["expected"][name][inner], rel=tolerance)
    assert values["stiffness"]["orifice"][8] > 1.1 * values["stiffness"]["capillary"][8]


def test_pads_tilt_until_their_centre_of_pressure_is_at_the_pivot() -> None:
    values = values_of("bearings/pivot_of_a_pad")
    at = np.interp(values["ratios"]["infinitely wide"], values["a"], values["centre"])
    assert at == pytest.approx(values["pivots"], abs=1e-3)
    for name, best in (("infinitely wide", 0.57), ("square", 0.6)):
        film = values["films"][name]
        assert values["pivots"][film.argmax()] == best
        assert film[0] < 0.6 * film.max()


def test_films_under_load_lie_on_the_curve_of_butenschoen() -> None:
    values = values_of("bearings/film_under_load")
    eccentricity = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95]
    number = [0.1196, 0.2518, 0.4091, 0.6108, 0.8903, 1.3146, 2.0432, 3.5663, 8.4352, 18.7895]
    table = CubicSpline(eccentricity, np.log(number * (1 - np.array(eccentricity)) ** 1.5))
    gap = values["films"] / 25e-6
    assert np.exp(table(1 - gap)) / gap**1.5 * values["unit"] == pytest.approx(values["forces"], rel=0.01)
    assert values["films"][4] == pytest.approx(10.3e-6, abs=0.05e-6)
    assert values["films"][0] / values["films"][-1] == pytest.approx(12.5, abs=0.1)


def test_inertia_takes_load_from_a_pad_where_the_flow_leaves_the_walls_of_its_grooves() -> None:
    values = values_of("bearings/inertia_in_a_pad")
    change, reduced = values["change"]["film_slope"], values["numbers"] / values["aspect"]
    assert np.abs(change[reduced < 3.2]).max() < 0.01
    assert (change[reduced > 6] < -0.03).all()
    assert change[-1] == pytest.approx(-0.21, abs=0.005)
    assert (values["change"]["film"][reduced < 3.2] > 0).all()


def test_a_starved_inlet_takes_what_it_is_given() -> None:
    values = values_of("bearings/inlet_starvation")
    inlets, couette = values["inlets"], values["speed"] * (values["film"] + values["rise"]) / 2
    starved = inlets < values["limit"]
    assert values["limit"] == pytest.approx(0.564, abs=5e-4)
    assert values["flow"][starved] == pytest.approx(inlets[starved] * couette, rel=1e-6)
    assert (np.diff(values["load"]) > 0).all()
    filled = (1 - np.sqrt(2 * inlets - 1)) / 2  # where the liquid that arrives fills the gap
    assert (np.array(values["start"])[starved] < filled[starved]).all()


def test_a_wavy_wall_carries_by_cavitation_alone() -> None:
    values = values_of("bearings/texture")
    assert abs(values["without"]) < 1e-6
    assert (np.diff(values["load"]) < 0).all()
    lowest = values["results"]["reynolds"].fields["pressure"].values.min()
    assert (np.abs(values["load"][values["pressures"] < lowest]) < 1e-6).all()


def test_pockets_make_the_film_of_a_pad_thicker() -> None:
    values = values_of("bearings/pad_with_pockets")
    film, friction = values["film"], values["friction"]
    assert 1e6 * film[[0, 3]] == pytest.approx([3.50, 3.91], abs=0.006)
    assert film.argmax() == 3
    assert 1 - friction[4] / friction[0] == pytest.approx(0.12, abs=0.005)
    assert film[1] - film[0] < 0.5e-6


def test_barus_law_has_the_pressure_of_the_closed_form() -> None:
    values = values_of("bearings/viscosity_of_pressure")
    assert values["pressure"] == pytest.approx(-np.log(1 - values["reduced"]) / values["alpha"], rel=1e-3)
    assert "no steady film" in values["refused"]


def test_a_multigrade_oil_loses_more_friction_than_film() -> None:
    values = values_of("bearings/shear_thinning")
    film, friction = ({name: np.array(one) for name, one in values[key].items()} for key in ("films", "friction"))
    thinner = 1 - film["of each place"] / film["at rest"]
    assert thinner[[0, -1]] == pytest.approx([0.097, 0.169], abs=0.003)
    assert 1 - friction["of each place"][-1] / friction["at rest"][-1] == pytest.approx(0.295, abs=0.003)
    assert 1 - film["of the mean shear rate"][0] / film["at rest"][0] < 0.005
    # A film of one viscosity depends on η u alone: the mean viscosities give points of the curve at rest.
    product = values["speeds"] * values["mean"] / 0.015
    on_curve = np.exp(np.interp(np.log(product[1:4]), np.log(values["speeds"]), np.log(film["at rest"])))
    assert film["of the mean shear rate"][1:4] == pytest.approx(on_curve, rel=0.01)


def test_a_field_of_temperature_leaves_less_load_than_one_temperature() -> None:
    values = values_of("bearings/one_temperature")
    loads, found = values["loads"], values["found"]
    assert loads["reynolds_cavitating"] == pytest.approx(loads["reynolds_cavitating"][0] * values["turns"] / 100)
    shares = {model: one / loads["reynolds_cavitating"] for model, one in loads.items()}
    assert shares["heat_balance"][-1] == pytest.approx(1 - 0.39, abs=0.006)
    assert shares["adiabatic"][-1] == pytest.approx(1 - 0.54, abs=0.006)
    assert shares["across"] == pytest.approx(shares["adiabatic"], rel=0.03)
    assert (shares["adiabatic"] < shares["heat_balance"]).all()
    # A film of one viscosity carries in proportion to it, and ASTM D341 gives that of the oil.
    temperature = np.array([one["effective_temperature"].value for one in found["heat_balance"]])
    assert shares["heat_balance"] == pytest.approx(_vg_32(temperature) / _vg_32(45.0), rel=5e-3)


def _vg_32(temperature: Any) -> Any:
    """The viscosity of ISO VG 32 at °C, over a density: Walther through 32 and 5.3 mm²/s (data sheets)."""
    log = np.log10(np.log10(np.array([32.0, 5.3]) + 0.7))
    slope = (log[1] - log[0]) / np.log10(373.15 / 313.15)
    kinematic = 10**10 ** (log[0] + slope * np.log10((np.asarray(temperature) + 273.15) / 313.15)) - 0.7
    return kinematic * np.exp(-0.6278 / 852 * (np.asarray(temperature) - 45))


def test_a_shaft_and_a_shell_cool_a_journal() -> None:
    hot, cool = values_of("bearings/temperature_map")["results"].values()
    assert hot["temperature_max"].value - cool["temperature_max"].value == pytest.approx(24.4, abs=0.5)
    for result in (hot, cool):
        left = sum(result[f"heat_to_{place}"].value for place in ("lubricant", "fixed_wall", "sliding_wall"))
        assert left == pytest.approx(result["heat_generated"].value, rel=1e-7)
    assert cool["heat_to_sliding_wall"].value == pytest.approx(0, abs=1e-6 * cool["heat_generated"].value)
    assert hot.fields["temperature"].values.max() == pytest.approx(hot["temperature_max"].value, abs=1.0)


# Mixed lubrication


def test_flow_factors_of_low_roughness_are_those_of_perturbation_theory() -> None:
    values = values_of("mixed_lubrication/flow_factors")
    expected = 1 - 1.5 / values["separation"][-1] ** 2  # isotropic roughness, to second order
    assert (values["a"][-1], values["b"][-1]) == (pytest.approx(expected, abs=5e-3), pytest.approx(expected, abs=5e-3))
    assert (np.diff(values["a"]) > 0).all()
    assert values["above_fit"][[0, 2]] == pytest.approx([0.16, 0.07], abs=5e-3)


def test_ridges_have_the_means_of_resistances_in_series_and_in_parallel() -> None:
    values = values_of("mixed_lubrication/ridges")
    ratio = 1e6 * values["gaps"]
    exact = (ratio**2 - 1) ** 2.5 / ratio**3 / (ratio**2 + 0.5)
    assert (np.abs(values["across"] - exact) <= values["uncertainty"]).all()
    assert values["along"] == pytest.approx(1 + 1.5 / ratio**2, rel=1e-9)
    assert (values["across"][3], values["along"][3]) == (pytest.approx(0.433, abs=5e-4), pytest.approx(1.375, abs=5e-4))


def test_many_waves_approach_their_average_in_inverse_proportion() -> None:
    values = values_of("mixed_lubrication/waves_of_a_slider")
    assert values["order"] == pytest.approx(1, abs=0.02)
    assert values["difference"][[0, 3]] == pytest.approx([0.10, 0.013], abs=1e-3)
    assert values["gain"] == pytest.approx(0.037, abs=5e-4)


def test_a_load_that_turns_at_half_of_the_speed_leaves_a_thinner_film() -> None:
    least = values_of("bearings/changing_load")["least"]
    assert 1e6 * least["standing"] == pytest.approx(12.97, abs=0.1)
    assert 1e6 * least["half speed"] == pytest.approx(3.8, abs=0.2)


def test_the_film_of_a_pin_that_swings_is_thinnest_between_the_reversals() -> None:
    least = values_of("bearings/swinging_pin")["least"]
    assert 1e6 * least[400][0] == pytest.approx(2.0, abs=0.1)
    assert 1e6 * least[200][0] == pytest.approx(1.28, abs=0.1)
    assert all(abs(at % 0.5 - 0.25) > 0.1 for _, at in least.values())


def test_the_load_of_a_washer_moves_from_asperities_to_the_film() -> None:
    values = values_of("mixed_lubrication/stribeck_washer")
    assert values["lift_off"] == pytest.approx([0.14, 0.60], abs=0.006)
    for curve in values["curves"]:
        friction = np.array([point.friction_coefficient for point in curve.points])
        share = np.array([point.contact_share for point in curve.points])
        assert (np.diff(share) <= 0).all()
        assert ((share == 0) == (values["speeds"] > curve.lift_off.speed)).all()
        assert friction[0] < 0.1
        assert 0.3 < values["speeds"][friction.argmin()] / curve.lift_off.speed < 3.2


def test_film_and_asperities_of_a_pad_share_its_load() -> None:
    values = values_of("mixed_lubrication/shared_load")
    assert values["by_film"] + values["by_contact"] == pytest.approx(values["load"], rel=1e-9)
    assert (values["share"][values["films"] >= 3e-6] == 0).all()
    assert values["share"][0] == pytest.approx(1 / 3, abs=0.02)
    assert values["films"][values["friction"].argmin()] == pytest.approx(3e-6)


def test_a_shaft_lifts_off_at_the_same_speed_in_plain_halves_and_in_a_lemon_bore() -> None:
    values = values_of("mixed_lubrication/start_of_a_journal")
    plain, lemon = (values["curves"][name] for name in ("plain halves", "lemon bore"))
    assert plain.lift_off.speed == pytest.approx(0.25, abs=0.005)
    assert lemon.lift_off.speed == pytest.approx(plain.lift_off.speed, rel=1e-3)
    assert plain.points[0].contact_share > 0.9
    assert plain.points[-1].contact_share == 0
    friction = [curve.points[-1].friction_coefficient for curve in (plain, lemon)]
    assert friction[1] / friction[0] == pytest.approx(1.69, abs=0.01)


@pytest.mark.slow
def test_the_lift_off_speed_is_proportional_to_the_load() -> None:
    values = values_of("mixed_lubrication/long_stribeck_washer")
    pressures = np.array([curve.pressure for curve in values["curves"]])
    proportional = values["lift_off"][0] * pressures / pressures[0]
    assert (np.abs(values["lift_off"] - proportional) < 2 * values["uncertainty"]).all()
    assert values["lift_off"][0] == pytest.approx(0.47, abs=0.005)


# Dry contact


def test_the_contact_area_is_that_of_theory_and_of_published_simulations() -> None:
    values = values_of("dry_contact/area_over_load")
    area, loads = values["area"], values["loads"]
    scaled = loads / (210e9 / (2 * (1 - 0.3**2)) * 0.1)  # over E* and the rms slope
    assert area["persson"] == pytest.approx(erf(np.sqrt(2) * scaled), rel=0.01)
    assert 1.9 < area["elastic"][2] / scaled[2] < 2.4  # Hyun et al. 2004, Yastrebov et al. 2017
    assert (area["elastic_plastic"] >= loads / 4e9).all()
    assert values["more_by_yielding"][[0, -1]] == pytest.approx([0.24, 0.58], abs=6e-3)
    assert values["persson_over_elastic"][[0, -1]] == pytest.approx([0.54, 0.80], abs=6e-3)


def test_a_wavy_surface_touches_as_westergaard_found() -> None:
    values = values_of("dry_contact/westergaard")
    exact = 2 / np.pi * np.arcsin(np.sqrt(values["shares"]))
    assert values["area"] == pytest.approx(exact, rel=0.011)
    assert values["worst_pressure"] < 3e-3


def test_a_ball_touches_as_hertz_found() -> None:
    values = values_of("dry_contact/hertz")
    composite = 210e9 / (1 - 0.3**2)
    radius = (3 * 20 * 5e-3 / (4 * composite)) ** (1 / 3)
    assert values["computed_radius"] == pytest.approx(radius, rel=1e-3)
    assert values["computed_peak"] == pytest.approx(3 * 20 / (2 * np.pi * radius**2), rel=1e-3)


def test_the_pressure_of_a_pressed_surface_adds_up_to_its_load() -> None:
    values = values_of("dry_contact/pressed_surface")
    assert values["mean_pressure"] == pytest.approx(400e6, rel=1e-6)
    assert values["largest"] <= 4e9 * (1 + 1e-9)
    assert values["touching"].value == pytest.approx(0.103, abs=6e-4)
    assert 0.1 < values["touching"].value < 0.11
    assert values["yielding"].value > 0.9 * values["touching"].value


# Seals


def test_a_seal_closes_at_one_load_however_it_is_sought() -> None:
    values, curve = values_of("seals/leakage_over_load"), values_of("seals/sealing_load")
    leak = values["leak"]["homogenized_leakage"]
    assert (np.diff(leak) <= 0).all()
    assert values["seals_between"] == (pytest.approx(0.45e6), pytest.approx(0.5e6))
    assert values["seals_between"][0] < curve["threshold"].load < values["seals_between"][1]
    assert np.abs(values["ratio"] - 1).max() < 0.19
    assert curve["threshold"].area_fraction == pytest.approx(0.415, abs=0.06)  # Dapp and Müser 2015
    assert 1.0 <= curve["light"] < 1.3


def test_few_places_carry_the_leak() -> None:
    values = values_of("seals/paths_of_a_leak")
    assert values["carrying"] == pytest.approx([0.145, 0.057], abs=1e-3)
    assert values["contact"][0] < values["contact"][1]


def test_a_ground_seal_leaks_along_its_marks() -> None:
    values = values_of("seals/lay")
    smooth = values["gap"] ** 3
    assert ((values["across"] < smooth) & (smooth < values["along"])).all()
    assert values["ratio"][[0, -1]] == pytest.approx([5, 100], rel=0.02)
    assert values["sealed_across"] == pytest.approx([60e3])


# Rough gaps


def test_the_correction_for_slope_contains_the_exact_flow() -> None:
    values = values_of("rough_gaps/slope")
    r = 10 / 3  # mean gap over amplitude
    assert values["thin"] == pytest.approx((r**2 - 1) ** 2.5 / r**3 / (r**2 + 0.5), rel=1e-3)
    long = values["slope"] < 0.15
    assert values["ratio"][long] == pytest.approx(1 - 0.8 * values["slope"][long] ** 2, abs=2e-3)
    for length, exact in values["exact"]:
        (place,) = np.flatnonzero(values["lengths"] == length)
        assert abs(values["ratio"][place] - exact) <= values["uncertainty"][place] / values["thin"][place]


def test_the_flow_of_a_rough_gap_lies_between_series_and_parallel() -> None:
    values = values_of("rough_gaps/flow_map")
    low, high = values["bounds"]
    assert low < 1 - values["taken"][0] < high
    assert values["taken"] == pytest.approx([0.109, 0.040], abs=1e-3)
    assert values["taken"][1] == pytest.approx(1.5 / 6**2, abs=3e-3)  # isotropic roughness, to second order


@pytest.mark.openfoam
@pytest.mark.slow
def test_the_correction_for_slope_agrees_with_stokes_flow() -> None:
    values = values_of("rough_gaps/long_openfoam_gap")
    assert abs(values["difference"]["slope_corrected"]) < 0.01
    assert values["difference"]["homogenized"] == pytest.approx(0.05, abs=0.01)


# Surfaces


def test_a_gaussian_surface_has_the_parameters_of_the_normal_distribution() -> None:
    normal, honed = (values_of("surfaces/bearing_curve")["parameters"][name] for name in ("Gaussian", "plateau-honed"))
    assert normal["Sk"] / normal["Sq"] == pytest.approx(2.57396, rel=0.01)
    assert normal["Sa"] / normal["Sq"] == pytest.approx(np.sqrt(2 / np.pi), rel=5e-3)
    assert normal["Ssk"] == pytest.approx(0, abs=0.1)
    assert (honed["Ssk"], honed["Sk"] / honed["Sq"]) == (pytest.approx(-2.6, abs=0.05), pytest.approx(1.1, abs=0.05))


def test_a_prepared_surface_fits_to_itself_and_keeps_its_middle() -> None:
    values = values_of("surfaces/prepare_measurement")
    cell = values["cell"]
    assert values["in_the_middle"] < 1e-18
    for axis in (0, 1):
        inside = np.abs(np.diff(cell, axis=axis)).mean()
        assert np.abs(cell.take(0, axis=axis) - cell.take(-1, axis=axis)).mean() < 1.5 * inside


def test_crossed_waves_have_the_closed_forms_of_their_volumes_slopes_and_peaks() -> None:
    """The volumes are integrals of the bearing curve over 4000² points of half a period.

    On the grid of the program the same heights return in each period, which moves the height at 10 % by steps.
    """
    values = values_of("surfaces/volumes_and_peaks")
    found, profile, height = values["found"], values["profile"], values["height"]
    squares = sum((2 * np.pi / length) ** 2 for length in values["lengths"])
    assert found["Sdq"] == pytest.approx(height * np.sqrt(squares) / 2, rel=1e-3)
    assert found["Sdr"] == pytest.approx(found["Sdq"] ** 2 / 2, rel=0.01)
    assert found["Spd"] == pytest.approx(2 / np.prod(values["lengths"]), rel=1e-9)
    assert found["Spc"] == pytest.approx(height * squares / 2, rel=2e-3)
    assert found["S10z"] == pytest.approx(2 * height, rel=1e-9)
    wave = np.cos((np.arange(4000) + 0.5) * np.pi / 4000)
    curve = np.sort(np.outer(wave, wave), axis=None)[::-1]
    volume = (curve[: curve.size // 10] - curve[curve.size // 10]).sum() / curve.size
    assert found["Vmp"] == pytest.approx(height * volume, rel=0.03)
    low = curve[8 * curve.size // 10 :]
    assert found["Vvv"] == pytest.approx(height * (low[0] - low).sum() / curve.size, rel=0.03)
    assert profile["Rsm"] == pytest.approx(values["lengths"][0], rel=1e-3)
    assert (profile["Rt"], profile["Rc"]) == pytest.approx((2 * height, 2 * height), rel=1e-3)


def test_the_rms_height_over_the_nesting_index_is_that_of_the_waves_that_are_kept() -> None:
    """The two waves of 2 µm and 0.5 µm keep 2^-(S/L)² (1 − 2^-(L'/L)²) of their amplitudes L."""
    for index, rms in values_of("surfaces/nesting_indices")["sq"].items():
        kept = [
            height * 2 ** (-((8 / length) ** 2)) * (1 - 2 ** (-((index / length) ** 2)))
            for height, length in ((2e-6, 500), (0.5e-6, 25))
        ]
        assert rms == pytest.approx(np.hypot(*kept) / np.sqrt(2), rel=1e-3)


def test_a_surface_of_a_profile_has_the_rms_height_and_slope_of_the_measured_surface() -> None:
    """The rms slope of the autocorrelation exp(-(r/λ)²) is √2 σ/λ; a profile of 500 λ knows it to some per cent."""
    values = values_of("surfaces/surface_of_a_profile")
    assert values["sq"] == pytest.approx(1e-6, rel=0.08)
    assert values["slope"] == pytest.approx(np.sqrt(2) * 0.1, rel=0.08)


def test_windows_lead_to_the_rms_height_of_the_whole_surface() -> None:
    """The heights of the surface have an rms of 1 µm; its windows lack what their means vary by.

    With the autocorrelation 0.2^(r/λ)², the variance of the mean of a window is π λ²/(L² ln 5).
    """
    values = values_of("surfaces/windows_of_a_measurement")
    trend, whole = values["sq"].trend, values["measured"].heights.std()
    assert whole == pytest.approx(1e-6)
    assert trend.limit == pytest.approx(whole, abs=trend.limit_uncertainty)
    assert trend.limit_uncertainty < 0.15e-6
    assert trend.part < 0
    own = 1e-6 * np.sqrt(1 - np.pi * (20 / 250) ** 2 / np.log(5))
    assert values["sq"].scatter.mean == pytest.approx(own, rel=0.02)


def test_the_worn_volume_is_that_of_the_scar_within_its_uncertainty() -> None:
    values = values_of("surfaces/wear")
    gone = values["gone"]
    assert abs(gone.value - values["true_volume"]) < 1.5 * gone.uncertainty < 0.05 * gone.value
    assert [shift.value for shift in values["shift"]] == pytest.approx([-4.3 * 2e-6, 2.6 * 2e-6], abs=0.02 * 2e-6)


def test_seeds_of_a_description_hold_the_windows_of_a_random_surface() -> None:
    """Of 16 windows, 13 and more lie within an interval of 95 % with a probability of 99 %."""
    values = values_of("surfaces/description_of_a_measurement")
    assert len(values["inside"]) == 4
    assert min(values["inside"].values()) >= 13
    windows, seeds = (np.array(values["skewness"][name]) for name in ("windows", "seeds"))
    assert abs(windows.mean() - seeds.mean()) < 3.3 * np.hypot(windows.std(), seeds.std()) / 4
    assert not any("seeds do not scatter" in one for one in values["fit"].warnings)


# The ladder


def test_the_advice_holds_against_a_better_model() -> None:
    chosen = values_of("ladder/advice")["chosen"]
    assert chosen == dict.fromkeys((10, 40, 80), "inertial_reynolds") | {160: "film_slope"}
    values = values_of("pockets/load_over_reynolds_number")  # the same groove
    error = np.abs(values["load"]["inertial_reynolds"] / values["load"]["film"] - 1)
    assert all(error[values["numbers"] == number] < 0.05 for number in (10, 40, 80))
    assert error[values["numbers"] == 160] > 0.05


def test_side_flow_is_what_raimondi_and_boyd_found() -> None:
    values = values_of("ladder/comparison")
    errors = values["load_errors"]
    assert errors["infinitely_wide"] == pytest.approx(0.121 / 0.0389 - 1, rel=0.02)  # Sommerfeld numbers at 0.6
    assert errors["reynolds"] == pytest.approx(0.47, abs=5e-3)
    assert 5 * values["uncertainty"] < -errors["reynolds_incompressible"] == pytest.approx(0.002, abs=3e-4)


def test_effects_add_up_from_sommerfelds_closed_form() -> None:
    values = values_of("ladder/effects")
    e = 0.75
    sommerfeld = 12 * np.pi * 0.05 * 4 * 0.025 * 1e6 * e / ((2 + e**2) * np.sqrt(1 - e**2))
    assert values["plain"] == pytest.approx(sommerfeld, rel=1e-3)
    parts = values["added"] / values["plain"]
    assert parts[:2] == pytest.approx([-0.83, -0.024], abs=5e-3)
    assert parts[2:].sum() == pytest.approx(0.047, abs=5e-3)


def test_the_uncertainty_contains_the_closed_form_on_each_grid() -> None:
    values = values_of("ladder/grid_convergence")
    assert (np.abs(values["values"] - values["exact"]) <= values["uncertainties"]).all()
    assert values["order"] == pytest.approx(2, abs=0.05)


def test_navier_stokes_costs_ten_thousand_times_as_much_as_reynolds() -> None:
    values = values_of("ladder/models")
    assert min(values["costs"], key=values["costs"].get) == "reynolds"
    assert 5e3 < values["ratio"] < 2e4


def test_a_stored_result_is_the_same() -> None:
    values = values_of("ladder/stored_result")
    assert values["again"]["load"] == values["result"]["load"]
    assert values["unit"] == "N"
    assert values["peak_place"][1] == pytest.approx(0.03)  # the middle of the width, by symmetry


def test_the_load_of_a_study_is_proportional_to_the_reynolds_number() -> None:
    values = values_of("ladder/study")
    assert len(values["cases"]) == 8
    for width in (0.2, 0.4):
        linear, film = values["load"]["inertial_reynolds", width], values["load"]["film", width]
        assert linear == pytest.approx(linear[0] * np.array([1, 2, 4, 8]), rel=1e-9)
        assert film == pytest.approx(linear, rel=0.15)


def test_the_best_depth_of_a_table_grows_with_the_width() -> None:
    values, finer = values_of("ladder/table_of_a_sweep"), values_of("pockets/best_depth")
    best = values["best_depths"]
    assert (np.diff(best) >= 0).all()
    assert best.iloc[0] == pytest.approx(15e-6)
    assert best.iloc[2] == pytest.approx(finer["best"][1], abs=2.6e-6)
    assert values["width"] == pytest.approx(0.7e-3)
    assert values["depth"] > 30e-6
