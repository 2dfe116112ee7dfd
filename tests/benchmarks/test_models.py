"""CPU time and load of every model at every resolution of its chart, as JSON with the machine: pytest -m benchmark."""

import json

import pytest
from places import BENCHMARKS

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.model import ladder
from roughfilm.rom.ladder.provenance import commit, machine, versions
from roughfilm.rom.ladder.request import Request

RESULTS = BENCHMARKS / "models.json"
REPEATS = 3


@pytest.mark.benchmark
def test_cost_of_every_model_of_a_pocket(make_scene):
    scene = make_scene(0.3, 0.75, 160)
    rows = []
    for model in ladder(rom, foamcases, kind="pocket"):
        if not model.available().available:
            continue
        for resolution in model.resolutions_of(scene):
            runs = [model.solve(scene, Request(resolution=resolution)) for _ in range(REPEATS)]
            times = sorted(run.numerics.cpu_s for run in runs)
            rows.append(
                {
                    "model": model.name,
                    "resolution": resolution,
                    "cpu_s": times,
                    "expected_cpu_s": model.cost(scene, resolution),
                    "load_plus": runs[0].quantities["load_plus"].value,
                }
            )
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(
            json.dumps({"machine": machine(), "versions": versions(), "commit": commit(), "rows": rows}, indent=1)
        )
    assert rows
