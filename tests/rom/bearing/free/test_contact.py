"""Shafts in lobes whose asperities touch: against the journal of one eccentricity, by themselves, and at their end."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import Drive, settled
from roughfilm.rom.ladder.request import Request

SHAFT = {"radius": "10 mm", "width": "10 mm", "clearance": "10 um"}
BORE = {"shape": "lobes", **SHAFT}
GROOVED = BORE | {"lobes": 2, "arc": "160 deg"}
FED = {"boundary": {"sides": {"low": "1 bar", "high": "1 bar"}}}
SLOW = {"motion": {"speed": "0.05 m/s"}}


def solved(scene, cells=48):
    return find("bearing", "mixed").solve(scene, Request(resolution=cells))


def film_of(tips, geometry=GROOVED, cells=(48, 24), **more):
    scene = tips.scene(geometry, **(SLOW | {"load": {"force": "1 kN"}} | more))
    asperities = tips.table()
    return free_film(scene, cells, film=lambda one: mixed_problem(one, asperities), contact=asperities)


def test_a_bore_that_opens_at_its_widest_place_is_the_journal(tips):
    """The search over one eccentricity, whose inlet is at the widest place, gives the load and its direction."""
    journal = solved(tips.scene({"shape": "journal", **SHAFT}, load={"force": "1 kN"}, **SLOW))
    turned = -90 - journal["attitude_angle"].value
    opened = BORE | {"arc": "359.9 deg", "first": "-90 deg"}
    shaft = solved(tips.scene(opened, load={"force": "1 kN", "angle": f"{turned!r} deg"}, **SLOW))
    assert 0.3 < journal["contact_share"].value < 0.9
    assert shaft["eccentricity_x"].value == pytest.approx(0, abs=2e-3)
    for name in ("contact_share", "friction", "friction_coefficient", "film_min", "pressure_max", "eccentricity"):
        one, other = journal[name], shaft[name]
        assert abs(one.value - other.value) <= one.uncertainty + other.uncertainty, name


def test_at_rest_asperities_alone_carry_the_shaft(tips):
    """∫ P₀ (1 - h/T)^1.5 cos φ dA over h = c (1 - ε cos φ), by quadrature."""
    shaft = solved(tips.scene(BORE, load={"force": "1 kN"}, motion={"speed": "0 m/s"}, **FED), cells=96)
    angle = np.linspace(-np.pi, np.pi, 200_001)

    def excess(ratio):
        pressure = tips.pressure(10e-6 * (1 - ratio * np.cos(angle)))
        return float(np.trapezoid(pressure * np.cos(angle), angle)) * 10e-3 * 10e-3 - 1000

    assert shaft["eccentricity"].value == pytest.approx(brentq(excess, 0.8, 0.97), rel=1e-4)
    assert shaft["contact_share"].value == pytest.approx(1, rel=1e-9)
    assert shaft["attitude_angle"].value == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("geometry", [GROOVED, {"shape": "pivoted", "length": "20 mm", "width": "20 mm", "pivot": 0.6}])
def test_walls_with_cavities_between_them_rest_on_their_asperities(tips, geometry):
    """No flow determines the cavities that are left where the walls were squeezed together."""
    result = solved(tips.scene(geometry, load={"force": "1 kN"}, motion={"speed": "0 m/s"}), cells=32)
    assert result["contact_share"].value == pytest.approx(1, rel=1e-6)
    assert result["load"].value == pytest.approx(1000, rel=1e-6)


def test_a_load_beyond_the_asperities_is_one_line(tips):
    film = film_of(tips, BORE, (24, 12), motion={"speed": "0 m/s"}, load={"force": "5 kN"}, **FED)
    with pytest.raises(InputError, match=r"whose contact pressure is known, the asperities carry .* larger loads"):
        equilibrium(film, None, tolerance=1e-10)


def test_the_stiffness_of_film_and_contact_is_that_of_differences(tips):
    film = film_of(tips)
    instant = equilibrium(film, None, tolerance=1e-12)
    inner, speed = film.solved, film.solved.problem.speed
    given = Drive(speed=speed, force=np.zeros(2), stiffness=np.zeros((2, 2)), free=np.zeros(2, dtype=bool))
    whole, contact = np.zeros((2, 2)), np.zeros((2, 2))
    for column in range(2):
        for sign in (1, -1):
            place = instant.place + sign * 1e-10 * np.eye(2)[column]
            moved = settled(inner, replace(instant, place=place), given, tolerance=1e-13)
            pressed = inner.contact_at(place).force
            contact[:, column] -= sign * pressed / 2e-10
            whole[:, column] -= sign * (pressed + inner.force(moved.state.pressure)) / 2e-10
    assert inner.contact_at(instant.place).stiffness == pytest.approx(contact, rel=1e-6)
    assert coefficients(inner, instant, speed=speed).stiffness == pytest.approx(whole, rel=1e-6)


def test_no_contact_acts_in_the_gaps_between_lobes(tips):
    """A load towards a gap: the shaft rests on the two edges, and its narrowest place would be inside the gap."""
    shaft = solved(tips.scene(GROOVED, load={"force": "300 N", "angle": "0 deg"}, **SLOW), cells=72)
    x = shaft.fields["x"].values[:, 0]
    pressed = shaft.fields["contact_pressure"].values.max(axis=1)
    touching = x[pressed > 0] / 10e-3
    begin, end = np.radians(160), np.radians(180)
    away = np.mod(touching, np.pi)
    assert touching.size
    assert not ((away > begin + 0.05) & (away < end - 0.05)).any()
