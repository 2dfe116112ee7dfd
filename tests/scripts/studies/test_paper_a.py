"""Verdicts on made-up sweeps whose answers are known, and depths read between points."""

from itertools import product
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from roughfilm.rom.pocket.kind import KIND
from roughfilm.rom.studies.sweep import Sweep
from scripts.studies.paper_a.claims import judge
from scripts.studies.paper_a.data import DEPTHS, NUMBERS, SHAPES, WIDTHS, PaperA, first_zero, highest, still_wall_shear

KEYS = list(product(SHAPES.values(), WIDTHS, DEPTHS, NUMBERS))


def paper(load, friction, stokes=lambda *_: 0.0):
    """A sweep whose load and friction are given functions of profile, xd+, w+, d+ and Re."""
    columns = np.array([(shape[1], width, depth, number) for shape, width, depth, number in KEYS]).T
    given = dict(zip(("shift_plus", "width_plus", "depth_plus", "reynolds_number"), columns, strict=True))
    given["profile"] = np.array([shape[0] for shape, *_ in KEYS])
    given["film_plus"] = np.full(len(KEYS), 0.03)

    def found(load):
        values = {name: np.ones(len(KEYS)) for name in KIND.sweeping.quantities}
        values["load_plus"] = np.array([load(*shape, *rest) for shape, *rest in KEYS])
        values["friction_plus"] = np.array([friction(*shape, *rest) for shape, *rest in KEYS])
        return values

    sweep = Sweep(
        kind="pocket",
        names=tuple(str(n) for n in range(len(KEYS))),
        given=given,
        found={"navier_stokes": found(load), "stokes": found(stokes)},
        cpu_s={},
        failures=(),
    )
    return PaperA(sweep=sweep, directory=Path("nowhere"), best="navier_stokes", stokes="stokes", upwind=None)


def falling(profile, _shift, width, depth, _number):
    return 3 - width * depth / 10 - (0.01 if profile == "cylindrical" else 0)


def verdicts(made, onset):
    onsets = dict.fromkeys(product(SHAPES, WIDTHS, NUMBERS), onset)
    return {claim.number: claim.verdict for claim in judge(made, onsets)}


def test_a_sweep_that_does_what_the_paper_says():
    def load(profile, _shift, width, depth, number):
        if profile == "splined":
            number = 60 + number / 8
        return number * width * depth * np.exp(-depth / 0.62)

    def friction(profile, shift, width, depth, number):
        rise = 0.02 * depth if width < 0.18 and number > 100 else 0.0
        return falling(profile, shift, width, depth, number) + rise

    assert verdicts(paper(load, friction), 0.6) == dict.fromkeys(range(1, 8), "true")


def test_a_sweep_that_does_the_opposite():
    def load(profile, _shift, width, depth, number):
        return (1 + depth) / number / width * (2 if (profile == "cylindrical") == (number < 100) else 1)

    def friction(profile, shift, width, depth, number):
        return 6 - falling(profile, shift, width, depth, number)

    found = verdicts(paper(load, friction, stokes=load), 0.3)
    assert found == dict.fromkeys(range(1, 8), "false")


def test_the_highest_point_of_a_parabola_and_of_a_slope():
    depths = np.array(DEPTHS)
    assert highest(depths, 1 - (depths - 0.6) ** 2) == pytest.approx(0.6)
    assert highest(depths, depths) == pytest.approx(1.25)


def test_the_shear_on_an_inclined_wall_counts_along_and_away_from_it():
    """A flow of shear rate -2 along a wall at 45°, on cells that lean: -2 in sliding speeds a film thickness of 1."""
    along, lean = np.array([1.0, 1.0]) / np.sqrt(2), np.array([-0.5, 2.0])
    vertices = np.arange(6)[:, None, None] * along + np.linspace(0, 1, 5)[:, None] * lean
    vertices[0, -1] = vertices[0, 0] + [0, 1]
    middle = (vertices[:-1, :-1] + vertices[1:, :-1] + vertices[1:, 1:] + vertices[:-1, 1:]) / 4
    height = middle @ [-along[1], along[0]]
    velocity = -2 * height[..., None] * along
    velocity[-1, -1] = 1.0
    fields = {"vertices": SimpleNamespace(values=vertices), "cell_velocity": SimpleNamespace(values=velocity)}
    assert still_wall_shear(SimpleNamespace(fields=fields)) == pytest.approx(-2)


def test_the_depth_at_which_shear_turns():
    depths = np.array(DEPTHS)
    assert first_zero(depths, 1 - depths / 0.6) == pytest.approx(0.6, abs=1e-3)
    assert first_zero(depths, 1 - depths / 4) == np.inf
    assert 0 < first_zero(depths, 1 - depths / 0.1) < 0.25
