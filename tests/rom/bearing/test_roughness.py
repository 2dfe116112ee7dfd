"""Rough bearings: scenes, every wave followed against all averaged, the rate in ε, where scales do not separate."""

import json
import math
from functools import partial

import numpy as np
import pytest
from places import SCENES

from roughfilm import rom
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.roughness import _factors
from roughfilm.rom.cavitation.oblique import wetness
from roughfilm.rom.homogenization.ridges import sinusoidal_ridges
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

SLIDER, PAD = SCENES / "rough_slider.toml", SCENES / "rough_pad.toml"
MODELS = of_kind(ladder(rom), "bearing")
HOMOGENIZED, DIRECT, SMOOTH = (find("bearing", name) for name in ("homogenized", "direct", "reynolds_cavitating"))
INCOMPRESSIBLE = "lubricant.compressibility.law=incompressible"
PARABOLIC = ["geometry.shape=parabolic", "geometry.rise=4 um"]


def value(result, name="load_per_width"):
    return result.quantities[name].value


def pressure(result):
    return result.fields["x"].values[:, 0], result.fields["pressure"].values[:, 0]


def ridges(**keys):
    return f"roughness={json.dumps({'kind': 'sinusoid', 'amplitude': '0.4 um', 'wavelength': '1 mm', **keys})}"


def errors(make, ratios, names=("load_per_width",)):
    """Of the averaged film against the one with every wave of ε = ``ratios``: pressure at most, then by name."""
    averaged = HOMOGENIZED.solve(make(ratios[0]))
    x, p = pressure(averaged)
    result = []
    for ratio in ratios:
        followed = DIRECT.solve(make(ratio))
        assert followed.warnings == ()
        there, waves = pressure(followed)
        most = np.abs(waves - np.interp(there, x, p)).max() / p.max()
        result.append([most, *(value(followed, name) / value(averaged, name) - 1 for name in names)])
    return np.array(result).T


def slope(ratios, result):
    return float(np.polyfit(np.log(ratios), np.log(np.abs(result)), 1)[0])


# scenes


def test_a_rough_scene_is_read_back_from_its_entries():
    for path in (SLIDER, PAD):
        scene = load_scene(path)
        assert read_scene(scene_entries(scene)) == scene


def test_ridges_are_those_of_the_source():
    scene = load_scene(SLIDER)
    x = np.linspace(0, 0.1, 1001)
    expected = 4e-6 + 1e-6 * (1 - x / 0.1) + 0.4e-6 * np.sin(2 * np.pi * 64 * x / 0.1)
    film = DIRECT.solve(scene, Request(resolution=1000)).fields["film_thickness"].values[:, 0]
    assert film == pytest.approx(expected, rel=1e-12)
    mean = HOMOGENIZED.solve(scene, Request(resolution=100)).fields["film_thickness"].values[:, 0]
    assert mean == pytest.approx(5e-6 - 1e-6 * np.linspace(0, 1, 101))


def test_oblique_ridges_lie_across_their_direction():
    wave = load_scene(PAD, ["roughness.direction=30 deg", "roughness.phase=90 deg"]).roughness
    along = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)]) * 1e-3
    steps = np.linspace(0, 1, 9)
    assert wave.added(along[0] * steps, along[1] * steps) == pytest.approx(12e-6 * np.cos(2 * np.pi * steps), abs=1e-17)
    assert wave.added(-along[1] * steps, along[0] * steps) == pytest.approx(12e-6)
    assert wave.finest == pytest.approx((1e-3 / np.cos(np.pi / 6), 2e-3))


def heights(n=16, m=12):
    made = 1e-6 * np.random.default_rng(20071).random((n, m))
    made[3, 5] = 3e-6
    return made


def rough_surface(tmp_path, made, **keys):
    np.save(tmp_path / "s.npy", made)
    entries = {"kind": "surface", "surface": str(tmp_path / "s.npy"), "spacing": ["10 um", "20 um"], **keys}
    return read_scene({**scene_entries(load_scene(PAD)), "roughness": entries})


def test_upward_heights_narrow_the_gap_and_the_surface_repeats(tmp_path):
    made = heights()
    rough = rough_surface(tmp_path, made, scale=2.0, stretch=3.0).roughness
    i, j = np.meshgrid(np.arange(16), np.arange(12), indexing="ij")
    x, y = i * 30e-6, j * 60e-6
    assert rough.added(x, y) == pytest.approx(-2 * (made - made.mean()), abs=1e-18)
    assert rough.added(x + 16 * 30e-6, y - 24 * 60e-6) == pytest.approx(rough.added(x, y), abs=1e-15)
    between = rough.added(np.array([2.5 * 30e-6]), np.array([5 * 60e-6]))
    assert between == pytest.approx(-2 * (made[2:4, 5].mean() - made.mean()))
    assert rough.peak == pytest.approx(2 * (3e-6 - made.mean()))
    assert rough.period == pytest.approx(16 * 30e-6)


def test_a_surface_that_varies_along_the_sliding_alone_is_a_line(tmp_path):
    profile = heights()[:, :1]
    line = rough_surface(tmp_path, np.hstack([profile, profile])).roughness
    x = np.linspace(0, 1e-3, 137)
    steps = np.append(profile, profile[0])
    expected = profile.mean() - np.interp(x % 160e-6, np.arange(17) * 10e-6, steps)
    assert line.added(x, 0 * x) == pytest.approx(expected, abs=1e-15)
    assert math.isinf(line.finest[1])


def test_another_surface_under_the_same_name_is_refused(tmp_path):
    written = scene_entries(rough_surface(tmp_path, heights()))
    np.save(tmp_path / "s.npy", heights() * 1.001)
    with pytest.raises(InputError, match=r"scene\.roughness.*digest: got .*holds other heights by now"):
        read_scene(written)


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("roughness.amplitude=4 um", "scene.roughness.amplitude: got 4e-06 m; it must be below film, 4e-06 m"),
        ("roughness.kind=wavy", "scene.roughness"),
        ("roughness.wave=1 mm", "scene.roughness.wave: unknown key; known here: kind, amplitude, wavelength"),
        ("roughness.wavelength=1", "scene.roughness.wavelength: got 1, a number without a unit"),
        ('roughness={"kind": "sinusoid", "amplitude": "1 um"}', "scene.roughness.wavelength: missing; add it"),
        ('roughness={"kind": "surface", "surface": "no.npy"}', "no such file; name a file of heights"),
        ('roughness={"kind": "surface", "surface": "s.h5", "size": 1}', "scene.roughness.size: unknown key"),
    ],
)
def test_errors_are_reported_in_one_line(override, words):
    with pytest.raises(InputError) as caught:
        load_scene(SLIDER, [override])
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


# what applies


def applied(scene):
    return {model.name: model.applies(scene) for model in MODELS}


def test_models_of_roughness_refuse_smooth_walls():
    result = applied(load_scene(SCENES / "journal.toml"))
    for name in ("homogenized", "direct"):
        assert not result[name].applies
        assert "the wall is smooth" in result[name].reason


def test_models_of_smooth_walls_report_the_roughness():
    result = applied(load_scene(SLIDER))
    assert {name for name, fits in result.items() if fits.applies} == {model.name for model in MODELS} - {
        "infinitely_wide",
        "mixed",
        "film",
        "film_slope",
        *("shear_thinning", "heat_balance", "adiabatic", "across"),
    }
    for name in ("reynolds", "reynolds_incompressible", "reynolds_cavitating"):
        assert "treats the wall as smooth: rms height over film = 0.071" in result[name].reason
    assert "period over length = 0.016" in result["homogenized"].reason


@pytest.mark.parametrize(
    ("path", "overrides", "words"),
    [
        (SLIDER, ["roughness.direction=10 deg"], "varies across the infinitely wide film"),
        (PAD, ["roughness.wavelength=10 um"], "at most 2048 are allowed"),
    ],
)
def test_waves_that_cannot_be_resolved_are_refused(path, overrides, words):
    scene = load_scene(path, overrides)
    assert words in applied(scene)["direct"].reason
    with pytest.raises(InputError, match=words):
        DIRECT.solve(scene)
    assert HOMOGENIZED.applies(scene).applies


def test_walls_that_touch_are_averaged_but_not_resolved(tmp_path):
    made = np.kron(heights(), np.ones((2, 2)))
    scene = rough_surface(tmp_path, made, scale=12.0)
    assert scene.roughness.peak > scene.geometry.film
    assert "the walls touch" in applied(scene)["direct"].reason
    assert value(HOMOGENIZED.solve(scene, Request(resolution=24))) > 0


def test_default_grids_resolve_the_waves():
    for overrides in ([], ["roughness.wavelength=0.3 mm"]):
        for path in (SLIDER, PAD):
            scene = load_scene(path, overrides)
            for cells in DIRECT.resolutions_of(scene):
                sides = (scene.geometry.length, scene.geometry.width or 0)
                assert all(cells * w >= 7.99 * s for s, w in zip(sides, scene.roughness.finest, strict=True))
    warning = DIRECT.solve(load_scene(SLIDER), Request(resolution=256)).warnings
    assert any("has 4 cells; take at least 2 times" in words for words in warning)


# averaged against followed


SINES = 2.0 ** -np.arange(4, 9)


@pytest.mark.parametrize("more", [[], [INCOMPRESSIBLE]])
def test_pressure_and_load_converge_at_first_order_in_the_wavelength(more):
    def make(ratio):
        return load_scene(SLIDER, [f"roughness.wavelength={0.1 * ratio} m", *more])

    most, load = errors(make, SINES)
    assert slope(SINES, most) == pytest.approx(1, abs=0.05)
    assert slope(SINES, load) == pytest.approx(1, abs=0.05)
    assert most[-1] < 0.01


def test_the_load_of_waves_that_begin_at_a_crest_converges_at_second_order():
    # the first correction of the load is ε times the heights' primitive at the ends, which is 0 for a cosine
    def make(ratio):
        return load_scene(SLIDER, [f"roughness.wavelength={0.1 * ratio} m", "roughness.phase=90 deg"])

    most, load = errors(make, SINES[:4])
    assert slope(SINES[:4], most) == pytest.approx(1, abs=0.05)
    assert slope(SINES[:4], load) == pytest.approx(2, abs=0.1)


def test_where_scales_do_not_separate_the_average_fails():
    def make(ratio, phase):
        return load_scene(SLIDER, [f"roughness.wavelength={0.1 * ratio} m", f"roughness.phase={phase} deg"])

    spread = [errors(partial(make, phase=phase), [1.0, 2.0**-8]) for phase in (0, 90, 180, 270)]
    most, load = np.moveaxis(np.array(spread), 1, 0)
    assert most[:, 0].min() > 0.3
    assert load[:, 0].max() - load[:, 0].min() > 0.5
    assert np.abs(load[:, 1]).max() < 0.005


def test_the_load_of_a_profile_converges(tmp_path, monkeypatch):
    monkeypatch.setattr("roughfilm.rom.bearing.roughness.FACTOR_TOLERANCE", 1e-5)  # below the compared differences
    rng = np.random.default_rng(20071)
    place = np.arange(128) / 128
    profile = sum(np.sin(2 * np.pi * (k * place + rng.random())) / k for k in range(1, 9))
    profile *= 0.3e-6 / profile.std()
    np.save(tmp_path / "p.npy", np.column_stack([profile, profile]))
    entries = scene_entries(load_scene(SLIDER, [INCOMPRESSIBLE]))

    def make(ratio):
        rough = {"kind": "surface", "surface": str(tmp_path / "p.npy"), "spacing": f"{0.1 / 128!r} m", "stretch": ratio}
        return read_scene({**entries, "roughness": rough})

    ratios = SINES[:-1]
    most, load, rub = errors(make, ratios, ("load_per_width", "friction_per_width"))
    assert slope(ratios, most) == pytest.approx(1, abs=0.05)
    assert slope(ratios, load) == pytest.approx(1, abs=0.05)
    assert slope(ratios, rub) == pytest.approx(1, abs=0.1)


def test_cavitating_films_over_ridges_converge():
    def make(ratio):
        return load_scene(SLIDER, [*PARABOLIC, ridges(amplitude="2 um", wavelength=f"{0.1 * ratio} m")])

    names = ("load_per_width", "friction_per_width", "inlet_flow_per_width")
    most, load, rub, flow = errors(make, SINES, names)
    assert slope(SINES, most) == pytest.approx(1, abs=0.1)
    assert slope(SINES[1:], load[1:]) == pytest.approx(1, abs=0.15)
    assert abs(rub[-1]) < 1.5e-3
    assert abs(flow[-1]) < 1e-3


def test_oblique_ridges_on_a_pad_with_sides_converge():
    ratios, overrides = np.array([0.25, 0.125, 0.0625]), ["geometry.shape=linear", "roughness.direction=40 deg"]
    averaged = HOMOGENIZED.solve(load_scene(PAD, overrides), Request(resolution=128))
    smooth = SMOOTH.solve(load_scene(PAD, overrides), Request(resolution=128))
    result = []
    for ratio in ratios:
        scene = load_scene(PAD, [*overrides, f"roughness.wavelength={20 * ratio} mm"])
        followed = DIRECT.solve(scene, Request(resolution=256))
        names = ("load", "friction", "pressure_max", "side_leakage")
        result.append([value(followed, name) / value(averaged, name) - 1 for name in names])
    off = np.abs(result)
    assert (off[-1] < (0.03, 0.02, 0.07, 0.05)).all()
    assert (off[-1] < off[0])[:3].all()
    assert slope(ratios, off[:, 2]) == pytest.approx(1, abs=0.3)
    assert value(averaged, "load") > 1.15 * value(smooth, "load")


def test_oblique_ridges_lead_the_flow_to_one_side():
    high, low = (
        HOMOGENIZED.solve(load_scene(PAD, [f"roughness.direction={angle} deg"]), Request(resolution=64))
        for angle in (-45, 45)
    )
    assert value(high, "load") == pytest.approx(value(low, "load"), rel=1e-6)
    turned = low.fields["pressure"].values[:, ::-1]
    assert high.fields["pressure"].values == pytest.approx(turned, rel=1e-6, abs=1e-6 * turned.max())
    # waves at +45 degrees have ridges that lead the flow towards y = 0: pressure leans there
    across = low.fields["y"].values * low.fields["pressure"].values
    assert across.sum() / low.fields["pressure"].values.sum() < 0.0099


def test_a_sector_of_large_radius_is_a_pad():
    entries = scene_entries(load_scene(PAD, ["geometry.shape=linear"]))
    radius = 20.0
    sector = {
        "shape": "sector",
        "inner_radius": f"{radius - 0.01} m",
        "outer_radius": f"{radius + 0.01} m",
        "angle": f"{0.02 / radius!r} rad",
        "film": "20 um",
        "rise": "20 um",
    }
    flat, bent = (
        HOMOGENIZED.solve(read_scene({**entries, "geometry": shape}), Request(resolution=48))
        for shape in (entries["geometry"], sector)
    )
    for name in ("load", "friction", "side_leakage", "pressure_max"):
        assert value(bent, name) == pytest.approx(value(flat, name), rel=2e-3), name
    assert not DIRECT.applies(read_scene({**entries, "geometry": sector})).applies


@pytest.mark.parametrize("angle", [0, 90])
def test_a_short_journal_is_ocvirks_with_the_factors_of_its_roughness(angle):
    width, radius = 0.8e-3, 25e-3
    rough = ridges(amplitude="10 um", direction=f"{angle} deg")
    scene = load_scene(SCENES / "journal.toml", [f"geometry.width={width} m", rough])
    result = HOMOGENIZED.solve(scene, Request(resolution=192))
    # ∂/∂y (A₂₂/12η ∂p/∂y) = u/2 ∂B₁/∂x where the film narrows, p = 0 at both sides
    angles = np.linspace(0, np.pi, 20_001)
    factors = sinusoidal_ridges(10e-6, math.radians(angle))(25e-6 * (1 + 0.4 * np.cos(angles)))
    narrowing = -np.gradient(factors.drag, angles * radius)
    expected = 3 * 0.02 * 2 * width**2 / 4 * (narrowing / factors.across).max()
    assert value(result, "pressure_max") == pytest.approx(expected, rel=0.01)


# behind a film


def streaks(ratio, part):
    """Between ridges across: how much of the way from streamers to a whole film <θh> and friction are, by quadrature.

    h = 1 + r sin s carries the flow q, a part of the way from min h to <h⁻²>/<h⁻³>: the film over the tip ends where
    h = q behind it and begins where its pressure is 0 before it.
    """
    s = np.linspace(0, 4 * np.pi, 80_001)
    h = 1 + ratio * np.sin(s)

    def primitive(values):
        return np.concatenate([[0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(s))])

    sums = {power: primitive(h**power) for power in (1, -1, -2, -3)}
    mean = {power: total[40_000] / (2 * np.pi) for power, total in sums.items()}
    whole = mean[-2] / mean[-3]
    flow = 1 - ratio + part * (whole - (1 - ratio))
    end = 4 * np.pi + np.arcsin((flow - 1) / ratio)

    def over(power, begin):
        return np.interp(end, s, sums[power]) - np.interp(begin, s, sums[power])

    before = s[(s > end - 2 * np.pi) & (s < 3 * np.pi - np.arcsin((flow - 1) / ratio))]
    pressure = over(-2, before) - flow * over(-3, before)
    begin = float(before[np.argmin(np.abs(pressure))])
    held = (over(1, begin) + flow * (2 * np.pi - (end - begin))) / (2 * np.pi)
    rub = over(-1, begin) + flow * (2 * np.pi * mean[-2] - over(-2, begin))
    rub = (rub + 3 * (over(-1, begin) - flow * over(-2, begin))) / (2 * np.pi)
    film = 4 * mean[-1] - 3 * whole * mean[-2]
    return (held - flow) / (1 - whole), (rub - flow * mean[-2]) / (film - whole * mean[-2])


@pytest.mark.parametrize(("ratio", "within"), [(0.1, 0.1), (0.3, 0.13), (0.6, 0.24)])
def test_the_length_of_wet_tips_behind_a_film(ratio, within):
    ridge = sinusoidal_ridges(ratio, 0.0)(np.array([1.0]))
    torn = float(ridge.least[0] / ridge.drag[0])
    for part in (0.3, 0.5, 0.7, 0.8, 0.9):
        held, rub = streaks(ratio, part)
        wet = float(wetness(np.array(torn + part * (1 - torn)), np.array(torn)))
        assert wet == pytest.approx(held, abs=within)
        assert wet == pytest.approx(rub, abs=within)


def test_a_negative_filling_fraction_is_an_error():
    """Ridges that all but touch, on a grid too coarse for what they drive along their lay into a cavity."""
    entries = {
        "name": "all but touching",
        "kind": "bearing",
        "geometry": {"shape": "parabolic", "length": "19.8 mm", "width": "1.98 mm", "film": "10 um", "rise": "2.67 um"},
        "lubricant": {"viscosity": "2.88 mPa*s"},
        "motion": {"speed": "-0.269 m/s"},
        "boundary": {"inlet": {"pressure": "34 kPa"}},
        "roughness": {
            "kind": "sinusoid",
            "amplitude": "9.5 um",
            "wavelength": "19.8 mm",
            "direction": "45 deg",
        },
    }
    with pytest.raises(ConvergenceError, match="a filling fraction is -"):
        HOMOGENIZED.solve(read_scene(entries), Request(resolution=32))


def test_friction_where_a_film_begins_inside_a_cell_is_of_second_order():
    """The tips are wet from the place where the film begins; its phase in the cell must not show."""
    entries = {
        "name": "starved",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "10 mm", "film": "15 um", "rise": "20 um"},
        "lubricant": {"viscosity": "0.05 Pa*s", "cavitation_pressure": "0 Pa"},
        "motion": {"speed": "1 m/s"},
        "boundary": {"inlet": {"theta": 0.45}},
        "roughness": {"kind": "sinusoid", "amplitude": "5 um", "wavelength": "2 mm", "direction": "0 deg"},
    }
    scene, model = read_scene(entries), find("bearing", "homogenized")
    frictions = [
        model.solve(scene, Request(resolution=cells))["friction_per_width"].value for cells in (100, 113, 128, 150, 200)
    ]
    assert frictions == sorted(frictions)
    assert max(frictions) / min(frictions) - 1 < 4e-5


def small_pad(film: str):
    """A pad with a rough surface in a film of this thickness."""
    entries = {
        "name": "pad",
        "kind": "bearing",
        "geometry": {"shape": "parabolic", "length": "2 mm", "width": "2 mm", "film": film, "rise": "4 um"},
        "lubricant": {"viscosity": "0.1 Pa*s"},
        "motion": {"speed": "1 m/s"},
        "roughness": {
            "kind": "surface",
            "surface": {
                "kind": "gaussian",
                "size": ["1 mm", "1 mm"],
                "points": [16, 16],
                "seed": 3,
                "rms_height": "0.5 um",
                "correlation_length": "0.25 mm",
            },
        },
    }
    return read_scene(entries)


def test_the_first_result_has_the_cost_of_the_table_and_later_ones_of_the_same_surface_have_none():
    _factors.cache_clear()
    first, second = (HOMOGENIZED.solve(small_pad(film), Request(resolution=16)) for film in ("4 um", "4.01 um"))
    assert first.provenance["table"]["digest"] == second.provenance["table"]["digest"]
    assert first.numerics.one_time["table"] > 0
    assert "table" not in second.numerics.one_time
    assert first.numerics.wall_s > 0


def test_a_solve_reports_the_progress_of_the_table_before_that_of_the_film():
    _factors.cache_clear()
    words: list[str] = []
    HOMOGENIZED.solve(small_pad("4 um"), Request(resolution=16), progress=lambda _, said: words.append(said))
    of_table = ["table of gaussian" in said for said in words]
    assert of_table[0]
    assert of_table == sorted(of_table, reverse=True)
    assert not of_table[-1]


def test_films_of_any_thickness_are_in_the_range_of_their_table():
    roughness = small_pad("4 um").roughness
    for film in (0.9 * roughness.peak, roughness.peak, 1.001 * roughness.peak, 3e-6, 1e-4):
        table = roughness.factors(film)
        assert film / 2 < table.narrowest < film
        assert table(np.array([film])).along[0] > 0
