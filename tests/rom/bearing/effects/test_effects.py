"""A bearing without some of its effects: the models of the ladder, limits, sums, loads."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any, cast

import pytest
from places import SCENES

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.effects.ablation import (
    EFFECTS,
    Variant,
    VariantSolution,
    ablations,
    amount,
    at_film,
    difference,
    effects_of,
    steps,
)
from roughfilm.rom.bearing.effects.contributions import study_effects
from roughfilm.rom.bearing.effects.explanation import effect_models
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.mixed.equilibrium import equilibrium
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene

CELLS = 32
SURFACE = {
    "kind": "gaussian",
    "size": ["0.3 mm", "0.3 mm"],
    "points": [32, 32],
    "seed": 7103,
    "rms_height": "1.2 um",
    "correlation_length": "40 um",
}
PAD: dict[str, Any] = {
    "name": "pad",
    "kind": "bearing",
    "geometry": {
        "shape": "linear",
        "length": "20 mm",
        "width": "16 mm",
        "film": "2.8 um",
        "rise": "0.3 um",
        "texture": {
            "profile": "cylindrical",
            "length": "4 mm",
            "width": "6 mm",
            "depth": "5 um",
            "start": "1 mm",
            "pitch": "6 mm",
            "columns": 2,
        },
    },
    "lubricant": {
        "viscosity": "0.01 Pa*s",
        "cavitation_pressure": "-0.05 MPa",
        "compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "1.6 GPa"},
        "piezoviscosity": {"law": "barus", "pressure_coefficient": "15 GPa^-1"},
    },
    "motion": {"speed": "4 m/s"},
    "roughness": {"kind": "surface", "surface": SURFACE},
    "asperities": {"friction": 0.12, "solid": {"modulus": "70 GPa", "poisson": 0.3, "hardness": "2 GPa"}},
}
MODELS = of_kind(ladder(rom), "bearing")
OF_PAD = [effect.name for effect in EFFECTS if effect.name not in ("shear thinning", "heating")]
"""Effects of the pad, whose viscosity changes with pressure alone."""


def scene(*left_out: str, **tables: Any) -> Bearing:
    """The pad without some tables, and with more in others."""
    entries = {name: table for name, table in PAD.items() if name not in left_out}
    for name, table in tables.items():
        entries[name] = {**entries.get(name, {}), **table}
    result = read_scene(entries)
    assert isinstance(result, Bearing)
    return result


def smooth(**tables: Any) -> Bearing:
    """The pad without roughness and asperities."""
    return scene("roughness", "asperities", **tables)


@pytest.fixture(scope="module")
def all_steps() -> tuple[VariantSolution, ...]:
    """The whole pad, its effects switched on one after the other."""
    return tuple(at_film(taken, CELLS) for taken in steps(scene()))


def model_values(taken: Bearing, name: str) -> dict[str, float]:
    """The quantities of a model on the same cells."""
    result = find("bearing", name).solve(taken, Request(resolution=CELLS))
    return {quantity: entry.value for quantity, entry in result.quantities.items()}


def test_the_whole_pad_and_its_steps_are_models_of_the_ladder(all_steps: tuple[VariantSolution, ...]) -> None:
    names = ["reynolds", "reynolds_incompressible", "reynolds_cavitating", "homogenized", "mixed"]
    for name, step in zip(names, all_steps[2:], strict=True):
        for quantity, value in model_values(scene(), name).items():
            assert step.values[quantity] == pytest.approx(value, rel=1e-9, abs=1e-12), (name, quantity)


def test_without_side_flow_a_pad_is_a_line_of_it() -> None:
    bare = smooth(geometry={"texture": None})
    taken = next(one for one in ablations(bare) if not one.sides)
    line = model_values(bare, "infinitely_wide")
    result = at_film(taken, CELLS).values
    for name in ("load_per_width", "friction_per_width", "inlet_flow_per_width", "pressure_max"):
        assert result[name] == pytest.approx(line[name], rel=1e-7)
    assert result["side_leakage"] == pytest.approx(0.0, abs=1e-15)


def test_steps_add_up_to_all_of_it(all_steps: tuple[VariantSolution, ...]) -> None:
    first, last = all_steps[0], all_steps[-1]
    for name in ("load", "friction", "inlet_flow_per_width", "side_leakage", "cavitated_fraction"):
        parts = [difference(more, less, name) for less, more in pairwise(all_steps)]
        total = sum(part.value for part in parts if part is not None)
        assert total == pytest.approx(last.values[name] - first.values[name], rel=1e-12)


def test_every_effect_of_this_pad_does_something(all_steps: tuple[VariantSolution, ...]) -> None:
    whole = all_steps[-1]
    assert [effect.name for effect in effects_of(scene())] == OF_PAD
    for less, more, taken in zip(all_steps, all_steps[1:], ablations(scene()), strict=False):
        on, alone = difference(more, less, "load"), difference(whole, at_film(taken, CELLS), "load")
        assert on is not None
        assert alone is not None
        assert abs(on.value) > 1e-3 * whole.values["load"]
        assert abs(alone.value) > 1e-3 * whole.values["load"]


def test_switching_off_an_absent_effect_changes_nothing() -> None:
    lacking = smooth(
        geometry={"texture": None}, lubricant={"compressibility": "incompressible", "piezoviscosity": "constant"}
    )
    assert [effect.name for effect in effects_of(lacking)] == ["side flow", "cavitation"]
    whole = at_film(Variant(scene=lacking), CELLS)
    for effect in EFFECTS:
        if effect not in effects_of(lacking):
            assert at_film(effect.without(Variant(scene=lacking)), CELLS).values == whole.values


CONSTANT = {"compressibility": "incompressible", "piezoviscosity": "constant"}
STIFF = {"compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "1e7 GPa"}, "piezoviscosity": "constant"}
POCKETS = PAD["geometry"]["texture"]


@pytest.mark.parametrize(
    ("effect", "tables", "most"),
    [
        ("pressure dependence", {"lubricant": STIFF}, 1e-6),
        ("cavitation", {"lubricant": {"cavitation_pressure": "-100 MPa", **CONSTANT}}, 1e-7),
        ("texture", {"geometry": {"texture": {**POCKETS, "depth": "0.01 nm"}}}, 1e-4),
        ("side flow", {"geometry": {"width": "20 m", "texture": {**POCKETS, "width": None}}}, 1.1 / CELLS),
        ("roughness", {"roughness": {"kind": "sinusoid", "amplitude": "1 nm", "wavelength": "0.1 mm"}}, 1e-6),
    ],
)
def test_effects_vanish_where_they_should(effect: str, tables: dict[str, Any], most: float) -> None:
    pad = smooth(**tables)
    whole = at_film(Variant(scene=pad), CELLS)
    which = next(place for place, one in enumerate(effects_of(pad)) if one.name == effect)
    without = at_film(ablations(pad)[which], CELLS)
    assert without.values["load"] == pytest.approx(whole.values["load"], rel=most)
    friction = difference(whole, without, "friction")
    assert friction is not None
    assert abs(friction.value) <= most * whole.values["friction"] + friction.uncertainty


def test_distant_walls_have_the_flow_of_a_smooth_film() -> None:
    apart = scene(geometry={"film": "200 um", "rise": "100 um"})
    whole = at_film(Variant(scene=apart), CELLS).values
    assert whole["contact_load"] == 0
    smoothed = at_film(Variant(scene=apart, factors=False), CELLS).values
    truth = at_film(Variant(scene=smooth(geometry={"film": "200 um", "rise": "100 um"})), CELLS).values
    for name, near in (("load", 1e-6), ("friction", 1e-3), ("side_leakage", 1e-6)):
        assert smoothed[name] == pytest.approx(truth[name], rel=near)
        assert whole[name] == pytest.approx(truth[name], rel=1e-3)


def test_without_flow_factors_asperities_carry_what_they_did(all_steps: tuple[VariantSolution, ...]) -> None:
    result = at_film(Variant(scene=scene(), factors=False), CELLS)
    assert result.values["contact_load"] == pytest.approx(all_steps[-1].values["contact_load"], rel=1e-12)


def test_the_uncertainty_of_a_difference_covers_finer_grids() -> None:
    pad = smooth()
    coarse, fine = ([at_film(taken, cells) for taken in steps(pad)] for cells in (CELLS, 4 * CELLS))
    sharper = 0
    for place, (less, more) in enumerate(pairwise(coarse)):
        estimate, truth = difference(more, less, "load"), difference(fine[place + 1], fine[place], "load")
        whole = amount(more, "load")
        assert estimate is not None
        assert truth is not None
        assert whole is not None
        assert abs(estimate.value - truth.value) <= estimate.uncertainty + truth.uncertainty
        sharper += estimate.uncertainty < whole.uncertainty / 2
    assert sharper >= 2


def test_a_wedge_carries_its_load_where_reynolds_says() -> None:
    entries = {"shape": "linear", "length": "10 mm", "film": "1 um", "rise": "10 um"}
    wedge = read_scene(
        {
            "name": "wedge",
            "kind": "bearing",
            "geometry": entries,
            "lubricant": {"viscosity": "0.02 Pa*s", "cavitation_pressure": "-1 GPa"},
            "motion": {"speed": "3 m/s"},
        }
    )
    assert isinstance(wedge, Bearing)
    film, rise, length = 8e-6, 10e-6, 10e-3
    ratio = rise / film
    unit = 6 * 0.02 * 3 * length / film**2
    pressure = unit * (math.log(1 + ratio) - 2 * ratio / (2 + ratio)) / ratio**2
    result = under_load(Variant(scene=wedge), pressure, 1024)
    assert result.values["film"] == pytest.approx(film, rel=1e-5)
    estimate = amount(result, "film")
    assert estimate is not None
    assert abs(estimate.value - film) <= estimate.uncertainty


def test_the_whole_pad_under_a_load_is_the_mixed_film_in_balance() -> None:
    pressure = 1.5e6
    result, truth = (
        under_load(Variant(scene=scene()), pressure, CELLS),
        equilibrium(scene(), pressure, resolution=CELLS),
    )
    assert result.values["load"] == pytest.approx(pressure * 20e-3 * 16e-3, rel=1e-6)
    assert result.values["film"] == pytest.approx(truth.separation, rel=1e-5)
    assert result.values["friction"] == pytest.approx(truth.friction, rel=1e-4)
    assert result.values["contact_share"] == pytest.approx(truth.contact_share, rel=1e-4)


def test_a_variant_without_a_solution_is_reported_with_the_others_solved() -> None:
    waves = read_scene(
        {
            "name": "waves",
            "kind": "bearing",
            "geometry": {
                "shape": "squared_cosine_inlet",
                "length": "10 mm",
                "extent": "10 mm",
                "film": "5 um",
                "amplitude": "5 um",
                "wavelength": "5 mm",
            },
            "lubricant": {"viscosity": "0.01 Pa*s", "cavitation_pressure": "-1 kPa"},
            "motion": {"speed": "3 m/s"},
        }
    )
    assert isinstance(waves, Bearing)
    result = study_effects(waves, lambda taken, progress: under_load(taken, 5e4, 128, progress))
    assert set(result.unsolved) == {"the plain film"}
    assert result.plain == {}
    (cavitation,) = result.contributions
    assert cavitation.on == {} == cavitation.alone
    assert cavitation.after["load_per_width"].value == pytest.approx(5e4 * 10e-3, rel=1e-5)


def test_more_than_any_film_carries_is_refused() -> None:
    with pytest.raises(InputError, match="at most"):
        under_load(Variant(scene=smooth(lubricant=CONSTANT)), 1e12, CELLS)
    with pytest.raises(InputError, match="must be above 0"):
        under_load(Variant(scene=smooth()), -1.0, CELLS)


def test_a_study_solves_no_bearing_twice_and_adds_up() -> None:
    solved: list[Variant] = []

    def solve(taken: Variant, _progress: object) -> VariantSolution:
        solved.append(taken)
        return at_film(taken, CELLS)

    result = study_effects(smooth(), solve)
    assert len(solved) == 2 * len(result.contributions)
    assert all(one != other for place, one in enumerate(solved) for other in solved[:place])
    total = result.plain["load"].value + sum(one.on["load"].value for one in result.contributions)
    assert total == pytest.approx(result.full["load"].value, rel=1e-12)
    last = result.contributions[-1]
    assert last.alone["load"].value == last.on["load"].value


def test_each_effect_has_its_model_and_its_numbers() -> None:
    models = {one.effect: one for one in effect_models(scene(lubricant={**PAD["lubricant"], "density": "850 kg/m^3"}))}
    assert list(models) == [*OF_PAD, "inertia"]
    assert models["roughness"].model == "homogenized"
    assert "period over length = 0.015" in models["roughness"].why
    assert "λ = h/Sq = 2.3" in models["asperities"].why
    assert f"Re·h/l = {850 * 4 * 2.8e-6 / 0.01 * 2.8e-6 / 4e-3:.2g}" in models["texture"].why
    assert [one.why for one in effect_models(smooth())][-1].startswith("left out: the scene has no lubricant.density")
    *_, inertia, slope = effect_models(cast(Bearing, load_scene(SCENES / "wide_pad.toml")))
    assert (inertia.effect, inertia.model) == ("inertia", "film")
    assert "in full, film minus the same film without density" in inertia.why
    assert (slope.effect, slope.model) == ("slope", "film_slope")


def test_variants_of_one_scene_differ() -> None:
    whole = Variant(scene=scene())
    assert replace(whole, sides=False) != whole
    assert Variant(scene=scene()) == whole


def test_a_film_sealed_by_its_roughness_is_reported_with_the_others_solved() -> None:
    thin = scene(geometry={"film": "0.3 um", "rise": "0.1 um", "texture": None}, lubricant=CONSTANT)
    result = study_effects(thin, lambda taken, _progress: at_film(taken, CELLS))
    assert set(result.unsolved) == {"with roughness"}
    assert "blocks the flow" in result.unsolved["with roughness"]
    assert result.full["contact_load"].value > 0
    roughness, asperities = result.contributions[-2:]
    assert roughness.on == {} == asperities.on == asperities.alone
    assert roughness.alone["load"].value > 0
