"""What a command costs before it computes, CPU s, and the first solve after an installation, which compiles loops."""

import json
import os
import subprocess
import sys

import pytest
from places import BENCHMARKS, ROOT, SCENES

from roughfilm.contact.foundation.files import replacing
from roughfilm.rom.ladder.provenance import circumstances

RESULTS = BENCHMARKS / "start.json"
REPEATS = 5

POCKET = ("solve", SCENES / "pocket.toml", "--model", "inertial_reynolds")
JOURNAL = ("solve", SCENES / "journal.toml", "--model", "reynolds_cavitating")

TARGETS = {
    ("--help",): 0.3,
    ("--version",): 0.3,
    ("models",): 0.3,
    POCKET: 0.8,
}
"""CPU s, of Python and of what it starts."""

IMPORT_S, COMPILE_S = 0.25, 8.0
"""CPU s of ``import roughfilm`` beyond that of numpy, and of compiling what a journal bearing calls."""


def cpu_s(*arguments, **more):
    """CPU s of Python with these arguments."""
    before = os.times()
    environment = os.environ | {"PYTHONPATH": str(ROOT)} | more
    command = [sys.executable, *map(str, arguments)]
    subprocess.run(command, cwd=ROOT, env=environment, check=True, capture_output=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def least(*arguments):
    """The least of a few runs, bytecode and compiled loops kept from the first."""
    return min([cpu_s(*arguments) for _ in range(REPEATS + 1)][1:])


@pytest.mark.benchmark
def test_commands_start_in_time(tmp_path):
    rows = {
        " ".join(map(str, arguments)): (least("-m", "roughfilm.cli.main", *arguments), target)
        for arguments, target in TARGETS.items()
    }
    rows["import roughfilm"] = (least("-c", "import roughfilm") - least("-c", "import numpy"), IMPORT_S)
    journal = ("-m", "roughfilm.cli.main", *JOURNAL)
    cold = cpu_s(*journal, NUMBA_CACHE_DIR=str(tmp_path))
    rows["first journal bearing"] = (cold - least(*journal), COMPILE_S)
    entries = [{"command": command, "cpu_s": cpu, "target_cpu_s": target} for command, (cpu, target) in rows.items()]
    with replacing(RESULTS) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "rows": entries}, indent=1))
    assert not [entry for entry in entries if entry["cpu_s"] > entry["target_cpu_s"]]
