"""Bores whose sides are at the cavitation pressure and refill their cavities: against differences and closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest
from moving_films import CLEARANCE, RADIUS, VISCOSITY, course, journal, steady
from scipy.sparse import csr_array
from scipy.sparse.linalg import spsolve

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.bearing.dynamics.whirl import rigid_whirl
from roughfilm.rom.cavitation.balance import FILM, FLOODED
from roughfilm.rom.cavitation.motion.coefficients import SmallMotion
from roughfilm.rom.cavitation.motion.march import begun, march
from roughfilm.rom.ladder.scene import read_scene

BORE = {"radius": "50 mm", "width": "30 mm", "clearance": "100 um"}
OIL, SPEED, LOAD = 0.1, 157.1 * 0.05, 525.0
NODES, ROWS = 96, 12


def scene(shape, **more):
    entries = {
        "name": "plain bore",
        "kind": "bearing",
        "geometry": {"shape": shape} | BORE,
        "motion": {"speed": f"{SPEED} m/s"},
    }
    return read_scene(entries | {"lubricant": {"viscosity": f"{OIL} Pa*s"}, "load": {"force": f"{LOAD} N"}} | more)


def swift_stieber(place, velocity, pressed=None):
    """The force of a film with p >= 0 and no outflow where p = 0, by differences on half the width and an active set.

    -∇·(h³/12η ∇p) = -(U/2 ∂h/∂x + ∂h/∂t) where p > 0, in a bore of 50 mm, 30 mm and 100 um; the force is -∫ p n dA.
    """
    radius, half, clearance = 0.05, 0.015, 1e-4
    angle, along, across = 2 * np.pi * np.arange(NODES) / NODES, 2 * np.pi * radius / NODES, half / ROWS

    def film(theta):
        return clearance - place[0] * np.cos(theta) - place[1] * np.sin(theta)

    h, ahead = film(angle), film(angle + np.pi / NODES)
    rising = SPEED / 2 * (ahead - np.roll(ahead, 1)) / along - velocity[0] * np.cos(angle) - velocity[1] * np.sin(angle)
    east, north = ahead**3 / (12 * OIL * along**2), h**3 / (12 * OIL * across**2)
    number = np.arange(NODES * ROWS).reshape(NODES, ROWS)
    matrix = np.zeros((number.size, number.size))
    for i in range(NODES):
        for j in range(ROWS):
            n = number[i, j]
            for k, g in ((number[(i + 1) % NODES, j], east[i]), (number[i - 1, j], east[i - 1])):
                matrix[n, n] += g
                matrix[n, k] -= g
            for row in (abs(j - 1), j + 1):  # symmetric about the middle, p = 0 at the side
                matrix[n, n] += north[i]
                if row < ROWS:
                    matrix[n, number[i, row]] -= north[i]
    sparse, source = csr_array(matrix), -np.repeat(rising, ROWS)
    pressed = np.ones(number.size, dtype=bool) if pressed is None else pressed
    for _ in range(60):
        pressure, among = np.zeros(number.size), np.flatnonzero(pressed)
        pressure[among] = spsolve(sparse[among][:, among].tocsc(), source[among])
        following = np.where(pressed, pressure > 0, sparse @ pressure < source)
        if (following == pressed).all():
            break
        pressed = following
    areas = along * across * np.where(np.arange(ROWS) == 0, 1.0, 2.0)
    carried = (pressure.reshape(NODES, ROWS) * areas).sum(axis=1)
    return -np.array([carried @ np.cos(angle), carried @ np.sin(angle)]), pressed


@pytest.fixture(scope="module")
def differences():
    """Place, stiffness and damping by differences of forces."""
    place, small = np.array([0.26e-4, -0.09e-4]), 1e-8
    force, pressed = swift_stieber(place, (0, 0))
    for _ in range(8):
        slopes = np.transpose(
            [(swift_stieber(place + small * e, (0, 0), pressed)[0] - force) / small for e in np.eye(2)]
        )
        place = place - np.linalg.solve(slopes, force - [0.0, LOAD])
        force, pressed = swift_stieber(place, (0, 0), pressed)
        if np.abs(force - [0.0, LOAD]).max() < 1e-6 * LOAD:
            break
    rate = 157.1 * small

    def slope(column, step, moves):
        ends = [
            swift_stieber(place + s * step * column * (not moves), s * step * column * moves, pressed)[0]
            for s in (1, -1)
        ]
        return -(ends[0] - ends[1]) / (2 * step)

    stiffness = np.transpose([slope(e, small, False) for e in np.eye(2)])
    damping = np.transpose([slope(e, rate, True) for e in np.eye(2)])
    return place, stiffness, damping


@pytest.mark.parametrize("shape", ["lobes", "journal"])
def test_a_plain_bore_has_the_coefficients_of_swift_and_stieber(differences, shape):
    place, stiffness, damping = differences
    (curve,) = dynamics(scene(shape), [SPEED], [LOAD / (0.1 * 0.03)], resolution=64)
    point = curve.points[0]
    assert point.numbers["eccentricity"] == pytest.approx(math.hypot(*place) / 1e-4, rel=2e-3)
    assert point.stiffness == pytest.approx(stiffness, rel=0.02)
    assert point.damping == pytest.approx(damping, rel=0.02)
    whirl = rigid_whirl(stiffness, damping)
    assert point.numbers["critical_mass"] == pytest.approx(1 / whirl.inverse_mass, rel=5e-3)
    assert point.numbers["whirl_ratio"] == pytest.approx(math.sqrt(whirl.frequency_squared) / 157.1, rel=5e-3)


def test_a_line_at_the_inlet_has_no_place_in_a_bore_whose_shaft_moves():
    with pytest.raises(InputError, match="boundary: got one for a shaft that moves in its bore"):
        dynamics(scene("journal", boundary={"inlet": {"theta": 0.5}}), [SPEED], [1e5])
    groove = {"kind": "groove", "angle": "90 deg", "length": "5 mm", "extent": "10 mm", "pressure": "0.1 MPa"}
    grooved = scene("journal", supply=[groove])
    with pytest.raises(InputError, match=r"supply: got one .* take geometry\.shape = 'lobes'"):
        dynamics(grooved, [SPEED], [1e5])


ECCENTRICITY, RATE = 0.4, 200.0


def damper():
    """A short shaft at rest whose cavities are refilled from its sides."""
    return replace(journal((96, 4), width=0.1 * RADIUS, halved=True, groove=False, speed=0.0), refills=True)


def test_a_damper_on_a_centred_orbit_has_the_forces_of_half_a_film():
    """Short film over half the circumference: F_r = -2ηRB³ωε²/(c²(1-ε²)²), F_t = -πηRB³ωε/(2c²(1-ε²)^1.5).

    Vance 1988, Rotordynamics of Turbomachinery, chapter 6.
    """
    film, size, period = damper(), ECCENTRICITY * CLEARANCE, 2 * math.pi / RATE

    def path(time):
        return size * np.array([math.cos(RATE * time), math.sin(RATE * time)])

    *_, last = march(
        film,
        course(film, place=path, speed=0.0),
        begun(film, steady(film, path(0.0)), velocity=np.array([0.0, size * RATE])),
        period / 4,
        largest_step=period / 400,
        error=None,
    )
    assert {FILM, FLOODED} <= set(np.unique(last.instant.kind))
    outwards, forwards = np.array([0.0, 1.0]), np.array([-1.0, 0.0])
    force, scale = (
        film.force(last.instant.state.pressure),
        VISCOSITY * RADIUS * (0.1 * RADIUS) ** 3 * RATE / CLEARANCE**2,
    )
    narrow = 1 - ECCENTRICITY**2
    assert force @ outwards == pytest.approx(-2 * scale * ECCENTRICITY**2 / narrow**2, rel=0.02)
    assert force @ forwards == pytest.approx(-math.pi * scale * ECCENTRICITY / (2 * narrow**1.5), rel=0.02)


def test_a_refilled_film_has_no_memory():
    film = replace(journal((32, 4), halved=True, groove=False), refills=True)
    at = steady(film, np.array([0.3, 0.0]) * CLEARANCE)
    motion = SmallMotion(film, at, speed=film.problem.speed)
    assert not motion.has_memory
    assert motion.slow.damping == pytest.approx(motion.slow.damping.T, rel=1e-9)
