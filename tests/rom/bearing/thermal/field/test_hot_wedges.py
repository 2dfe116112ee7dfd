"""Wedges whose temperature varies across the film, against finite differences that share no code with the project.

With ζ = z/h from the sliding wall the flow of a cell is that of the velocity ∫ τ/η dz from the wall. The energy of the
cells is marched along the film (implicit, upwind), and the flow q follows from ∫ dp/dx dx = 0.
"""

import math

import numpy as np
import pytest
from scipy.linalg import solve_banded
from scipy.optimize import brentq

import roughfilm as rf
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

LENGTH, FILM, DENSITY, CAPACITY, CONDUCTIVITY, SUPPLIED, BETA = 0.05, 50e-6, 870.0, 2000.0, 0.13, 40.0, 0.04


def numbers_of(peclet, nahme):
    """Speed and viscosity with ρ c u h²/(k L) and β η u²/k."""
    speed = peclet * CONDUCTIVITY * LENGTH / (DENSITY * CAPACITY * FILM**2)
    return speed, nahme * CONDUCTIVITY / (BETA * speed**2)


def marched(peclet, nahme, rise, columns, rows, wall=None):
    """Load, N/m, and highest temperature above the supply, K, of a wedge whose walls take no heat, or stay cold."""
    speed, viscosity = numbers_of(peclet, nahme)
    x = np.linspace(0, LENGTH, columns + 1)
    h = FILM + rise * FILM * (1 - x / LENGTH)
    faces = np.linspace(0, 1, rows + 1)
    centres, width = (faces[1:] + faces[:-1]) / 2, 1 / rows
    temperature = np.zeros((columns + 1, rows))
    pressure = np.zeros(columns + 1)
    for _ in range(200):
        eta = viscosity * np.exp(-BETA * temperature)
        z, dz = centres * h[:, None], width * h[:, None]
        f0, f1 = (dz / eta).sum(axis=1), (z * dz / eta).sum(axis=1)
        f2 = ((z**2 + dz**2 / 12) * dz / eta).sum(axis=1)
        determinant = f0 * f2 - f1**2

        def slope(flow, f0=f0, f1=f1, determinant=determinant):
            return (-speed * -f1 - flow * f0) / determinant

        flow = brentq(lambda q: np.trapezoid(slope(q), x), 0.0, speed * h[0])
        gradient = slope(flow)
        stress = (-speed - gradient * f1) / f0
        shear = (stress[:, None] + gradient[:, None] * z) / eta
        velocity = speed + np.concatenate([np.zeros((columns + 1, 1)), np.cumsum(shear * dz, axis=1)], axis=1)
        through = (velocity[:, 1:] + velocity[:, :-1]) / 2 * dz
        through *= flow / through.sum(axis=1, keepdims=True)
        heat = (stress[:, None] + gradient[:, None] * z) ** 2 / eta * dz / (DENSITY * CAPACITY)
        below = np.concatenate([np.zeros((columns + 1, 1)), np.cumsum(through, axis=1)], axis=1)
        found = np.zeros_like(temperature)
        diffusivity = CONDUCTIVITY / (DENSITY * CAPACITY)
        for n in range(1, columns + 1):
            step = x[n] - x[n - 1]
            up = below[n - 1] - below[n]
            conducted = np.full(rows + 1, diffusivity * step / (width * h[n]))
            conducted[[0, -1]] = 0.0 if wall is None else 2 * conducted[0]
            rising, falling = np.maximum(up, 0) + conducted, np.maximum(-up, 0) + conducted
            bands = np.zeros((3, rows))
            bands[0, 1:] = -falling[1:-1]
            bands[2, :-1] = -rising[1:-1]
            bands[1] = through[n] + rising[1:] + falling[:-1]
            found[n] = solve_banded((1, 1), bands, through[n - 1] * found[n - 1] + heat[n] * step)
        change = np.abs(found - temperature).max()
        temperature = temperature + 0.6 * (found - temperature)
        if change < 1e-7 * max(found.max(), 1e-3):
            break
    else:
        raise AssertionError(change)
    pressure[1:] = np.cumsum((gradient[1:] + gradient[:-1]) / 2 * np.diff(x))
    near = [1.5 * temperature[:, a] - 0.5 * temperature[:, b] for a, b in ((0, 1), (-1, -2))]
    hottest = max(temperature.max(), *(one.max() for one in near)) if wall is None else temperature.max()
    return float(np.trapezoid(pressure, x)), float(hottest)


def scene_of(peclet, nahme, rise, *, wall=None, conductivity=True):
    speed, viscosity = numbers_of(peclet, nahme)
    lubricant = {
        "viscosity": f"{viscosity} Pa*s",
        "density": f"{DENSITY} kg/m^3",
        "heat_capacity": f"{CAPACITY} J/(kg*K)",
        "temperature": f"{SUPPLIED} degC",
        "thermoviscosity": {
            "law": "exponential",
            "temperature_coefficient": f"{BETA} 1/K",
            "valid_from": "-100 degC",
            "valid_to": "600 degC",
        },
    }
    lubricant |= {"conductivity": f"{CONDUCTIVITY} W/(m*K)"} if conductivity else {}
    geometry = {"shape": "linear", "length": f"{LENGTH} m", "film": f"{FILM} m", "rise": f"{rise * FILM} m"}
    entries = {"name": "hot wedge", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    heat = {} if wall is None else {"heat": dict.fromkeys(("fixed_wall", "sliding_wall"), wall)}
    return read_scene({**entries, "motion": {"speed": f"{speed} m/s"}, **heat})


@pytest.mark.parametrize(
    ("peclet", "nahme", "rise", "wall"),
    [
        (0.3, 3.0, 0.5, None),
        (3.0, 10.0, 0.5, None),
        (30.0, 10.0, 0.5, None),
        (84.0, 31.0, 0.47, None),
        (3.0, 10.0, 0.5, {"kind": "temperature", "temperature": f"{SUPPLIED} degC"}),
    ],
)
def test_the_model_across_the_film_is_that_of_the_other_program(peclet, nahme, rise, wall):
    """Both agree to the change of the other one between its grids, extrapolated at its first order along the film."""
    found = find("bearing", "across").solve(scene_of(peclet, nahme, rise, wall=wall), Request(resolution=128))
    grids = [marched(peclet, nahme, rise, n, n // 4, wall) for n in (100, 200, 400)]
    ours = found["load_per_width"].value, found["temperature_max"].value - SUPPLIED
    for own, *theirs in zip(ours, *grids, strict=True):
        limit = 2 * theirs[2] - theirs[1]
        error = abs(limit - (2 * theirs[1] - theirs[0])) + 2e-3 * abs(limit)
        assert abs(own - limit) < error
        assert error < 0.02 * abs(limit)


@pytest.mark.parametrize(("peclet", "nahme"), [(0.1, 3.0), (3.0, 1.0), (30.0, 3.0), (300.0, 30.0)])
@pytest.mark.parametrize("conductivity", [True, False])
def test_errors_of_one_temperature_across_the_film_contain_the_difference(peclet, nahme, conductivity):
    """Also of a lubricant without a conductivity, which that of oils replaces; they are at most thrice as large."""
    true = marched(peclet, nahme, 0.5, 400, 100)[0]
    scene = scene_of(peclet, nahme, 0.5, conductivity=conductivity)
    found = rf.solve(scene, model="adiabatic", resolution=128)
    error = abs(found["load_per_width"].value - true) / true
    stated = found.expected_error["load_per_width"]
    assert error <= stated <= 3 * error + 0.02


def test_the_heat_of_a_fast_film_stays_where_it_is_made():
    """Without conduction the error of adiabatic is that of the Nahme number over the root of the Péclet number."""
    errors = []
    for peclet in (30.0, 120.0):
        nahme = 0.3 * math.sqrt(peclet)
        pair = [
            find("bearing", model).solve(scene_of(peclet, nahme, 0.5), Request(resolution=128))
            for model in ("adiabatic", "across")
        ]
        errors.append(pair[0]["load_per_width"].value / pair[1]["load_per_width"].value - 1)
    assert min(errors) > 0.02
    assert errors[1] == pytest.approx(errors[0], rel=0.25)
