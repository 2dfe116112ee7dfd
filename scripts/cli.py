"""The ``roughfilm`` command: one subcommand a file."""

import io
import signal
import sys
from types import FrameType

import typer
from typer.exceptions import TyperException

from scripts import compare, doctor, generate, models, solve
from scripts.common import BAD_INPUT, fail

app = typer.Typer(
    name="roughfilm",
    help="Thin lubricant films by a ladder of models, from Reynolds to Navier-Stokes in OpenFOAM.",
    add_completion=False,
    pretty_exceptions_enable=False,
)
for module in (models, solve, compare, generate, doctor):
    app.command(module.__name__.rpartition(".")[2])(module.command)


def main() -> None:
    """Run the command line: one line for every fault, and no program left running when it is told to stop."""
    signal.signal(signal.SIGTERM, _stop)
    if sys.stdout is None:
        sys.exit(BAD_INPUT)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")
    try:
        sys.exit(app(args=sys.argv[1:] or ["--help"], standalone_mode=False))
    except TyperException as error:
        message = error.format_message() if hasattr(error, "format_message") else str(error)
        sys.exit(fail(ValueError(f"{message} See roughfilm --help"), BAD_INPUT).exit_code)
    except typer.Abort:
        sys.exit(128 + signal.SIGINT)


def _stop(number: int, _frame: FrameType | None) -> None:
    sys.exit(128 + number)


if __name__ == "__main__":
    main()
