"""What a scene says about heat is refused in one line where it has no effect or no sense."""

import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError

PAD = {
    "name": "pad",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "20 um", "rise": "20 um"},
    "lubricant": {"oil": "ISO VG 32", "temperature": "45 degC"},
    "motion": {"speed": "5 m/s"},
}
PLAIN = {"viscosity": "20 mPa*s"}
HOLE = {"kind": "hole", "diameter": "2 mm", "x": "10 mm", "pressure": "1 bar", "temperature": "40 degC"}
LAW = {"law": "exponential", "temperature_coefficient": "0.03 1/K"}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"lubricant": PLAIN, "heat": {}},
            r"heat: got a table, but the scene has no temperature without lubricant\.",
        ),
        ({"lubricant": PLAIN, "supply": [HOLE]}, r"supply\.0\.temperature: got a temperature, but the scene has no"),
        (
            {"lubricant": PLAIN, "boundary": {"inlet": {"temperature": "40 degC"}}},
            r"boundary\.inlet\.temperature: got a temperature, but the scene has no temperature without lubricant",
        ),
        (
            {"lubricant": {**PLAIN, "temperature": "45 degC", "density": "860 kg/m^3", "thermoviscosity": LAW}}
            | {"heat": {}},
            r"heat: got a table, but the scene has no temperature without lubricant\.heat_capacity; give it, name",
        ),
        ({"heat": {"fixed_wall": "conducting"}}, r"heat\.fixed_wall: got a conducting wall without a thermal resis"),
        (
            {"heat": {"sliding_wall": {"kind": "conducting", "thickness": "5 mm"}}},
            r"heat\.sliding_wall\.conductivity: is missing beside thickness",
        ),
        (
            {"heat": {"fixed_wall": {"kind": "conducting", "conductivity": "50 W/(m*K)"}}},
            r"heat\.fixed_wall\.thickness: is missing beside conductivity",
        ),
        (
            {"heat": {"surroundings": "20 degC"}},
            r"heat\.surroundings: got a temperature without heat_transfer and",
        ),
        (
            {"heat": {"fixed_wall": {"kind": "temperature", "temperature": "40 K"}}},
            r"heat\.fixed_wall\.temperature: got -233\.1 °C; it must be from -155 °C to 545 °C, .*; check the unit",
        ),
        ({"supply": [HOLE | {"temperature": "40 K"}]}, r"supply\.0\.temperature: got -233\.1 °C; it must be from"),
        (
            {"heat": {"time_constant": "10 s"}, "body": {"start": {"temperature": "900 degC"}}},
            r"body\.start\.temperature: got 900 °C; it must be from",
        ),
        (
            {"lubricant": {"oil": "ISO VG 32", "temperature": "45 K"}},
            r"lubricant\.temperature: got -228\.1 °C; it",
        ),
        ({"lubricant": {"oil": "SAE 30", "temperature": "9000 K"}}, r"lubricant\.temperature: got 8727 °C; it must be"),
        (
            {"lubricant": {"oil": "ISO VG 32", "temperature": "113 degF"}},
            r"got '113 degF', a .*; write '45 degC'$",
        ),
    ],
)
def test_heat_without_effect_or_sense_is_refused_in_one_line(changes, words):
    with pytest.raises(InputError, match=words) as refused:
        rf.read_scene(PAD | changes)
    assert "\n" not in str(refused.value)


WIDE_PAD = {"shape": "linear", "length": "50 mm", "rise": "20 um"}
JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "40 um", "width": "25 mm"}
RING = {"shape": "sector", "inner_radius": "40 mm", "outer_radius": "80 mm", "angle": "45 deg", "rise": "20 um"}
SOLID = {"conductivity": "50 W/(m*K)", "density": "7800 kg/m^3", "heat_capacity": "460 J/(kg*K)"}


@pytest.mark.parametrize(
    ("geometry", "applies"),
    [
        (WIDE_PAD | {"width": "50 mm"}, True),
        (JOURNAL, True),
        (RING, True),
        (RING | {"joined": True}, False),
        (JOURNAL | {"shape": "lobes"}, False),
    ],
)
def test_a_half_space_slides_past_films_with_an_inlet_also_under_a_load(geometry, applies):
    sides = {} if applies else {"boundary": {"sides": {"low": "0.1 MPa"}}}
    heat = {"sliding_wall": {"kind": "half_space", **SOLID}}
    scene = rf.read_scene(PAD | sides | {"geometry": geometry, "load": {"pressure": "1 MPa"}, "heat": heat})
    fits = next(one for one in rf.models("bearing") if one.name == "across").applies(scene)
    assert fits.applies == applies
    assert applies or "a half space needs a film with an inlet past which it slides; take turning" in fits.reason


@pytest.mark.parametrize(
    ("model", "heat", "left"),
    [
        ("heat_balance", {"fixed_wall": {"kind": "temperature", "temperature": "40 degC"}}, "heat.fixed_wall"),
        ("adiabatic", {"sliding_wall": "turning"}, "heat.sliding_wall"),
        ("adiabatic", {"heat_transfer": "20 W/(m^2*K)", "area": "1 m^2"}, "heat.heat_transfer"),
        ("across", {"heat_transfer": "20 W/(m^2*K)", "area": "1 m^2"}, None),
        (
            "across",
            {
                "heat_transfer": "20 W/(m^2*K)",
                "area": "1 m^2",
                "fixed_wall": {"kind": "temperature", "temperature": "40 degC"},
            },
            "heat.heat_transfer",
        ),
        ("across", {"sliding_wall": "turning"}, None),
    ],
)
def test_a_model_says_which_heat_it_leaves_out(model, heat, left):
    fits = next(one for one in rf.models("bearing") if one.name == model).applies(rf.read_scene(PAD | {"heat": heat}))
    assert fits.applies
    assert (f"leaves out {left}" in fits.reason) if left else ("heat." not in fits.reason)
