"""What the commands share: their options, their ladder, one line and an exit code for every failure."""

import functools
import io
import json
import os
import re
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.markup import escape
from typer.exceptions import TyperException

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError

BAD_INPUT, NOT_CONVERGED, MISSING = 2, 3, 4

ScenePath = Annotated[Path, typer.Argument(metavar="SCENE", help="The scene file (TOML).")]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Override a key, e.g. geometry.depth=22.5um; repeatable."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object on standard output, nothing else there.")]
Resolution = Annotated[int | None, typer.Option(help="Nodes or mesh columns; see 'roughfilm models'.")]
Scheme = Annotated[str | None, typer.Option(help="Advection scheme; see 'roughfilm models'.")]
Processes = Annotated[int, typer.Option(help="Processes of one OpenFOAM run (MPI).")]
Threads = Annotated[int | None, typer.Option(help="Gaps whose flow is solved at once; two where there are two cores.")]
Tolerance = Annotated[float | None, typer.Option(help="Residual at which a solver stops.")]

messages = Console(stderr=True, highlight=False)
output = Console(highlight=False)


def fail(error: Exception, code: int, command: Callable[..., None] | None = None) -> typer.Exit:
    """Say one line (and the log's last lines, where there are some) and return the exit.

    Where the line begins with the name of a parameter of the command, its option takes the place of the name.
    """
    options = {} if command is None else _options(command)
    line = re.sub(r"^\w+(?=:? )", lambda place: options.get(place[0], place[0]), str(error))
    messages.print(f"[bold red]error:[/] {escape(line)}", soft_wrap=True)
    print_notes(error, style="dim")
    return typer.Exit(code)


def _options(command: Callable[..., None]) -> dict[str, str]:
    """The options of a command by the names of its parameters, such as ``--counter-modulus`` by counter_modulus."""
    parameters = typer.main.get_command(_app(command)).params
    return {str(one.name).rstrip("_"): one.opts[0] for one in parameters if one.opts[0].startswith("--")}


def print_notes(error: BaseException, style: str | None = None) -> None:
    """Print the lines that the library added to an exception."""
    for note in getattr(error, "__notes__", []):
        messages.print(escape(note), style=style, soft_wrap=True)


def in_one_line(command: Callable[..., None]) -> Callable[..., None]:
    """Turn our errors into one line on standard error and the exit code 2, 3 or 4, and print the notes of a stop."""

    @functools.wraps(command)
    def wrapped(*arguments: Any, **options: Any) -> None:
        try:
            command(*arguments, **options)
        except InputError as error:
            raise fail(error, BAD_INPUT, command) from None
        except ConvergenceError as error:
            raise fail(error, NOT_CONVERGED) from None
        except UnavailableError as error:
            raise fail(error, MISSING, command) from None
        except (KeyboardInterrupt, SystemExit) as stop:
            print_notes(stop)
            raise
        except BrokenPipeError:
            raise
        except OSError as error:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or Python says it again at its end
            told = f"standard output: cannot be written ({error.strerror or error}); send it elsewhere"
            raise fail(InputError(told), BAD_INPUT) from None

    return wrapped


def launch(app: typer.Typer, arguments: list[str]) -> None:
    """Run an application: one line for every fault, and no program left running when it is told to stop."""
    signal.signal(signal.SIGTERM, _stop)
    if sys.stdout is None:
        sys.exit(BAD_INPUT)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")
    try:
        sys.exit(app(args=arguments, standalone_mode=False))
    except TyperException as error:
        message = error.format_message() if hasattr(error, "format_message") else str(error)
        sys.exit(fail(InputError(f"{message.rstrip('.')}; see --help"), BAD_INPUT).exit_code)
    except typer.Abort:
        sys.exit(128 + signal.SIGINT)


def run_alone(command: Callable[..., None]) -> None:
    """Run one command as a program of its own, as ``python scripts/x.py`` does."""
    launch(_app(command), sys.argv[1:])


def _app(command: Callable[..., None]) -> typer.Typer:
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(command)
    return app


def _stop(number: int, _frame: FrameType | None) -> None:
    sys.exit(128 + number)


def print_json(entries: dict[str, Any]) -> None:
    """The one object of ``--json``."""
    sys.stdout.write(json.dumps(entries, allow_nan=False, ensure_ascii=True) + "\n")
    sys.stdout.flush()


@contextmanager
def progress_bar(total: float) -> Iterator[Callable[[float, str], None]]:
    """A bar on standard error with time left; yields advance(done, words) with done counted towards ``total``."""
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f}%"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    shown = messages.is_terminal
    with Progress(*columns, console=messages, transient=True, disable=not shown, speed_estimate_period=3600) as bar:
        task = bar.add_task("starting", total=total)
        yield lambda done, words: bar.update(task, completed=done, description=escape(words))


def make_directory(path: Path) -> None:
    """The directory of ``--out``; InputError if it cannot be made."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {path}: cannot be made ({error.strerror}); choose another place") from error
