"""First-order inertia of a bearing's film: pockets judged elsewhere, ridges at any angle, symmetry of the two axes."""

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from places import SCENES
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.effects.ablation import Variant, VariantSolution, amount
from roughfilm.rom.bearing.effects.inertia import (
    FIRST_ORDER,
    FULL,
    inertia_added,
    inertia_obstacle,
    inertia_under_load,
    pocket_inertia,
)
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.inertia import Inertia, inertia
from roughfilm.rom.bearing.numbers import without_inertia
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene
from roughfilm.rom.pocket.closed_form import inertia_pressure

VISCOSITY, DENSITY, FILM, LENGTH, WIDTH = 0.01, 1000.0, 30e-6, 1e-3, 0.3e-3
PAD = SCENES / "pad.toml"
POCKET_MODELS = of_kind(ladder(rom, foamcases), "pocket")


def bearing(speed: float, **tables: Any) -> Bearing:
    """A parallel slider, one groove in its middle, of a liquid that bears any tension."""
    groove = {"length": f"{WIDTH} m", "depth": f"{0.25 * FILM} m", "start": f"{(LENGTH - WIDTH) / 2} m"}
    geometry = {"shape": "parallel", "length": f"{LENGTH} m", "film": f"{FILM} m", "texture": groove}
    lubricant = {
        "viscosity": f"{VISCOSITY} Pa*s",
        "density": f"{DENSITY} kg/m^3",
        "cavitation_pressure": "-1000 MPa",
    }
    scene = read_scene(
        {
            "name": "slider",
            "kind": "bearing",
            "geometry": geometry | tables.get("geometry", {}),
            "lubricant": lubricant | tables.get("lubricant", {}),
            "motion": {"speed": f"{speed} m/s"},
        }
    )
    assert isinstance(scene, Bearing)
    return scene


def judged_film(scene: Bearing, cells: int, **changes: Any) -> tuple[Solution, Inertia]:
    """The film with something else in its problem, and what inertia adds to it."""
    solved = solve(replace(scene.problem(), **changes), (cells, cells), ruptures=False)
    return solved, inertia(scene, solved)


def speed_of(reynolds_number: float) -> float:
    """The sliding speed, m/s."""
    return reynolds_number * VISCOSITY / (DENSITY * FILM)


def pocket(speed: float) -> Any:
    """One period of the slider, repeated."""
    return read_scene(
        {
            "name": "pocket",
            "kind": "pocket",
            "geometry": {
                "length": f"{LENGTH} m",
                "film": f"{FILM} m",
                "profile": "cylindrical",
                "width": f"{WIDTH} m",
                "depth": f"{0.25 * FILM} m",
            },
            "lubricant": {"viscosity": f"{VISCOSITY} Pa*s", "density": f"{DENSITY} kg/m^3"},
            "motion": {"speed": f"{speed} m/s"},
        }
    )


def test_a_groove_carries_what_an_independent_solution_of_a_pocket_says() -> None:
    """F+ = 0.890 at Re = 40 to first order, with which ends at ambient pressure agree: the flow is that of a period."""
    speed = speed_of(40)
    _, solved = judged_film(bearing(speed), 2048)
    plus = 100 * solved.load / LENGTH * FILM**2 / (VISCOSITY * speed * LENGTH)
    assert plus == pytest.approx(0.890, abs=1e-3)
    assert solved.friction == pytest.approx(0.0, abs=1e-9 * VISCOSITY * speed / FILM * LENGTH)
    assert solved.inlet_flow == pytest.approx(0.0, abs=1e-9 * speed * FILM)


def test_it_is_of_second_order_in_the_cells() -> None:
    loads = [judged_film(bearing(2.0), cells)[1].load for cells in (64, 128, 256)]
    assert (loads[1] - loads[0]) / (loads[2] - loads[1]) == pytest.approx(4.0, abs=1.0)


def test_a_film_between_two_cavities_has_the_inertia_of_its_closed_form() -> None:
    """p₁' = -12η/h³ (q₁ + ρh²Cx/(2η)), with p₁ = 0 where the film begins and ruptures; q = θUh(0)/2.

    A parabola with rise = film and θ = 0.55 begins at x/L = 0.100041, where p = 0 by quadrature, and ruptures where
    h = θh(0). A front lies anywhere in its cell, so that the pressure difference over that cell is no gradient.
    """
    speed, length, low, theta, start = 5.0, 10e-3, 20e-6, 0.55, 0.10004089922828287
    x = np.linspace(start, (1 + np.sqrt(2 * theta - 1)) / 2, 100_001) * length
    h, rise = low * (1 + (2 * x / length - 1) ** 2), 4 * low / length * (2 * x / length - 1)
    a = theta * speed * low / h - speed / 2
    by_h = speed**2 / 20 + speed * a / 5 + 9 * a**2 / 35 - (a + speed / 2) * (speed / 5 + 18 * a / 35)
    force = by_h * rise + speed * rise * (speed / 60 + a / 70)
    resistance, drive = 12 * VISCOSITY / h**3, 6 * DENSITY / h * force
    added = -np.trapezoid(drive, x) / np.trapezoid(resistance, x)
    slope = -(resistance * added + drive)
    pressure = np.append(0.0, np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(x)))
    truth = float(np.trapezoid(pressure, x))

    geometry = {"shape": "parabolic", "length": "10 mm", "film": "20 um", "rise": "20 um", "texture": None}
    scene = bearing(speed, geometry=geometry, lubricant={"cavitation_pressure": "0 Pa"})
    inlet = scene.boundary.model_copy(update={"inlet": scene.boundary.inlet.model_copy(update={"theta": theta})})
    starved = scene.model_copy(update={"boundary": inlet})
    for cells, most in ((128, 0.06), (256, 0.04), (1000, 0.01), (4000, 0.003)):
        assert inertia(starved, solve(starved.problem(), (cells, cells))).load == pytest.approx(truth, rel=most)
    load = inertia_added(Variant(scene=starved), 1000, POCKET_MODELS).amounts["load"]
    number = DENSITY * speed * low**2 / (VISCOSITY * length)
    assert abs(load.value - truth) <= load.uncertainty - min(1.0, number) * abs(load.value)


@pytest.mark.openfoam
def test_slow_flow_over_a_groove_is_that_of_the_mesh() -> None:
    """Navier–Stokes at Re = 5, less Stokes: 0.7 % below first order, as slope and the rest of inertia have it."""
    speed = speed_of(5)
    _, solved = judged_film(bearing(speed), 1024)
    loads = [
        find("pocket", name).solve(pocket(speed), Request(resolution=80)).quantities["load_per_area"].value
        for name in ("navier_stokes", "stokes")
    ]
    assert solved.load / LENGTH == pytest.approx(loads[0] - loads[1], rel=0.01)


@pytest.mark.parametrize("degrees", [0.0, 30.0, 60.0])
def test_ridges_at_an_angle_are_those_of_a_line_at_the_speed_across_them(degrees: float) -> None:
    """Sliding along ridges brings no momentum anywhere: p₁ is that of the speed u cos β, but for a constant."""
    speed, wave, amplitude, cells = 2.0, 1e-3, 10e-6, 128
    across, along = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    pad = bearing(speed, geometry={"length": "6 mm", "width": "6 mm", "texture": None})

    def ridges(x: Array, y: Array) -> Array:
        return np.asarray(FILM + amplitude * np.cos(2 * np.pi * (across * x + along * y) / wave))

    solved, added = judged_film(pad, cells, shape=replace(pad.problem().shape, thickness=ridges))
    line = 1 + amplitude / FILM * np.cos(2 * np.pi * np.linspace(0, 1, 4000, endpoint=False))
    flow = (line**-2).mean() / (2 * (line**-3).mean())
    number = DENSITY * speed * across * FILM / VISCOSITY
    truth = VISCOSITY * speed * across / FILM * number * inertia_pressure(solved.faces.thickness / FILM, flow)
    x, y = np.meshgrid(solved.grid.x, solved.grid.y, indexing="ij")
    middle = (abs(x - 3e-3) < wave) & (abs(y - 3e-3) < wave)
    got, expected = added.pressure[middle], truth[middle]
    got, expected = got - got.mean(), expected - expected.mean()
    assert (got * expected).sum() / (expected**2).sum() == pytest.approx(1.0, abs=0.03)
    assert np.sqrt(((got - expected) ** 2).mean()) < 0.06 * expected.std()


def test_pressure_driven_flow_is_symmetric_in_the_axes() -> None:
    """Without sliding, a film turned over its diagonal has its inertia turned over it."""
    pad = bearing(0.0, geometry={"length": "2 mm", "width": "2 mm", "texture": None})
    low = pad.lubricant.cavitation_pressure

    def film(turned: bool) -> Problem:
        def hill(x: Array, y: Array) -> Array:
            x, y = (y, x) if turned else (x, y)
            return np.asarray(FILM * (1 - 0.3 * np.sin(4e3 * x) * np.cos(2.5e3 * y + 1e3 * x)))

        ends = (
            Ends(inlet=8e4 - low, outlet=1e4 - low, sides=(3e4 - low, -low)),
            Ends(inlet=3e4 - low, outlet=-low, sides=(8e4 - low, 1e4 - low)),
        )
        return replace(pad.problem(), shape=replace(pad.problem().shape, thickness=hill), ends=ends[turned])

    one, other = (inertia(pad, solve(film(turned), (64, 64), ruptures=False)).pressure for turned in (False, True))
    inner = (slice(8, -8), slice(8, -8))
    assert np.abs(one).max() > 1.0
    assert np.abs(one[inner] - other.T[inner]).max() < 0.02 * np.abs(one[inner]).max()


def test_the_friction_of_a_wedge_follows_from_its_momentum_balance() -> None:
    """τ = ηU/h + h/2 ∂p/∂x + ρ ∫ Y (u ∂u/∂x + w ∂u/∂z) dz, the integral by brute force from u and its continuity."""
    speed, length, low, rise = 4.0, 1e-3, 20e-6, 25e-6
    wedge = {"shape": "linear", "length": f"{length} m", "film": f"{low} m", "rise": f"{rise} m", "texture": None}
    solved, added = judged_film(bearing(speed, geometry=wedge), 512)
    flow = float((solved.network.couette[0] - solved.network.east[0] * np.diff(solved.state.pressure, axis=0)[0])[0])

    def velocity(x: float, z: Array) -> Array:
        h = low + rise * (1 - x / length)
        part = z / h
        return speed * part + 6 * (flow / h - speed / 2) * part * (1 - part)

    def momentum(x: float) -> float:
        h, step = low + rise * (1 - x / length), 1e-6 * length
        z = np.linspace(0, h, 2001)
        u = velocity(x, z)
        along = (velocity(x + step, z) - velocity(x - step, z)) / (2 * step)
        above = -np.concatenate([[0.0], np.cumsum((along[1:] + along[:-1]) / 2) * (z[1] - z[0])])
        return float(np.trapezoid(z / h * (u * along + above * np.gradient(u, z)), z))

    places = (solved.grid.x[1:] + solved.grid.x[:-1]) / 2
    felt = DENSITY * sum(momentum(float(x)) for x in places) * length / places.size
    pressed = float((np.diff(added.pressure[:, 0]) * (low + rise * (1 - places / length)) / 2).sum())
    assert abs(felt) > 1e-3 * abs(pressed)
    assert added.friction == pytest.approx(felt + pressed, rel=1e-3)


def test_a_pad_without_flow_through_its_sides_is_a_line_of_it() -> None:
    line = judged_film(bearing(2.0), 64)[1]
    pad = bearing(2.0, geometry={"width": "1 mm"})
    solved = judged_film(pad, 64, ends=replace(pad.problem().ends, sides=None))[1]
    assert solved.load / 1e-3 == pytest.approx(line.load, rel=1e-7), "round-off of pressures leaves 1e-9 of the flow"


def test_open_sides_lower_the_pressure_of_inertia() -> None:
    line = judged_film(bearing(2.0), 64)[1]
    solved = judged_film(bearing(2.0, geometry={"width": "1 mm"}), 64)[1]
    assert 0.2 * line.load < solved.load / 1e-3 < 0.95 * line.load


def test_it_grows_with_density_alone() -> None:
    once = judged_film(bearing(2.0), 64)[1]
    thrice = judged_film(bearing(2.0, lubricant={"density": "3000 kg/m^3"}), 64)[1]
    assert thrice.load == pytest.approx(3 * once.load, rel=1e-12)


def test_inertia_changes_no_pressure_in_cavities() -> None:
    cavitated = bearing(20.0, geometry={"width": "1 mm"}, lubricant={"cavitation_pressure": "-1 kPa"})
    solved = solve(cavitated.problem(), (64, 64))
    added = inertia(cavitated, solved)
    assert (solved.state.fill < 1).any()
    assert (added.pressure[solved.state.fill < 1] == 0).all()


def test_the_uncertainty_covers_models_with_full_inertia() -> None:
    """``film`` does not apply to a viscosity that depends on pressure, here by less than one part in 10⁹."""
    law = {"law": "barus", "pressure_coefficient": "1e-6 GPa^-1"}
    scene = bearing(speed_of(60), lubricant={"piezoviscosity": law})
    change = inertia_added(Variant(scene=scene, ruptures=False), 512, POCKET_MODELS)
    truth = find("pocket", "film_slope").solve(pocket(speed_of(60))).quantities["load_per_area"].value * LENGTH
    assert change.model == FIRST_ORDER
    assert change.slope is None
    assert change.pocket is not None
    assert change.pocket.model in ("inertial_reynolds", "film", "film_slope")
    assert change.untextured_load == pytest.approx(0.0, abs=1e-9 * change.amounts["load"].value)
    assert abs(change.amounts["load"].value - truth) <= change.amounts["load"].uncertainty < 0.1 * truth


def test_inertia_of_a_pad_with_several_pockets_is_that_of_the_film_whose_sign_the_first_order_misses() -> None:
    scene, film = load_scene(SCENES / "wide_pad.toml"), find("bearing", "film")
    load = inertia_added(Variant(scene=scene), 512, ladder(rom, foamcases)).amounts["load"]
    whole, creeping = (film.solve(one)["load_per_width"].value for one in (scene, without_inertia(scene)))
    assert load.value < 0
    assert abs(load.value - (whole - creeping)) <= load.uncertainty


def test_inertia_thickens_a_wedge_film_until_its_load_is_the_same() -> None:
    wedge = {"shape": "linear", "length": "10 mm", "film": "40 um", "rise": "40 um", "texture": None}
    taken = Variant(scene=bearing(20.0, geometry=wedge))
    whole: VariantSolution = under_load(taken, 5e5, 512)
    changes, thicker = inertia_under_load(taken, whole, 5e5, 512, POCKET_MODELS)
    film, gained = whole.values["film"], thicker.value
    assert changes.amounts["load"].value * gained > 0
    assert changes.model == FULL
    of_film = amount(whole, "film")
    assert of_film is not None
    thinner, thicker_still = (
        find("bearing", "film").solve(
            taken.scene.at_film(film + gained + side * (of_film.uncertainty + thicker.uncertainty)),
            Request(resolution=1600),
        )
        for side in (-1, 1)
    )
    assert thicker.uncertainty < 0.02 * gained
    assert thicker_still["load_per_width"].value < 5e5 * 10e-3 < thinner["load_per_width"].value


@pytest.mark.parametrize("direction", [1, -1])
def test_a_wide_pad_has_all_of_inertia_and_slope_to_second_order(direction: int) -> None:
    """The load of the Reynolds equation is 0. In OpenFOAM that of one period is 7 % below the first order."""
    scene = bearing(direction * speed_of(160))
    change = inertia_added(Variant(scene=scene), 512, POCKET_MODELS)
    load, friction, slope = change.amounts["load"], change.amounts["friction"], change.slope
    assert change.model == FULL
    assert change.pocket is None
    assert slope is not None
    film, sloped, creeping = (
        find("bearing", name).solve(scene, Request(resolution=1600)) for name in ("film", "film_slope", "reynolds")
    )

    def between(more: Any, less: Any, quantity: str) -> float:
        return float(more[quantity].value - less[quantity].value)

    assert abs(load.value - between(film, creeping, "load_per_width")) <= load.uncertainty < 1e-3 * load.value
    assert friction.value == pytest.approx(between(film, creeping, "friction_per_width"), abs=2 * friction.uncertainty)
    assert slope["load"].value == pytest.approx(between(sloped, film, "load_per_width"), abs=slope["load"].uncertainty)
    first = judged_film(scene, 512)[1].load
    assert (load.value + slope["load"].value) / first == pytest.approx(0.93, abs=0.005)


@pytest.mark.parametrize(
    "tables",
    [{"geometry": {"width": "1 mm"}}, {"lubricant": {"cavitation_pressure": "-1 kPa"}}],
    ids=["narrow", "ruptured"],
)
def test_other_pads_have_inertia_to_first_order(tables: dict[str, Any]) -> None:
    scene = bearing(speed_of(160), **tables)
    change = inertia_added(Variant(scene=scene), 64, POCKET_MODELS)
    assert change.model == FIRST_ORDER
    assert change.slope is None
    assert change.pocket is not None
    added = inertia(scene, solve(scene.problem(), (64, 64)))
    assert change.amounts["load"].value == pytest.approx(added.load, rel=1e-9)
    assert change.amounts["load"].uncertainty >= abs(change.pocket.over_first_order - 1) * abs(added.load)


def test_where_inertia_cannot_be_estimated_the_reason_is_given() -> None:
    light = bearing(2.0)
    light = light.model_copy(update={"lubricant": light.lubricant.model_copy(update={"density": None})})
    assert inertia_obstacle(bearing(2.0)) is None
    assert inertia_obstacle(bearing(0.0)) == "the sliding speed is zero"
    with pytest.raises(InputError, match="density: is missing"):
        judged_film(light, 16)


@pytest.mark.parametrize("odd", ["geometry.texture.depth=1.5mm", "lubricant.density=1e15 kg/m^3"])
def test_pockets_outside_the_range_of_the_models_are_not_solved(odd: str) -> None:
    assert pocket_inertia(cast(Bearing, load_scene(PAD, [])), POCKET_MODELS) is not None
    assert pocket_inertia(cast(Bearing, load_scene(PAD, [odd])), POCKET_MODELS) is None


def inertia_of_an_ideal_gas(vapour: float) -> tuple[float, float]:
    """The changes of load and friction of an air slider, N/m, by the acceleration of its velocities on a fine mesh.

    The density is ρp/``vapour``, with ρ = 1.2 kg/m³ at ambient pressure. The film without inertia is found by shooting;
    then η u₁'' = p₁' + ρ Du/Dt is integrated across the film with the weights Y(1 - Y) and Y, and p₁ is found by
    shooting, too, with the density that it changes.
    """
    viscosity, speed, length, film, ambient = 18.5e-6, 50.0, 0.01, 1e-5, 101325.0
    density = 1.2 * vapour / ambient

    def thickness(x: Any) -> Any:
        return film * (2 - x / length)

    def slope(x: Any, p: Any, flow: float) -> Any:
        return (speed * thickness(x) / 2 - flow * vapour / p) * 12 * viscosity / thickness(x) ** 3

    def shot(flow: float) -> Any:
        return solve_ivp(slope, (0, length), [ambient], args=(flow,), method="DOP853", rtol=1e-11, dense_output=True)

    least = speed * film / 2 * ambient / vapour
    flow = brentq(lambda guess: shot(guess).y[0, -1] - ambient, least, 1.9 * least)
    x, across = np.linspace(0, length, 2001), np.linspace(0, 1, 201)
    p, h = shot(flow).sol(x)[0], thickness(x)
    gradient = slope(x, p, flow)
    u = speed * across - (h**2 * gradient / (2 * viscosity))[:, None] * across * (1 - across)
    mass = (p / vapour * h)[:, None] * u
    gained = np.gradient(mass, x, axis=0, edge_order=2)
    through = -np.pad(np.cumsum((gained[:, 1:] + gained[:, :-1]) / 2 * np.diff(across), axis=1), ((0, 0), (1, 0)))
    force = np.gradient(mass * u, x, axis=0, edge_order=2) + np.gradient(through * u, across, axis=1, edge_order=2)
    weighted, stress = (np.trapezoid(force * weight, across, axis=1) for weight in (across * (1 - across), across))

    def change(x_: float, p1: Any, flow1: float) -> Any:
        here, at, drive = thickness(x_), np.interp(x_, x, p), np.interp(x_, x, weighted)
        carried = p1 / vapour * flow * vapour / at
        own = (flow1 - carried) * vapour / at
        return (-own - density * here**2 / (2 * viscosity) * drive) * 12 * viscosity / here**3

    def changed(flow1: float) -> Any:
        return solve_ivp(change, (0, length), [0.0], args=(flow1,), rtol=1e-8, max_step=length / 200, dense_output=True)

    without, with_flow = changed(0.0).y[0, -1], changed(flow).y[0, -1]
    p1 = changed(-without * flow / (with_flow - without)).sol(x)[0]
    load = float(np.trapezoid(p1, x))
    friction = float(np.trapezoid(h / 2 * np.gradient(p1, x, edge_order=2) + density * stress, x))
    return load, friction


@pytest.mark.parametrize("vapour", [10132.5, 1013.25])
def test_inertia_of_a_gas_is_that_of_its_own_density(vapour):
    rows = [[0, 1], [101325.0 - vapour, 101325.0 / vapour], [1e6 - vapour, 1e6 / vapour]]
    scene = read_scene(
        {
            "name": "air slider",
            "kind": "bearing",
            "geometry": {"shape": "linear", "length": "10 mm", "film": "10 um", "rise": "10 um"},
            "lubricant": {
                "viscosity": "18.5 uPa*s",
                "density": f"{1.2 * vapour / 101325.0} kg/m^3",
                "cavitation_pressure": f"{vapour - 101325.0} Pa",
                "compressibility": {"law": "tabulated", "table": rows},
            },
            "motion": {"speed": "50 m/s"},
        }
    )
    assert isinstance(scene, Bearing)
    coarse, fine = (inertia(scene, solve(scene.problem(), (cells, cells))) for cells in (256, 512))
    load, friction = inertia_of_an_ideal_gas(vapour)
    assert 2 * fine.load - coarse.load == pytest.approx(load, rel=3e-3)  # of first order at the ends
    assert 2 * fine.friction - coarse.friction == pytest.approx(friction, rel=3e-3)
