"""Marches: conservation, equilibria, closed forms, and the same numbers after a stop."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.free.idle import idle_pads
from roughfilm.rom.bearing.march import solve, store
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.scene import read_scene

CELLS = (16, 8)
GROOVED = {
    "shape": "lobes",
    "radius": "25 mm",
    "clearance": "40 um",
    "width": "25 mm",
    "lobes": 2,
    "arc": "150 deg",
}
LUBRICANT = {"viscosity": "15 mPa*s", "cavitation_pressure": "-0.1 MPa"}


class StoppedError(Exception):
    """Ends a march as a kill does, after a chunk is in the file."""


def bearing(**tables):
    return read_scene(
        {
            "name": "changing",
            "kind": "bearing",
            "geometry": GROOVED,
            "lubricant": LUBRICANT,
            "motion": {"speed": "6000 rpm"},
            **tables,
        }
    )


def changing(**motion):
    table = {
        "time": ["0 ms", "5 ms", "10 ms"],
        "load_x": ["0 N", "400 N", "-300 N"],
        "load_y": ["-600 N", "-200 N", "200 N"],
        "period": "15 ms",
    }
    return bearing(motion={"speed": "6000 rpm", "over_time": table, **motion})


@pytest.fixture(scope="module")
def periodic():
    return march_bearing(changing(), end=0.015, error=3e-3, cells=(24, 8), fields=3)


def test_what_enters_leaves_or_is_stored_at_every_step(periodic):
    assert np.abs(periodic["flow_imbalance"]).max() < 1e-9
    held = np.trapezoid(periodic["volume_rate"], periodic.time)
    assert periodic["volume"][-1] - periodic["volume"][0] == pytest.approx(
        held, rel=0.1, abs=1e-3 * periodic["volume"][0]
    )


def test_the_film_carries_the_load_of_a_body_without_mass(periodic):
    for part in ("force_x", "force_y"):
        scale = np.abs(periodic[f"load_{part}"]).max()
        assert np.abs(periodic[f"film_{part}"] + periodic[f"load_{part}"])[1:].max() < 1e-4 * scale


def test_every_quantity_has_an_uncertainty_and_fields_are_kept(periodic):
    assert all(one.uncertainty is not None and one.uncertainty >= 0 for one in periodic.quantities.values())
    assert periodic.series.snapshots[0].time == 0.0
    last = periodic.series.snapshots[-1]
    assert last.fields["film_thickness"][0].min() == pytest.approx(periodic["film_min"][-1], rel=0.02)


def test_a_march_from_anywhere_ends_in_the_equilibrium():
    scene = bearing(load={"force": "600 N"}, body={"start": {"eccentricity": [0.4, 0.1]}})
    march = march_bearing(scene, end=0.1, cells=CELLS, uncertain=False)
    film = free_film(scene, CELLS)
    place = equilibrium(film, None, tolerance=1e-10).place / film.wall.unit[0]
    assert [march["eccentricity_x"][-1], march["eccentricity_y"][-1]] == pytest.approx(place, abs=2e-4)
    assert march.settled
    assert "equilibrium" in march.state


def test_pads_without_load_rest_as_in_equilibrium():
    """At ambient cavitation pressure nothing but its alignment determines the tilt of a pad without load."""
    pads = GROOVED | {"lobes": 5, "arc": "60 deg", "pivot": 0.5}
    oil = {"viscosity": "15 mPa*s"}
    scene = bearing(geometry=pads, lubricant=oil, body={"mass": "30 kg"}, load={"force": "600 N"})
    film = free_film(scene, CELLS)
    steady = equilibrium(film, None, tolerance=1e-10)
    assert idle_pads(film, steady)
    march = march_bearing(scene, cells=CELLS, end=0.1, uncertain=False, error=1e-2)
    for axis, name in enumerate(("eccentricity_x", "eccentricity_y")):
        assert march[name][-1] == pytest.approx(steady.place[axis] / film.wall.unit[axis], abs=1e-5)
    assert np.abs(march["flow_imbalance"]).max() < 1e-9


def test_flows_at_corners_between_edges_of_other_pressures_have_no_uncertainty():
    fed = bearing(boundary={"inlet": {"pressure": "1 bar"}}, load={"force": "600 N"})
    march = march_bearing(fed, end=2e-3, cells=CELLS, error=1e-2)
    flows = {f"{name}_flow_mean" for name in ("gap_1", "gap_2")} | {
        f"side_flow_{side}_mean" for side in ("low", "high")
    }
    assert {name for name, one in march.quantities.items() if one.uncertainty is None} == flows
    assert any(line.startswith("gap_1_flow, gap_2_flow, side_flow_high, side_flow_low") for line in march.warnings)


def test_less_than_a_period_or_a_few_turns_state_no_end_of_the_motion():
    """A turn takes 10 ms; in 1 ms a shaft hardly leaves its start."""
    for body in ({"unbalance": "100 g*mm"}, {"mass": "1 kg", "start": {"eccentricity": [0.1, -0.1]}}):
        scene = bearing(load={"force": "100 N"}, body=body)
        march = march_bearing(scene, end=1e-3, steps=2, cells=CELLS, uncertain=False)
        assert march.settled is None
        assert (march.first, march.last) == (0.0, 1e-3)
        assert "period" in march.state or "too short" in march.state


def test_a_heavy_rotor_whirls_at_about_half_of_its_speed_and_a_light_one_does_not():
    def marched(mass):
        body = {"mass": mass, "start": {"eccentricity": [0.1, -0.1]}}
        return march_bearing(bearing(load={"force": "100 N"}, body=body), end=0.06, cells=CELLS, uncertain=False)

    heavy, light = marched("40 kg"), marched("0.1 kg")
    assert "whirl" in heavy.state
    late = heavy.time > 0.03
    turned = np.unwrap(np.arctan2(heavy["eccentricity_y"], heavy["eccentricity_x"]))[late]
    omega = 6000 * 2 * math.pi / 60
    assert 0.2 < np.ptp(turned) / np.ptp(heavy.time[late]) / omega < 0.6
    assert np.ptp(heavy["eccentricity_x"][late]) > 3 * np.ptp(light["eccentricity_x"][light.time > 0.03])


def test_a_law_over_temperature_without_a_heat_capacity_is_reported():
    law = {"law": "exponential", "temperature_coefficient": "0.03 1/K"}
    lubricant = LUBRICANT | {"temperature": "40 degC", "density": "870 kg/m^3", "thermoviscosity": law}
    scene = bearing(load={"force": "100 N"}, lubricant=lubricant)
    march = march_bearing(scene, end=1e-3, steps=2, cells=CELLS, uncertain=False)
    assert any(line.startswith("lubricant.heat_capacity: missing, so that") for line in march.warnings)


def test_a_shaft_that_sinks_at_rest_does_not_whirl():
    scene = bearing(motion={"speed": "0 rpm"}, load={"force": "100 N"}, body={"mass": "1 kg"})
    march = march_bearing(scene, end=0.05, steps=20, cells=CELLS, uncertain=False)
    assert march["eccentricity_y"][-1] < march["eccentricity_y"][-5]
    assert march.state.startswith("a motion that")


def test_a_long_plate_that_closes_without_sliding_follows_the_closed_form():
    """Between parallel plates of length L, W = η L³ V/h³ per width: 1/h² = 1/h₀² + 2 W t/(η L³)."""
    length, film, force, viscosity = 0.02, 50e-6, 2e3, 0.1
    scene = read_scene(
        {
            "name": "plates",
            "kind": "bearing",
            "geometry": {"shape": "parallel", "length": f"{length} m"},
            "lubricant": {"viscosity": f"{viscosity} Pa*s"},
            "motion": {"speed": "0 m/s"},
            "load": {"force_per_width": f"{force} N/m"},
            "body": {"start": {"film": f"{film} m"}},
        }
    )
    march = march_bearing(scene, end=0.2, error=1e-4, cells=(40, 8), uncertain=False)
    exact = (film**-2 + 2 * force * march.time / (viscosity * length**3)) ** -0.5
    assert march["film"] == pytest.approx(exact, rel=3e-3)


def test_the_first_film_is_squeezed_by_a_wall_that_moves_then():
    """An infinitely wide plate: p = 6ηV x(L - x)/h³, W/B = ηV(L/h)³."""
    scene = read_scene(
        {
            "name": "plate",
            "kind": "bearing",
            "geometry": {"shape": "parallel", "length": "20 mm", "film": "50 um"},
            "lubricant": LUBRICANT,
            "motion": {"speed": "0 m/s", "approach": "1 mm/s"},
        }
    )
    march = march_bearing(scene, cells=(64, 8), end=1e-4, steps=2, uncertain=False)
    assert march["film_force"][0] == pytest.approx(15e-3 * 1e-3 * (20e-3 / 50e-6) ** 3, rel=2e-3)


def test_a_given_path_squeezes_with_its_velocity():
    """The load of parallel plates is η L³ V/h³ per width while the film closes."""
    length, viscosity = 0.02, 0.1
    table = {"time": ["0 s", "1 s"], "film": ["20 um", "10 um"]}
    scene = read_scene(
        {
            "name": "plates",
            "kind": "bearing",
            "geometry": {"shape": "parallel", "length": f"{length} m"},
            "lubricant": {"viscosity": f"{viscosity} Pa*s", "cavitation_pressure": "-1 MPa"},
            "motion": {"speed": "0 m/s", "over_time": table},
        }
    )
    march = march_bearing(scene, steps=100, cells=(40, 8), uncertain=False)
    exact = viscosity * length**3 * 10e-6 / march["film"] ** 3
    assert march["film_force"][5:] == pytest.approx(exact[5:], rel=2e-3)


def test_steps_are_of_second_order():
    def last(steps):
        march = march_bearing(changing(), end=0.003, steps=steps, cells=(16, 8), uncertain=False)
        return np.array([march["eccentricity_x"][-1], march["eccentricity_y"][-1]])

    fine = last(320)
    errors = [float(np.abs(last(steps) - fine).max()) for steps in (40, 80)]
    assert errors[0] / errors[1] > 2.5


def test_a_stopped_march_goes_on_with_the_same_bits(tmp_path, monkeypatch):
    monkeypatch.setattr("roughfilm.rom.bearing.march.series.CHUNK", 10)
    options = {"end": 0.003, "cells": (16, 8), "fields": 4}
    whole = march_bearing(changing(), path=tmp_path / "whole.h5", **options)
    path, usual, count = tmp_path / "stopped.h5", store.grow, [0]

    def stopping(*arguments):
        usual(*arguments)
        count[0] += 1
        if count[0] % 2 == 0:
            raise StoppedError

    monkeypatch.setattr(store, "grow", stopping)
    march = None
    for _ in range(100):
        try:
            march = march_bearing(changing(), path=path, **options)
            break
        except StoppedError:
            continue
    assert march is not None
    assert march.series.rows.tobytes() == whole.series.rows.tobytes()
    assert march.quantities == whole.quantities
    assert len(march.series.snapshots) == len(whole.series.snapshots) == 4
    monkeypatch.setattr(store, "grow", usual)
    again = march_bearing(changing(), path=path, **options)
    assert again.series.known == len(again.time)


def test_a_file_of_another_march_is_refused(tmp_path):
    path = tmp_path / "series.h5"
    march_bearing(changing(), path=path, end=0.002, cells=(16, 8), uncertain=False)
    with pytest.raises(InputError, match="holds another march, with end"):
        march_bearing(changing(), path=path, end=0.003, cells=(16, 8), uncertain=False)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"end": 0.0}, "end: got"),
        ({"end": -1.0}, "end: got"),
        ({"end": math.nan}, "end: got"),
        ({"error": 2.0}, "error: got"),
        ({"error": -1.0}, "error: got"),
        ({"steps": 0}, "steps: got"),
        ({"cells": (2, 8)}, "cells along: got"),
        ({"fields": -1}, "fields: got"),
    ],
)
def test_options_out_of_range_are_refused(options, words):
    with pytest.raises(InputError, match=words):
        march_bearing(changing(), **options)


def test_the_end_lies_within_a_table_that_does_not_repeat():
    table = {"time": ["0 s", "1 ms"], "load": ["100 N", "200 N"]}
    scene = bearing(motion={"speed": "6000 rpm", "over_time": table})
    with pytest.raises(InputError, match="the table ends at"):
        march_bearing(scene, end=0.01)
    assert solve.Duty(scene=scene).default_end() == pytest.approx(1e-3)


def test_the_flow_of_a_supply_is_that_of_its_orifice_at_its_pressure():
    hole = {"kind": "hole", "angle": "90 deg", "diameter": "3 mm", "pressure": "0.5 MPa"}
    scene = bearing(
        lubricant=LUBRICANT | {"density": "850 kg/m^3"},
        load={"force": "300 N"},
        supply=[hole | {"orifice": {"diameter": "0.3 mm"}}],
    )
    march = march_bearing(scene, end=1e-3, cells=CELLS)
    flows = [name for name in march.series.units if name.endswith("_flow")]
    assert flows == ["gap_1_flow", "gap_2_flow", "supply_1_flow"]
    drop = 0.5e6 - march["supply_1_pressure"][1:]
    area = math.pi * 0.3e-3**2 / 4
    assert drop.min() > 0
    np.testing.assert_allclose(march["supply_1_flow"][1:], 0.6 * area * np.sqrt(2 * drop / 850), rtol=1e-6)
