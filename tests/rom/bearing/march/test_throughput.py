"""What flows through the edges of a film over time is what its walls displace, also where a cavity closes."""

import numpy as np
import pytest

from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.bearing.march.throughput import flows_of, throughput
from roughfilm.rom.ladder.scene import read_scene

LENGTH, PERIOD, FILM, SWING = 20e-3, 0.2, 10e-6, 3.5e-6


def gap(time):
    return FILM - SWING * np.cos(2 * np.pi * time / PERIOD)


def oscillating_plate():
    """A wide plate above another one, between which the film ruptures and fills again in each period."""
    times = np.linspace(0.0, PERIOD, 201)
    path = {
        "time": [f"{time!r} s" for time in times.tolist()],
        "film": [f"{film!r} m" for film in gap(times).tolist()],
        "period": f"{PERIOD!r} s",
    }
    return read_scene(
        {
            "name": "plate",
            "kind": "bearing",
            "geometry": {"shape": "parallel", "length": f"{LENGTH!r} m", "film": f"{FILM - SWING!r} m"},
            "lubricant": {"viscosity": "0.05 Pa*s", "cavitation_pressure": "-0.1 MPa"},
            "motion": {"speed": "0 m/s", "over_time": path},
        }
    )


@pytest.mark.parametrize("count", [50, 100, 400])
def test_a_plate_displaces_what_leaves_its_full_film(count):
    """Half of the change of h L passes each end; over a period nothing does."""
    march = march_bearing(oscillating_plate(), end=2 * PERIOD, steps=2 * count, cells=(32, 8), uncertain=False)
    passed, full = throughput(march.series), march["cavitated_fraction"] == 0
    assert full[-1]
    assert (np.diff(full.astype(int)) == 1).sum() == 2
    exact = LENGTH / 2 * (march["film"] - march["film"][0])
    swing = LENGTH * SWING  # what passes each end in half a period of a film without cavities
    np.testing.assert_allclose(passed["inlet_flow"][full], exact[full], atol=1e-8 * swing)
    np.testing.assert_allclose(passed["outlet_flow"][full], -exact[full], atol=1e-8 * swing)
    mean = march.quantities["inlet_flow_mean"].value
    assert abs(mean) * PERIOD < 0.05 / count * swing


def test_the_flows_of_a_grooved_journal_are_what_its_film_stores():
    table = {
        "time": ["0 ms", "5 ms", "10 ms"],
        "load_x": ["0 N", "400 N", "-300 N"],
        "load_y": ["-600 N", "-200 N", "200 N"],
        "period": "15 ms",
    }
    scene = read_scene(
        {
            "name": "grooved",
            "kind": "bearing",
            "geometry": {
                "shape": "lobes",
                "radius": "25 mm",
                "clearance": "40 um",
                "width": "25 mm",
                "lobes": 2,
                "arc": "150 deg",
            },
            "lubricant": {"viscosity": "15 mPa*s", "cavitation_pressure": "-0.1 MPa"},
            "motion": {"speed": "6000 rpm", "over_time": table},
            "supply": [{"kind": "hole", "angle": "90 deg", "diameter": "3 mm", "pressure": "0.5 MPa"}],
        }
    )
    march = march_bearing(scene, end=0.015, error=3e-3, cells=(24, 8), uncertain=False)
    passed, names = throughput(march.series), flows_of(march.series)
    assert {"gap_1_flow", "supply_1_flow", "side_flow_low", "side_flow_high"} <= {*names}
    assert np.ptp(march["cavitated_fraction"]) > 0.01
    entered = sum((1 if name.startswith(("gap", "supply")) else -1) * passed[name] for name in names)
    turnover = max(float(np.abs(one).max()) for one in passed.values())
    np.testing.assert_allclose(entered, march["volume"] - march["volume"][0], atol=1e-7 * turnover)
    for name in names:
        trapezoids = np.concatenate([[0.0], np.cumsum(np.diff(march.time) * (march[name][1:] + march[name][:-1]) / 2)])
        np.testing.assert_allclose(passed[name], trapezoids, atol=0.02 * turnover)
