"""Properties of marches of random journals and pads: balance, scaling, and extremes of body, load and start."""

from contextlib import suppress

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.scene import read_scene

CELLS = (12, 8)
BALANCE = 1e-9


def journal(rng):
    lobes = int(rng.integers(2, 4))
    return {
        "geometry": {
            "shape": "lobes",
            "radius": "25 mm",
            "clearance": "40 um",
            "width": f"{rng.uniform(10, 40)!r} mm",
            "lobes": lobes,
            "arc": f"{360 / lobes - 20!r} deg",
        },
        "motion": {"speed": f"{rng.uniform(500, 6000)!r} rpm"},
        "body": {"start": {"eccentricity": rng.uniform(-0.5, 0.5, 2).tolist()}},
    }


def pad(rng):
    return {
        "geometry": {"shape": "pivoted", "length": "40 mm", "width": "30 mm", "pivot": float(rng.uniform(0.55, 0.65))},
        "motion": {"speed": f"{rng.uniform(1, 20)!r} m/s"},
        "body": {"start": {"film": f"{rng.uniform(20, 80)!r} um"}},
    }


def line(rng):
    """An infinitely wide pad, whose load is one per width."""
    scene = pad(rng)
    scene["geometry"].pop("width")
    return scene


KINDS = {"journal": journal, "pad": pad, "line": line}


def scene(kind, seed, *, factor=1.0, mass=1.0, lubricant=None, loads=None):
    """A random bearing under 200 to 2000 N (per m of a line), with all stresses and the mass times a factor."""
    rng = np.random.default_rng(seed)
    entries = KINDS[kind](rng)
    load, viscosity = factor * rng.uniform(200, 2000), factor * rng.uniform(5e-3, 5e-2)
    entries["lubricant"] = {"viscosity": f"{viscosity!r} Pa*s", "cavitation_pressure": f"{-0.1 * factor!r} MPa"}
    entries["lubricant"] |= lubricant or {}
    entries["body"]["mass"] = f"{factor * mass!r} kg"
    if loads is None:
        entries["load"] = {"force_per_width": f"{10 * load!r} N/m"} if kind == "line" else {"force": f"{load!r} N"}
    else:
        times = np.array([0, 1, 1.001, 2, 2.001, 3]) * 1e-3
        over_time = {"time": [f"{one!r} s" for one in times.tolist()], "load": [f"{load * one!r} N" for one in loads]}
        entries["motion"]["over_time"] = over_time
    return read_scene({"name": "random", "kind": "bearing", **entries})


def marched(bearing, **options):
    end = {} if bearing.motion.over_time is not None else {"end": 3e-3}
    return march_bearing(bearing, cells=CELLS, uncertain=False, **(end | options))


def check(march):
    assert all(np.isfinite(march[name]).all() for name in march.series.units)
    assert np.abs(march["flow_imbalance"]).max() <= BALANCE
    assert march["force_residual"].max() <= BALANCE
    assert march["film_min"].min() > 0


@pytest.mark.parametrize(("kind", "seed"), [("journal", 1), ("pad", 2), ("line", 3)])
def test_stresses_and_masses_of_one_factor_leave_the_path(kind, seed):
    one, other = (marched(scene(kind, seed, factor=factor), steps=30) for factor in (1.0, 8.0))
    check(one)
    name = "eccentricity_x" if kind == "journal" else "pivot_film"
    np.testing.assert_allclose(other[name], one[name], rtol=1e-7)
    np.testing.assert_allclose(other["friction"], 8 * one["friction"], rtol=1e-6)


@pytest.mark.parametrize("mass", [1e-9, 1e6])
@pytest.mark.parametrize("kind", KINDS)
def test_tiny_and_huge_masses_balance(kind, mass):
    march = marched(scene(kind, 5, mass=mass), steps=30)
    check(march)
    if mass > 1:
        name = "eccentricity_y" if kind == "journal" else "pivot_film"
        assert march[name] == pytest.approx(march[name][0], rel=1e-3)


@pytest.mark.parametrize("kind", ["journal", "pad"])
def test_steps_and_gaps_of_the_load_balance(kind):
    check(marched(scene(kind, 6, loads=(1, 1, 5, 5, 0, 0)), error=1e-2))


@pytest.mark.parametrize("kind", KINDS)
def test_compressible_films_balance(kind):
    law = {"compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "0.1 GPa"}}
    check(marched(scene(kind, 7, lubricant=law), steps=30))


def test_a_capillary_that_passes_next_to_nothing_leaves_its_hole_to_the_film():
    bearing = read_scene(
        {
            "name": "closed capillary",
            "kind": "bearing",
            "geometry": {"shape": "lobes", "radius": "25 mm", "clearance": "40 um", "width": "20 mm"},
            "lubricant": {"viscosity": "20 mPa*s", "cavitation_pressure": "-0.1 MPa"},
            "motion": {"speed": "1000 rpm"},
            "load": {"force": "300 N"},
            "body": {"start": {"eccentricity": [0.1, -0.2]}},
            "supply": [
                {
                    "kind": "hole",
                    "angle": "270 deg",
                    "diameter": "6 mm",
                    "pressure": "1 MPa",
                    "capillary": {"diameter": "1 um", "length": "20 mm"},
                }
            ],
        }
    )
    march = marched(bearing, steps=30)
    check(march)
    passed = np.abs(march["supply_1_flow"][1:]).max()
    assert passed < 1e-6 * np.abs(march["side_flow_high"][1:]).max()


@pytest.mark.parametrize("eccentricity", [[0.0, -0.9999], [0.99999, 0.0]])
def test_walls_that_nearly_touch_end_in_a_march_or_in_one_line(eccentricity):
    bearing = scene("journal", 8)
    start = bearing.body.start.model_copy(update={"eccentricity": tuple(eccentricity)})
    near = bearing.model_copy(update={"body": bearing.body.model_copy(update={"start": start})})
    with suppress(ConvergenceError, InputError):
        check(marched(near, error=1e-2))
