"""The largest pressure between nodes: exact values, kinks, and neighbours outside the film."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.evaluation.peak import peak_pressure
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene

VISCOSITY, SPEED, LENGTH, FILM_THICKNESS = 0.01, 1.0, 0.01, 10e-6
UNIT = 6 * VISCOSITY * SPEED * LENGTH / FILM_THICKNESS**2


def peak(cells: int, geometry: dict[str, Any]) -> float:
    entries = {
        "name": "pad",
        "kind": "bearing",
        "geometry": {"length": "10 mm", "film": "10 um", **geometry},
        "lubricant": {"viscosity": "0.01 Pa*s"},
        "motion": {"speed": "1 m/s"},
    }
    return find("bearing", "reynolds").solve(read_scene(entries), Request(resolution=cells))["pressure_max"].value


@pytest.mark.parametrize("cells", [47, 50, 77, 100])
def test_the_peak_of_a_wedge_between_two_nodes(cells: int) -> None:
    """p = 6ηuL/h² (k - 1)/(4k(k + 1)) of the wedge with h(0)/h(L) = k = 2; the highest node is up to 3e-4 below."""
    assert peak(cells, {"shape": "linear", "rise": "10 um"}) == pytest.approx(UNIT / 24, rel=3e-5)


@pytest.mark.parametrize("cells", [47, 50])
def test_a_kink_is_no_parabola(cells: int) -> None:
    """p = 6ηuL/h² (H - 1) b (1 - b)/(H³ (1 - b) + b) of Rayleigh's step at x = b L with H = h(0)/h(L)."""
    before, ratio = 0.6, 1.8
    exact = UNIT * (ratio - 1) * before * (1 - before) / (ratio**3 * (1 - before) + before)
    assert peak(cells, {"shape": "step", "rise": "8 um", "step": "6 mm"}) == pytest.approx(exact, rel=1e-8)


@pytest.fixture(scope="module")
def film() -> Solution:
    return balance(load_scene(SCENES / "journal.toml", []).problem(), (16, 16))


def paraboloid(film: Solution, x: float, y: float) -> Solution:
    """The pressure 500 - a² - b² - ab with its top at x, y in cells."""
    i, j = np.indices(film.grid.shape)
    a, b = i - x, j - y
    pressure = 500 - a**2 - b**2 - a * b
    return replace(film, state=State(pressure=pressure, fill=np.ones(pressure.shape)), kind=np.full(i.shape, FILM))


def test_the_top_of_a_paraboloid_with_slanting_axes_is_exact(film: Solution) -> None:
    assert peak_pressure(paraboloid(film, 6.3, 7.4)) == pytest.approx(500, rel=1e-12)


def test_beside_a_cavity_and_at_the_edge_the_highest_node_is_the_peak(film: Solution) -> None:
    found = paraboloid(film, 6.3, 7.4)
    found.kind[7, 7] = CAVITY
    assert peak_pressure(found) == found.state.pressure.max() < 500
    corner = paraboloid(film, 0.3, 0.2)
    assert peak_pressure(corner) == corner.state.pressure.max() < 500
