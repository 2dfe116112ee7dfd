"""Options of the commands, their consoles and progress bars, and one line and an exit code for every error."""

import functools
import json
import logging
import os
import re
import shutil
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Annotated, Any, Literal, TextIO

import typer
from rich.console import Console, ConsoleOptions, RenderableType
from rich.markup import escape
from rich.segment import Segment
from typer.exceptions import TyperException

from roughfilm.contact.foundation.brief import short_message
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError, unwritable
from roughfilm.contact.foundation.timing import running_cost
from roughfilm.contact.foundation.writing.kinds import protected_inputs
from roughfilm.terminal.layout import visible, wrapped
from roughfilm.terminal.streams import prepare_streams

BAD_INPUT, NOT_CONVERGED, MISSING = 2, 3, 4

NUMERICS, OUTPUT = "Numerics", "Output"
"""Groups of options in the help of a command; options without a group describe what is computed."""

EXIT_CODES = """Exit codes
  0  success
  2  invalid input
  3  not converged, or no model is accurate enough
  4  something is missing, such as OpenFOAM"""

HELP_MODE: Literal["rich"] | None = "rich" if shutil.get_terminal_size().columns >= 72 else None
"""The form of a command's help: with frames where these do not cut the names of options."""

PROGRESS_VARIABLE = "ROUGHFILM_PROGRESS"
"""Environment variable that, set to "off", leaves out bars and lines about progress."""

FIRST_LINE_S, LINE_INTERVAL_S = 2.0, 10.0
"""Time until the first line about progress, and between lines, s."""

STOP_AGAIN_S = 0.01
"""Time after which a signal to stop is raised again, s."""

LEAST_DONE = 0.05
"""Done fraction below which the time left is not estimated."""

ScenePath = Annotated[Path, typer.Argument(metavar="SCENE", help="The scene file (TOML).")]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Override a key, e.g. geometry.depth=22.5um; repeatable."),
]
AsJson = Annotated[
    bool,
    typer.Option("--json", help="Print one JSON object on standard output and nothing else.", rich_help_panel=OUTPUT),
]
OutDirectory = Annotated[
    Path,
    typer.Option("--out", help="Output directory; finished results in it are used again.", rich_help_panel=OUTPUT),
]
ReportFile = Annotated[
    Path | None, typer.Option("--report", help="Write a page with figures here (HTML).", rich_help_panel=OUTPUT)
]
Overwrite = Annotated[
    bool,
    typer.Option(
        "--overwrite", help="Replace the output file, whatever it is; an input never is.", rich_help_panel=OUTPUT
    ),
]
Resolution = Annotated[
    int | None, typer.Option(help="Nodes or mesh columns; see 'roughfilm models KIND'.", rich_help_panel=NUMERICS)
]
Scheme = Annotated[
    str | None, typer.Option(help="Advection scheme; see 'roughfilm models KIND'.", rich_help_panel=NUMERICS)
]
Processes = Annotated[int, typer.Option(help="Processes of one OpenFOAM run (MPI).", rich_help_panel=NUMERICS)]
Jobs = Annotated[int | None, typer.Option(help="Processes (default: one for each core).", rich_help_panel=NUMERICS)]
Windows = Annotated[
    Path | None,
    typer.Option(
        metavar="DIR",
        help="Set of windows in place of the scene's surface: a directory from 'roughfilm windows'.",
    ),
]
Threads = Annotated[
    int | None,
    typer.Option(help="Gaps whose flow is solved at once (default: 2 on several cores).", rich_help_panel=NUMERICS),
]
Tolerance = Annotated[float | None, typer.Option(help="Residual at which a solver stops.", rich_help_panel=NUMERICS)]
Spacing = Annotated[
    str | None, typer.Option(metavar="D", help="Distance between the points of an array of heights: 1um, or 1um,2um.")
]


class _Terminal(Console):
    """A console on which control characters in a text, such as a name, are shown and do not act."""

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterator[Segment]:
        """Yield the segments of a renderable."""
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=visible(segment.text))


FILE_WIDTH = 80
"""Columns of what is not printed on a terminal, unless COLUMNS gives another number."""


def _width(stream: TextIO | None) -> int | None:
    """The columns of a stream that is no terminal or has none; None where the console finds them."""
    columns = os.environ.get("COLUMNS", "")
    if columns.isdecimal():
        return None if int(columns) else FILE_WIDTH
    return None if stream is not None and stream.isatty() else FILE_WIDTH


messages = _Terminal(stderr=True, highlight=False, width=_width(sys.stderr))
output = _Terminal(highlight=False, width=_width(sys.stdout))


def fail(error: Exception, code: int, command: Callable[..., None] | None = None) -> typer.Exit:
    """Print an error, a line for each fault, and the notes that it carries, and return the exit with this code.

    Where a line begins with the name of a parameter of the command, its option takes the place of the name.
    """
    options = {} if command is None else _options(command)
    for fault in str(error).split("\n"):
        line = re.sub(r"^\w+(?=:? )", lambda place: options.get(place[0], place[0]), fault)
        messages.print(f"[bold red]error:[/] {escape(line)}", soft_wrap=True)
    print_notes(error, style="dim")
    return typer.Exit(code)


def _unusable(error: OSError) -> InputError:
    """The error of the system with its file, where it names one, and the remedy."""
    return unwritable(error.filename or "a file", error, done="read or written")


def _options(command: Callable[..., None]) -> dict[str, str]:
    """The options of a command by the names of its parameters, such as ``--counter-modulus`` by counter_modulus."""
    parameters = typer.main.get_command(_app(command)).params
    return {str(one.name).rstrip("_"): one.opts[0] for one in parameters if one.opts[0].startswith("--")}


def print_notes(error: BaseException, style: str | None = None) -> None:
    """Print the notes that an exception carries."""
    for note in getattr(error, "__notes__", []):
        messages.print(escape(short_message(note)), style=style, soft_wrap=True)


def print_message(kind: str, text: str) -> None:
    """Print a message of a kind, such as "warning", on standard error; it is broken between words."""
    line = escape(wrapped(short_message(f"{kind}: {text}"), messages.width)).removeprefix(f"{kind}:")
    messages.print(f"[yellow]{kind}:[/]{line}", soft_wrap=True)


def in_one_line(command: Callable[..., None]) -> Callable[..., None]:
    """A command that ends an error in one line with exit code 2, 3 or 4, and says in one line what a stop leaves."""

    @functools.wraps(command)
    def wrapped(*arguments: Any, **options: Any) -> None:
        out = options.get("out")
        makes_out = out is not None and not out.exists()
        from roughfilm.contact.foundation.arrays import finite_arithmetic  # NumPy is slow to import

        try:
            with protected_inputs(), _stop_kept(), finite_arithmetic(command.__module__.rpartition(".")[2]):
                command(*arguments, **options)
        except (InputError, ConvergenceError, UnavailableError) as error:
            codes = {InputError: BAD_INPUT, ConvergenceError: NOT_CONVERGED, UnavailableError: MISSING}
            code = next(code for kind, code in codes.items() if isinstance(error, kind))
            raise fail(error, code, command) from None
        except (KeyboardInterrupt, SystemExit) as stop:
            if not hasattr(stop, "__notes__"):
                stop.add_note(_what_is_left(out, makes_out))
            print_notes(stop)
            raise
        except OSError as error:
            raise fail(_unusable(error), BAD_INPUT) from None

    return wrapped


@contextmanager
def _stop_kept() -> Iterator[None]:
    """Turn an error that hides a signal to stop into that stop.

    HDF5 and other libraries in C call functions of Python. A stop in one of these ends as an error of the library.
    """
    try:
        yield
    except Exception as error:
        if _stopped is None:
            raise
        raise _exit_after(_stopped) from error


def _what_is_left(out: Path | None, makes_out: bool) -> str:
    """The line on an interruption; a directory that the command made is removed if it is empty."""
    if out is not None and (out.is_file() or (out.is_dir() and any(out.iterdir()))):
        return f"stopped; what {out} holds is kept; give the same command to go on"
    if makes_out and out is not None and out.is_dir():
        out.rmdir()
    return "stopped; nothing is kept; give the same command to start again"


def help_below(examples: Sequence[str], mode: str | None = HELP_MODE) -> str:
    """The end of a command's help: examples, and the exit codes."""
    paragraphs = [EXIT_CODES]
    if examples:
        paragraphs.insert(0, "\n".join(("Examples", *(f"  {one}" for one in examples))))
    kept = "" if mode else "\b\n"  # click breaks the lines of a paragraph anew without it
    return "\n\n".join(f"{kept}{escape(one) if mode else one}" for one in paragraphs)


def launch(app: typer.Typer, arguments: list[str], name: str | None = None) -> None:
    """Run an application: one line for every error, and no program left running after a signal to stop."""
    signal.signal(signal.SIGTERM, _stop)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # nohup and batch jobs may ignore it
        signal.signal(signal.SIGINT, _stop)
    sys.unraisablehook = _stop_later
    prepare_streams()
    _print_logged()
    if _width(sys.stdout) is not None:
        os.environ.setdefault("TERMINAL_WIDTH", str(FILE_WIDTH))  # of the help, which typer prints
    try:
        with lines_of_progress():
            sys.exit(app(args=arguments, prog_name=name, standalone_mode=False))
    except TyperException as error:
        message = error.format_message() if hasattr(error, "format_message") else str(error)
        sys.exit(fail(InputError(f"{message.rstrip('.')}; see --help"), BAD_INPUT).exit_code)
    except InputError as error:
        sys.exit(fail(error, BAD_INPUT).exit_code)
    except OSError as error:
        sys.exit(fail(_unusable(error), BAD_INPUT).exit_code)
    except typer.Abort:
        sys.exit(128 + signal.SIGINT)


class _Logged(logging.Handler):
    """Prints what the packages log, such as that a cache cannot be written, on standard error."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print one record in one line."""
        messages.print(short_message(record.getMessage()), soft_wrap=True, markup=False)


def _print_logged() -> None:
    """Print what the packages log with the messages of the command."""
    logger = logging.getLogger("roughfilm")
    if not logger.handlers:
        logger.addHandler(_Logged(logging.WARNING))


def run_alone(command: Callable[..., None]) -> None:
    """Run one command as a program of its own."""
    launch(_app(command), sys.argv[1:])


def _app(command: Callable[..., None]) -> typer.Typer:
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=HELP_MODE)
    app.command()(command)
    return app


_stopped: int | None = None
"""Number of the signal to stop that came; None before."""


def _stop(number: int, _frame: FrameType | None) -> None:
    global _stopped
    _stopped = number
    raise _exit_after(number)


def _stop_later(ignored: "sys.UnraisableHookArgs") -> None:
    """Stop again where Python ignored the exception of a signal, as in callbacks of weak references."""
    if _stopped is None or not isinstance(ignored.exc_value, KeyboardInterrupt | SystemExit):
        sys.__unraisablehook__(ignored)
        return
    number = _stopped
    signal.signal(signal.SIGALRM, lambda _number, frame: _stop(number, frame))
    signal.setitimer(signal.ITIMER_REAL, STOP_AGAIN_S)


def _exit_after(number: int) -> BaseException:
    """The exception that a signal to stop raises."""
    return KeyboardInterrupt() if number == signal.SIGINT else SystemExit(128 + number)


def print_json(entries: dict[str, Any]) -> None:
    """Print the one object of ``--json``."""
    sys.stdout.write(json.dumps(entries, allow_nan=False, ensure_ascii=True) + "\n")
    sys.stdout.flush()


class _Work:
    """The work of the command that runs, as its lines on standard error describe it."""

    def __init__(self, words: str) -> None:
        self.words, self.done, self.since = words, 0.0, time.monotonic()
        self.drawn = False

    def advance(self, done: float, words: str) -> None:
        """Note the done fraction, 0 to 1; where it falls to less than half, other work begins."""
        if done < 0.5 * self.done:
            self.since = time.monotonic()
        self.done, self.words = done, words

    def line(self) -> str:
        """What is done, the fraction, the time spent and the time left, where it can be estimated."""
        spent = time.monotonic() - self.since
        if running_cost() == "compilation":
            return f"compiling numerical kernels: {duration(spent)}"
        if not LEAST_DONE < self.done < 1:
            return f"{self.words}: {duration(spent)}"
        left = duration(spent * (1 - self.done) / self.done)
        return f"{self.words}: {100 * self.done:.0f} %, {duration(spent)}, about {left} left"


_work = _Work("starting")


def duration(seconds: float) -> str:
    """A time in words such as "43 s", "12 min" or "3.2 h"."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


@contextmanager
def lines_of_progress() -> Iterator[None]:
    """Print a line on standard error after 2 s and then every 10 s, unless a bar is shown there.

    With ``ROUGHFILM_PROGRESS=off`` in the environment there are neither lines nor bars.
    """
    if os.environ.get(PROGRESS_VARIABLE) == "off":
        yield
        return
    global _work
    _work, ended = _Work("starting"), threading.Event()

    def show() -> None:
        wait = FIRST_LINE_S
        while not ended.wait(wait):
            wait = LINE_INTERVAL_S
            if not _work.drawn:
                messages.print(_work.line(), soft_wrap=True, markup=False)

    thread = threading.Thread(target=show, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


@contextmanager
def progress_bar(total: float) -> Iterator[Callable[[float, str], None]]:
    """Show progress on standard error, as a bar on a terminal and in lines elsewhere.

    It yields advance(done, words), whose ``done`` grows to ``total``. Work that is not handed this function, such as a
    table of a surface, shows its words without a fraction.
    """
    from roughfilm.rom.ladder.model import reported_to  # no other use of this module needs it

    with _shown_progress(total) as show:
        last = 0.0

        def advance(done: float, words: str) -> None:
            nonlocal last
            last = done
            show(done, words)

        with reported_to(lambda _, words: show(last, words)):
            yield advance


@contextmanager
def _shown_progress(total: float) -> Iterator[Callable[[float, str], None]]:
    whole = total or 1.0
    if not messages.is_terminal or os.environ.get(PROGRESS_VARIABLE) == "off":
        yield lambda done, words: _work.advance(done / whole, words)
        _work.advance(0.0, "writing the results")
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f}%"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=messages, transient=True, speed_estimate_period=3600) as bar:
        task = bar.add_task("starting", total=total)
        _work.drawn = True
        try:
            yield lambda done, words: bar.update(task, completed=done, description=escape(words))
        finally:
            _work.drawn = False
            _work.advance(0.0, "writing the results")


def make_directory(path: Path) -> None:
    """Make the directory of ``--out``; InputError if it cannot be made."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(f"--out {path}", error, done="made") from error


def process_count(jobs: int | None) -> int:
    """The number of processes of ``--jobs``, by default one for each core; InputError below 1."""
    processes = len(os.sched_getaffinity(0)) if jobs is None else jobs
    if processes < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    return processes
