"""Random shafts that swing back and forth, in lobes and as journals, keep the symmetries, scales and balances."""

import functools

import numpy as np
import pytest

from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.scene import read_scene

SEEDS = range(4)
STEPS, CELLS = 24, (20, 8)


def drawn(seed):
    """A bearing whose speed changes its sign, in SI units and degrees; of odd seeds a journal."""
    rng = np.random.default_rng(seed)
    clearance, viscosity, period = rng.uniform(20e-6, 60e-6), rng.uniform(0.01, 0.05), rng.uniform(0.02, 0.06)
    speed, radius = rng.uniform(1, 4), 0.02
    pressure = rng.uniform(0.02, 0.1) * viscosity * speed * radius / clearance**2
    width = radius * rng.uniform(0.5, 1.5)
    shares = rng.uniform(0.3, 1.0, 4)
    one = {"shape": "journal"} if seed % 2 else {"shape": "lobes", "lobes": 2, "arc": rng.uniform(120, 170)}
    return one | {
        "first": -90.0,
        "radius": radius,
        "clearance": clearance,
        "width": width,
        "viscosity": viscosity,
        "period": period,
        "speed": speed * np.array([1, rng.uniform(-0.2, 0.2), -1, 0.1]),
        "load": 2 * radius * width * pressure * shares,
        "angle": rng.uniform(-110, -70, 4),
    }


def scene_of(one):
    def listed(values, unit):
        return [f"{value!r} {unit}" for value in np.asarray(values).tolist()]

    geometry = {key: f"{one[key]!r} m" for key in ("radius", "clearance", "width")} | {"shape": one["shape"]}
    if one["shape"] == "lobes":
        geometry |= {"lobes": one["lobes"], "arc": f"{one['arc']!r} deg", "first": f"{one['first']!r} deg"}
    table = {"time": listed(one["period"] * np.arange(4) / 4, "s"), "period": f"{one['period']!r} s"}
    table |= {"speed": listed(one["speed"], "m/s"), "load": listed(one["load"], "N")}
    table |= {"angle": listed(one["angle"], "deg")}
    lubricant = {"viscosity": f"{one['viscosity']!r} Pa*s"}
    motion = {"speed": f"{float(one['speed'][0])!r} m/s", "over_time": table}
    return read_scene(
        {"name": "swing", "kind": "bearing", "geometry": geometry, "lubricant": lubricant, "motion": motion}
    )


def marched(one):
    return march_bearing(scene_of(one), end=0.75 * one["period"], steps=STEPS, cells=CELLS, uncertain=False)


@functools.cache
def plain(seed):
    return marched(drawn(seed))


@pytest.mark.parametrize("seed", SEEDS)
def test_flows_and_forces_balance_across_the_reversal(seed):
    march = plain(seed)
    assert march["speed"].min() < 0 < march["speed"].max()
    assert np.abs(march["flow_imbalance"]).max() < 1e-9
    load = np.hypot(march["load_force_x"], march["load_force_y"])
    for axis in "xy":
        assert np.abs(march[f"film_force_{axis}"] + march[f"load_force_{axis}"])[1:].max() < 1e-6 * load.max()
    assert march["film_min"].min() > 0
    assert march["cavitated_fraction"].max() <= 1


@pytest.mark.parametrize("seed", SEEDS)
def test_the_mirrored_bearing_moves_as_the_mirror_image(seed):
    """Mirrored in the plane of the y axis: angles φ become 180° - φ, and the shaft turns the other way."""
    one, march = drawn(seed), plain(seed)
    image = marched(one | {"speed": -one["speed"]} | {key: 180.0 - one[key] for key in ("first", "angle")})
    assert image["eccentricity_x"] == pytest.approx(-march["eccentricity_x"], abs=1e-6)
    for name in ("eccentricity_y", "film_min", "friction", "side_flow_low"):
        assert image[name] == pytest.approx(march[name], rel=1e-5, abs=1e-6 * np.abs(march[name]).max()), name


@pytest.mark.parametrize("seed", SEEDS)
def test_only_viscosity_times_speed_counts(seed):
    """Three times as fast with a third of the viscosity, the same path is run through in a third of the time."""
    one, march = drawn(seed), plain(seed)
    thin = one | {"viscosity": one["viscosity"] / 3, "speed": 3 * one["speed"], "period": one["period"] / 3}
    faster = marched(thin)
    assert 3 * faster.time == pytest.approx(march.time, rel=1e-9)
    for name, factor in (("eccentricity_x", 1), ("film_min", 1), ("friction", 1), ("side_flow_low", 3)):
        size = factor * np.abs(march[name]).max()
        assert faster[name] == pytest.approx(factor * march[name], rel=1e-5, abs=1e-6 * size), name
