"""The model heat_balance: closed forms, conservation of energy, and the limits in which it is isothermal."""

import math

import numpy as np
import pytest
from scipy.special import lambertw

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import Effect
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

MODEL = find("bearing", "heat_balance")
COLD, DENSITY, CAPACITY, ETA, BETA = 40.0, 870.0, 2000.0, 0.03, 0.035
OIL = {
    "viscosity": f"{ETA} Pa*s",
    "density": f"{DENSITY} kg/m^3",
    "heat_capacity": f"{CAPACITY} J/(kg*K)",
    "temperature": f"{COLD} degC",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{BETA} 1/K"},
}
BORE = {"shape": "lobes", "radius": "25 mm", "clearance": "30 um", "width": "40 mm"}
WIDE = {name: value for name, value in BORE.items() if name != "width"}
JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "30 um", "width": "40 mm"}
WEDGE = {"shape": "linear", "length": "50 mm", "width": "40 mm", "film": "20 um", "rise": "20 um"}
RECESS = {"kind": "pocket", "x": "25 mm", "length": "20 mm", "extent": "20 mm", "depth": "1 mm", "pressure": "3 MPa"}
GROOVE = {"kind": "groove", "angle": "90 deg", "length": "8 mm", "extent": "24 mm", "pressure": "0.2 MPa"}
COOLED = {"heat_transfer": "400 W/(m^2*K)", "area": "0.05 m^2", "surroundings": "20 degC"}
CAPILLARY = {"capillary": {"diameter": "0.8 mm", "length": "40 mm"}}


def scene_of(geometry, *, speed="5 m/s", oil=(), **tables):
    lubricant = OIL | dict(oil)
    tables = {"lubricant": lubricant, "motion": {"speed": speed}} | tables
    return read_scene({"name": "heated", "kind": "bearing", "geometry": geometry, **tables})


def solved(geometry, cells=24, model=MODEL, **options):
    return model.solve(scene_of(geometry, **options), Request(resolution=cells))


def values(result):
    return {name: quantity.value for name, quantity in result.quantities.items()}


CASES = {
    "wedge": {"geometry": WEDGE},
    "wedge that slides back": {"geometry": WEDGE, "speed": "-5 m/s"},
    "wedge that the surroundings cool": {"geometry": WEDGE, "heat": COOLED},
    "wide wedge": {"geometry": {name: value for name, value in WEDGE.items() if name != "width"}},
    "journal": {"geometry": JOURNAL | {"eccentricity": 0.6}},
    "journal under a load": {"geometry": JOURNAL, "load": {"force": "4 kN"}, "heat": {"carried_over": 0.6}},
    "bore fed through a side": {
        "geometry": BORE | {"eccentricity": [0.03, -0.04]},
        "boundary": {"sides": {"low": "2 MPa"}},
    },
    "bore with a groove": {
        "geometry": BORE | {"eccentricity": [0.3, -0.4]},
        "supply": [GROOVE | {"temperature": "30 degC"}],
        "heat": {"carried_over": 0.8},
    },
    "lobes with gaps": {
        "geometry": BORE | {"lobes": 2, "arc": "150 deg", "eccentricity": [0.2, -0.3]},
        "boundary": {"inlet": {"pressure": "0.1 MPa", "temperature": "35 degC"}},
    },
    "hydrostatic pad behind a capillary": {
        "geometry": WEDGE | {"rise": "2 um"},
        "speed": "0.5 m/s",
        "supply": [RECESS | CAPILLARY],
    },
    "sector under a load": {
        "geometry": {
            "shape": "sector",
            "inner_radius": "30 mm",
            "outer_radius": "60 mm",
            "angle": "40 deg",
            "pads": 8,
            "rise": "20 um",
        },
        "load": {"force": "8 kN"},
    },
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_energy_leaves_as_it_comes_in(case):
    """The lubricant that leaves has the heat of what enters, of friction and of pressure, less what is given off."""
    result = solved(**case)
    found, supplies = values(result), case.get("supply", [])
    per = "_per_width" if "width" not in case["geometry"] and "inner_radius" not in case["geometry"] else ""

    def heat(temperature):
        return DENSITY * CAPACITY * (temperature - COLD)

    out, at_inlet = heat(found["outlet_temperature"]), heat(found["inlet_temperature"])
    sides = 0.0 if per else found["side_leakage_low"] + found["side_leakage_high"]
    inlet, outlet = (found.get(f"{end}_flow{per}") for end in ("inlet", "outlet"))
    given = [heat(float(one.get("temperature", f"{COLD} degC").split()[0])) for one in supplies]
    supplied = [found[f"supply_{number}_flow"] for number in range(1, len(supplies) + 1)]
    if inlet is None:
        # A film without an end recirculates what enters neither from a supply nor through the sides.
        entering = max(-found["side_leakage_low"], 0.0)
        left = (sides + entering) * out - sum(flow * one for flow, one in zip(supplied, given, strict=True))
        if supplies:
            carried, new = 0.8, supplied[0]
            recirculated = (found["inlet_temperature"] - 30.0) / (found["outlet_temperature"] - 30.0)
            # The groove drains a fifth of the hot lubricant, Q_r, and replaces it: T_in is the mixture.
            around = recirculated * new / (carried - recirculated)
            left += (1 - carried) * around * (out - given[0])
    else:
        left = (outlet + sides) * out - inlet * at_inlet
        left -= sum(flow * one for flow, one in zip(supplied, given, strict=True))
    generated, off = found[f"heat_generated{per}"], found[f"heat_to_surroundings{per}"]
    assert left + off == pytest.approx(generated, rel=1e-8)
    assert found[f"heat_to_lubricant{per}"] + off == pytest.approx(generated, rel=1e-12)
    middle = (found["inlet_temperature"] + found["outlet_temperature"]) / 2
    if case.get("heat") is COOLED:
        # The exponential of a stream that exchanges heat: its mean over its length is that over its logarithm.
        final = 20.0 + generated / 20.0
        first, last = found["inlet_temperature"] - final, found["outlet_temperature"] - final
        middle = final + (first - last) / math.log(first / last)
    assert found["effective_temperature"] == pytest.approx(middle, abs=1e-5)
    pumped = (
        0.0
        if inlet is None
        else sum(flow * float(one["pressure"].split()[0]) * 1e6 for flow, one in zip(supplied, supplies, strict=True))
    )
    if "boundary" not in case and inlet is not None:
        assert generated == pytest.approx(found[f"power_loss{per}"] + pumped, rel=1e-9)
    if case.get("heat") is COOLED:
        assert off == pytest.approx(20.0 * (found["effective_temperature"] - 20.0), rel=1e-6)


def test_a_bore_draws_new_lubricant_where_its_pressure_is_below_that_of_the_sides():
    """What the pressure gradient at the sides draws in, and no net flow, takes the heat away."""
    bath = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    result = solved(BORE | {"eccentricity": [0.3, -0.4]}, boundary=bath, cells=48)
    found, fields = values(result), {name: field.values for name, field in result.fields.items()}
    eta = ETA * math.exp(-BETA * (found["effective_temperature"] - COLD))
    drop = fields["pressure"][:, 0] - fields["pressure"][:, 1]
    step_x, step_y = (float(np.diff(fields[axis], axis=n).max()) for n, axis in enumerate("xy"))
    drawn = 2 * float(np.maximum(drop * fields["film_thickness"][:, 0] ** 3 / (12 * eta * step_y), 0).sum() * step_x)
    taken = DENSITY * CAPACITY * drawn * (found["outlet_temperature"] - COLD)
    assert abs(found["side_leakage"]) < 1e-9 * drawn
    assert taken == pytest.approx(found["heat_to_lubricant"], rel=1e-3)
    assert found["heat_to_lubricant"] == pytest.approx(found["power_loss"], rel=1e-9)


def test_a_wide_wedge_is_that_of_the_closed_form():
    """Friction F = η f and flow Q are those of Reynolds' wedge; T - T0 = η(T) f u/(2 ρ c Q), a Lambert function."""
    length, film, ratio, speed = 0.05, 20e-6, 1.0, 5.0
    logarithm = math.log1p(ratio)
    shear = speed * length / film * (4 * logarithm / ratio - 6 / (2 + ratio))
    flow = speed * film * (1 + ratio) / (2 + ratio)
    rise = ETA * shear * speed / (2 * DENSITY * CAPACITY * flow)
    warmed = lambertw(BETA * rise).real / BETA
    result = solved({name: value for name, value in WEDGE.items() if name != "width"}, cells=256)
    found = result.quantities
    for name, exact in {
        "effective_temperature": COLD + warmed,
        "outlet_temperature": COLD + 2 * warmed,
        "inlet_temperature": COLD,
        "friction_per_width": ETA * math.exp(-BETA * warmed) * shear,
    }.items():
        error = abs(found[name].value - exact)
        assert error <= found[name].uncertainty + 1e-9
        assert error < 1e-4 * abs(exact)
    assert warmed > 5


def test_surroundings_alone_cool_a_concentric_shaft():
    """Petroff's friction, 2π η u² R B/c, goes to the surroundings: T - T0 = P(T)/(α A), a Lambert function."""
    heat = {"heat_transfer": "20 W/(m^2*K)", "area": "0.1 m^2", "surroundings": f"{COLD} degC"}
    still = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    found = values(solved(BORE | {"eccentricity": [0.0, 0.0]}, heat=heat, boundary=still))
    rise = 2 * math.pi * ETA * 5.0**2 * 25e-3 * 40e-3 / 30e-6 / 2.0
    exact = COLD + lambertw(BETA * rise).real / BETA
    assert found["effective_temperature"] == pytest.approx(exact, abs=2e-5)
    assert found["outlet_temperature"] == found["inlet_temperature"]
    assert found["heat_to_lubricant"] == 0


@pytest.mark.parametrize("options", [{"geometry": JOURNAL | {"eccentricity": 0.5}}, CASES["journal under a load"]])
def test_a_viscosity_that_does_not_change_leaves_the_isothermal_film(options):
    """All quantities of the isothermal model and their uncertainties are the same to the last bit."""
    oil = {"thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
    heated = solved(**options, oil=oil)
    isothermal = solved(**options, model=find("bearing", "reynolds_cavitating"))
    assert heated["effective_temperature"].value > COLD + 5
    for name, quantity in isothermal.quantities.items():
        assert heated.quantities[name] == quantity, name
    for name, field in isothermal.fields.items():
        assert (heated.fields[name].values == field.values).all(), name
    assert heated.provenance["scene"]["lubricant"]["temperature"] == "313.15 K"


def test_hot_lubricant_mixes_with_new_at_the_inlet():
    """T_in - T0 is the recirculated part of the flow times T_out - T0; the more recirculates, the hotter the film."""
    effective = []
    for carried in (0.0, 0.5, 1.0):
        found = values(solved(JOURNAL | {"eccentricity": 0.6}, heat={"carried_over": carried}))
        mixed = carried * found["outlet_flow"] / found["inlet_flow"] * (found["outlet_temperature"] - COLD)
        assert found["inlet_temperature"] - COLD == pytest.approx(mixed, abs=1e-7)
        effective.append(found["effective_temperature"])
    assert effective == sorted(effective)
    assert effective[-1] - effective[0] > 1


@pytest.mark.parametrize("carried_over", [1.0, 0.6])
def test_each_gap_mixes_what_its_lobes_discharge_and_take_in(carried_over):
    """The wide lobes carry the flows that each of them has alone, and a gap passes on at most what the next one takes.

    The smaller flow enters the other lobe with new lubricant, and the excess of the larger one leaves.
    """
    bore = WIDE | {"arc": "150 deg", "eccentricity": [0.2, -0.3]}
    plain, flows = find("bearing", "reynolds_cavitating"), []
    for first in ("15 deg", "195 deg"):
        alone = values(solved(bore | {"lobes": 1, "first": first}, model=plain, cells=64))
        flows.append(alone["inlet_flow_per_width"])
    both = solved(bore | {"lobes": 2, "first": "15 deg"}, heat={"carried_over": carried_over}, cells=128)
    found = values(both)
    carried = sum(min(carried_over * out, into) for out, into in (flows, flows[::-1]))
    rise = found["outlet_temperature"] - COLD
    assert max(flows) > 1.1 * min(flows)
    assert found["inlet_temperature"] - COLD == pytest.approx(carried / sum(flows) * rise, rel=1e-3)
    taken = DENSITY * CAPACITY * (sum(flows) - carried) * rise
    assert found["heat_generated_per_width"] == pytest.approx(taken, rel=5e-3)


@pytest.mark.parametrize(
    "bearing",
    [
        {"geometry": WIDE | {"lobes": 2, "arc": "150 deg", "eccentricity": [0.2, -0.3]}},
        {"geometry": BORE | {"lobes": 4, "arc": "80 deg", "eccentricity": [0.1, -0.1]}},
        {
            "geometry": BORE | {"lobes": 4, "arc": "80 deg", "pivot": 0.5, "preload": 0.3, "first": "-45 deg"},
            "load": {"force": "1 kN"},
        },
    ],
    ids=["wide lobes", "lobes", "tilting pads"],
)
def test_lobes_and_pads_have_about_the_mean_temperature_of_the_model_with_a_field(bearing):
    """The mean is the higher one, as lubricant leaves the film colder than it enters the next one."""
    mean = values(solved(**bearing, model=find("bearing", "adiabatic")))["temperature_mean"]
    assert mean > COLD + 20
    below = (mean - values(solved(**bearing))["effective_temperature"]) / (mean - COLD)
    assert 0 < below < 0.15


@pytest.mark.parametrize("carried_over", [1.0, 0.6])
def test_gaps_renew_as_much_lubricant_as_in_the_model_with_a_field(carried_over):
    """In a film of one viscosity both have the same flows; what leaves takes the heat away, Q ρ c (T_out - T_0)."""
    constant = {"thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
    lobes = {"geometry": WIDE | {"lobes": 2, "arc": "150 deg", "eccentricity": [0.2, -0.3]}, "oil": constant}
    renewed = []
    for model in (MODEL, find("bearing", "adiabatic")):
        found = values(solved(**lobes, model=model, heat={"carried_over": carried_over}))
        rise = found["outlet_temperature"] - COLD
        renewed.append(found["heat_to_lubricant_per_width"] / (DENSITY * CAPACITY * rise))
    assert renewed[1] == pytest.approx(renewed[0], rel=1e-6)


def test_a_capillary_has_the_viscosity_of_its_supply():
    """The flow of the hot film is larger, while the capillary keeps its resistance at the temperature of the supply."""
    case = CASES["hydrostatic pad behind a capillary"]
    found = values(solved(**case))
    drop = 3e6 - found["supply_1_pressure"]
    assert found["supply_1_flow"] == pytest.approx(math.pi * 0.8e-3**4 * drop / (128 * ETA * 40e-3), rel=1e-7)
    warm = values(solved(**case | {"supply": [RECESS | CAPILLARY | {"temperature": "60 degC"}]}))
    drop = 3e6 - warm["supply_1_pressure"]
    thin = ETA * math.exp(-BETA * 20)
    assert warm["supply_1_flow"] == pytest.approx(math.pi * 0.8e-3**4 * drop / (128 * thin * 40e-3), rel=1e-7)


def test_uncertainties_cover_what_a_fine_grid_gives():
    coarse, fine = (solved(**CASES["journal under a load"], cells=cells) for cells in (32, 128))
    for name in (
        "effective_temperature",
        "outlet_temperature",
        "film_min",
        "friction",
        "heat_generated",
        "pressure_max",
    ):
        error = abs(coarse[name].value - fine[name].value)
        assert error <= coarse[name].uncertainty + fine[name].uncertainty, name
        assert coarse[name].uncertainty < 0.1 * abs(fine[name].value), name


def test_asperities_heat_the_film_too():
    """Of a pad whose asperities carry half of the load the heat is its friction, u (F_film + μ W_contact)."""
    rough = {
        "kind": "surface",
        "surface": {
            "kind": "gaussian",
            "size": ["0.2 mm", "0.2 mm"],
            "points": [24, 24],
            "seed": 3,
            "rms_height": "1 um",
            "correlation_length": "30 um",
        },
    }
    solid = {"modulus": "210 GPa", "poisson": 0.3, "hardness": "3 GPa"}
    geometry = {"shape": "linear", "length": "20 mm", "width": "20 mm", "rise": "2 um"}
    asperities = {"friction": 0.1, "solid": solid}
    options = {"load": {"pressure": "3 MPa"}, "roughness": rough, "asperities": asperities, "speed": "0.3 m/s"}
    heat = {"heat_transfer": "500 W/(m^2*K)", "area": "0.01 m^2"}
    found = values(solved(geometry, cells=16, **options, heat=heat))
    isothermal = values(solved(geometry, cells=16, **options, model=find("bearing", "mixed")))
    assert found["contact_load"] > isothermal["contact_load"] > 0
    assert found["heat_generated"] == pytest.approx(found["power_loss"], rel=1e-9)
    assert found["heat_generated"] > 0.3 * 0.1 * found["contact_load"]
    assert found["effective_temperature"] > COLD + 1


def test_thermal_runaway_is_one_line():
    """A viscosity that grows with temperature heats the film without end."""
    oil = {"thermoviscosity": {"law": "exponential", "temperature_coefficient": "-0.1 1/K"}}
    with pytest.raises(InputError, match=r"^heat_balance: thermal runaway: friction heats the film further [^\n]*$"):
        solved(WEDGE, oil=oil)


def test_a_temperature_outside_of_the_range_of_its_law_is_marked():
    """The range of the law is that about the supply temperature, also for a film that is hot."""
    hot = solved(WEDGE | {"film": "5 um", "rise": "5 um"}, speed="20 m/s")
    assert hot["effective_temperature"].value > COLD + 30
    assert [one for one in hot.outside if one.startswith("temperature: ") and "from 10 °C to 70 °C" in one]
    assert solved(WEDGE).outside == ()


@pytest.mark.parametrize("temperature", ["-20 degC", "220 degC"])
def test_a_supply_outside_of_the_range_of_its_oil_is_marked_by_every_model(temperature):
    """VG 46 flows above -15 °C and burns above 185 °C; nothing is promised, and no model is advised."""
    tables = {"geometry": WEDGE, "motion": {"speed": "0.1 m/s"}}
    oil = {"oil": "ISO VG 46", "temperature": temperature}
    scene = read_scene({"name": "cold", "kind": "bearing", "lubricant": oil, **tables})
    for name in ("reynolds_cavitating", "heat_balance", "adiabatic"):
        result = rf.solve(scene, model=name, resolution=16)
        assert "valid from -15 °C to 185 °C, pour and flash point of such oils" in result.outside[0], name
        assert result.expected_error == {}
    assert rf.advise(scene).chosen is None


def test_a_film_without_flow_is_cooled_as_a_bearing_in_still_air_and_says_so():
    """Petroff's friction goes to the surroundings by 300 W/(m² K) over diameter times width: a Lambert function."""
    still = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    result = solved(BORE | {"eccentricity": [0.0, 0.0]}, boundary=still)
    rise = 2 * math.pi * ETA * 5.0**2 * 25e-3 * 40e-3 / 30e-6 / (300.0 * 50e-3 * 40e-3)
    exact = lambertw(BETA * rise).real / BETA
    temperature = result["effective_temperature"]
    assert temperature.value == pytest.approx(COLD + exact, abs=2e-5)
    assert temperature.uncertainty > 0.3 * exact
    assert [one for one in result.warnings if "heat.heat_transfer and heat.area" in one]


@pytest.mark.parametrize("speed", [0.5, 5.0, 20.0])
def test_an_estimated_heat_transfer_makes_the_temperature_uncertain_by_a_factor_of_two(speed):
    """A concentric shaft gives Petroff's friction to the surroundings: a Lambert function.

    The uncertainty is of first order in the change, and contains both ends without being twice as large.
    """
    area, still = 50e-3 * 40e-3, {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    result = solved(BORE | {"eccentricity": [0.0, 0.0]}, boundary=still, speed=f"{speed} m/s")

    def temperature(transfer):
        rise = 2 * math.pi * ETA * speed**2 * 25e-3 * 40e-3 / 30e-6 / (transfer * area)
        return COLD + lambertw(BETA * rise).real / BETA

    colder, own, hotter = (temperature(part * 300.0) for part in (2.0, 1.0, 0.5))
    found = result["effective_temperature"]
    assert found.value == pytest.approx(own, abs=1e-3)
    widest = max(own - colder, hotter - own)
    assert widest <= found.uncertainty < 2 * widest


def test_a_slow_journal_in_cool_air_leaves_no_lubricant_colder_than_the_air():
    air = {"heat_transfer": "20 W/(m^2*K)", "area": "0.1 m^2", "surroundings": "20 degC"}
    oil = {"temperature": "60 degC"}
    found = values(solved(JOURNAL, speed="0.026 m/s", load={"force": "1 kN"}, oil=oil, heat=air))
    power, conductance = found["heat_generated"], 2.0
    assert 20 <= found["outlet_temperature"] <= 60
    assert 20 <= found["effective_temperature"] < 20 + power / conductance + 5


@pytest.mark.parametrize(
    ("heat", "geometry", "match"),
    [
        ({"heat_transfer": "20 W/(m^2*K)"}, WEDGE, r"heat\.area: is missing beside heat.heat_transfer"),
        ({"area": "1 m^2"}, WEDGE, r"heat\.heat_transfer: is missing beside heat.area"),
        (
            COOLED,
            {name: value for name, value in WEDGE.items() if name != "width"},
            "infinitely wide bearing; give .*width",
        ),
    ],
)
def test_incomplete_heat_transfer_is_refused(heat, geometry, match):
    with pytest.raises(InputError, match=match):
        solved(geometry, heat=heat)


@pytest.mark.parametrize(
    ("tables", "place"),
    [
        ({"supply": [RECESS | {"temperature": "50 degC"}]}, "supply.0"),
        ({"boundary": {"inlet": {"temperature": "50 degC"}}}, "boundary.inlet"),
    ],
)
def test_entering_lubricant_has_a_temperature_only_with_a_law(tables, place):
    cold = {name: value for name, value in OIL.items() if name != "thermoviscosity"}
    entries = {"name": "cold", "kind": "bearing", "geometry": WEDGE, "motion": {"speed": "1 m/s"}} | tables
    with pytest.raises(InputError, match=rf"{place}.temperature: got a temperature, but .* without lubricant.thermo"):
        read_scene(entries | {"lubricant": cold})
    assert read_scene(entries | {"lubricant": OIL}).isothermal().lubricant.thermoviscosity is None


def test_it_applies_to_lubricants_with_temperature_alone():
    oil = dict.fromkeys(("heat_capacity", "thermoviscosity"))
    lubricant = {name: value for name, value in OIL.items() if name not in oil}
    scene = read_scene(
        {"name": "cold", "kind": "bearing", "geometry": WEDGE, "lubricant": lubricant, "motion": {"speed": "1 m/s"}}
    )
    fits = MODEL.applies(scene)
    assert not fits.applies
    assert "lubricant.thermoviscosity, lubricant.heat_capacity missing" in fits.reason
    assert Effect.HEATING in MODEL.keeps
