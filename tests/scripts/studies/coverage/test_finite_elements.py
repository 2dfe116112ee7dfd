"""The finite elements of the coverage study against exact solutions, and against values of another program."""

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.coverage.finite_elements.flow import solve
from scripts.studies.coverage.finite_elements.forces import forces
from scripts.studies.coverage.finite_elements.mesh import fitted_mesh
from scripts.studies.coverage.finite_elements.wall import Groove, Wall
from scripts.studies.coverage.truths.pocket import forces_on, truth


def pocket(film, reynolds_number, **groove):
    entries = {"length": "1 mm", "film": f"{film} mm", **groove}
    return read_scene(
        {
            "name": "a pocket",
            "kind": "pocket",
            "geometry": entries,
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": reynolds_number},
        }
    )


def bump(length, depth):
    return Groove(
        breaks=(-length / 2, length / 2),
        corners=(),
        depth=lambda x: depth * np.cos(np.pi * np.clip(x / length, -0.5, 0.5)) ** 2,
    )


@pytest.mark.parametrize("reynolds_number", [0.0, 100.0])
def test_smooth_walls_have_plane_couette_flow(reynolds_number):
    flow = solve(fitted_mesh(Wall(length=20.0, grooves=()), 0.5), reynolds_number)
    found = forces(flow, 10.0)
    assert found.friction == pytest.approx(1, abs=1e-10)
    assert (found.load, found.pressure_max, found.pressure_min) == pytest.approx((0, 0, 0), abs=1e-8)
    assert flow.fields.u == pytest.approx(flow.spaces.nodes[1], abs=1e-10)


def test_a_given_flow_is_found_to_high_order():
    """Stream function y + sin(k x) sin(y) and pressure cos(k x) y, with the force that they need."""
    reynolds_number, length = 20.0, 6.0
    k = 2 * np.pi / length

    def velocity(x, y):
        return 1 + np.sin(k * x) * np.cos(y), -k * np.cos(k * x) * np.sin(y)

    def force(x, y):
        u, v = velocity(x, y)
        ux, uy = k * np.cos(k * x) * np.cos(y), -np.sin(k * x) * np.sin(y)
        vx, vy = k**2 * np.sin(k * x) * np.sin(y), -k * np.cos(k * x) * np.cos(y)
        stretch = 1 + k**2  # minus the Laplacian over the wave
        return (
            reynolds_number * (u * ux + v * uy) - k * np.sin(k * x) * y + stretch * (u - 1),
            reynolds_number * (u * vx + v * vy) + np.cos(k * x) + stretch * v,
        )

    errors = []
    for level in (0.5, 1.0):
        mesh = fitted_mesh(Wall(length=length, grooves=(bump(3.0, 0.8),)), level)
        flow = solve(mesh, reynolds_number, walls=velocity, force=force)
        spaces, fields = flow.spaces, flow.fields
        exact = velocity(*spaces.points)
        gaps = [
            spaces.at_points(own, spaces.shapes) - true for own, true in zip((fields.u, fields.v), exact, strict=True)
        ]
        x, y = spaces.pressure_nodes
        pressure = fields.p - fields.p.mean() - (np.cos(k * x) * y - (np.cos(k * x) * y).mean())
        errors.append([np.sqrt((sum(gap**2 for gap in gaps) * spaces.weights).sum()), np.abs(pressure).max()])
    coarse, fine = np.array(errors)
    assert fine[0] < 2e-4
    assert coarse[0] / fine[0] > 2**3
    assert coarse[1] / fine[1] > 2**2


def test_a_long_shallow_groove_approaches_the_reynolds_equation():
    """dp/dx = 6/h² - 12 q/h³ with the flow q that makes the pressure periodic; what is left is of order slope²."""
    width, length, depth, shift = 240.0, 400.0, 0.8, 0.2

    def gap(x):
        low = shift * width
        t = (x + width / 2) / (width / 2 + low) if x < low else (width / 2 - x) / (width / 2 - low)
        return 1 + depth * t**2 * (3 - 2 * t)

    ends = {"points": [shift * width], "limit": 200, "epsabs": 1e-12}

    def over_groove(power):
        return quad(lambda x: gap(x) ** -power, -width / 2, width / 2, **ends)[0] + length - width

    flow = over_groove(2) / (2 * over_groove(3))

    def rise(x):
        return 6 / gap(x) ** 2 - 12 * flow / gap(x) ** 3

    land = (6 - 12 * flow) * (length - width) / 2  # pressure at the first edge; p = 0 at the ends of the period
    moment = quad(lambda x: (width / 2 - x) * rise(x), -width / 2, width / 2, **ends)[0]
    load = (land * width + moment) / length  # the two lands cancel
    scene = pocket(1 / length, 1e-3, profile="splined", width="0.6 mm", depth="2 um", shift="0.12 mm")
    found = forces_on(scene, 0.7)
    assert found.load == pytest.approx(load, rel=1e-3)
    reynolds = find("pocket", "reynolds").solve(scene)["load_plus"].value
    assert found.load * scene.plus_factor == pytest.approx(reynolds, rel=1e-3)


def test_the_position_of_the_grooves_in_the_period_matters_to_the_reference_pressure_alone():
    grooves = [
        {"profile": "cylindrical", "position": f"{-0.2 + shift} mm", "width": "0.2 mm", "depth": "20 um"}
        for shift in (0.0, 0.3)
    ]
    one, other = (forces_on(pocket(0.1, 20, **groove), 0.7) for groove in grooves)
    assert one.friction == pytest.approx(other.friction, rel=1e-9)
    assert one.pressure_max - one.pressure_min == pytest.approx(other.pressure_max - other.pressure_min, rel=1e-9)
    assert one.load - one.pressure_min == pytest.approx(other.load - other.pressure_min, rel=1e-6)
    assert abs(one.load - other.load) > 0.01


@pytest.mark.parametrize(
    ("scene", "load"),
    [
        ({"profile": "cylindrical", "width": "0.15 mm", "depth": "37.5 um", "reynolds_number": 160}, 0.8880),
        ({"profile": "cylindrical", "width": "0.3 mm", "depth": "60 um", "reynolds_number": 100}, 0.9664),
        (
            {"profile": "splined", "width": "0.15 mm", "depth": "37.5 um", "shift": "-45 um", "reynolds_number": 160},
            1.0235,
        ),
        ({"profile": "points", "points": [[-150e-6, 0], [0, 15e-6], [150e-6, 0]], "reynolds_number": 100}, 2.509),
    ],
)
def test_loads_of_another_finite_element_program(scene, load):
    scene = pocket(0.03, **scene)
    assert forces_on(scene, 0.7).load * scene.plus_factor == pytest.approx(load, rel=4e-3)


def test_the_uncertainty_contains_the_load_of_another_program():
    scene = pocket(0.03, profile="cylindrical", width="0.2 mm", depth="60 um", reynolds_number=40)
    found = truth(scene)
    value, uncertainty = found.values["load_plus"], found.uncertainty["load_plus"]
    assert abs(value - 0.2046) <= uncertainty + 1e-4
    assert uncertainty <= 2e-4 * found.values["pressure_max_plus"]
