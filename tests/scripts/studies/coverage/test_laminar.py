"""Random films beyond the laminar limit have no promise of any model; those far below it are not touched."""

import zlib

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.advice.measured import with_measured_errors
from roughfilm.rom.advice.stated import stated_errors
from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.bearing.mixed.stribeck import stribeck
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import kind_of_scene
from roughfilm.rom.ladder.request import Request
from roughfilm.words.summary import summary
from scripts.studies.coverage.laminar import KINDS, at_reynolds_number

SEEDS = range(20_000, 20_004)
CELLS = 16
"""Cells along a side of a bearing: its Reynolds numbers hardly depend on them."""


def scenes(kind, low, high):
    """The valid ones of some random scenes, at random multiples of the limit."""
    found = []
    for seed in SEEDS:
        rng = np.random.default_rng([seed, zlib.crc32(kind.encode())])
        try:
            found.append(at_reynolds_number(kind, seed, float(np.exp(rng.uniform(np.log(low), np.log(high))))))
        except (ConvergenceError, InputError):
            continue
    assert found
    return found


def solved(scene):
    """The results of all models that run here, on coarse grids."""
    found = {}
    for model in models(scene.kind):
        if model.outside or not model.applies(scene).applies:
            continue
        try:
            found[model.name] = model.solve(scene, Request(resolution=CELLS if scene.kind == "bearing" else None))
        except (ConvergenceError, InputError):
            continue
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_no_film_beyond_the_laminar_limit_has_a_promise(kind):
    for scene in scenes(kind, 1.05, 20.0):
        own = kind_of_scene(scene)
        quantity = next(iter(own.compared))
        advice = advise(scene, models(scene.kind), quantity=quantity, within=0.9)
        assert advice.chosen is None, scene.name
        results = solved(scene)
        for model in models(scene.kind):
            if model.name in results:
                one = with_errors(results[model.name], scene, model, models(scene.kind))
                assert one.outside, (scene.name, model.name)
                assert not stated_errors(one), (scene.name, model.name)
                assert summary(one, quantity, 0.9).startswith("outside the range of the model: Re = ")
        compared = with_measured_errors(scene, models(scene.kind), results) if results else {}
        assert not any(stated_errors(one) for one in compared.values()), scene.name


@pytest.mark.parametrize("kind", KINDS)
def test_films_far_below_the_limit_are_laminar(kind):
    """A thirtieth of it leaves room for the thickest part of a film, and for the clearance of a shaft."""
    for scene in scenes(kind, 1e-3, 3e-3):
        assert not any(one.outside for one in solved(scene).values()), scene.name


@pytest.mark.parametrize("kind", ["free_bearing", "placed_bearing"])
def test_no_point_of_a_series_beyond_the_limit_promises_anything(kind):
    points = []
    for scene in scenes(kind, 1.5, 20.0)[:3]:
        assert isinstance(scene, Bearing)
        speed, load = abs(scene.motion.speed), scene.load_pressure or 2e5
        for series in (dynamics, stribeck):
            try:
                (curve,) = series(scene, [speed], [load], resolution=32 if series is dynamics else CELLS)
            except (ConvergenceError, InputError):
                continue
            points += [(scene.name, series.__name__, point.outside) for point in curve.points]
    assert points
    assert all(outside for *_, outside in points), points
