"""CPU time of advice for the example scenes beside that of the best model that it could have run, as JSON."""

import json
import time

import pytest
from places import BENCHMARKS, SCENES

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.rom.ladder.model import best
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import kind_named, load_entries, load_scene

RESULTS = BENCHMARKS / "advice.json"
TOLERANCES = (0.1, 0.05, 0.01, 0.003, 0.001)


def costs(path):
    """A row for each tolerance; the first advice at each imports and compiles, and is left out."""
    scene = load_scene(path)
    here = [one for one in models(scene.kind) if one.applies(scene).applies and one.available().available]
    top = best(here)
    finest = max(top.resolutions_of(scene))
    quantity = next(iter(kind_of_name(scene.kind).compared))

    def spent(within):
        started = time.process_time()
        found = advise(scene, models(scene.kind), quantity=quantity, within=within)
        chosen = None if found.chosen is None else f"{found.chosen.model} {found.chosen.resolution}"
        return {"within": within, "chosen": chosen, "runs_cpu_s": found.spent_cpu_s} | {
            "own_cpu_s": time.process_time() - started
        }

    for within in TOLERANCES:
        spent(within)
    rows = [spent(within) for within in TOLERANCES]
    reference = top.solve(scene, Request(resolution=finest)).numerics.cpu_s
    return {"scene": path.stem, "best": f"{top.name} {finest}", "best_cpu_s": reference, "advice": rows}


@pytest.mark.benchmark
@pytest.mark.openfoam
def test_cost_of_advice():
    paths = [path for path in sorted(SCENES.glob("*.toml")) if kind_named(load_entries(path))]
    entries = [costs(path) for path in paths]
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "scenes": entries}, indent=1))
    assert entries
