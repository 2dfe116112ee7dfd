"""Growth of the cost and memory of every method with the size of its problem, as JSON with the machine.

Each size is solved by ``growth.py`` in a process of its own. ``-m "benchmark and not slow"`` leaves out minutes.
"""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import pytest
from places import BENCHMARKS, ROOT

from roughfilm.charts.peer_runs import one_thread
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.provenance import circumstances

RESULTS = BENCHMARKS / "scale.json"
PROGRAM = Path(__file__).with_name("growth.py")

SIZES = {
    "contact": (256, 512, 1024, 2048, 4096, 8192),
    "flow_factors": (256, 512, 1024, 2048, 4096, 8192),
    "direct_flow": (256, 512, 1024, 2048, 4096),
    "film_plane": (128, 256, 512, 1024, 2048),
    "film_line": (10_000, 100_000, 1_000_000),
    "film_slope": (100, 200, 400, 800, 1600),
    "mixed": (64, 128, 256, 512),
    "navier_stokes": (60, 120, 240, 480),
    "stokes": (16, 32, 64, 96),
}
SLOW = {"contact": 4096, "flow_factors": 4096, "direct_flow": 4096, "film_plane": 2048, "stokes": 96}
"""The smallest size of a method that takes a minute or more with what it needs."""

KEPT = {}


def exponent(rows, name):
    """The slope of the logarithm over that of the number of unknowns between the two largest sizes."""
    small, large = rows[-2:]
    return math.log(large[name] / small[name]) / math.log(large["unknowns"] / small["unknowns"])


@pytest.mark.benchmark
@pytest.mark.openfoam
@pytest.mark.parametrize(
    ("name", "size"),
    [
        pytest.param(name, size, marks=[pytest.mark.slow] if size >= SLOW.get(name, math.inf) else [])
        for name, sizes in SIZES.items()
        for size in sizes
    ],
)
def test_cost_and_memory_of_a_size(name, size):
    command = [sys.executable, str(PROGRAM), name, str(size)]
    environment = os.environ | one_thread() | {"PYTHONPATH": str(ROOT)}
    printed = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout
    rows = KEPT.setdefault(name, [])
    rows.append(json.loads(printed) | {"load_average": os.getloadavg()[0]})
    growth = {method: exponent(found, "cpu_s") for method, found in KEPT.items() if len(found) > 1}
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "methods": KEPT, "exponents": growth}, indent=1))
    assert rows[-1]["unknowns"] > 0
