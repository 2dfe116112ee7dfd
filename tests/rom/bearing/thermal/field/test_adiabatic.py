"""Films between walls that take no heat, against an independent solution of a wedge, and in balance of their heat."""

import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.bearing.thermal import leading
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

ADIABATIC, ISOTHERMAL = find("bearing", "adiabatic"), find("bearing", "reynolds_cavitating")
VISCOSITY, SUPPLIED, DENSITY, CAPACITY, THINNING = 0.05, 40.0, 860.0, 2000.0, 0.035

LUBRICANT = {
    "viscosity": f"{VISCOSITY} Pa*s",
    "density": f"{DENSITY} kg/m^3",
    "temperature": f"{SUPPLIED} degC",
    "heat_capacity": f"{CAPACITY} J/(kg*K)",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{THINNING} 1/K"},
}
WEDGE = {"shape": "linear", "length": "0.1 m", "film": "40 um", "rise": "40 um"}
JOURNAL = {"shape": "journal", "radius": "50 mm", "width": "80 mm", "clearance": "60 um", "eccentricity": 0.7}
LOBES = {"shape": "lobes", "lobes": 3, "arc": "100 deg", "radius": "50 mm", "width": "80 mm", "clearance": "60 um"}


def scene(geometry, speed="10 m/s", lubricant=LUBRICANT, **more):
    entries = {"name": "hot", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    return read_scene({**entries, "motion": {"speed": speed}, **more})


def solved(bearing, cells, model=ADIABATIC):
    return model.solve(bearing, Request(resolution=cells))


def value(result, name):
    return result.quantities[name].value


@cache
def exact_wedge():
    """The load, the friction and the largest temperature of the wide wedge, by shooting for its flow q.

    ∂p/∂x = 6ηu/h² - 12ηq/h³ and ρ c q ∂T/∂x = ηu²/h + 12η (q - uh/2)²/h³ with η(T), p = 0 at both ends.
    """
    speed, length, film = 10.0, 0.1, 40e-6

    def along(flow):
        def slopes(x, values):
            _, temperature, *_ = values
            h = film * (2 - x / length)
            eta = VISCOSITY * math.exp(-THINNING * (temperature - SUPPLIED))
            rise = 6 * eta * speed / h**2 - 12 * eta * flow / h**3
            power = eta * speed**2 / h + 12 * eta * (flow - speed * h / 2) ** 2 / h**3
            return [rise, power / (DENSITY * CAPACITY * flow), values[0], eta * speed / h + h / 2 * rise]

        return solve_ivp(slopes, (0, length), [0.0, SUPPLIED, 0.0, 0.0], method="DOP853", rtol=1e-11, atol=1e-9).y[
            :, -1
        ]

    flow = brentq(lambda one: along(one)[0], 0.5 * speed * film, 0.9 * speed * film, xtol=1e-16, rtol=1e-13)
    _, temperature, load, friction = along(flow)
    return {
        "load_per_width": load,
        "friction_per_width": friction,
        "inlet_flow_per_width": flow,
        "temperature_max": temperature,
        "outlet_temperature": temperature,
    }


@pytest.fixture(scope="module")
def wedges():
    return {cells: solved(scene(WEDGE), cells) for cells in (32, 64, 128)}


@pytest.mark.parametrize("name", ["load_per_width", "friction_per_width", "inlet_flow_per_width", "temperature_max"])
def test_a_wide_wedge_is_second_order(wedges, name):
    exact = exact_wedge()[name]
    errors = [abs(value(wedges[cells], name) - exact) for cells in (32, 64, 128)]
    assert errors[-1] < 1e-3 * abs(exact)
    assert math.log2(errors[0] / errors[2]) / 2 > 1.7


def test_uncertainties_cover_the_errors_of_a_wedge(wedges):
    for cells in (64, 128):
        for name, exact in exact_wedge().items():
            found = wedges[cells].quantities[name]
            assert abs(found.value - exact) <= found.uncertainty, name
            assert found.uncertainty < 0.02 * abs(exact)


def test_heat_leaves_as_it_comes_in(wedges):
    result = wedges[128]
    flow, rise = value(result, "outlet_flow_per_width"), value(result, "outlet_temperature") - SUPPLIED
    generated = value(result, "heat_generated_per_width")
    assert generated == pytest.approx(value(result, "power_loss_per_width"), rel=2e-5)  # of the film before
    assert DENSITY * CAPACITY * flow * rise == pytest.approx(generated, rel=1e-8)
    assert value(result, "heat_to_lubricant_per_width") == pytest.approx(generated, rel=1e-12)
    assert result.numerics.details["energy_imbalance"] < 1e-8


def test_a_heat_transfer_that_is_given_changes_nothing_between_insulated_walls(wedges):
    """Per area of a machine it has no meaning for a wide pad, and this model does not use it."""
    result = solved(scene(WEDGE, heat={"heat_transfer": "20 W/(m^2*K)", "area": "0.1 m^2"}), 32)
    assert value(result, "load_per_width") == value(wedges[32], "load_per_width")
    assert not any("heat.heat_transfer" in one for one in (*result.warnings, *wedges[32].warnings))


def test_a_warning_that_has_no_temperature_leaves_the_film(monkeypatch, wedges):
    def never(*_arguments):
        raise ConvergenceError("heat: belongs to no temperature")

    monkeypatch.setattr(leading, "temperatures", never)
    result = solved(scene(WEDGE), 32)
    assert value(result, "load_per_width") == value(wedges[32], "load_per_width")


@pytest.mark.parametrize("approach", ["1 mm/s", "-1 mm/s"])
def test_walls_that_approach_or_part_leave_their_heat_to_the_lubricant(approach):
    """Without heat to the walls the lubricant takes all of it, in its flows and where the film stores it."""
    moving = {"speed": "10 m/s", "approach": approach}
    result = solved(scene(WEDGE, motion=moving), 32)
    generated = value(result, "heat_generated_per_width")
    assert value(result, "heat_to_lubricant_per_width") == pytest.approx(generated, rel=1e-8)


def test_temperatures_of_infinite_flows_are_unknown():
    """A jump of the pressure at a corner makes the flow infinite, and what it carries away follows it."""
    wedge = scene(WEDGE | {"width": "80 mm"}, boundary={"inlet": {"pressure": "1 MPa"}})
    result = solved(wedge, 24)
    for name in ("outlet_temperature", "heat_generated", "heat_to_lubricant"):
        assert result.quantities[name].uncertainty is None, name
    assert result.quantities["temperature_max"].uncertainty is not None
    (jump,) = (one for one in result.warnings if "pressure jumps" in one)
    assert "outlet_temperature" in jump
    assert not any("too few points" in one for one in result.warnings)


@pytest.mark.parametrize("model", [ADIABATIC, find("bearing", "across")], ids=lambda model: model.name)
def test_corners_without_a_flow_are_not_the_hottest_place(model):
    """A pad at rest, fed with colder lubricant than that of the bath, is nowhere as hot as the bath."""
    pad = {"shape": "parallel", "length": "50 mm", "width": "40 mm", "film": "20 um"}
    recess = {"kind": "pocket", "x": "25 mm", "length": "20 mm", "extent": "20 mm", "depth": "1 mm"}
    cold = [{**recess, "pressure": "3 MPa", "temperature": "20 degC"}]
    conducting = {**LUBRICANT, "conductivity": "0.14 W/(m*K)"}
    result = solved(scene(pad, speed="0 m/s", supply=cold, lubricant=conducting), 24, model)
    assert 21 < value(result, "temperature_max") < 25


def test_a_starved_film_has_the_residual_of_its_viscosities():
    """What the inlet supplies to a starved film is no error of it."""
    result = solved(scene(WEDGE, boundary={"inlet": {"theta": 0.4}}), 32)
    assert result.numerics.details["coupled_residual"] < 1e-4


def test_the_numerics_state_the_iteration(wedges):
    details = wedges[64].numerics.details
    assert details["viscosity_change"] <= 2e-5
    assert details["coupled_residual"] <= 1e-4
    assert 0 <= details["contraction"] < 0.5
    assert details["heated_films"] <= 4


def test_a_constant_viscosity_gives_the_isothermal_film_to_the_last_bit():
    constant = {**LUBRICANT, "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
    for geometry, more in (
        (JOURNAL, {}),
        ({**WEDGE, "width": "0.1 m"}, {}),
        ({key: one for key, one in JOURNAL.items() if key != "eccentricity"}, {"load": {"force": "5 kN"}}),
        (LOBES, {"load": {"force": "5 kN"}}),
    ):
        bearing = scene(geometry, lubricant=constant, **more)
        hot, plain = solved(bearing, 24), solved(bearing, 24, ISOTHERMAL)
        np.testing.assert_array_equal(hot.fields["pressure"].values, plain.fields["pressure"].values)
        for name, one in plain.quantities.items():
            assert hot.quantities[name].value == one.value, name


@pytest.fixture(scope="module")
def journal():
    return solved(scene(JOURNAL), 48)


def test_a_journal_cavitates_and_mixes_hot_lubricant_at_its_inlet(journal):
    """New lubricant takes the heat away: ρ c (Q_new (T_out - T_new)) = P for all that leaves at its own temperature."""
    assert value(journal, "cavitated_fraction") > 0.2
    inlet, outlet, leak = (value(journal, name) for name in ("inlet_flow", "outlet_flow", "side_leakage"))
    mixture = value(journal, "inlet_temperature")
    assert SUPPLIED < mixture < value(journal, "temperature_max")
    carried = DENSITY * CAPACITY * ((outlet + leak) * (value(journal, "outlet_temperature") - mixture))
    assert inlet == pytest.approx(outlet + leak, rel=1e-6)
    assert carried == pytest.approx(value(journal, "heat_generated"), rel=0.05)  # sides draw some new lubricant in


def test_new_lubricant_alone_enters_where_none_is_carried_over(journal):
    cold = solved(scene(JOURNAL, heat={"carried_over": 0}), 48)
    assert "inlet_temperature" not in cold.quantities
    assert value(cold, "temperature_max") < value(journal, "temperature_max") - 1
    half = solved(scene(JOURNAL, heat={"carried_over": 0.5}), 48)
    assert SUPPLIED < value(half, "inlet_temperature") < value(journal, "inlet_temperature") - 2


def test_a_groove_that_replaces_all_hot_lubricant_has_its_own_temperature():
    """A part of it at least stays, so that the heat transfer that stands for the rest is balanced to its round-off."""
    groove = {"kind": "groove", "angle": "99 deg", "length": "10 mm", "extent": "40 mm", "temperature": "60 degC"}
    bore = {"shape": "lobes", "radius": "50 mm", "clearance": "76 um", "width": "60 mm", "eccentricity": [0.1, -0.5]}
    supply = [{**groove, "pressure": "0.09 MPa"}]
    result = solved(scene(bore, speed="-4 m/s", supply=supply, heat={"carried_over": 0}), 24)
    temperature = result.fields["temperature"].values
    assert np.isclose(temperature, 60, atol=1e-2).any()
    assert result.numerics.details["energy_imbalance"] < 1e-8


def test_a_load_of_almost_nothing_is_found():
    """1 Pa, which the residual of a film that suffices for a part of the change of a load would hide."""
    free = {key: one for key, one in JOURNAL.items() if key != "eccentricity"}
    result = solved(scene(free, load={"pressure": "1 Pa"}, heat={"carried_over": 0}), 16)
    assert value(result, "load") == pytest.approx(0.1 * 0.08, rel=1e-6)
    assert 0 < value(result, "eccentricity") < 1e-4


def test_the_film_under_a_load_is_that_of_its_thickness():
    free = {key: one for key, one in JOURNAL.items() if key != "eccentricity"}
    loaded = solved(scene(free, load={"force": "20 kN"}), 32)
    given = solved(scene({**free, "eccentricity": value(loaded, "eccentricity")}), 32)
    for name in ("load", "friction", "temperature_max", "outlet_temperature", "inlet_temperature", "heat_generated"):
        assert value(given, name) == pytest.approx(value(loaded, name), rel=1e-4), name
    assert value(loaded, "load") == pytest.approx(20e3, rel=1e-6)


def test_lobes_under_a_load_heat_and_come_closer():
    bearing = scene(LOBES, load={"force": "10 kN"})
    hot, plain = solved(bearing, 32), solved(bearing, 32, ISOTHERMAL)
    assert value(hot, "load") == pytest.approx(10e3, rel=1e-6)
    assert value(hot, "film_min") < value(plain, "film_min")
    assert value(hot, "temperature_max") > SUPPLIED + 10
    assert hot.numerics.details["energy_imbalance"] < 1e-8


@pytest.mark.parametrize("carried_over", [1.0, 0.6])
def test_wide_lobes_heat_as_their_arcs_do_alone_with_the_mixture_at_their_inlets(carried_over):
    """Each arc alone takes in c Q_out of the other one, at most all of Q_in, at its temperature, and new lubricant."""
    bore = {"shape": "lobes", "radius": "50 mm", "clearance": "60 um", "arc": "150 deg", "eccentricity": [0.2, -0.4]}
    heated, inlets = {}, [SUPPLIED + 10.0, SUPPLIED + 10.0]
    for _ in range(8):
        for arc in (0, 1):
            alone = bore | {"lobes": 1, "first": f"{20 + 180 * arc} deg"}
            inlet = {"boundary": {"inlet": {"temperature": f"{inlets[arc]!r} degC"}}, "heat": {"carried_over": 0}}
            heated[arc] = solved(scene(alone, "5 m/s", **inlet), 40)
            flow = value(heated[arc], "inlet_flow_per_width")
            if arc or len(heated) > 1:
                before = value(heated[1 - arc], "inlet_flow_per_width")
                hot = value(heated[arc], "outlet_temperature")
                inlets[1 - arc] = SUPPLIED + min(carried_over * flow, before) / before * (hot - SUPPLIED)
    both = solved(scene(bore | {"lobes": 2, "first": "20 deg"}, "5 m/s", heat={"carried_over": carried_over}), 96)
    highest = max(value(one, "temperature_max") for one in heated.values())
    assert min(inlets) > SUPPLIED + 3
    assert value(both, "temperature_max") == pytest.approx(highest, abs=0.2)
    for name in ("friction_per_width", "heat_generated_per_width", "inlet_flow_per_width"):
        assert value(both, name) == pytest.approx(sum(value(one, name) for one in heated.values()), rel=1e-2), name


def test_tilting_pads_have_temperatures():
    pads = {**LOBES, "lobes": 4, "arc": "80 deg", "preload": 0.3, "pivot": 0.5}
    found = solved(scene(pads, load={"force": "10 kN"}), 32)
    assert value(found, "load") == pytest.approx(10e3, rel=1e-6)
    assert SUPPLIED < value(found, "temperature_mean") < value(found, "temperature_max")


def test_a_wall_that_slides_back_mirrors_the_temperature():
    pad = {"shape": "parallel", "length": "0.1 m", "width": "0.1 m", "film": "40 um"}
    inlet = {"boundary": {"inlet": {"pressure": "1 MPa"}, "outlet": {"pressure": "1 MPa"}}}
    here, back = solved(scene(pad, **inlet), 24), solved(scene(pad, speed="-10 m/s", **inlet), 24)
    one, other = here.fields["temperature"].values, back.fields["temperature"].values
    np.testing.assert_allclose(other, one[::-1], atol=1e-3)
    assert value(back, "temperature_max_x") == pytest.approx(0.1 - value(here, "temperature_max_x"))


def test_ridges_are_averaged():
    rough = {"kind": "sinusoid", "amplitude": "8 um", "wavelength": "0.1 mm", "direction": "0 deg"}
    bearing = scene(WEDGE, roughness=rough)
    hot, cold = solved(bearing, 64), solved(bearing, 64, find("bearing", "homogenized"))
    assert value(hot, "load_per_width") < value(cold, "load_per_width")
    assert value(hot, "temperature_max") > exact_wedge()["temperature_max"]  # ridges across narrow the film


BORE = {"shape": "lobes", "radius": "25 mm", "width": "50 mm", "clearance": "50 um", "eccentricity": [0.1, -0.6]}


@pytest.mark.parametrize("viscosity", ["0.3 Pa*s", "3 Pa*s"])
def test_a_full_bore_whose_lubricant_circulates_has_temperatures(viscosity):
    """Where 3 Pa s are not thinned yet, hardly any lubricant flows through the sides: no temperature exists for it."""
    lubricant = {**LUBRICANT, "viscosity": viscosity}
    fed = {"boundary": {"sides": {"low": "0.2 MPa", "high": "0.2 MPa"}}}
    hot = solved(scene(BORE, lubricant=lubricant, **fed), 32)
    assert hot.numerics.details["heated_films"] <= 50
    assert hot.numerics.details["viscosity_change"] < 1e-3
    assert hot.numerics.details["energy_imbalance"] < 1e-8
    assert value(hot, "heat_to_lubricant") == pytest.approx(value(hot, "heat_generated"))
    temperature = hot.fields["temperature"].values
    np.testing.assert_allclose(temperature, temperature[:, ::-1], atol=0.1)
    assert temperature.min() >= SUPPLIED - 0.1
    assert hot.quantities["temperature_max"].uncertainty is None
    assert any("temperature_max: unknown uncertainty" in one for one in hot.warnings)


def test_a_full_bore_through_which_lubricant_flows_has_a_highest_temperature():
    """What enters through one side leaves through the other one in less than a turn."""
    hot = solved(scene(BORE, "2 m/s", boundary={"sides": {"low": "2 MPa"}}), 24)
    assert hot.quantities["temperature_max"].uncertainty is not None
    assert not any("turns around" in one for one in hot.warnings)


def test_a_supply_at_both_ends_feeds_the_sides():
    """Where the flow turns along the end, no film alternates between new and hot lubricant there."""
    oil = {"oil": "ISO VG 32", "temperature": f"{SUPPLIED} degC"}
    geometry = JOURNAL | {"clearance": "80 um", "width": "70 mm", "eccentricity": 0.534}
    result = solved(scene(geometry, "15.7 m/s", oil, boundary={"inlet": {"pressure": "1 MPa"}}), 24)
    assert result.numerics.details["heated_films"] < 15
    assert SUPPLIED < value(result, "temperature_max") < 90


def test_lubricant_that_returns_without_a_side_runs_away():
    wide = {key: one for key, one in JOURNAL.items() if key != "width"}
    with pytest.raises(ConvergenceError, match=r"thermal runaway, hot lubricant enters the film again") as caught:
        solved(scene(wide), 64)
    assert "\n" not in str(caught.value)


def test_the_model_needs_the_heat_of_the_lubricant():
    bare = {"viscosity": "0.05 Pa*s"}
    fits = ADIABATIC.applies(scene(WEDGE, lubricant=bare))
    assert not fits.applies
    assert "lubricant.thermoviscosity" in fits.reason
    assert ADIABATIC.applies(scene(WEDGE)).applies
