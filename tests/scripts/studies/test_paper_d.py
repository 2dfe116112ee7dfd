"""Verdicts on made-up contacts whose answers are known, the unloaded surface loaded again, and the page made small."""

import json
from functools import partial

import numpy as np
import pytest

from scripts.studies.paper_d import __main__ as paper_d
from scripts.studies.paper_d.claims import judge, power_of, settled, straightness
from scripts.studies.paper_d.data import QUANTITIES, SPECTRA, PaperD, compute, line_contacts, low_pass, refined
from scripts.studies.paper_e.surface import load_model, reload

LOADS = np.array([2e3, 1e4, 3e4, 1e5])
WAVES = np.array([1, 5, 10, 20, 40, 80, 160, 255])
ROUGHNESS = {"A": 0.93, "B": 0.3, "C": 0.14, "D": 0.35}


def paper(area, index, by_waves):
    """Area and plasticity index as functions of load, N/m, and Ra, µm; area as a function of waves."""
    pressed = {}
    for spectrum in SPECTRA:
        for name, average in ROUGHNESS.items():
            state = {quantity: np.ones((2, LOADS.size)) for quantity in QUANTITIES}
            state["area"] = np.tile(area(LOADS, average), (2, 1))
            state["plasticity_index"] = np.tile(index(LOADS, average), (2, 1))
            pressed[spectrum, name] = state
    cut = {spectrum: dict.fromkeys(("elastic", "elastic-plastic"), by_waves(WAVES)[None, :]) for spectrum in SPECTRA}
    return PaperD(
        loads=tuple(LOADS),
        waves=tuple(WAVES),
        profiles={key: [np.zeros(512)] for key in pressed},
        pressed=pressed,
        cut=cut,
        shown=None,
        finer={key: {name: values[:, [0, -1]] for name, values in state.items()} for key, state in pressed.items()},
    )


def verdicts(made):
    return {claim.number: claim.verdict for claim in judge(made)}


def test_contacts_that_do_what_the_paper_says():
    made = paper(
        lambda load, _: 8e-7 * load,
        lambda load, average: average * (0.5 + load / 4e5),
        lambda n: 0.08 * (1 + np.exp(-n / 4.0)),
    )
    assert verdicts(made) == dict.fromkeys((15, 16, 17, 18), "true")


def test_contacts_that_do_the_opposite():
    made = paper(
        lambda load, average: 0.08 * (load / 1e5) ** 0.6 / average,
        lambda load, average: np.where(load < 5e4, 0, 0.3 - 0.1 * average),
        lambda n: 0.5 / n,
    )
    assert verdicts(made) == dict.fromkeys((15, 16, 17, 18), "false")


def test_powers_lines_and_where_an_area_settles():
    x = np.array([1.0, 2.0, 4.0])
    assert power_of(x, 3 * x**0.7) == pytest.approx(0.7)
    assert straightness(x, 5 * x) == pytest.approx(1)
    assert straightness(x, x**2) == pytest.approx(1 - 404 / 21 / 126)
    assert settled(np.array([1, 2, 3, 4]), np.array([9.0, 4.2, 4.1, 4.0]), 0.03) == 3
    assert settled(np.array([1, 2, 3, 4]), np.array([4.0, 4.0, 4.0, 4.0]), 0.01) == 1


def test_waves_are_cut_off_and_refined():
    x = 2 * np.pi * np.arange(64) / 64
    wave, ripple = np.cos(3 * x + 0.4), 0.2 * np.sin(9 * x)
    assert low_pass(wave + ripple, 8) == pytest.approx(wave, abs=1e-14)
    assert low_pass(wave + ripple, 9) == pytest.approx(wave + ripple, abs=1e-14)
    assert refined(wave, 4) == pytest.approx(np.cos(3 * 2 * np.pi * np.arange(256) / 256 + 0.4), abs=1e-14)


def test_a_soft_profile_bears_its_load_where_it_is_highest():
    """With the height of ridges beyond what 1 MPa can press down, the area is W/H: 42 N/m over 0.42 mm is 0.1 MPa."""
    heights = 1e-3 * np.random.default_rng(911).permutation(128)
    (contact,) = line_contacts(heights, [42 * 16 / 12.8], hardness=1e6)
    assert contact.plastic_fraction == pytest.approx(16 / 128)
    assert set(np.flatnonzero(contact.in_contact)) == set(np.argsort(heights)[-16:])


def test_a_flattened_surface_is_elastic_under_the_same_load():
    contacts = load_model(256, (1e8, 8e8))
    for contact in contacts:
        assert contact.plastic_displacement.max() > 1e-7
        again = reload(contact)
        assert again.highest <= 1 + 1e-6
        assert again.pressure < 1e-5
        assert again.heights < 1e-8
    lightly_again = reload(contacts[0])
    assert lightly_again.load == 1e8


def test_the_page(monkeypatch, tmp_path):
    small = partial(compute, seeds=(103,), loads=(2e4, 1e5), waves=(4, 64, 255))
    monkeypatch.setattr(paper_d, "compute", small)
    paper_d.command(tmp_path)
    page = (tmp_path / "paper_d.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 8
    stated = json.loads((tmp_path / "paper_d.json").read_text(encoding="utf-8"))
    assert [claim["number"] for claim in stated["claims"]] == [15, 16, 17, 18]
    assert stated["profiles"]["self-affine"]["A"]["average"] == pytest.approx(0.93e-6, rel=1e-5)
    least = 1e5 / 0.42e-3 / 4e9
    assert all(found["area"]["mean"][-1] >= least for found in stated["pressed"]["self-affine"].values())
