"""The study of textured pads: the flows that its claims rest on, and its page."""

import json
from contextlib import contextmanager

import numpy as np
import pytest
from batches import Threads

from scripts.studies.pads import __main__ as pads
from scripts.studies.pads.claims import FULL, INLET, judge, reduced, relative
from scripts.studies.pads.data import NO_INERTIA, Pad, Plan

SMALL = Plan(ratios=(8.0, 32.0), numbers=(20.0, 200.0), checked_ratios=(), film_cells=200)


@contextmanager
def here(_count, _scratch):
    with Threads(1) as executor:
        yield executor


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return pads.compute(tmp_path_factory.mktemp("pads") / "found", SMALL, here)


def test_a_pad_without_inertia_is_that_of_reynolds_and_the_full_one_carries_nothing(study):
    pad = Pad(texture="inlet half", depth=1.0, rise=0.0, ratio=32.0, number=NO_INERTIA)
    assert study.load(pad, "film") == pytest.approx(study.without(pad), rel=1e-2)
    assert abs(study.load(Pad(**{**vars(pad), "texture": "full"}), "film_slope")) < 1e-3 * study.without(pad)


def test_inertia_follows_re_over_the_aspect_ratio_and_changes_its_sign(study):
    change, number = relative(study, INLET), reduced(study)
    assert (change[number > 20] < -0.1).all()
    assert (np.abs(change[number < 3]) < 0.01).all()
    assert (study.map(FULL, study.by_inertia) > 0).all()


def test_single_cells_predict_a_full_texture_and_the_wrong_sign_near_the_inlet(study):
    full = study.map(FULL, lambda pad: study.by_cells(pad) / study.by_inertia(pad))
    assert full[reduced(study) < 10] == pytest.approx(1.0, abs=0.1)
    assert (study.map(INLET, study.by_cells) > 0).all()


def test_verdicts_and_page(study, tmp_path):
    assert [claim.verdict for claim in judge(study)] == ["partly", "true", "true"]
    pads.write(tmp_path, study, as_json=False)
    numbers = json.loads((tmp_path / "pads.json").read_text())
    assert np.shape(numbers["maps"][0]["film_slope"]) == (2, 2)
    assert numbers["checks"] == []
    assert "OpenFOAM was not on the machine" in (tmp_path / "pads.html").read_text()
