"""The script Allrun: its criterion is the library's, it needs a shell alone, and nothing of it is left when it ends."""

import os
import shutil
import signal
import stat
import subprocess
import time

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.foamcases.openfoam.allrun import EXIT_CODE, FINISHED, RUNNING, SETTLED, allrun
from roughfilm.foamcases.openfoam.dialect import COM
from roughfilm.foamcases.openfoam.installation import PLACES, VARIABLE
from roughfilm.foamcases.openfoam.kept import (
    ended,
    is_finished,
    kept_tries,
    latest_iteration,
    release_of,
    runner,
    wall_time,
)
from roughfilm.foamcases.openfoam.residuals import PATIENCE, Judged, Residuals
from roughfilm.foamcases.openfoam.settling import settled_within

TOLERANCE = 1e-5
ALONG = Judged(main="Ux", fields=("Ux", "Uz", "p"), slack=300.0)
ACROSS = Judged(main="Uy", fields=("Uy",), slack=300.0)


def logged(number, **residuals):
    lines = [
        f"DILUPBiCGStab:  Solving for {name}, Initial residual = {value}, Final residual = 1e-09, No Iterations 1"
        for name, value in residuals.items()
    ]
    return "\n".join([f"Time = {number}\n", *lines, f"ExecutionTime = {number / 100} s  ClockTime = 3 s\n", ""])


def functions_of(judged, place):
    """The functions of the script in a directory, with the fields that are judged."""
    functions, _, _ = allrun({".": judged}, tolerance=TOLERANCE, processes=1, dialect=COM).partition("\nLC_ALL=C\n")
    functions = functions.replace('cd "$(dirname "$0")"', f'cd "{place}"')
    return f"{functions}\njudged='{' '.join(judged.fields)}'\n"


SERIES = {
    "still": np.full(40, 0.7),
    "settled": 0.7 + 1e-3 * 0.5 ** np.arange(40.0),
    "settling slowly": 0.7 + 1e-3 * 0.9 ** np.arange(40.0),
    "near the limit": 0.7 + 6.4e-3 * 0.8 ** np.arange(40.0),
    "oscillating": 0.7 + 1e-3 * (-1.0) ** np.arange(40),
    "diverging": 0.7 * 1.1 ** np.arange(40.0),
    "backward": -0.7 - 1e-3 * 0.5 ** np.arange(40.0),
    "no flow": np.zeros(40),
    "too short": np.full(12, 0.7),
}


@pytest.mark.parametrize("name", SERIES)
@pytest.mark.parametrize(
    ("judged", "last"),
    [
        (ALONG, {"Ux": 1e-4, "Uy": 0.9, "Uz": 2e-3, "p": 1e-3}),
        (ALONG, {"Ux": 1e-4, "Uy": 0.9, "Uz": 4e-3, "p": 1e-3}),
        (ALONG, {"Ux": 1e-4, "Uy": 0.9, "Uz": 2e-3, "p": "nan"}),
        (ACROSS, {"Ux": 0.9, "Uy": 1e-9, "Uz": 0.8, "p": 0.7}),
    ],
)
def test_the_shell_judges_as_the_library(tmp_path, name, judged, last):
    values = SERIES[name]
    means = tmp_path / "postProcessing" / "flow" / "0" / "volFieldValue.dat"
    means.parent.mkdir(parents=True)
    column = 1 if judged is ACROSS else 0
    rows = [
        f"{n}\t({' '.join(f'{v if k == column else 0.0:.12e}' for k in range(3))})" for n, v in enumerate(values, 1)
    ]
    means.write_text("# Time\tvolAverage(U)\n" + "\n".join(rows) + "\n")
    usual = dict.fromkeys(("Ux", "Uy", "Uz", "p"), 1e-9)
    text = "".join(logged(n, **usual) for n in range(1, values.size)) + logged(values.size, **last)
    (tmp_path / "log.simpleFoam").write_text(text)
    residuals = Residuals(tmp_path / "log.simpleFoam", judged)
    residuals.read()
    shell = functions_of(judged, tmp_path) + "from=0\nif settled log.simpleFoam; then echo yes; else echo no; fi\n"
    done = subprocess.run(["sh"], input=shell, capture_output=True, text=True, check=True)
    expected = settled_within(TOLERANCE, tmp_path, judged)(residuals)
    assert done.stdout.split() == ["yes" if expected else "no"], done.stderr


@pytest.mark.parametrize(("halved_every", "stagnant"), [(0.9, False), (1.1, True)])
def test_the_shell_ends_a_run_that_gets_no_nearer(tmp_path, halved_every, stagnant):
    falling = 0.5 ** (np.arange(3 * PATIENCE) / (halved_every * PATIENCE))
    (tmp_path / "log").write_text("".join(logged(n, Ux=1e-9, Uy=0.9, p=f"{p:.9e}") for n, p in enumerate(falling, 1)))
    shell = functions_of(Judged(fields=("Ux", "p")), tmp_path) + "if stagnant log; then echo yes; else echo no; fi\n"
    done = subprocess.run(["sh"], input=shell, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["yes" if stagnant else "no"], done.stderr


def test_some_of_these_series_are_settled_and_some_are_not(tmp_path):
    """Guard against a criterion that is the same in both languages because it never holds."""
    found = {}
    for name, values in SERIES.items():
        means = tmp_path / name / "postProcessing" / "flow" / "0" / "volFieldValue.dat"
        means.parent.mkdir(parents=True)
        means.write_text("".join(f"{n}\t({v:.12e} 0 0)\n" for n, v in enumerate(values, 1)))
        log = tmp_path / name / "log"
        log.write_text("".join(logged(n, Ux=1e-9, p=1e-9) for n in range(1, values.size + 1)))
        residuals = Residuals(log, ALONG)
        residuals.read()
        found[name] = settled_within(TOLERANCE, tmp_path / name, ALONG)(residuals)
    assert {name for name, settled in found.items() if settled} == {"still", "settled", "backward", "no flow"}


ENDLESS = """#!/bin/sh
echo "nProcs : 1"
sleep 30 &
trap 'kill $!; exit 143' TERM
wait
"""
CONVERGING = """#!/bin/sh
last=$(ls | grep '^[0-9][0-9]*$' | sort -n | tail -n 1)
grep -q 'endTime 3000' system/controlDict && count=2 || count=1
echo "nProcs : 1"
n=$last
while [ $n -lt $((last + count)) ]; do
    n=$((n + 1))
    echo "Solving for Ux, Initial residual = 1e-9, Final residual = 1e-9, No Iterations 1"
    echo "Solving for p, Initial residual = 1e-9, Final residual = 1e-9, No Iterations 1"
    echo "ExecutionTime = 0.5 s  ClockTime = 1 s"
done
mkdir -p $n
[ $count = 1 ] || echo "SIMPLE solution converged in $n iterations"
"""
STUBBORN = """#!/bin/sh
echo "Solving for Ux, Initial residual = 0.5, Final residual = 1e-9, No Iterations 1"
echo "Solving for p, Initial residual = 0.5, Final residual = 1e-9, No Iterations 1"
cat system/fvSolution
grep -q rest system/fvSolution && echo "SIMPLE solution converged in 1 iterations"
grep -q start system/fvSolution && echo "SIMPLE solution converged in 1 iterations"
mkdir -p $(($(ls | grep '^[0-9]*$' | sort -n | tail -n 1) + 1))
"""


@pytest.fixture
def case(tmp_path):
    """A case without a mesh, and programs that only pretend to solve it."""
    programs, place = tmp_path / "bin", tmp_path / "case"
    programs.mkdir()

    def make(simple_foam, check_mesh="#!/bin/sh\necho 'Mesh OK.'\n"):
        for name, text in {"simpleFoam": simple_foam, "checkMesh": check_mesh}.items():
            (programs / name).write_text(text)
            (programs / name).chmod(stat.S_IRWXU)
        for name in ("system", "0", "second_try/start/system", "second_try/rest/system"):
            (place / name).mkdir(parents=True)
        (place / "system" / "controlDict").write_text("endTime 3000;\n")
        (place / "system" / "fvSolution").write_text("as asked\n")
        for stage in ("start", "rest"):
            (place / "second_try" / stage / "system" / "fvSolution").write_text(f"{stage}\n")
        (place / "Allrun").write_text(
            allrun({".": Judged(fields=("Ux", "p"))}, tolerance=TOLERANCE, processes=1, dialect=COM, settles=False)
        )
        (place / "Allrun").chmod(stat.S_IRWXU)
        return place

    make.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "WM_PROJECT_DIR": "/"}
    make.run = lambda: subprocess.run([place / "Allrun"], capture_output=True, text=True, env=make.environment)
    return make


def dictionaries(place):
    return {path.name: path.read_text() for path in (place / "system").iterdir()}


def test_a_case_is_run_and_verified_and_its_dictionaries_are_as_they_were(case):
    place = case(CONVERGING)
    before = dictionaries(place)
    for _ in range(2):  # a second run begins anew
        done = case.run()
        assert done.returncode == 0, done.stdout + done.stderr
        assert "SIMPLE solution converged in 2 iterations" in done.stdout
        assert is_finished(place)
        assert (place / FINISHED).read_text() == "0\n"
        tries = kept_tries(place, judged=Judged(fields=("Ux", "p")), settled=None, asked=Asked)
        assert [(one.outcome, one.iterations, one.cpu_s) for one in tries] == [(Outcome.CONVERGED, 2, 0.5)]
        assert ended(place, "log.verify").code == 0
        assert latest_iteration(place) == 3
        assert wall_time(place) == 2.0
    assert dictionaries(place) == before


class Asked:
    """Settings of a run."""

    tolerance = TOLERANCE
    scheme = ""
    processes = 1


def test_a_second_try_follows_and_leaves_the_dictionaries_as_they_were(case):
    place = case(STUBBORN)
    before = dictionaries(place)
    done = case.run()
    assert done.returncode == 0, done.stdout + done.stderr
    first, second = kept_tries(place, judged=Judged(fields=("Ux", "p")), settled=None, asked=Asked)
    assert first.outcome is Outcome.UNFINISHED
    assert (second.outcome, second.iterations) == (Outcome.CONVERGED, 2)
    assert "second try" in str(second)
    assert "rest" in ended(place, "log.verify").log
    assert dictionaries(place) == before


@pytest.mark.parametrize(
    ("simple_foam", "check_mesh", "log", "code"),
    [
        ("#!/bin/sh\nexit 3\n", "#!/bin/sh\necho 'Mesh OK.'\n", "log.simpleFoam", 3),
        (CONVERGING, "#!/bin/sh\nexit 4\n", "log.checkMesh", 4),
    ],
)
def test_a_program_that_fails_is_recorded(case, simple_foam, check_mesh, log, code):
    place = case(simple_foam, check_mesh)
    assert case.run().returncode == 1
    assert (place / FINISHED).read_text() == "1\n"
    assert ended(place, log).code == code


def test_a_case_without_openfoam_says_so(case, tmp_path):
    place = case(CONVERGING)
    for name in ("simpleFoam", "checkMesh"):
        (tmp_path / "bin" / name).unlink()
    for name in ("bash", "sh", "dirname", "awk", "sed", "ls", "grep", "cat"):
        (tmp_path / "bin" / name).symlink_to(shutil.which(name))
    text = (place / "Allrun").read_text()
    for found in PLACES:
        text = text.replace(f" {found}", "")
    (place / "Allrun").write_text(text)
    case.environment |= {"PATH": str(tmp_path / "bin")}
    done = case.run()
    assert done.returncode == 1
    assert "no OpenFOAM: no simpleFoam on the PATH" in done.stderr
    assert not (place / "log.checkMesh").exists()


def test_a_path_with_a_blank_is_refused(case, tmp_path):
    place = case(CONVERGING).rename(tmp_path / "a case")
    done = subprocess.run([place / "Allrun"], capture_output=True, text=True, env=case.environment)
    assert done.returncode == 1
    assert done.stderr == f"'{place}': OpenFOAM takes no blanks in a path; move the case to another place\n"


@pytest.mark.parametrize("named", ["directory", "file", "command"])
def test_openfoam_is_the_one_that_is_named(case, tmp_path, named):
    case(CONVERGING)
    own = (tmp_path / "bin").rename(tmp_path / "own")
    bashrc = tmp_path / "openfoam" / "etc" / "bashrc"
    bashrc.parent.mkdir(parents=True)
    bashrc.write_text(f"PATH={own}:$PATH\n")
    command = tmp_path / "with_openfoam"
    command.write_text(f'#!/bin/sh\nPATH={own}:$PATH exec "$@"\n')
    command.chmod(stat.S_IRWXU)
    names = {"directory": bashrc.parent.parent, "file": bashrc, "command": f"{command} env"}
    case.environment |= {VARIABLE: str(names[named])}
    done = case.run()
    assert done.returncode == 0, done.stderr
    assert "SIMPLE solution converged in 2 iterations" in done.stdout


@pytest.mark.parametrize("named", [".", "/none/bashrc", "no-such-command with words"])
def test_a_named_openfoam_that_is_none_is_refused(case, named):
    place = case(CONVERGING)
    case.environment |= {VARIABLE: named}
    done = case.run()
    assert done.returncode == 1
    assert done.stderr.startswith(f"{VARIABLE}: ")
    assert len(done.stderr.splitlines()) == 1
    assert not (place / "log.checkMesh").exists()


def test_a_log_without_its_end_is_said_in_one_line(tmp_path):
    with pytest.raises(ConvergenceError, match=r"log\.simpleFoam is missing; run the case again"):
        ended(tmp_path, "log.simpleFoam")
    (tmp_path / "log.simpleFoam").write_text("Time = 1\n")
    with pytest.raises(ConvergenceError, match="ends without an exit code"):
        ended(tmp_path, "log.simpleFoam")
    (tmp_path / "log.simpleFoam").write_text(f"Time = 1\n{SETTLED}\n{EXIT_CODE} 136\n")
    assert ended(tmp_path, "log.simpleFoam").code == 136


def test_a_script_that_is_ended_ends_its_program(case):
    place = case(ENDLESS)
    running = subprocess.Popen([place / "Allrun"], env=case.environment, stdout=subprocess.DEVNULL)
    until = time.monotonic() + 60
    while not (place / "log.simpleFoam").is_file() or not (place / "log.simpleFoam").stat().st_size:
        assert time.monotonic() < until
        time.sleep(0.02)
    children = subprocess.run(["ps", "-o", "pid=", "--ppid", str(running.pid)], capture_output=True, text=True)
    started = [int(pid) for pid in children.stdout.split()]
    running.send_signal(signal.SIGTERM)
    assert running.wait(60) == 143
    for pid in started:
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)
    assert not is_finished(place)
    assert not (place / "running").exists()


def test_a_case_that_runs_is_not_run_a_second_time(case):
    place = case(CONVERGING)
    (place / "running").mkdir()
    (place / RUNNING).write_text(f"{os.uname().nodename} {os.getpid()}\n")
    done = case.run()
    assert done.returncode == 1
    name = f"{os.uname().nodename} (process {os.getpid()})"
    assert done.stderr == f"{place}: is running on {name}; remove {place}/running if it is not\n"
    assert runner(place) == name
    assert not (place / "log.checkMesh").exists()


def test_the_lock_of_a_process_that_is_gone_is_taken(case):
    place = case(CONVERGING)
    gone = subprocess.Popen(["true"])
    gone.wait()
    (place / "running").mkdir()
    (place / RUNNING).write_text(f"{os.uname().nodename} {gone.pid}\n")
    done = case.run()
    assert done.returncode == 0, done.stderr
    assert runner(place) == ""
    assert not (place / "running").exists()


@pytest.mark.parametrize(
    ("banner", "release", "dialect"),
    [
        (
            "|  \\\\    /   O peration     | Version:        |\n|   \\\\  /    A nd  | Website:  www.openfoam.com |\n"
            "Build  : OPENFOAM=1912 patch=200626\n",
            "OpenFOAM v1912",
            "com",
        ),
        (
            "|  \\\\    /   O peration     | Version:  2412  |\n|   \\\\  /    A nd  | Website:  www.openfoam.com |\n"
            "Build  : _91ec2b12c0-20241222 OPENFOAM=2412 patch=241222 version=2412\n",
            "OpenFOAM v2412",
            "com",
        ),
        (
            "  \\\\    /   O peration     | Website:  https://openfoam.org\n   \\\\  /    A nd  | Version:  13\n"
            "Build  : 13-441953dfbb54\n",
            "OpenFOAM 13 of openfoam.org",
            "org",
        ),
        (
            "  \\\\    /   O peration     | Website:  https://openfoam.org\n   \\\\  /    A nd  | Version:  7\n"
            "Build  : 7-1ff648926f77\n",
            "OpenFOAM 7 of openfoam.org",
            "com",
        ),
        ("a log of another program\n", "OpenFOAM, version unknown", ""),
    ],
)
def test_the_release_is_that_of_the_log_and_must_read_the_case(tmp_path, banner, release, dialect):
    log = tmp_path / "log.checkMesh"
    log.write_text(banner)
    for written in ("com", "org"):
        if dialect in ("", written):
            assert release_of(tmp_path, written) == release
        else:
            with pytest.raises(InputError, match=f"this case is for .*: generate it with --dialect {dialect}$"):
                release_of(tmp_path, written)
    shell = functions_of(ALONG, tmp_path) + "dialect_of log.checkMesh\n"
    assert subprocess.run(["sh"], input=shell, capture_output=True, text=True, check=True).stdout.strip() == dialect


def test_a_case_for_the_other_family_is_not_run(case):
    banner = "echo '| Website:  https://openfoam.org'\necho '| Version:  13'\n"
    place = case(CONVERGING, f"#!/bin/sh\n{banner}echo 'Mesh OK.'\n")
    done = case.run()
    assert done.returncode == 1
    assert done.stderr.splitlines() == [
        f"{place}: this case is for openfoam.com, or openfoam.org 7; the OpenFOAM here is of openfoam.org 8 or later: "
        "generate it with --dialect org"
    ]
    assert not (place / "log.simpleFoam").exists()
    assert (place / FINISHED).read_text() == "1\n"
