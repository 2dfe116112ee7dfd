"""CPU time of making, preparing and describing a surface at growing sizes, beside surfalize where it does the same."""

import json
import time
import warnings

import numpy as np
import pytest
from places import BENCHMARKS

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.contact.parameters.definitions import AREAL
from roughfilm.contact.parameters.roughness_parameters import parameters
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.ladder.provenance import commit, machine, versions

RESULTS = BENCHMARKS / "surfaces.json"
REPEATS = 3


def timed(call):
    """CPU seconds of each of some repeats, sorted, and what the last one returned."""
    times = []
    for _ in range(REPEATS):
        started = time.process_time()
        found = call()
        times.append(time.process_time() - started)
    return sorted(times), found


def theirs(surface):
    """The same parameters, as far as surfalize has them; None where it is not installed."""
    surfalize = pytest.importorskip("surfalize")
    micro = [1e6 * length for length in surface.spacing]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        other = surfalize.Surface(np.ascontiguousarray(surface.heights.T) * 1e6, *micro)
        names = [name for name in AREAL if hasattr(other, name)]
        return {name: getattr(other, name)() for name in names}


@pytest.mark.benchmark
def test_cost_of_surfaces():
    rows = []
    for points in (256, 512, 1024, 2048):
        made, surface = timed(
            lambda points=points: self_affine(
                size=(1e-3, 1e-3),
                points=(points, points),
                seed=861,
                hurst=0.8,
                roll_off=0.25e-3,
                cut_off=8e-3 / points,
                rms_height=1e-6,
            )
        )
        measured = Surface(heights=surface.heights, spacing=surface.spacing)
        prepared, _ = timed(lambda measured=measured: prepare(measured, Recipe()))
        described, ours = timed(lambda surface=surface: parameters(surface))
        surfalize, other = timed(lambda surface=surface: theirs(surface))
        rows.append(
            {
                "points": points,
                "make_cpu_s": made,
                "prepare_cpu_s": prepared,
                "parameters_cpu_s": described,
                "surfalize_cpu_s": surfalize,
                "Sal_m": [ours["Sal"].value, other["Sal"] * 1e-6],
                "Sk_m": [ours["Sk"].value, other["Sk"] * 1e-6],
            }
        )
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(
            json.dumps({"machine": machine(), "versions": versions(), "commit": commit(), "rows": rows}, indent=1)
        )
    assert rows
