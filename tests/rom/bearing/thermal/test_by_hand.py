"""The heat balance of a journal bearing under a load against a second program without common code.

It is the method of a designer: dimensionless load, flows and friction over the eccentricity, from a film by projected
relaxation, and an iteration of the effective temperature by hand.
"""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

RADIUS, CLEARANCE, WIDTH, SPEED, LOAD = 25e-3, 30e-6, 50e-3, 7.0, 4000.0
COLD, DENSITY, CAPACITY, ETA, BETA = 40.0, 870.0, 2000.0, 0.03, 0.03


def film(eccentricity, nx=120, ny=24):
    """Load over 6ηuR³/c², friction over ηuR²/c, and the flows in and through the sides over ucR, with h = 1 + ε cos θ.

    The pressure P = p c²/(6ηuR) >= 0 obeys ∂(h³ ∂P/∂θ)/∂θ + ∂(h³ ∂P/∂y)/∂y = ∂h/∂θ where it is above 0; behind its
    rupture streamers fill the part h_r/h of the gap.
    """
    theta, dx = np.linspace(0, 2 * math.pi, nx + 1, retstep=True)
    dy = WIDTH / 2 / RADIUS / ny
    h, middle = 1 + eccentricity * np.cos(theta), 1 + eccentricity * np.cos(theta[:-1] + dx / 2)
    east, west, north = middle[1:, None] ** 3 / dx**2, middle[:-1, None] ** 3 / dx**2, h[1:-1, None] ** 3 / dy**2
    source = (-eccentricity * np.sin(theta[1:-1]))[:, None]
    pressure = np.zeros((nx + 1, ny + 1))
    colour = np.add.outer(np.arange(1, nx), np.arange(ny)) % 2
    relaxation = 2 / (1 + math.sin(math.pi / nx * 2))
    for sweep in range(6000):
        before = pressure.copy() if sweep % 200 == 0 else None
        for part in (0, 1):
            inner = pressure[1:-1, :-1]
            below = np.concatenate([inner[:, 1:2], inner[:, :-1]], axis=1)
            around = east * pressure[2:, :-1] + west * pressure[:-2, :-1] + north * (below + pressure[1:-1, 1:])
            wanted = np.maximum((around - source) / (east + west + 2 * north), 0.0)
            inner[...] = np.where(colour == part, np.maximum(inner + relaxation * (wanted - inner), 0.0), inner)
        if before is not None and sweep and np.abs(pressure - before).max() < 1e-9 * pressure.max():
            break
    weights = np.full(ny + 1, 2 * dy)
    weights[[0, -1]] = dy
    line = pressure @ weights * dx
    load = math.hypot(float((line * np.cos(theta)).sum()), float((line * np.sin(theta)).sum()))
    last = nx - np.argmax(pressure[::-1] > 0, axis=0)
    last[-1] = last[-2]
    ruptured = 1 + eccentricity * np.cos(theta[last])
    between = (np.arange(nx)[:, None] + 0.5) > last[None, :]
    shear = np.where(between, ruptured / middle[:, None] ** 2, 1 / middle[:, None])
    shear += 3 * middle[:, None] * np.diff(pressure, axis=0) / dx
    friction = float((shear @ weights).sum() * dx)
    entering = float((h[0] / 2 - h[0] ** 3 / 2 * (4 * pressure[1] - pressure[2]) / (2 * dx)) @ weights)
    sides = float((h**3 * (4 * pressure[:, -2] - pressure[:, -3]) / (2 * dy)).sum() * dx)
    return load, friction, entering, sides


def test_a_journal_under_a_load_has_the_temperatures_of_a_hand_calculation():
    places = np.linspace(0.1, 0.7, 7)
    coarse, fine = (np.array([film(one, *cells) for one in places]) for cells in ((60, 12), (120, 24)))
    loads, frictions, entering, sides = (CubicSpline(places, column) for column in ((4 * fine - coarse) / 3).T)
    temperature = COLD
    for _ in range(200):
        eta = ETA * math.exp(-BETA * (temperature - COLD))
        wanted = LOAD / (6 * eta * SPEED * RADIUS**3 / CLEARANCE**2)
        eccentricity = float(loads.solve(wanted, extrapolate=False)[0])
        power = eta * SPEED**2 * RADIUS**2 / CLEARANCE * float(frictions(eccentricity))
        flow_in, side = (SPEED * CLEARANCE * RADIUS * float(one(eccentricity)) for one in (entering, sides))
        outlet = COLD + power / (DENSITY * CAPACITY * side)
        inlet = COLD + (1 - side / flow_in) * (outlet - COLD)
        temperature += 0.5 * ((inlet + outlet) / 2 - temperature)
    scene = read_scene(
        {
            "name": "by hand",
            "kind": "bearing",
            "geometry": {
                "shape": "journal",
                "radius": f"{RADIUS} m",
                "clearance": f"{CLEARANCE} m",
                "width": f"{WIDTH} m",
            },
            "lubricant": {
                "viscosity": f"{ETA} Pa*s",
                "density": f"{DENSITY} kg/m^3",
                "heat_capacity": f"{CAPACITY} J/(kg*K)",
                "temperature": f"{COLD} degC",
                "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{BETA} 1/K"},
            },
            "motion": {"speed": f"{SPEED} m/s"},
            "load": {"force": f"{LOAD} N"},
        }
    )
    found = find("bearing", "heat_balance").solve(scene, Request(resolution=64))
    rise = outlet - COLD
    assert rise > 10
    assert 0.2 < eccentricity < 0.6
    assert found["eccentricity"].value == pytest.approx(eccentricity, rel=0.005)
    assert found["power_loss"].value == pytest.approx(power, rel=0.005)
    assert found["side_leakage"].value == pytest.approx(side, rel=0.005)
    assert found["outlet_temperature"].value == pytest.approx(outlet, abs=0.005 * rise)
    assert found["inlet_temperature"].value == pytest.approx(inlet, abs=0.005 * rise)
    assert found["effective_temperature"].value == pytest.approx(temperature, abs=0.005 * rise)
