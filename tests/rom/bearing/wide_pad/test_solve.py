"""The thin films of infinitely wide pads against closed forms, exact Stokes flow, first orders and Navier-Stokes."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider
from roughfilm.rom.bearing.inertia import inertia
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

FILM, FILM_SLOPE = (find("bearing", name) for name in ("film", "film_slope"))
LOAD, FRICTION, FLOW, PEAK = "load_per_width", "friction_per_width", "inlet_flow_per_width", "pressure_max"
POCKETS = {"length": "0.3 mm", "depth": "15 um", "columns": 3, "pitch": "0.5 mm", "start": "0.1 mm"}


def pad(geometry, speed="4 m/s", density="1000 kg/m^3", **boundary):
    return read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": {"film": "20 um", **geometry},
            "lubricant": {"viscosity": "10 mPa*s", "density": density},
            "motion": {"speed": speed},
            "boundary": boundary,
        }
    )


def values(model, scene, resolution=200):
    return {name: one.value for name, one in model.solve(scene, Request(resolution=resolution)).quantities.items()}


@pytest.mark.parametrize("model", [FILM, FILM_SLOPE], ids=["film", "film_slope"])
def test_without_inertia_a_long_wedge_is_that_of_reynolds_within_the_uncertainty(model):
    scene = pad({"shape": "linear", "length": "40 mm", "rise": "20 um"}, density="1e-9 kg/m^3")
    exact = linear_slider(film=20e-6, rise=20e-6, length=40e-3, speed=4.0, viscosity=10e-3)
    result = model.solve(scene, Request(resolution=200))
    for name, value in ((LOAD, exact.load), (FRICTION, exact.friction), (PEAK, exact.pressure_max)):
        assert abs(result[name].value - value) <= result[name].uncertainty + 1e-5 * value
        assert result[name].uncertainty < 1e-3 * value


@pytest.mark.parametrize("ram", [0.0, 0.5])
def test_between_parallel_walls_inertia_changes_nothing_and_pressure_falls_evenly(ram):
    scene = pad({"shape": "parallel", "length": "1 mm"}, "20 m/s", inlet={"pressure": "2 bar", "ram_factor": ram})
    pressure = 2e5 + ram * 1000 * 20**2 / 2
    found = values(FILM_SLOPE, scene, 30)
    assert found[LOAD] == pytest.approx(pressure * 1e-3 / 2, rel=1e-9)
    assert found[FLOW] == pytest.approx(20 * 20e-6 / 2 + pressure * (20e-6) ** 3 / (12 * 10e-3 * 1e-3), rel=1e-9)
    assert found[FRICTION] == pytest.approx(10e-3 * 20 / 20e-6 * 1e-3 - pressure * 20e-6 / 2, rel=1e-9)


@pytest.mark.parametrize("shape", ["linear", "parabolic"])
def test_a_little_inertia_is_that_of_first_order(shape):
    geometry = {"shape": shape, "length": "10 mm", "rise": "20 um"}
    scene, without = (pad(geometry, density=f"{density} kg/m^3") for density in (100, 1e-9))
    first = inertia(scene, solve(scene.problem(), (1024, 1), ruptures=False))
    found, creeping = values(FILM, scene), values(FILM, without)
    assert found[LOAD] - creeping[LOAD] == pytest.approx(first.load, rel=2e-3)
    if shape == "linear":  # the changes of a symmetric film cancel
        assert found[FRICTION] - creeping[FRICTION] == pytest.approx(first.friction, rel=5e-3)
        assert found[FLOW] - creeping[FLOW] == pytest.approx(first.inlet_flow, rel=5e-3)


def wedge_flow(slope):
    """The factors of the Stokes flow in a wedge, ψ = r f(θ) + q g(θ), over the viscosity.

    On the sliding wall, θ = 0, with unit speed towards the apex: dp/dr = P/r² + q Q/r³ and τ = F/r + q G/r².
    """
    angle = np.arctan(slope)
    c, s = np.cos(angle), np.sin(angle)
    rows = [[1, 0, 0, 0], [0, 1, 1, 0], [c, s, angle * c, angle * s], [-s, c, c - angle * s, s + angle * c]]
    a, b, d, e = np.linalg.solve(np.array(rows), [0, -1, 0, 0])
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    rows = [[1, 0, 1, 0], [0, 1, 0, 2], [1, angle, c, s], [0, 1, -2 * s, 2 * c]]
    _, _, k, m = np.linalg.solve(np.array(rows), [0, 0, -1, 0])
    return -b - 3 * d - 1, -8 * m, -a + 2 * e, -4 * k


def test_inside_a_wedge_slope_to_second_order_is_that_of_exact_stokes_flow():
    errors = []
    for slope in (0.1, 0.2):
        rise, film, viscosity = 60e-6, 20e-6, 10e-3
        length = rise / slope
        scene = pad({"shape": "linear", "length": f"{length} m", "rise": "60 um"}, "1 m/s", "1e-9 kg/m^3")
        result = FILM_SLOPE.solve(scene, Request(resolution=800))
        x, p, shear = (result.fields[name].values[:, 0] for name in ("x", "pressure", "shear_stress"))
        middle = x.size // 2
        r, h = (film + rise) / slope - x[middle], film + rise * (1 - x[middle] / length)
        q = result[FLOW].value
        of_sliding, of_flow, shear_of_sliding, shear_of_flow = wedge_flow(slope)
        gradient = -(p[middle + 1] - p[middle - 1]) / (x[middle + 1] - x[middle - 1]) / viscosity
        stress = shear[middle] / viscosity
        errors.append(
            [
                abs(gradient - (of_sliding / r**2 + q * of_flow / r**3)) * h**2 / 6,
                abs(stress - abs(shear_of_sliding / r + q * shear_of_flow / r**2)) * h,
            ]
        )
    assert np.max(errors[1]) < 2e-3
    assert np.max(np.array(errors[0]) / errors[1]) < 0.12  # fourth order: 1/16


@pytest.mark.parametrize("model", [FILM, FILM_SLOPE], ids=["film", "film_slope"])
def test_many_pockets_between_parallel_walls_approach_the_periodic_pocket(model):
    cell = {"length": "0.4 mm", "film": "20 um", "profile": "cylindrical", "width": "0.2 mm", "depth": "10 um"}
    liquid, motion = {"viscosity": "10 mPa*s", "density": "1000 kg/m^3"}, {"speed": "20 m/s"}
    pocket = read_scene({"name": "p", "kind": "pocket", "geometry": cell, "lubricant": liquid, "motion": motion})
    periodic = find("pocket", model.name).solve(pocket, Request(resolution=100)).quantities
    texture = {"length": "0.2 mm", "depth": "10 um", "columns": 9, "pitch": "0.4 mm", "start": "0.1 mm"}
    result = model.solve(
        pad({"shape": "parallel", "length": "3.6 mm", "texture": texture}, "20 m/s"), Request(resolution=900)
    )
    x, p, shear = (result.fields[name].values[:, 0] for name in ("x", "pressure", "shear_stress"))
    inside = (x > 1.6e-3) & (x < 2.0e-3)
    widths = np.gradient(x)[inside]
    at_edges = np.interp([1.6e-3, 2.0e-3], x, p)
    level = np.interp(x[inside], [1.6e-3, 2.0e-3], at_edges)
    load = (widths * (p[inside] - level)).sum() / widths.sum()
    friction = (widths * shear[inside]).sum() / widths.sum()
    assert load == pytest.approx(periodic["load_per_area"].value, rel=1e-2)
    assert friction == pytest.approx(periodic["friction_per_area"].value, rel=1e-3)
    assert abs(np.diff(at_edges)[0]) < 1e-3 * periodic["load_per_area"].value


@pytest.mark.parametrize(
    ("geometry", "speed", "load", "friction", "flow", "peak"),
    [
        ({"shape": "parallel", "length": "2 mm", "texture": POCKETS}, "40 m/s", 298.09, 37.630, 4.31496e-4, 352664.0),
        (
            {"shape": "linear", "length": "2 mm", "rise": "10 um", "texture": POCKETS},
            "20 m/s",
            311.538,
            16.8193,
            2.48151e-4,
            283818.0,
        ),
        ({"shape": "linear", "length": "4 mm", "rise": "40 um"}, "40 m/s", 2545.82, 59.526, 5.80660e-4, 1072807.0),
    ],
    ids=["textured parallel", "textured inclined", "inclined"],
)
def test_film_slope_is_near_navier_stokes(geometry, speed, load, friction, flow, peak):
    """References: navier_stokes on 480 columns, whose change from 240 columns is 0.04 to 0.2 % of the load."""
    found = values(FILM_SLOPE, pad(geometry, speed), 400)
    assert found[LOAD] == pytest.approx(load, rel=1e-3)
    assert found[FRICTION] == pytest.approx(friction, rel=5e-4)
    assert found[FLOW] == pytest.approx(flow, rel=2e-4)
    assert found[PEAK] == pytest.approx(peak, rel=2e-3)


def test_order_of_accuracy_and_uncertainty_of_the_load():
    scene = pad({"shape": "parallel", "length": "2 mm", "texture": POCKETS}, "40 m/s")
    results = [FILM.solve(scene, Request(resolution=cells)) for cells in (150, 300, 600, 1200)]
    loads = [result[LOAD].value for result in results]
    assert 1.5 < np.log2(abs((loads[0] - loads[1]) / (loads[1] - loads[2]))) < 2.6
    assert all(abs(result[LOAD].value - loads[-1]) <= result[LOAD].uncertainty for result in results[:-1])


def test_backwards_a_mirrored_pad_is_the_same():
    forth = pad({"shape": "parallel", "length": "2 mm", "texture": POCKETS}, "20 m/s", inlet={"pressure": "1 bar"})
    mirrored = {**POCKETS, "start": "0.6 mm"}
    back = pad({"shape": "parallel", "length": "2 mm", "texture": mirrored}, "-20 m/s", inlet={"pressure": "1 bar"})
    one, other = (FILM.solve(scene, Request(resolution=150)) for scene in (forth, back))
    for name in (LOAD, FRICTION, FLOW, PEAK, "power_loss_per_width"):
        assert one[name].value == pytest.approx(other[name].value, rel=1e-9)
    assert 2e-3 - other.fields["x"].values[::-1] == pytest.approx(one.fields["x"].values)
    assert other.fields["pressure"].values[::-1] == pytest.approx(one.fields["pressure"].values)


def test_warnings_and_refusals():
    texture = {**POCKETS, "columns": 30, "pitch": "1.2 mm", "start": "1 mm"}
    scene = pad({"shape": "parallel", "length": "40 mm", "texture": texture}, "800 m/s")
    result = FILM.solve(scene, Request(resolution=60))
    warnings = " ".join(result.warnings)
    assert "kPa below the cavitation pressure" in warnings
    assert any("above which shear flow is turbulent" in one for one in result.outside)
    assert "the shortest feature of the wall along the sliding direction has" in warnings
    with pytest.raises(InputError, match="the wall has a step at"):
        FILM.solve(pad({"shape": "step", "length": "1 mm", "rise": "20 um", "step": "0.5 mm"}))
