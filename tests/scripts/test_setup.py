"""The set-up shows what pip does, and says what to do where pip fails; a script stands for pip here."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from places import ROOT

LOCK = "first==1.0 \\\n    --hash=sha256:0\nsecond==2.0 ; sys_platform == 'win32' \\\n    --hash=sha256:0\nthird==3.0\n"

STEPS = """
echo "WARNING: Location 'file:///nowhere/simple/' is ignored: it is neither a file nor a directory."
echo "Ignoring second: markers do not match your environment"
echo "Collecting first==1.0 (from -r requirements.lock (line 1))"
echo "  Downloading first-1.0-cp311-cp311-manylinux_2_28_x86_64.whl (112.5 MB)"
sleep 2.5
echo "Installing collected packages: first, third"
sleep 1.5
"""


def set_up(place: Path, pip: str, *, terminal: bool = False, **environment: str) -> subprocess.CompletedProcess[str]:
    """The set-up of a small tree with a script instead of pip, which speaks every second.

    Only the first call of Python, which is that of pip with the list of packages, runs the script.
    """
    (place / "scripts").mkdir()
    script = (ROOT / "scripts" / "setup").read_text(encoding="utf-8")
    assert script.count("\nevery=10 ") == 1
    (place / "scripts" / "setup").write_text(script.replace("\nevery=10 ", "\nevery=1 "), encoding="utf-8")
    (place / "requirements.lock").write_text(LOCK, encoding="utf-8")
    (place / "pyproject.toml").write_text("", encoding="utf-8")
    python = place / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    version = '[ "$1" = --version ] && { echo Python 3.11; exit; }\n'
    first = f'[ -e "{place}/called" ] && exit\ntouch "{place}/called"\n'
    logged = 'while [ $# -gt 0 ]; do [ "$1" = --log ] && log=$2; shift; done\n'
    python.write_text(f"#!/bin/bash\n{version}{first}{logged}{pip}\n", "utf-8")
    python.chmod(0o755)
    command = ["bash", str(place / "scripts" / "setup")]
    if terminal:
        command = ["script", "--quiet", "--return", "--command", " ".join(command), "/dev/null"]
    programs = f"{place / 'programs'}:{os.environ['PATH']}"
    own = {"PATH": programs, "HOME": str(place), "ROUGHFILM_SYSTEM_PACKAGES": "no"}
    return subprocess.run(
        command, env={**own, **environment}, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60
    )


def test_the_set_up_says_what_pip_fetches_and_how_large_it_is(tmp_path):
    done = set_up(tmp_path, STEPS)
    assert done.returncode == 0, done.stderr
    assert "s, fetching first-1.0 (112.5 MB), package 1 of 2\n" in done.stderr
    assert "s, unpacking 2 packages\n" in done.stderr
    assert "WARNING" not in done.stderr
    assert (tmp_path / ".venv" / "roughfilm-stamp").is_file()


@pytest.mark.skipif(shutil.which("script") is None, reason="the program script, which makes a terminal, is not here")
def test_on_a_terminal_the_steps_of_pip_share_one_line(tmp_path):
    done = set_up(tmp_path, STEPS, terminal=True)
    steps, _, after = done.stdout.partition("setup: compiling")
    shown = [line.split("s, ")[1] for line in steps.split("\x1b[Ksetup: ")[1:]]
    assert {line.strip() for line in shown} >= {
        "looking for first==1.0, package 1 of 2",
        "fetching first-1.0 (112.5 MB), package 1 of 2",
    }
    assert steps.endswith("\x1b[K")  # nothing of the line is left
    assert after.endswith("\x1b[K")


FAULTS = {
    "certificate": ("SSLError(SSLCertVerificationError(1, 'certificate verify failed'))", "set PIP_CERT"),
    "bundle": ("Could not find a suitable TLS CA certificate bundle, invalid path: /x.pem", "a file that is not there"),
    "proxy": ("ProxyError('Cannot connect to proxy.', NewConnectionError(''))", "correct HTTPS_PROXY="),
    "name": ("NewConnectionError: Temporary failure in name resolution", "set HTTPS_PROXY="),
    "time": ("ReadTimeoutError: Read timed out.", "the index was not reached"),
    "refusal": ("403 Client Error: Forbidden for url", "the index refused"),
    "disk": ("[Errno 28] No space left on device", "free 2 GB"),
    "hashes": ("THESE PACKAGES DO NOT MATCH THE HASHES FROM THE REQUIREMENTS FILE.", "PIP_INDEX_URL="),
    "version": ("No matching distribution found for first==1.0", "has not all packages for Python 3.11"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_where_pip_fails_the_set_up_says_what_to_do(tmp_path, fault):
    words, remedy = FAULTS[fault]
    (tmp_path / "words").write_text(words, encoding="utf-8")
    pip = f'cat "{tmp_path}/words" >> "$log"\necho "ERROR: last words of pip"\nexit 3'
    done = set_up(tmp_path, pip, HTTPS_PROXY="http://127.0.0.1:9")
    assert done.returncode == 3
    assert "ERROR: last words of pip\n" in done.stderr
    (line,) = (line for line in done.stderr.splitlines() if "were not installed" in line)
    assert remedy in line
    assert ".venv/pip.log" in done.stderr
    assert not (tmp_path / ".venv" / "roughfilm-stamp").exists()


def test_graphics_libraries_are_installed_while_pip_works(tmp_path):
    """Each of pip and apt-get ends after the other has begun."""
    pip, apt = (
        f'touch "{tmp_path}/{own}"; until [ -e "{tmp_path}/{other}" ]; do sleep 0.1; done'
        for own, other in (("pip", "apt"), ("apt", "pip"))
    )
    stand_ins = {"id": "echo 0", "dpkg": "exit 1", "apt-get": f'[ "$1" = update ] || {{ {apt}; }}'}
    (tmp_path / "programs").mkdir()
    for name, words in stand_ins.items():
        (tmp_path / "programs" / name).write_text(f"#!/bin/bash\n{words}\n", "utf-8")
        (tmp_path / "programs" / name).chmod(0o755)
    done = set_up(tmp_path, pip, ROUGHFILM_SYSTEM_PACKAGES="yes")
    assert done.returncode == 0, done.stderr
    assert "setup: installing graphics libraries" in done.stderr
