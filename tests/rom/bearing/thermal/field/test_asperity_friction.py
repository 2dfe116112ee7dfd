"""Films with asperities in contact, whose heat warms the lubricant."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries

ADIABATIC, ACROSS, MIXED = (find("bearing", name) for name in ("adiabatic", "across", "mixed"))
WEDGE = {"shape": "linear", "length": "20 mm", "width": "10 mm", "film": "1.9 um", "rise": "2 um"}
HEAT = {
    "density": "860 kg/m^3",
    "temperature": "40 degC",
    "heat_capacity": "2000 J/(kg*K)",
    "conductivity": "0.14 W/(m*K)",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.03 1/K"},
}


def hot(tips, friction=None, **more):
    entries = scene_entries(tips.scene(WEDGE, **more))
    entries["lubricant"] = {**entries["lubricant"], **HEAT}
    if friction is not None:
        entries["asperities"] = {**entries["asperities"], "friction": friction}
    return read_scene(entries)


def solved(bearing, model=ADIABATIC, cells=16):
    return model.solve(bearing, Request(resolution=cells))


def value(result, name):
    return result.quantities[name].value


@pytest.mark.parametrize("model", [ADIABATIC, ACROSS], ids=lambda model: model.name)
def test_the_heat_is_that_of_film_and_asperities(tips, model):
    result = solved(hot(tips), model)
    assert value(result, "heat_generated") == pytest.approx(value(result, "power_loss"), rel=1e-4)
    taken = sum(one.value for name, one in result.quantities.items() if name.startswith("heat_to_"))
    assert taken == pytest.approx(value(result, "heat_generated"), rel=1e-8)
    rubbed = tips.friction * value(result, "contact_load") * abs(hot(tips).motion.speed)
    assert 0 < rubbed < value(result, "heat_generated")


def test_a_hot_film_leaves_more_of_the_load_to_the_asperities(tips):
    load = {"load": {"pressure": "1.25 MPa"}}
    warm, cold = solved(hot(tips, **load)), solved(hot(tips, **load), MIXED)
    assert value(warm, "load") == pytest.approx(value(cold, "load"), rel=1e-6)
    assert value(warm, "contact_load") > value(cold, "contact_load")
    assert value(warm, "film_min") < value(cold, "film_min")
    assert value(warm, "temperature_max") > 45


def test_asperities_that_a_hot_film_leaves_too_much_to_run_away_in_one_line(tips):
    with pytest.raises(ConvergenceError, match=r"thermal runaway, .* grew from .* °C") as caught:
        solved(hot(tips, load={"pressure": "1.5 MPa"}))
    assert "\n" not in str(caught.value)


def test_boundary_friction_over_temperature_is_that_of_the_contact(tips):
    """With less friction at a higher temperature the power is between those of the coefficients at both ends."""
    falling = {"table": [["20 degC", 0.2], ["200 degC", 0.02]]}
    given = hot(tips, friction=falling)
    high, low, found = (
        value(solved(hot(tips, friction=one) if isinstance(one, float) else given), "friction")
        for one in (given.asperities.friction_at(313.15), 0.02, falling)
    )
    assert low < found < high
