"""The uncertainty of a march where marches on coarser grids stop."""

from types import SimpleNamespace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.bearing.march import solve
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.bearing.march.summary import apart
from roughfilm.rom.ladder.scene import read_scene

CELLS = (16, 8)


def scene():
    """A shaft with an unbalance in two axial grooves."""
    return read_scene(
        {
            "name": "rotor",
            "kind": "bearing",
            "geometry": {
                "shape": "lobes",
                "radius": "25 mm",
                "clearance": "40 um",
                "width": "25 mm",
                "lobes": 2,
                "arc": "150 deg",
            },
            "lubricant": {"viscosity": "15 mPa*s"},
            "motion": {"speed": "6000 rpm"},
            "load": {"force": "300 N"},
            "body": {"mass": "3 kg", "unbalance": "50 g*mm"},
        }
    )


def marched(monkeypatch, stops):
    """A march whose other marches stop where stops(numerics) is true, and the numerics of the others."""
    others, own = [], solve.run

    def run(duty, numerics, **options):
        if stops(numerics):
            raise ConvergenceError("the film becomes too thin")
        others.append(numerics)
        return own(duty, numerics, **options)

    monkeypatch.setattr(solve, "run", run)
    march = march_bearing(scene(), end=2e-3, steps=12, cells=CELLS)
    return march, others[1:]


@pytest.fixture(scope="module")
def finer():
    """The march on four times as many nodes with steps half as long."""
    return march_bearing(scene(), end=2e-3, steps=24, cells=(32, 16), uncertain=False)


def covered(march, finer):
    return all(
        abs(one.value - finer.quantities[name].value) <= one.uncertainty for name, one in march.quantities.items()
    )


def test_a_finer_grid_takes_the_place_of_the_coarse_one(monkeypatch, finer):
    march, others = marched(monkeypatch, lambda numerics: numerics.cells[0] < 12)
    assert [one.cells for one in others] == [(12, 6), (12, 6)]
    assert covered(march, finer)
    assert not march.warnings


def test_shorter_steps_take_the_place_of_longer_ones(monkeypatch, finer):
    given = 2e-3 / 12
    march, others = marched(monkeypatch, lambda numerics: numerics.step > 1.5 * given)
    assert [one.step for one in others] == pytest.approx([given, given / 2])
    assert covered(march, finer)


def test_without_any_other_march_there_is_no_uncertainty_and_a_warning_says_why(monkeypatch):
    march, _ = marched(monkeypatch, lambda numerics: numerics.cells != CELLS)
    assert all(one.uncertainty is None for one in march.quantities.values())
    assert "no uncertainty: all marches on coarser grids stopped (the film becomes too thin)" in march.warnings


def test_the_error_of_steps_counts_where_the_largest_step_limits_them(monkeypatch):
    """With a large error of a step all steps are the largest one; those of the comparison are twice as long."""
    steps, own = [], solve.run

    def run(duty, numerics, **options):
        series = own(duty, numerics, **options)
        steps.append(series["step"][-3:].max())
        return series

    monkeypatch.setattr(solve, "run", run)
    march_bearing(scene(), end=2e-3, error=0.2, cells=CELLS)
    fine, coarse, longer = steps
    assert coarse == pytest.approx(fine)
    assert longer == pytest.approx(2 * fine)


class Orbit(dict):
    """The steps of an ellipse that is run through with a phase, at times that are its own."""

    def __init__(self, size, phase, steps):
        self.time = np.linspace(0, 1, steps)
        angle = 2 * np.pi * self.time + phase
        super().__init__(eccentricity_x=size * np.cos(angle), eccentricity_y=0.5 * size * np.sin(angle))


def test_orbits_that_differ_in_their_phase_alone_have_the_same_extremes():
    duty = SimpleNamespace(lobes=True)
    assert apart(duty, Orbit(0.6, 0.0, 400), Orbit(0.6, 2.0, 300), 0.0, 1.0) < 1e-3
    assert apart(duty, Orbit(0.6, 0.0, 400), Orbit(0.5, 2.0, 300), 0.0, 1.0) == pytest.approx(0.1, abs=1e-3)


def test_a_given_path_states_the_uncertainty_of_its_force_and_none_of_its_own():
    """Oscillating plates whose cavity closes at 5.3696 MPa, as the mass balance of its edge has it."""
    time = np.linspace(0.0, 0.2, 81)
    film = 10e-6 - 3.5e-6 * np.cos(10 * np.pi * time)
    table = {"time": [f"{one!r} s" for one in time.tolist()], "film": [f"{one!r} m" for one in film.tolist()]}
    entries = {
        "name": "plates",
        "kind": "bearing",
        "geometry": {"shape": "parallel", "length": "20 mm"},
        "lubricant": {"viscosity": "0.05 Pa*s", "cavitation_pressure": "-0.1 MPa"},
        "motion": {"speed": "0 m/s", "over_time": table | {"period": "0.2 s"}},
    }
    found = march_bearing(read_scene(entries), end=0.2, cells=(32, 8)).quantities
    assert found["film_min"].uncertainty <= 1e-9
    for name, exact in (("pressure_max", 5.3696e6), ("film_force_max", 2 / 3 * 5.3696e6 * 0.02)):
        assert abs(found[name].value - exact) <= found[name].uncertainty <= 0.02 * exact
