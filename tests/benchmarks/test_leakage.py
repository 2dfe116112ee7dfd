"""A seal from the first touch to sealed, timed: contact, thresholds, and leakage directly and averaged, as JSON.

A surface of 512² points, 25 loads and the last ones that leak, both directions; two threads. The flow of single gaps is
timed beside elimination (SuperLU) on the same network, which must agree.
"""

import json
import os
import time

import numpy as np
import pytest
from places import BENCHMARKS

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import load_contact
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.seal.leakage.curve import chosen_loads, sealing, setup, solved
from roughfilm.rom.seal.leakage.direct import direct_flow, direct_leakage
from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage
from roughfilm.rom.seal.leakage.series import SOUGHT

RESULTS = BENCHMARKS / "leakage.json"

POINTS, SIDE, MODULUS, THREADS = 512, 42e-6, 10e6 / 0.75, 2
AGREED = 1e-6
"""Of K: how near both solvers have to be."""


def times():
    return time.perf_counter(), sum(os.times()[:4])


def taken(before):
    return {name: now - then for name, now, then in zip(("wall_s", "cpu_s"), times(), before, strict=True)}


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """A series, and what each part of it took, kernels compiled before."""
    wave = np.cos(2 * np.pi * np.arange(64) / 64)
    gap = np.maximum(np.add.outer(wave, wave), 0.0)
    Press(gap, (1.0, 1.0), 1.0).at(0.05)
    direct_leakage(gap, (1.0, 1.0))
    homogenized_leakage(gap, (1.0, 1.0))
    surface = self_affine(
        size=(SIDE, SIDE),
        points=(POINTS, POINTS),
        seed=20071,
        hurst=0.8,
        roll_off=SIDE / 4,
        cut_off=SIDE / 32,
        rms_height=0.125e-6,
    )
    inputs = Inputs(heights=surface.heights, spacing=surface.spacing, settings={"benchmark": "leakage"})
    press = Press(surface.heights, surface.spacing, MODULUS)
    body = setup(surface, press, inputs, tmp_path_factory.mktemp("seal"))
    stated, whole = {}, times()
    before = times()
    thresholds = sealing(body, lambda *_: None)
    stated["thresholds"] = taken(before)
    before = times()
    loads = chosen_loads(body, thresholds)
    stated["choosing loads"] = taken(before)
    before = times()
    rows, _ = solved(body, loads, THREADS, lambda *_: None)
    stated["contacts and flow"] = taken(before)
    stated["whole"] = taken(whole)
    stated["flow alone, cpu_s"] = sum(row.cpu_s for row in rows.values())
    keep("series", {"points": POINTS, "loads": len(rows), "threads": THREADS, "times": stated})
    return body, rows, thresholds


def keep(name, entries):
    """Add to the file of results."""
    there = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.is_file() else {}
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps(there | {name: entries | circumstances()}, indent=1), encoding="utf-8")


@pytest.mark.benchmark
def test_a_series_from_the_first_touch_to_sealed(found):
    _, rows, thresholds = found
    ordered = list(rows.values())
    assert ordered[0].area_fraction < 0.01
    for name in SOUGHT:
        assert thresholds[name].bracketed
        assert [getattr(row, f"{name}_sealed") == 1 for row in ordered] == [
            row.load > thresholds[name].open.load for row in ordered
        ]
        values = [getattr(row, name) for row in ordered]
        assert all(value >= 0 for value in values)
        assert sorted(values, reverse=True) == values


@pytest.mark.benchmark
@pytest.mark.parametrize("part", [0.2, 0.6, 0.95])
def test_flow_beside_elimination(found, part):
    body, rows, _ = found
    opened = [load for load, row in rows.items() if not row.direct_x_sealed]
    contact = load_contact(body.contacts, opened[int(part * (len(opened) - 1))])
    stated = {}
    for name, how in (("multigrid", {}), ("elimination", {"solvers": ["elimination"]})):
        before = times()
        passage = direct_flow(contact.gap, contact.spacing, 0, tolerance=AGREED / 10, **how)
        stated[name] = {"permeability_m3": passage.permeability, **taken(before)}
    assert stated["multigrid"]["permeability_m3"] == pytest.approx(stated["elimination"]["permeability_m3"], rel=AGREED)
    ratio = stated["elimination"]["cpu_s"] / stated["multigrid"]["cpu_s"]
    keep(f"flow at {100 * contact.area_fraction:.0f} % of contact", stated | {"elimination over multigrid": ratio})
