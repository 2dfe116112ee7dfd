"""The models of a bearing: published numbers, closed forms, limits in which they agree, and the contract."""

import math
import re

import numpy as np
import pytest
from places import SCENES

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.totals.rounding import NO_LOAD
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.model import Effect, best, ladder, of_kind, one_effect_away
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

MODELS = of_kind(ladder(rom), "bearing")
CAVITATING = find("bearing", "reynolds_cavitating")


HEATED = [
    "lubricant.temperature=40 degC",
    "lubricant.density=870 kg/m^3",
    "lubricant.heat_capacity=2000 J/(kg*K)",
    "lubricant.conductivity=0.13 W/(m*K)",
    'lubricant.thermoviscosity={"law": "exponential", "temperature_coefficient": "0.03 1/K"}',
]

THINNING = ['lubricant.shear_thinning={"law": "carreau_yasuda", "index": 0.5, "relaxation_time": "25 us"}']

ROUGH = [
    'roughness={"kind": "sinusoid", "amplitude": "2 um", "wavelength": "50 mm", "direction": "30 deg"}',
]


def solve(name, *overrides, model="reynolds_cavitating", **options):
    return find("bearing", model).solve(load_scene(SCENES / f"{name}.toml", overrides), Request(**options))


def values(result):
    return {name: quantity.value for name, quantity in result.quantities.items()}


def test_the_lattice():
    assert [model.name for model in MODELS] == [
        "reynolds",
        "infinitely_wide",
        "reynolds_incompressible",
        "film",
        "reynolds_cavitating",
        "film_slope",
        "homogenized",
        "direct",
        "mixed",
        "shear_thinning",
        "heat_balance",
        "adiabatic",
        "across",
    ]
    steps = {(a.name, b.name): effect for a in MODELS for b, effect in one_effect_away(a, MODELS)}
    assert steps == {
        ("reynolds", "reynolds_incompressible"): Effect.CAVITATION,
        ("reynolds", "film"): Effect.INERTIA,
        ("reynolds_incompressible", "reynolds_cavitating"): Effect.PRESSURE_DEPENDENCE,
        ("infinitely_wide", "reynolds_cavitating"): Effect.SIDE_FLOW,
        ("reynolds_cavitating", "homogenized"): Effect.ROUGHNESS,
        ("homogenized", "direct"): Effect.FINITE_WAVES,
        ("mixed", "shear_thinning"): Effect.SHEAR_THINNING,
        ("shear_thinning", "heat_balance"): Effect.HEATING,
        ("heat_balance", "adiabatic"): Effect.TEMPERATURE_FIELD,
        ("adiabatic", "across"): Effect.TEMPERATURE_ACROSS,
    }
    assert best(MODELS).name == "across"


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_contract(model, tips):
    scene = load_scene(SCENES / "journal.toml", ROUGH if Effect.ROUGHNESS in model.keeps else [])
    if Effect.DEFORMATION in model.keeps:
        scene = tips.scene(scene_entries(scene)["geometry"] | {"eccentricity": 0.95})
    if Effect.HEATING in model.keeps:
        scene = load_scene(SCENES / "journal.toml", HEATED)
    elif Effect.SHEAR_THINNING in model.keeps:
        scene = load_scene(SCENES / "journal.toml", THINNING)
    if Effect.INERTIA in model.keeps:
        scene = load_scene(SCENES / "wide_pad.toml")
    seen = []
    result = model.solve(scene, Request(resolution=32), progress=lambda done, words: seen.append((done, words)))
    assert result.model == model.name
    assert set(kinds()["bearing"].compared) <= set(result.quantities)
    assert {"x", "y", "film_thickness", "pressure", "density_ratio"} <= set(result.fields)
    assert len({field.values.shape for field in result.fields.values()}) == 1
    assert result.numerics.residual <= 1e-9
    assert result.provenance["keeps"] == sorted(model.keeps)
    assert result["load_per_width"].uncertainty > 0
    assert all(0 <= done <= 1 for done, _ in seen)
    assert model.applies(scene).reason
    assert model.cost(scene, 64) > 0
    for options, words in (
        ({"resolution": 7}, "resolution: got 7"),
        ({"tolerance": 2.0}, "tolerance: got 2.0"),
        ({"scheme": "upwind"}, "offers no choice"),
        ({"processes": 2}, "processes: got 2"),
    ):
        with pytest.raises(InputError, match=words):
            model.solve(scene, Request(**options))


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        ((), {"film_start": 0, "rupture": 0.70277, "load_per_width": 108785.05, "pressure_max": 3715098.3}),
        (
            ("boundary.inlet.theta=0.55",),
            {"film_start": 0.15624, "rupture": 0.65811, "load_per_width": 41640.25, "pressure_max": 1942332.4},
        ),
        (
            ("lubricant.compressibility.bulk_modulus=10 GPa",),
            {"film_start": 0, "rupture": 0.67909, "load_per_width": 101403.97, "pressure_max": 3592809.4},
        ),
    ],
)
def test_the_parabolic_slider_of_vijayaraghavan_and_keith(overrides, expected):
    result = values(solve("parabolic_slider", *overrides, resolution=100_000))
    for name, value in expected.items():
        assert result[name] == pytest.approx(value, rel=1e-6 if "film" not in name else 1e-5, abs=1e-5)


@pytest.mark.parametrize("modulus", ["0.05 GPa", "1 GPa", "100 GPa"])
@pytest.mark.parametrize("theta", [0.52, 0.6, 0.9])
def test_a_starved_film_forms_where_the_gap_is_as_thin_as_the_supplied_film(modulus, theta):
    law = f"lubricant.compressibility.bulk_modulus={modulus}"
    result = values(solve("parabolic_slider", law, f"boundary.inlet.theta={theta}", resolution=4000))
    # h(x2) = θ h(0): 1 + (2x - 1)² = 2 θ; a film that reaches the inlet turns away what it cannot take
    if result["film_start"] > 0:
        assert result["rupture"] == pytest.approx((1 + math.sqrt(2 * theta - 1)) / 2, abs=2e-6)
        assert result["inlet_flow_per_width"] == pytest.approx(4.57 / 2 * theta * 50.8e-6, rel=1e-12)
    else:
        assert result["inlet_flow_per_width"] < 4.57 / 2 * theta * 50.8e-6


@pytest.mark.parametrize(("eccentricity", "sommerfeld", "angle"), [(0.1, 1.330, 79.5), (0.2, 0.632, 73.9), (0.4, 0.260, 62.6)])  # fmt: skip  # noqa: E501
def test_the_journal_bearing_of_raimondi_and_boyd(eccentricity, sommerfeld, angle):
    result = values(solve("journal", f"geometry.eccentricity={eccentricity}", resolution=128))
    assert result["sommerfeld_number"] == pytest.approx(sommerfeld, rel=0.015)
    assert result["attitude_angle"] == pytest.approx(angle, rel=0.015)


def test_a_full_journal_without_cavitation_is_sommerfelds():
    result = values(solve("journal", "geometry.width=1 km", model="reynolds", resolution=64))
    wide = load_scene(SCENES / "journal.toml")
    entries = scene_entries(wide)
    del entries["geometry"]["width"]
    line = values(find("bearing", "reynolds").solve(read_scene(entries)))
    e = 0.4  # W = 12 π η u (R/c)² ε / ((2 + ε²) √(1 - ε²)), at right angles to the narrowest place
    load = 12 * math.pi * 0.02 * 2 * 1e3**2 * e / ((2 + e**2) * math.sqrt(1 - e**2))
    assert line["load_per_width"] == pytest.approx(load, rel=1e-6)
    assert line["attitude_angle"] == pytest.approx(90, abs=1e-6)
    torque = 4 * math.pi * 0.02 * 2 * 1e3 * (1 + 2 * e**2) / ((2 + e**2) * math.sqrt(1 - e**2))
    assert line["friction_per_width"] == pytest.approx(torque, rel=1e-6)
    assert result["load_per_width"] == pytest.approx(load, rel=0.03)  # its last cells at the sides see the bath


def test_sliding_backwards_gives_the_mirrored_film():
    forth = solve("parabolic_slider", "boundary.inlet.theta=0.55", resolution=501)
    back = solve("parabolic_slider", "boundary.inlet.theta=0.55", "motion.speed=-4.57 m/s", resolution=501)
    assert back.fields["pressure"].values[::-1] == pytest.approx(forth.fields["pressure"].values, rel=1e-9, abs=1e-3)
    assert back.fields["x"].values == pytest.approx(forth.fields["x"].values, rel=1e-12)
    for name, quantity in forth.quantities.items():
        assert back.quantities[name].value == pytest.approx(quantity.value, rel=1e-9, abs=1e-12)


def test_without_sliding_the_pressure_falls_with_the_resistance():
    result = solve("parabolic_slider", "motion.speed=0 m/s", "boundary.inlet.pressure=1 bar", resolution=2000)
    # incompressible: q = Δp / (12 η ∫h⁻³ dx), ∫ (1 + s²)⁻³ ds = 1/2 + 3π/16 over (-1, 1)
    integral = 76.2e-3 / 2 / 25.4e-6**3 * (0.5 + 3 * math.pi / 16)
    flow = values(result)["inlet_flow_per_width"]
    assert flow == pytest.approx(1e5 / (12 * 0.039 * integral), rel=1e-3)  # compression: p / 2β = 7e-4
    assert values(result)["cavitated_fraction"] == 0


def test_pressure_that_compresses_nothing_changes_nothing():
    stiff = values(solve("parabolic_slider", "lubricant.compressibility.bulk_modulus=1e9 GPa", resolution=1000))
    plain = values(solve("parabolic_slider", model="reynolds_incompressible", resolution=1000))
    for name, value in plain.items():
        assert stiff[name] == pytest.approx(value, rel=1e-6, abs=1e-9)


def test_a_film_that_only_narrows_needs_no_cavitation():
    linear = {"shape": "linear", "length": "20 mm", "width": "30 mm", "film": "10 um", "rise": "12 um"}
    entries = scene_entries(load_scene(SCENES / "parabolic_slider.toml")) | {"geometry": linear}
    scene = read_scene(entries)
    plain, cavitating = (
        values(find("bearing", name).solve(scene, Request(resolution=64)))
        for name in ("reynolds", "reynolds_incompressible")
    )
    assert cavitating["cavitated_fraction"] == 0
    for name, value in plain.items():
        assert cavitating[name] == pytest.approx(value, rel=1e-7, abs=1e-12)


def test_what_leaves_a_bearing_at_its_sides_was_brought():
    # the film is full at the inlet and cavitated at the outlet; what does not leave through the sides leaves there
    result = solve("journal", resolution=256)
    theta, h, pressure = (result.fields[name].values for name in ("density_ratio", "film_thickness", "pressure"))
    carried = 2.0 / 2 * (theta * h)[-3, 1:-1].mean() * 50e-3
    assert pressure[-4:].max() == 0
    quantities = values(result)
    assert quantities["inlet_flow_per_width"] * 50e-3 - quantities["side_leakage"] == pytest.approx(carried, rel=0.01)
    assert quantities["side_leakage"] > 0.01 * carried


def test_the_infinitely_wide_line_stands_for_a_wide_bearing():
    wide = values(solve("journal", "geometry.width=5 m", model="infinitely_wide"))
    plane = values(solve("journal", "geometry.width=5 m", resolution=128))
    assert wide["load_per_width"] == pytest.approx(plane["load_per_width"], rel=0.03)
    assert not find("bearing", "infinitely_wide").applies(load_scene(SCENES / "parabolic_slider.toml")).applies


def test_the_model_without_cavitation_refuses_a_starved_inlet():
    scene = load_scene(SCENES / "parabolic_slider.toml", ["boundary.inlet.theta=0.9"])
    assert not find("bearing", "reynolds").applies(scene).applies
    with pytest.raises(InputError, match=r"^model: got 'reynolds'; the inlet is starved"):
        find("bearing", "reynolds").solve(scene)


def test_a_supply_too_small_for_a_film_is_reported():
    result = solve("parabolic_slider", "boundary.inlet.theta=0.3")
    assert values(result)["load_per_width"] == 0
    assert values(result)["pressure_max"] == 0
    assert (values(result)["film_start"], values(result)["rupture"]) == (1, 1)
    assert values(result)["cavitated_fraction"] > 0.999
    assert "no film forms" in result.warnings[0]


def test_loads_count_from_ambient():
    pumped = ["lubricant.cavitation_pressure=-1 bar", "motion.speed=0 m/s"]
    result = values(solve("parabolic_slider", *pumped, "boundary.inlet.pressure=0 bar"))
    assert result["load_per_width"] == pytest.approx(0, abs=1e-6)
    assert result["cavitated_fraction"] == 0


def test_the_uncertainty_covers_a_finer_grid():
    coarse, fine = (solve("parabolic_slider", resolution=n) for n in (250, 16_000))
    for name in ("load_per_width", "friction_per_width", "pressure_max"):
        error = abs(coarse.quantities[name].value - fine.quantities[name].value)
        assert error <= coarse[name].uncertainty


def test_loads_converge_at_second_order_in_the_plane():
    loads = [values(solve("journal", resolution=n))["load"] for n in (64, 128, 256, 512)]
    steps = np.diff(loads)
    assert np.log2(np.abs(steps[:-1] / steps[1:])) == pytest.approx([2, 2], abs=0.15)


def joined(cells, **changes):
    numbers = {"inner_radius": "40 mm", "outer_radius": "80 mm", "angle": "45 deg", "rise": "20 um", "taper": 0.7}
    entries = scene_entries(load_scene(SCENES / "parabolic_slider.toml"))
    entries["geometry"] = {"shape": "sector", "film": "10 um", "joined": True, **numbers}
    entries["boundary"] = {"sides": {"low": "1 bar", "high": "1 bar"}}
    return CAVITATING.solve(read_scene(entries | changes), Request(resolution=cells))


def test_joined_pads_meet_where_they_are_joined():
    loads = [values(joined(cells))["load"] for cells in (48, 96, 192)]
    assert abs(loads[2] - loads[1]) < 0.4 * abs(loads[1] - loads[0])
    pressure = joined(48).fields["pressure"].values
    assert abs(pressure[0] - pressure[-1]).max() < 0.2 * pressure.max()
    assert values(joined(48, motion={"speed": "-4.57 m/s"}))["load"] != pytest.approx(loads[0], rel=1e-3)


def test_the_line_of_the_greatest_pressure_lies_in_the_film():
    entries = scene_entries(load_scene(SCENES / "parabolic_slider.toml"))
    entries["geometry"]["width"] = "0.1 m"
    entries["boundary"]["sides"] = {"low": "10 MPa"}
    result = values(CAVITATING.solve(read_scene(entries), Request(resolution=48)))
    assert result["film_start"] < 0.1


def test_no_film_is_reported_only_without_any_film_node():
    still = solve("journal", "geometry.eccentricity=0", resolution=32)
    assert still.warnings == (NO_LOAD,)
    below = ["lubricant.cavitation_pressure=-1 bar", "boundary.outlet.pressure=-1 bar"]
    empty = solve("parabolic_slider", "boundary.inlet.theta=0.3", *below)
    assert "no film forms" in empty.warnings[0]


def test_a_starved_inlet_without_sliding_is_reported():
    result = solve("parabolic_slider", "boundary.inlet.theta=0.5", "motion.speed=0 m/s", resolution=64)
    assert "is treated as flooded" in result.warnings[0]


@pytest.mark.parametrize(("fed", "warned"), [("0.5 MPa", True), ("1 kPa", False)])
def test_one_line_warns_of_pressure_at_the_sides_that_it_leaves_out(fed, warned):
    """The largest pressure of this film is some MPa."""
    entries = scene_entries(load_scene(SCENES / "parabolic_slider.toml"))
    entries["geometry"]["width"] = "0.1 m"
    entries["boundary"]["sides"] = {"high": fed}
    scene = read_scene(entries)
    warnings = find("bearing", "infinitely_wide").solve(scene, Request(resolution=512)).warnings
    assert any(warning.startswith("boundary.sides: ") for warning in warnings) == warned
    assert not any("boundary.sides" in one for one in CAVITATING.solve(scene, Request(resolution=32)).warnings)


def test_an_unknown_uncertainty_is_not_zero():
    fine = solve("parabolic_slider", resolution=16_000)
    for options in ({"resolution": 256}, {"resolution": 1024}, {"tolerance": 1e-3}):
        result = solve("parabolic_slider", **options)
        for name in ("load_per_width", "friction_per_width", "rupture", "cavitated_fraction", "pressure_max"):
            error = abs(result.quantities[name].value - fine.quantities[name].value)
            assert error <= result[name].uncertainty, (name, options)
    assert "there is no coarser grid" in solve("parabolic_slider", resolution=10).warnings[0]
    same = solve("parabolic_slider", "geometry.count=1000", resolution=500)  # one cell for each, on every grid
    assert all(quantity.uncertainty is None for quantity in same.quantities.values())
    assert any("has 1 cells" in warning for warning in same.warnings)


@pytest.mark.parametrize("modulus", ["1 Pa", "1 GPa"])
def test_the_neglected_effects_are_reported_for_any_film(modulus):
    law = ["lubricant.piezoviscosity.law=barus", "lubricant.piezoviscosity.pressure_coefficient=20 GPa^-1"]
    bulk = f"lubricant.compressibility.bulk_modulus={modulus}"
    rough = 'roughness={"kind": "sinusoid", "amplitude": "0.05 um", "wavelength": "1 mm"}'
    for more in ([], [rough]):
        scene = load_scene(SCENES / "parabolic_slider.toml", [*law, bulk, "geometry.film=0.1 um", *more])
        assert all(model.applies(scene).reason for model in MODELS)


def test_one_line_does_not_stand_for_pockets_or_rings():
    entries = scene_entries(load_scene(SCENES / "journal.toml"))
    entries["geometry"]["texture"] = {"length": "5 mm", "width": "5 mm", "depth": "5 um", "start": "10 mm"}
    assert not find("bearing", "infinitely_wide").applies(read_scene(entries)).applies


def test_a_grid_too_coarse_for_the_wall_is_reported():
    coarse = solve("textured_slider", resolution=40)
    assert any("has 4 cells; take at least 2 times" in warning for warning in coarse.warnings)
    fine, enough = solve("textured_slider"), solve("textured_slider", resolution=80)
    assert fine.warnings == enough.warnings == ()
    assert values(enough)["load_per_width"] == pytest.approx(values(fine)["load_per_width"], rel=0.05)


def test_pressures_outside_the_range_of_a_law_are_reported():
    rows = [[0, 870], [1e6, 870.5], [2e6, 871]]
    entries = scene_entries(load_scene(SCENES / "parabolic_slider.toml"))
    entries["lubricant"]["compressibility"] = {"law": "tabulated", "table": rows}
    warning = CAVITATING.solve(read_scene(entries), Request(resolution=256)).warnings
    assert len(warning) == 1
    assert "the law tabulated is valid up to 2e+06 Pa" in warning[0]
    assert solve("parabolic_slider", resolution=256).warnings == ()


def test_a_film_restarted_from_a_thicker_one_has_the_load_of_one_from_coarser_grids():
    scene = load_scene(SCENES / "washer.toml")
    thicker = scene.model_copy(update={"geometry": scene.geometry.at_film(scene.geometry.film * (1 + 1e-5))})
    start = balance(thicker.problem(), (64, 64)).state
    restarted = balance(scene.problem(), (64, 64), start=start)
    fresh = balance(scene.problem(), (64, 64), tolerance=1e-13)
    assert restarted.levels[-1].load == pytest.approx(fresh.levels[-1].load, rel=2e-9)


@pytest.mark.parametrize(
    ("load", "warning"),
    [("1 mN", r"film thickness: up to .* m, over a tenth of"), ("6 GN", r"pressure: .* Pa; walls deform")],
)
def test_loads_at_which_the_model_does_not_hold_are_warned_of(load, warning):
    pad = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": 0.6}
    entries = {"name": "pad", "kind": "bearing", "geometry": pad, "lubricant": {"viscosity": "30 mPa*s"}}
    scene = read_scene(entries | {"motion": {"speed": "10 m/s"}, "load": {"force": load}})
    warnings = find("bearing", "reynolds_cavitating").solve(scene, Request(resolution=32)).warnings
    assert re.match(warning, warnings[0])
