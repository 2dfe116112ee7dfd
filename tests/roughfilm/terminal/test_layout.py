"""Lines and tables on terminals of any width, character set and colour, and the words that the shell completes."""

import os
import pty
import shlex
import subprocess
import sys

import pytest
from places import SCENES
from small_scenes import SURFACE
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.terminal.layout import PLAIN, in_charset, wrapped


def program(*arguments, **options):
    command = [sys.executable, "-m", "roughfilm.cli.main", *map(str, arguments)]
    return subprocess.run(command, timeout=120, check=False, **options)


def completed(line):
    """The words that bash offers for the last word of a line."""
    words = {"COMP_WORDS": line, "COMP_CWORD": str(len(line.split(" ")) - 1), "_ROUGHFILM_COMPLETE": "complete_bash"}
    return CliRunner().invoke(app, [], prog_name="roughfilm", env=words).stdout.split()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("roughfilm st", ["stribeck", "stability"]),
        ("roughfilm solve --wi", ["--within"]),
        ("roughfilm models ", ["bearing", "dry_contact", "pocket", "rough_gap", "seal"]),
        (f"roughfilm solve {SCENES / 'pocket.toml'} --model f", ["film", "film_slope"]),
        (f"roughfilm solve {SCENES / 'seal.toml'} --model d", ["direct_leakage"]),
        ("roughfilm contact cell.h5 --boundary f", ["free"]),
        ("roughfilm solve poc", []),
    ],
)
def test_the_shell_completes_commands_options_kinds_and_models_and_leaves_files_to_itself(line, words):
    assert completed(line) == words


def test_the_script_of_a_shell_names_the_command():
    command = f"{shlex.quote(sys.executable)} -m roughfilm.cli.main --show-completion; true"  # true: bash stays parent
    shown = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=120, check=True)
    assert "complete -o default -F _roughfilm_completion roughfilm" in shown.stdout


def test_the_version_is_one_line():
    shown = program("--version", capture_output=True, text=True)
    name, number = shown.stdout.split()
    assert name == "roughfilm"
    assert number[0].isdigit()


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
def test_a_terminal_without_utf_8_gets_what_it_can_show(encoding, tmp_path):
    (tmp_path / "rough.toml").write_text(SURFACE)
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    shown = program("surface", tmp_path / "rough.toml", capture_output=True, env=environment)
    assert shown.returncode == 0
    text = shown.stdout.decode(encoding)
    assert ("Sq, um" if encoding == "ascii" else "Sq, µm") in text
    assert "?" not in text


def test_every_replacement_is_ascii():
    assert all(text.isascii() for text in PLAIN.values())
    assert in_charset("θ − 1 = 0.2 ± 0.1, 6ηuL/h²", "ascii") == "theta - 1 = 0.2 +- 0.1, 6etauL/h^2"
    assert in_charset("日", "ascii") == "?"


@pytest.mark.parametrize("colour", [True, False])
def test_no_color_is_honoured(colour):
    environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "FORCE_COLOR")}
    environment |= {"TERM": "xterm-256color"} if colour else {"TERM": "xterm-256color", "NO_COLOR": "1"}
    ours, theirs = pty.openpty()
    try:
        program("models", "no_such_kind", stderr=theirs, stdout=subprocess.DEVNULL, env=environment)
        shown = os.read(ours, 65536).decode()
    finally:
        os.close(ours)
        os.close(theirs)
    assert "error:" in shown
    assert ("31m" in shown) == colour


@pytest.mark.parametrize("line", ["load 12.3 ± 0.4 N, 5 % off, Re = 160", "  indented: a b c d e f", ""])
@pytest.mark.parametrize("width", [1, 12, 20, 400])
def test_a_broken_line_keeps_its_words(line, width):
    assert wrapped(line, width).split() == line.split()


def test_numbers_stay_with_their_unit_and_uncertainty():
    assert wrapped("the load is 12.3 ± 0.4 % of it", 20) == "the load is\n  12.3 ± 0.4 % of it"
