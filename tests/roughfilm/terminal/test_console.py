"""What the terminal makes of exceptions that end a command."""

import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import pytest
import typer

from roughfilm.cli.first_steps.advise import Want
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.timing import one_time
from roughfilm.terminal import console
from roughfilm.terminal.console import Overrides, Tolerance, in_one_line
from roughfilm.terminal.results import print_all, table_of


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit])
def test_the_note_of_what_stops_a_command_is_printed_and_the_command_stops(kind, capsys):
    def command() -> None:
        stop = kind(130)
        stop.add_note("stopped: 3 of 5 loads; the same command goes on")
        raise stop

    with pytest.raises(kind):
        in_one_line(command)()
    assert capsys.readouterr().err == "stopped: 3 of 5 loads; the same command goes on\n"


@pytest.mark.parametrize("finished", [False, True])
def test_a_stop_without_a_note_says_what_is_kept_and_leaves_no_empty_directory(finished, tmp_path, capsys):
    place = tmp_path / "out"

    def command(out: Path) -> None:
        out.mkdir()
        if finished:
            (out / "result.h5").touch()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        in_one_line(command)(out=place)
    kept = f"what {place} holds is kept; give the same command to go on"
    lost = "nothing is kept; give the same command to start again"
    assert capsys.readouterr().err == f"stopped; {kept if finished else lost}\n"
    assert place.exists() == finished


def test_a_stop_leaves_an_empty_directory_that_was_there_before(tmp_path, capsys):
    def command(out: Path) -> None:  # noqa: ARG001
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        in_one_line(command)(out=tmp_path)
    assert capsys.readouterr().err.startswith("stopped; nothing is kept")
    assert tmp_path.exists()


@pytest.mark.parametrize(
    ("message", "line"),
    [
        ("step_length: got 0", "--step-length: got 0"),
        ("quantity: got 'lift'", "--want: got 'lift'"),
        ("set geometry.depth: got no key=value", "--set geometry.depth: got no key=value"),
        ("scene: got 3", "scene: got 3"),
        ("set.depth: got 3", "set.depth: got 3"),
        ("model: got 'x'", "model: got 'x'"),
    ],
    ids=lambda text: text.partition(":")[0],
)
def test_an_error_that_begins_with_a_parameter_begins_with_its_option(capsys, message, line):
    def command(scene: str, quantity: Want, step_length: Tolerance, set_: Overrides) -> None:  # noqa: ARG001
        raise InputError(message)

    with pytest.raises(typer.Exit) as stop:
        in_one_line(command)("film.toml", None, None, None)
    assert stop.value.exit_code == 2
    assert capsys.readouterr().err == f"error: {line}\n"


def test_work_is_described_by_words_fraction_time_spent_and_time_left(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(console.time, "monotonic", lambda: now[0])
    work = console._Work("starting")
    now[0] = 103.0
    assert work.line() == "starting: 3 s"
    work.advance(0.25, "12 points")
    now[0] = 130.0
    assert work.line() == "12 points: 25 %, 30 s, about 90 s left"
    work.advance(0.0, "film")
    now[0] = 134.0
    assert work.line() == "film: 4 s"
    with one_time("compilation"):
        assert work.line() == "compiling numerical kernels: 4 s"


def test_long_work_prints_lines_where_no_bar_is_shown(monkeypatch):
    printed, shown = [], threading.Event()

    def write(line: str, **_: object) -> None:
        printed.append(line)
        if len(printed) > 2 and not line.startswith("starting"):  # the thread may print before work begins
            shown.set()

    monkeypatch.setattr(console, "FIRST_LINE_S", 0.0)
    monkeypatch.setattr(console, "LINE_INTERVAL_S", 0.001)
    monkeypatch.setattr(console, "messages", SimpleNamespace(print=write, is_terminal=False))
    monkeypatch.delenv("ROUGHFILM_PROGRESS")
    with console.lines_of_progress(), console.progress_bar(4.0) as advance:
        advance(1.0, "contact at 2 MPa")
        assert shown.wait(60)
    assert printed[-1].startswith("contact at 2 MPa: 25 %, ")


def test_progress_can_be_switched_off(monkeypatch, capsys):
    monkeypatch.setattr(console, "FIRST_LINE_S", 0.0)
    monkeypatch.setenv("ROUGHFILM_PROGRESS", "off")
    threads = threading.active_count()
    with console.lines_of_progress(), console.progress_bar(1.0) as advance:
        advance(0.5, "contact")
        assert threading.active_count() == threads
    assert capsys.readouterr().err == ""


def test_every_fault_of_an_input_is_a_line_of_its_own(capsys):
    def command() -> None:
        raise InputError("pocket.toml:6: geometry.film: got 1\npocket.toml:9: geometry.depth: got 2")

    with pytest.raises(typer.Exit) as stop:
        in_one_line(command)()
    assert stop.value.exit_code == 2
    assert capsys.readouterr().err.splitlines() == [
        "error: pocket.toml:6: geometry.film: got 1",
        "error: pocket.toml:9: geometry.depth: got 2",
    ]


@pytest.mark.parametrize("name", ["\x1b[31mred", "\x1b]0;title\x07", "a\x9b2J", "a\u202etxt.exe", "bell\x07", "a\rb"])
def test_control_characters_are_shown_and_do_not_act(name, capsys):
    def command() -> None:
        console.print_message("warning", f"{name} is coarse")
        raise ConvergenceError(f"{name}: stopped")

    with pytest.raises(typer.Exit):
        in_one_line(command)()
    print_all(
        [f"{name} of a line", table_of([f"{name} of a head"], [[f"{name} of a cell"]], title=f"{name} of a title")]
    )
    shown = capsys.readouterr()
    for text in (shown.out, shown.err):
        assert all(character == "\n" or character.isprintable() for character in text)
    assert "red" not in name or r"\x1b[31mred of a cell" in shown.out


@pytest.mark.parametrize("value", ["x" * 100_000, "many words " * 10_000, "/folder" * 20_000])
def test_a_line_about_a_very_long_value_is_short(value, capsys):
    for message in (f"scene.kind: got {value!r}; it must be a kind", f"{value}: no such file; name a TOML file"):
        with pytest.raises(typer.Exit):
            in_one_line(_raiser(InputError(message)))()
        shown = capsys.readouterr().err
        assert len(shown) < 2100
        assert shown.endswith(message[-15:] + "\n")


def test_an_error_of_the_system_names_its_file(capsys):
    with pytest.raises(typer.Exit) as stop:
        in_one_line(_raiser(OSError(28, "No space left on device", "/disk/case/log")))()
    assert stop.value.exit_code == 2
    assert capsys.readouterr().err == (
        "error: /disk/case/log: cannot be read or written (No space left on device); "
        "free some space there or choose another place\n"
    )


def _raiser(error: Exception) -> Callable[[], None]:
    def command() -> None:
        raise error

    return command


@pytest.mark.parametrize(("number", "stop"), [(signal.SIGTERM, SystemExit), (signal.SIGINT, KeyboardInterrupt)])
def test_an_error_that_hides_a_signal_to_stop_is_the_stop(number, stop, monkeypatch):
    monkeypatch.setattr(console, "_stopped", None)

    def command() -> None:
        with suppress(BaseException):
            console._stop(number, None)
        raise TypeError("an error of a library in C")

    with pytest.raises(stop):
        in_one_line(command)()


STOPPED_IN_A_CALLBACK = """
import signal, time, weakref
from roughfilm.terminal.console import run_alone

class Kept: pass

def command() -> None:
    kept = Kept()
    seen = weakref.ref(kept, lambda _: signal.raise_signal(signal.SIGTERM))
    del kept
    time.sleep(60)
    print("went on")

run_alone(command)
"""


def test_a_signal_to_stop_in_a_callback_whose_exceptions_are_ignored_stops_the_command():
    done = subprocess.run(
        [sys.executable, "-c", STOPPED_IN_A_CALLBACK], capture_output=True, text=True, timeout=50, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (128 + signal.SIGTERM, "", "")
