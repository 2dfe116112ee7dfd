"""The flash temperature of spots in contact: by one contact that has a closed form, and by limits of the partition."""

import math

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing import flash as flash_module
from roughfilm.rom.bearing.flash import Spots, flash_temperature, flash_warnings, rise_of_spots, spots_of
from roughfilm.rom.bearing.kind import KIND
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.parts.solids import HeatConductor
from roughfilm.rom.temperature.closed_forms.moving_sources import moving_circle, resting_circle

STEEL = {"conductivity": "46 W/(m*K)", "density": "7850 kg/m^3", "heat_capacity": "460 J/(kg*K)"}
SOLID = HeatConductor.model_validate(STEEL)
STEP = 1e-6
"""Spacing of the nodes of a contact, m."""

SURFACE = {
    "kind": "gaussian",
    "size": ["0.2 mm", "0.2 mm"],
    "points": [32, 32],
    "seed": 3,
    "rms_height": "0.5 um",
    "correlation_length": "20 um",
}


def conductor(factor):
    return SOLID.model_copy(update={"conductivity": factor * SOLID.conductivity})


def one_spot(radius, pressure):
    return Spots(areas=np.array([math.pi * radius**2]), pressures=np.array([pressure]), area_fraction=0.01, nodes=100.0)


@pytest.fixture(scope="module")
def scene():
    return rf.read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "1 um", "rise": "1 um"},
            "lubricant": {"viscosity": "0.05 Pa*s"},
            "motion": {"speed": "2 m/s"},
            "roughness": {"kind": "surface", "surface": SURFACE},
            "asperities": {
                "friction": 0.1,
                "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "4 GPa"},
                "solid_heat": STEEL,
            },
        }
    )


def test_spots_carry_the_load_on_the_area_in_contact():
    heights = np.random.default_rng(5).standard_normal((32, 32)) * 1e-7
    contact = Press(heights, (1e-6, 1e-6), 1e11, hardness=5e9).at(2e8)
    for turn in (0, 7):
        moved = Press(np.roll(heights, turn, axis=(0, 1)), (1e-6, 1e-6), 1e11, hardness=5e9).at(2e8)
        spots = spots_of(moved)
        assert float(spots.areas @ spots.pressures) == pytest.approx(2e8 * (32e-6) ** 2, rel=1e-9)
        assert spots.areas.sum() == pytest.approx(contact.area_fraction_pixel * (32e-6) ** 2)
        assert sorted(spots.areas) == pytest.approx(sorted(spots_of(contact).areas))  # across the seams, too


def test_one_sphere_is_one_spot_of_the_area_of_hertz():
    x = (np.arange(64) - 32) * 2e-6
    sphere = -(x[:, None] ** 2 + x**2) / (2 * 1e-3)
    load = 1e7
    spots = spots_of(Press(sphere, (2e-6, 2e-6), 1e11, boundary="free").at(load))
    radius = (3 * load * (128e-6) ** 2 * 1e-3 / (4 * 1e11)) ** (1 / 3)
    assert spots.areas == pytest.approx([math.pi * radius**2], rel=0.1)  # in pixels


def test_equal_walls_at_rest_share_the_heat_and_a_conductor_takes_it_all():
    slow = 1e-6
    spots, flux = one_spot(10e-6, 1e9), 0.1 * 1e9 * slow
    alone = resting_circle(radius=10e-6, flux=flux, conductivity=SOLID.conductivity)
    both = rise_of_spots(spots, friction=0.1, speed=slow, rough=SOLID, smooth=SOLID)
    assert both.mean == pytest.approx(alone.mean / 2, rel=1e-3)
    assert both.high == pytest.approx(3 * math.pi / 8 * alone.greatest / 2, rel=1e-3)
    insulated = rise_of_spots(spots, friction=0.1, speed=slow, rough=conductor(1e-9), smooth=SOLID)
    assert insulated.mean == pytest.approx(alone.mean, rel=1e-3)


def test_the_shares_of_the_heat_give_both_walls_the_same_temperature():
    spots, speed = one_spot(8e-6, 3e9), 5.0
    rise = rise_of_spots(spots, friction=0.1, speed=speed, rough=conductor(0.5), smooth=SOLID).mean
    flux, at_rest = 0.1 * 3e9 * speed, {"radius": 8e-6, "speed": 0.0}
    own = moving_circle(**at_rest, flux=1.0, conductivity=SOLID.conductivity / 2, heat_per_volume=SOLID.heat_per_volume)
    other = moving_circle(
        radius=8e-6,
        flux=1.0,
        speed=speed,
        conductivity=SOLID.conductivity,
        heat_per_volume=SOLID.heat_per_volume,
    )
    assert rise / own.mean + rise / other.mean == pytest.approx(flux)


def test_the_range_is_that_of_small_and_large_spots():
    spots = Spots(
        areas=math.pi * np.array([2e-6, 2e-6, 10e-6]) ** 2, pressures=np.full(3, 1e9), area_fraction=0.01, nodes=50.0
    )
    flash = rise_of_spots(spots, friction=0.1, speed=1.0, rough=SOLID, smooth=SOLID)
    small, large = (
        rise_of_spots(one_spot(radius, 1e9), friction=0.1, speed=1.0, rough=SOLID, smooth=SOLID)
        for radius in (2e-6, 10e-6)
    )
    assert small.mean < flash.low < flash.mean < large.mean < flash.high
    assert flash.high == large.high
    assert flash.low == pytest.approx((2 * small.mean + large.mean) / 3)


def of_nodes(across, along, speed):
    """The rise at the middles of square nodes by a unit flux on each of them, K m²/W, from moving point sources."""
    middles = (np.arange(8) + 0.5) / 8 * STEP - STEP / 2
    total = np.zeros_like(along)
    for x in middles:
        for y in middles:
            distance = np.hypot(along - x, across - y)
            rate = speed * SOLID.heat_per_volume / (2 * SOLID.conductivity)
            total += np.exp(-rate * (distance - (along - x))) / distance
    return total * (STEP / 8) ** 2 / (2 * math.pi * SOLID.conductivity)


@pytest.mark.parametrize("speed", [0.1, 2.0, 20.0])
def test_lightly_touching_spots_are_as_hot_as_both_walls_solved_at_once(speed):
    """The heat of each node in contact is divided so that both walls have one temperature there, also by the others."""
    spectrum = {**SURFACE, "size": ["0.128 mm", "0.128 mm"], "points": [128, 128], "correlation_length": "8 um"}
    heights = RoughSurface.model_validate({"kind": "surface", "surface": spectrum}).scaled_heights()
    contact = Press(heights, (STEP, STEP), 115e9, hardness=4e9).at(1e7)
    i, j = np.nonzero(contact.in_contact)
    assert 10 < i.size < 200
    along, across = ((one[:, None] - one) * STEP for one in (i, j))
    along, across = ((one + 64e-6) % 128e-6 - 64e-6 for one in (along, across))  # the nearest of all periods
    rough, smooth = of_nodes(across, along, 0.0), of_nodes(across, along, speed)
    flux = 0.1 * contact.pressure[i, j] * speed
    rise = rough @ np.linalg.solve(rough + smooth, smooth @ flux)
    flash = rise_of_spots(spots_of(contact), friction=0.1, speed=speed, rough=SOLID, smooth=SOLID)
    assert flash.mean == pytest.approx(rise.mean(), rel=0.1)
    assert flash.low < rise.mean() < rise.max() < flash.high


def test_the_model_reports_an_estimate_with_its_range(scene):
    result = rf.solve(scene, model="mixed", resolution=16)
    flash, low, high = (result[f"flash_temperature{end}"] for end in ("", "_low", "_high"))
    assert 0 < low.value < flash.value < high.value
    assert {one.unit for one in (flash, low, high)} == {"K"}
    assert all(one.uncertainty is None for one in (flash, low, high))
    assert not any("unknown uncertainty" in line for line in result.warnings)
    pressure = result["contact_pressure_max"].value
    assert flash.value == pytest.approx(flash_temperature(scene, pressure, 0.1).mean)
    # The greatest heat flux is that of plastic spots, friction times hardness times speed.
    widest = math.sqrt((0.2e-3) ** 2 / math.pi)
    alone = resting_circle(radius=widest, flux=0.1 * 4e9 * 2, conductivity=SOLID.conductivity)
    assert high.value < alone.greatest


def test_without_contact_or_solids_there_is_no_flash_temperature(scene):
    assert flash_temperature(scene, 0.0, 0.1) is None
    plain = rf.replace(scene, "asperities.solid_heat", None)
    assert flash_temperature(plain, 1e8, 0.1) is None


def test_a_film_that_parts_its_walls_has_no_flash_temperature_and_says_why(scene):
    result = rf.solve(rf.replace(scene, "geometry.film", "6 um"), model="mixed", resolution=8)
    assert result["contact_pressure_max"].value == 0
    assert not any("flash" in name for name in result.quantities)
    why = "no asperities touch, so that there is no flash temperature"
    assert why in KIND.remarks(result.provenance["scene"], result.quantities)
    touching = rf.solve(scene, model="mixed", resolution=8)
    assert why not in KIND.remarks(touching.provenance["scene"], touching.quantities)


def test_the_estimate_says_where_its_range_ends(scene):
    flash = flash_temperature(scene, 2.5e9, 0.1)
    lines = flash_warnings(scene, 2.5e9, flash)
    assert any("neighbouring spots heat one another" in line for line in lines)
    fast = rf.replace(scene, "motion.speed", "200 m/s")
    assert any("solids soften" in line for line in flash_warnings(fast, 1e8, flash_temperature(fast, 1e8, 0.1)))
    light = flash_warnings(scene, 1e5, flash_temperature(scene, 1e5, 0.1))
    assert any("its size is that of the grid" in line for line in light)


def test_solids_of_heat_are_checked(scene, tips):
    with pytest.raises(InputError, match=r"asperities\.solid_heat: is missing, but there is counter_heat"):
        rf.replace(rf.replace(scene, "asperities.solid_heat", None), "asperities.counter_heat", STEEL)
    geometry = {"shape": "parallel", "length": "20 mm", "width": "10 mm", "film": "1 um"}
    with pytest.raises(InputError, match=r"asperities\.solid_heat: got one, but a stored table has no spots"):
        tips.scene(geometry, asperities={"friction": 0.1, "solid_heat": STEEL})


def test_a_heated_film_flashes_above_its_own_temperature(scene, monkeypatch):
    """The flash temperature of a heat balance has the friction at the temperature of the film.

    It is that of films on the finest grid alone, not of each temperature at which the balance is sought.
    """
    solved, spots_at = [], flash_module._spots_at
    monkeypatch.setattr(flash_module, "_spots_at", lambda *args: solved.append(args[1]) or spots_at(*args))
    oil = {"temperature": "40 degC", "density": "870 kg/m^3", "heat_capacity": "2000 J/(kg*K)"}
    thinning = {"law": "exponential", "temperature_coefficient": "0.001 1/K"}
    lubricant = {"viscosity": "0.01 Pa*s", **oil, "thermoviscosity": thinning}
    warm = rf.replace(rf.replace(scene, "lubricant", lubricant), "motion.speed", "0.5 m/s")
    hot = rf.replace(warm, "asperities.friction", {"table": [["0 degC", 0.02], ["500 degC", 0.0]]})
    result = rf.solve(hot, model="heat_balance", resolution=8)
    assert len(set(solved)) <= result.numerics.details["heated_films"]
    coefficient = 0.02 * (1 - result["effective_temperature"].value / 500)
    expected = flash_temperature(warm, result["contact_pressure_max"].value, coefficient).mean
    assert result["flash_temperature"].value == pytest.approx(expected, rel=1e-3)
    assert result["flash_temperature"].uncertainty is None
    assert not any(line.startswith("flash_temperature, ") for line in result.warnings)
