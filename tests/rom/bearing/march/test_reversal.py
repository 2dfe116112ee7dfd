"""Marches of bearings whose speed changes its sign: mirror images, conservation, and the same numbers after a stop."""

import contextlib

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.march import store
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.scene import read_scene

PIN = {"shape": "lobes", "radius": "15 mm", "width": "20 mm", "clearance": "20 um", "lobes": 2, "arc": "160 deg"}
PAD = {"shape": "parabolic", "length": "20 mm", "width": "20 mm", "rise": "20 um"}
TIMES, PERIOD = ["0 ms", "10 ms", "20 ms", "30 ms"], "40 ms"
CELLS = (24, 8)
READ = ("speed", "film_force", "pressure_max_x")
MIRRORED = {"eccentricity_x", "film_force_x", "load_force_x", "eccentricity_x_velocity", "speed"}
SWAPPED = {"gap_1_flow": "gap_2_flow", "gap_2_flow": "gap_1_flow"}
NOISE = {"film_min_x", "pressure_max_x", "residual", "force_residual", "flow_imbalance", "error", "iterations"}


class StoppedError(Exception):
    """Ends a march as a kill does, after a chunk is in the file."""


def swinging(sign=1, geometry=PIN, **tables):
    speeds = [f"{sign * speed} m/s" for speed in (1.0, 0.2, -1.0, -0.2)]
    table = {"time": TIMES, "period": PERIOD, "speed": speeds}
    table |= {"load_x": [f"{sign * load} N" for load in (100, 300, -200, 0)], "load_y": ["-900 N"] * 4}
    lubricant = {"viscosity": "15 mPa*s", "cavitation_pressure": "-0.1 MPa"}
    entries = {"geometry": geometry, "lubricant": lubricant, "motion": {"speed": "1 m/s", "over_time": table}}
    return read_scene({"name": "pin", "kind": "bearing", **entries, **tables})


def sliding(**tables):
    """A pad with a given film that slides forth and back."""
    table = {"time": ["0 s", "0.5 s", "1 s", "1.5 s"], "period": "2 s", "film": ["10 um"] * 4}
    table |= {"speed": ["1 m/s", "0 m/s", "-1 m/s", "0 m/s"]}
    return swinging(geometry=PAD, motion={"speed": "1 m/s", "over_time": table}, **tables)


def marched(scene, **more):
    return march_bearing(scene, cells=CELLS, uncertain=False, **({"end": 0.04, "steps": 80} | more))


@pytest.fixture(scope="module")
def pin():
    return marched(swinging(), fields=4)


def test_what_enters_leaves_or_is_stored_at_every_step(pin):
    assert pin["speed"].min() < 0 < pin["speed"].max()
    assert np.abs(pin["flow_imbalance"]).max() < 1e-9
    for part in ("force_x", "force_y"):
        assert np.abs(pin[f"film_{part}"] + pin[f"load_{part}"])[1:].max() < 1e-6 * 900


def test_the_mirrored_scene_with_the_opposite_speed_is_the_mirror_image(pin):
    """The mirrored shaft passes the two grooves in the other order."""
    image = marched(swinging(-1), fields=4)
    for name in set(pin.series.units) - NOISE:
        sign, other = -1 if name in MIRRORED else 1, SWAPPED.get(name, name)
        size = np.abs(pin[name]).max()
        assert image[other] == pytest.approx(sign * pin[name], abs=1e-9 * size), name
    half = np.pi * 15e-3
    for name in (
        "film_min_x",
        "pressure_max_x",
    ):  # from the beginning of the first lobe, at -170° of -10° to the y axis
        turned = np.mod(pin[name] + image[name] - np.radians(160) * 15e-3, 2 * half)
        assert np.minimum(turned, 2 * half - turned) == pytest.approx(0, abs=1e-9), name


def test_fields_lie_at_the_same_places_in_both_directions(pin):
    place = pin.series.grid["x"][0]
    for shot in pin.series.snapshots:
        step = int(np.argmin(np.abs(pin.time - shot.time)))
        thickness = shot.fields["film_thickness"][0].min(axis=1)
        angle = np.radians(-170) + place / 15e-3
        shaft = pin["eccentricity_x"][step] * np.cos(angle) + pin["eccentricity_y"][step] * np.sin(angle)
        assert thickness == pytest.approx(20e-6 * (1 - shaft), rel=1e-9)


def test_a_march_stopped_at_the_reversal_goes_on_with_the_same_bits(pin, tmp_path, monkeypatch):
    monkeypatch.setattr("roughfilm.rom.bearing.march.series.CHUNK", 7)
    path, usual = tmp_path / "pin.h5", store.grow

    def stopping(*arguments):
        usual(*arguments)
        raise StoppedError

    march = None
    for attempt in range(6):
        monkeypatch.setattr(store, "grow", stopping if attempt < 5 else usual)
        with contextlib.suppress(StoppedError):
            march = marched(swinging(), fields=4, path=path)
    assert march is not None
    assert march.series.rows.tobytes() == pin.series.rows.tobytes()


def test_a_symmetric_pad_that_slides_back_has_the_mirror_image_of_its_pressure():
    """The load at a given film is the same half a period later, and the peak lies on the other side."""
    march = marched(sliding(), end=2.0, steps=80)
    at = np.array([0.2, 0.35, 0.8])
    forth, back = ({name: np.interp(at + late, march.time, march[name]) for name in READ} for late in (0.0, 1.0))
    assert back["speed"] == pytest.approx(-forth["speed"], rel=1e-3)
    assert back["film_force"] == pytest.approx(forth["film_force"], rel=5e-3)
    assert back["pressure_max_x"] == pytest.approx(20e-3 - forth["pressure_max_x"], rel=5e-3)


def test_ends_of_different_pressure_would_change_places():
    with pytest.raises(InputError, match="the two ends change places"):
        marched(sliding(boundary={"inlet": {"pressure": "1 bar"}}))
