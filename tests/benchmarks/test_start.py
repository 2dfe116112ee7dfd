"""What a command costs before it computes, CPU s, and the first solve after an installation, which compiles loops."""

import json
import os
import subprocess
import sys

import pytest
from places import BENCHMARKS, ROOT, SCENES

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.provenance import circumstances

COMMAND = ("-c", "from roughfilm.cli.main import main; main()")
"""What the installed command runs. With ``python -m`` a first solve took up to 1.3 s more, in page faults."""

RESULTS = BENCHMARKS / "start.json"
REPEATS = 5

POCKET = ("solve", SCENES / "pocket.toml", "--model", "inertial_reynolds")
FIRST = {
    "journal bearing": ("solve", SCENES / "journal.toml", "--model", "reynolds_cavitating"),
    "rough gap": ("solve", SCENES / "rough_gap.toml", "--model", "homogenized"),
    "seal": ("solve", SCENES / "seal.toml", "--model", "direct_leakage"),
    "contact": ("solve", SCENES / "dry_contact.toml", "--model", "elastic"),
    "pocket": ("solve", SCENES / "pocket.toml", "--model", "film_slope"),
}
"""A solve of each kind that compiles what it calls."""

TARGETS = {
    ("--help",): 0.3,
    ("--version",): 0.3,
    ("models",): 0.3,
    POCKET: 0.8,
}
"""CPU s, of Python and of what it starts."""

IMPORT_S, COMPILE_S = 0.25, 8.0
"""CPU s of ``import roughfilm`` beyond that of numpy, and of compiling what the first solve of a kind calls."""


def cpu_s(*arguments, **more):
    """CPU s of Python with these arguments, which keeps bytecode."""
    before = os.times()
    environment = os.environ | {"PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": ""} | more
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
        " ".join(map(str, arguments)): (least(*COMMAND, *arguments), target) for arguments, target in TARGETS.items()
    }
    rows["import roughfilm"] = (least("-c", "import roughfilm") - least("-c", "import numpy"), IMPORT_S)
    for kind, arguments in FIRST.items():
        solve = (*COMMAND, *arguments)
        cold = cpu_s(*solve, NUMBA_CACHE_DIR=str(tmp_path / kind))
        rows[f"first {kind}"] = (cold - least(*solve), COMPILE_S)
    entries = [{"command": command, "cpu_s": cpu, "target_cpu_s": target} for command, (cpu, target) in rows.items()]
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "rows": entries}, indent=1))
    assert not [entry for entry in entries if entry["cpu_s"] > entry["target_cpu_s"]]
