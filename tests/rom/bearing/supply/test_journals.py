"""Shafts in lobes with grooves and holes: an independent solution, closed forms, conservation, mirror and scaling."""

import math
import random

import numpy as np
import pytest
import scipy.sparse
import scipy.sparse.linalg

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.cavitation.motion.coupled import Drive, settled
from roughfilm.rom.cavitation.motion.past import held
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

RADIUS, CLEARANCE, WIDTH, ETA, SPEED = 25e-3, 25e-6, 40e-3, 0.02, 4.0
BORE = {"shape": "lobes", "radius": "25 mm", "clearance": "25 um", "width": "40 mm"}
LENGTH = 2 * math.pi * RADIUS / 16
GROOVE = {"kind": "groove", "angle": "90 deg", "length": f"{LENGTH!r} m", "extent": "20 mm", "pressure": "0.5 MPa"}
STARVED = {name: value for name, value in GROOVE.items() if name != "pressure"} | {"flow": "0.01 l/min"}
LOADED = {"force": "3 kN", "angle": "-90 deg"}
AROUND = {"kind": "groove", "extent": "4 mm", "pressure": "0.2 MPa"}


def scene_of(supply, geometry=None, **tables):
    tables = {"lubricant": {"viscosity": "20 mPa*s"}, "motion": {"speed": "4 m/s"}} | tables
    bore = BORE | (geometry or {})
    return read_scene({"name": "journal", "kind": "bearing", "geometry": bore, "supply": supply, **tables})


def solved(supply, geometry=None, *, model="reynolds_cavitating", cells=32, **tables):
    return find("bearing", model).solve(scene_of(supply, geometry, **tables), Request(resolution=cells))


def independent(nx, ny, place):
    """Force on the shaft and side leakage with GROOVE by five-point differences of ∇·(h³∇p) = 6ηu ∂h/∂x.

    The nodes in the groove, also at its edges, have its pressure; half of the width, from its middle, is solved.
    """
    theta = 2 * math.pi * np.arange(nx) / nx
    y = np.linspace(0.0, WIDTH / 2, ny + 1)
    dx, dy = 2 * math.pi * RADIUS / nx, WIDTH / 2 / ny

    def film(angle):
        return CLEARANCE * (1 - place[0] * np.cos(angle) - place[1] * np.sin(angle))

    east = film(theta + math.pi / nx) ** 3 / dx**2
    across = film(theta) ** 3 / dy**2
    slope = (film(theta + math.pi / nx) - film(theta - math.pi / nx)) / dx
    off = np.abs(np.arctan2(np.sin(theta - math.pi / 2), np.cos(theta - math.pi / 2)))
    fed = (off[:, None] * RADIUS <= LENGTH / 2 * (1 + 1e-9)) & (y <= 10e-3 * (1 + 1e-9))
    known = np.where(fed, 0.5e6, 0.0)
    fixed = fed | (np.arange(ny + 1) == ny)
    rows, columns, entries, right = [], [], [], []
    for i in range(nx):
        for j in range(ny + 1):
            row = i * (ny + 1) + j
            around = [((i + 1) % nx, j, east[i]), ((i - 1) % nx, j, east[i - 1])]
            around += [(i, abs(j - 1), across[i]), (i, min(j + 1, ny), across[i])]
            if fixed[i, j]:
                around = []
            rows += [row] * (1 + len(around))
            columns += [row, *(a * (ny + 1) + b for a, b, _ in around)]
            entries += [-sum(g for _, _, g in around) if around else 1.0, *(g for _, _, g in around)]
            right.append(known[i, j] if fixed[i, j] else 6 * ETA * SPEED * slope[i])
    matrix = scipy.sparse.csr_matrix((entries, (rows, columns)))
    p = scipy.sparse.linalg.spsolve(matrix, np.array(right)).reshape(nx, ny + 1)
    weights = np.full(ny + 1, dy)
    weights[[0, -1]] /= 2
    push = 2 * (p * weights).sum(axis=1) * dx
    leak = 2 * 2 * (film(theta) ** 3 * (3 * p[:, -1] - 4 * p[:, -2] + p[:, -3]) / (2 * dy) * -dx).sum() / (24 * ETA)
    return np.array([-(push * np.cos(theta)).sum(), -(push * np.sin(theta)).sum(), leak])


def test_a_full_film_with_a_groove_has_the_force_and_the_flow_of_an_independent_solution():
    place = (0.3, -0.5)
    result = solved([GROOVE], {"eccentricity": list(place)}, model="reynolds", cells=64)
    coarse, fine = (independent(16 * n, 2 * n, place) for n in (4, 8))
    scatter = np.abs(fine - coarse)
    load = math.hypot(*fine[:2])
    assert abs(result["load"].value - load) <= result["load"].uncertainty + scatter[:2].sum()
    assert abs(result["supply_flow"].value - fine[2]) <= result["supply_flow"].uncertainty + scatter[2]
    assert result["load"].value == pytest.approx(load, rel=0.01)
    assert result["supply_flow"].value == pytest.approx(fine[2], rel=0.02)


@pytest.mark.parametrize("eccentricity", [0.0, 0.5, 0.8])
def test_a_groove_around_feeds_two_lands(eccentricity):
    """Q = π D c³ p/(6 η l) (1 + 1.5 ε²) at rest, of both lands of the length l together."""
    result = solved(
        [AROUND], {"eccentricity": [eccentricity, 0.0]}, model="reynolds", motion={"speed": "0 m/s"}, cells=48
    )
    exact = math.pi * 2 * RADIUS * CLEARANCE**3 * 0.2e6 / (6 * ETA * 18e-3) * (1 + 1.5 * eccentricity**2)
    assert result["supply_flow"].value == pytest.approx(exact, rel=1e-4)


def drawn(seed):
    """Random supplies around a bore, apart from each other."""
    draw = random.Random(seed)
    count = draw.randint(1, 4)
    supplies = []
    for number in range(count):
        at = {"angle": f"{360 * (number + 0.6 * draw.random()) / count} deg"}
        at |= {"y": f"{20 + 4 * draw.uniform(-1, 1)} mm"} if draw.random() < 0.5 else {}
        pressure = {"pressure": f"{draw.uniform(0.1, 2)} MPa"}
        if draw.random() < 0.5:
            pressure |= draw.choice(
                [
                    {"capillary": {"diameter": "0.5 mm", "length": "30 mm"}},
                    {"orifice": {"diameter": f"{draw.uniform(0.1, 0.3)} mm"}},
                ]
            )
        kind = draw.choice(
            [
                {"kind": "hole", "diameter": "4 mm"},
                {"kind": "groove", "length": f"{draw.choice([0, 5])} mm", "extent": "20 mm"},
                {"kind": "pocket", "length": "8 mm", "extent": "20 mm", "depth": "0.5 mm"},
            ]
        )
        supplies.append(kind | at | pressure)
    eccentricity = draw.uniform(0, 0.8)
    angle = draw.uniform(0, 2 * math.pi)
    place = [eccentricity * math.cos(angle), eccentricity * math.sin(angle)]
    return supplies, {"eccentricity": place}


LUBRICANT = {"viscosity": "20 mPa*s", "density": "870 kg/m^3", "cavitation_pressure": "-0.1 MPa"}


@pytest.mark.parametrize("seed", range(6))
def test_random_bearings_conserve_mirror_and_scale(seed):
    supplies, place = drawn(seed)
    result = solved(supplies, place, lubricant=LUBRICANT, cells=24)
    flows = [quantity.value for name, quantity in result.quantities.items() if quantity.unit == "m^3/s"]
    total = sum(result[f"supply_{number}_flow"].value for number in range(1, len(supplies) + 1))
    assert total == pytest.approx(result["supply_flow"].value, rel=1e-12)
    assert abs(total - result["side_leakage"].value) <= 1e-9 * max(map(abs, flows))
    x, y = place["eccentricity"]
    back = solved(
        [one | {"angle": f"{180 - float(one['angle'].split()[0])} deg"} for one in supplies],
        {"eccentricity": [-x, y], "first": "-90 deg"},
        motion={"speed": "-4 m/s"},
        lubricant=LUBRICANT,
        cells=24,
    )
    # the density of an orifice scales with the viscosity and the pressures, as Q = k √(Δp/ρ) does not change then
    scaled = solved(
        [one | {"pressure": f"{3 * float(one['pressure'].split()[0])} MPa"} for one in supplies],
        place,
        lubricant={"viscosity": "60 mPa*s", "density": "2610 kg/m^3", "cavitation_pressure": "-0.3 MPa"},
        cells=24,
    )
    for name in ("load", "friction", "supply_flow", "supply_1_flow", "supply_1_pressure"):
        factor = 1.0 if "flow" in name else 3.0
        near = 1e-7 * abs(result[name].value) + 1e-9 * max(map(abs, flows)) * ("flow" in name)
        assert abs(back[name].value - result[name].value) <= near, name
        assert abs(scaled[name].value - factor * result[name].value) <= factor * near, name


def test_a_film_that_closes_conserves_what_is_supplied():
    """Flows in are flows out and storage, in a step in time with cavities."""
    scene = scene_of([GROOVE], load={"force": "1 kN"}, lubricant=LUBRICANT)
    film = free_film(scene, (32, 12)).whole
    moving = free_film(scene, (32, 12))
    instant = equilibrium(moving, None, tolerance=1e-10)
    step = 1e-4
    drive = Drive(
        speed=4.0,
        force=np.zeros(2),
        stiffness=np.zeros((2, 2)),
        free=np.zeros(2, dtype=bool),
        storage=(1 / step, held(moving.solved, instant) / step),
    )
    begun = moving.first(instant.place + np.array([1e-6, -2e-6]))
    after = settled(moving.solved, begun, drive, tolerance=1e-12)
    areas = moving.solved.grid.areas
    growth = ((held(moving.solved, after) - held(moving.solved, instant)) * areas).sum() / step
    entering = after.balance[after.network.fixed].sum()
    assert (after.kind == 1).any()
    assert abs(entering - growth) <= 1e-9 * np.abs(after.balance).max()
    assert film.grid.shape[1] == 2 * moving.solved.grid.shape[1] - 1


def test_a_supply_that_the_film_starves_at_the_equilibrium_is_named():
    """Nowhere in the clearance does a film whose pressures are above cavitation come near to the load."""
    film, starving, load = free_film(scene_of([STARVED], load=LOADED), (32, 16)), 0, np.array([0.0, -3e3])
    drive = Drive(
        speed=film.solved.problem.speed, force=np.zeros(2), stiffness=np.zeros((2, 2)), free=np.zeros(2, dtype=bool)
    )
    for ratio in (0.1, 0.4, 0.7):
        for angle in np.radians(range(0, 360, 45)):
            place = CLEARANCE * ratio * np.array([math.cos(angle), math.sin(angle)])
            instant = settled(film.solved, film.first(place), drive, tolerance=1e-8, starved=True)
            if instant.pressures[0] < 0:
                starving += 1
            else:
                assert np.hypot(*(film.solved.force(instant.state.pressure) + load)) > 0.2 * 3e3
    assert starving > 0
    with pytest.raises(InputError, match=r"^supply\.0: in equilibrium at the eccentricity .* raise the flow") as error:
        solved([STARVED], load=LOADED)
    assert "\n" not in str(error.value)
