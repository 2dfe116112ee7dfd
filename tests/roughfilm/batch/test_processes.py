"""One process is this process; more processes run nothing of the program that starts them, and a dead one is said."""

import os
import subprocess
import sys
from concurrent.futures import BrokenExecutor
from pathlib import Path

import numpy as np
import pytest
from batches import wait_for

import roughfilm as rf
from roughfilm.batch import executors, solve
from roughfilm.batch.each import for_each
from roughfilm.batch.execute import lost
from roughfilm.contact.foundation.errors import InputError, UnavailableError

STUDY = """name = "depths"
kind = "pocket"
geometry = { length = "1 mm", film = "30 um", width = "0.3 mm", depth = ["5 um", "10 um", "15 um"] }
lubricant = { viscosity = "0.01 Pa*s", density = "1000 kg/m^3" }
motion = { reynolds_number = 40 }
study = { models = ["reynolds", "inertial_reynolds"] }
"""

PLAIN = {
    "run_study": "print(*rf.run_study('study.toml', 'out', processes={})['outcome'])",
    "windows": "print(rf.windows(surface, size=6.4e-5, sizes=[3.2e-5], count=2, processes={}).headline)",
    "leakage_curve": "print(len(rf.leakage_curve(seal, windows=[surface, surface], loads=[1e5], processes={}).rows))",
}
ANSWERS = {"run_study": " ".join(["solved"] * 6), "windows": "Sq", "leakage_curve": "1"}


@pytest.fixture
def study(tmp_path: Path) -> Path:
    (tmp_path / "study.toml").write_text(STUDY)
    return tmp_path / "study.toml"


@pytest.mark.parametrize("processes", [1, 2])
@pytest.mark.parametrize("name", PLAIN)
def test_a_plain_program_runs_once(name: str, processes: int, study: Path) -> None:
    heights = 1e-7 * np.random.default_rng(1).standard_normal((128, 128))
    np.save(study.parent / "heights.npy", heights)
    program = study.parent / "program.py"
    program.write_text(
        "import numpy as np\nimport roughfilm as rf\n"
        "open('runs.txt', 'a').write('run ')\n"
        "surface = rf.Surface(heights=np.load('heights.npy'), spacing=(1e-6, 1e-6), periodic=True)\n"
        "solid = {'modulus': '1 GPa', 'poisson': 0.3}\n"
        "liquid = {'density': '1000 kg/m^3', 'viscosity': '1 mPa*s'}\n"
        "flow = {'pressure_drop': '1 MPa', 'length': '1 mm', 'direction': 'x'}\n"
        "seal = {'name': 's', 'kind': 'seal', 'geometry': {'surface': 'heights.npy', 'spacing': '1 um'},\n"
        "    'solid': solid, 'load': {'pressure': '0.1 MPa'}, 'liquid': liquid, 'flow': flow}\n"
        f"seal = rf.read_scene(seal)\n{PLAIN[name].format(processes)}\n"
    )
    done = subprocess.run([sys.executable, program.name], cwd=study.parent, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == ANSWERS[name]
    assert (study.parent / "runs.txt").read_text() == "run "


def test_one_process_is_this_one(study: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executors, "Processes", None)
    assert set(rf.run_study(study, study.parent / "out", processes=1)["outcome"]) == {"solved"}


def test_a_process_that_dies_is_no_missing_number(study: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solve, "run", lambda jobs, _: ((job, lost(BrokenExecutor())) for job in jobs))
    with pytest.raises(UnavailableError, match=r"^6 of 6 jobs: its worker died twice .* the same call goes on$"):
        rf.run_study(study, study.parent / "out", processes=1)
    monkeypatch.undo()
    assert set(rf.run_study(study, study.parent / "out", processes=1)["outcome"]) == {"solved"}


def test_a_call_whose_process_dies_raises() -> None:
    with pytest.raises(UnavailableError, match=r"^windows: a process died; if memory is short, give fewer processes$"):
        for_each(os._exit, [(1,), (1,)], 2, lambda *_: None, "windows")


def runs(process: str) -> bool:
    """Whether a process is there and is no dead one that nobody has waited for."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except FileNotFoundError:
        return False


@pytest.mark.parametrize("dies", [True, False])
def test_a_process_leaves_no_program_of_another_group(dies: bool, tmp_path: Path) -> None:
    note = tmp_path / "program"
    code = (
        "import os, signal, subprocess, time\n"
        "program = subprocess.Popen(['sleep', '300'], process_group=0)\n"
        f"open({str(note) + '.part'!r}, 'w').write(str(program.pid))\n"
        f"os.replace({str(note) + '.part'!r}, {str(note)!r})\n"
        + ("os.kill(os.getpid(), signal.SIGKILL)\n" if dies else "time.sleep(300)\n")
    )
    with executors.Processes(1, tmp_path) as executor:
        call = executor.submit(exec, code)
        wait_for(note.is_file)
        if dies:
            with pytest.raises(BrokenExecutor):
                call.result(60)
        else:
            executor.shutdown()
    assert wait_for(lambda: not runs(note.read_text()))


@pytest.mark.parametrize("processes", [0, -1, 1.5, True, "2", 10**6])
def test_a_number_of_processes_is_checked(processes: object, study: Path) -> None:
    for call in (rf.run_study, rf.collect_study):
        arguments = (study, study.parent / "out") if call is rf.run_study else (study.parent,)
        with pytest.raises(InputError, match=r"^processes: got .*; give a whole number from 1 to 1024$"):
            call(*arguments, processes=processes)
