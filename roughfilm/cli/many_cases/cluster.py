"""roughfilm cluster: keys for TLS between a batch and the scheduler and workers of a dask cluster."""

import shlex
import textwrap
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from roughfilm.batch.keys import AUTHORITY, CERTIFICATE, KEY, key_options, write_keys
from roughfilm.terminal.console import AsJson, output, print_json
from roughfilm.terminal.results import print_all

EXAMPLES = ("roughfilm cluster keys keys", "roughfilm cluster keys ~/keys --host login1")

PORT = 8786
"""Port of the scheduler in the commands that are shown; the default of dask."""


class Action(StrEnum):
    """The things that the command does."""

    KEYS = "keys"


def command(
    action: Annotated[Action, typer.Argument(metavar="keys", help="Write keys.")],  # noqa: ARG001 (the only one)
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="The directory of the keys, which is made.")],
    host: Annotated[
        str, typer.Option(help="Host of the scheduler in the commands: its name or address in the cluster.")
    ] = "127.0.0.1",
    as_json: AsJson = False,
) -> None:
    """Write keys that close a dask cluster to others, and show the commands that use them."""
    write_keys(directory)
    commands = _commands(directory, host)
    if as_json:
        files = {name: str(directory / name) for name in (AUTHORITY, CERTIFICATE, KEY)}
        print_json({"files": files, "commands": commands})
        return
    for line in commands.values():
        output.print(escape(_lines(line)), soft_wrap=True)
    print_all([f"{directory} holds keys for a year; whoever reads its {KEY} can run programs on the cluster"])


def _lines(line: str) -> str:
    """A command in lines that fit the terminal and can be copied as they are."""
    parts = textwrap.wrap(
        line, output.width - 2, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False
    )
    return " \\\n".join(parts) + "\n"


def _commands(directory: Path, host: str) -> dict[str, str]:
    """The commands that start scheduler, workers and a batch with the keys of a directory."""
    keys = key_options(directory)
    address = f"tls://{host}:{PORT}"
    return {
        "scheduler": f"dask scheduler --protocol tls --host {host} --port {PORT} --no-dashboard {keys}",
        "workers": f"dask worker {address} --nworkers 2 --nthreads 1 --no-dashboard --death-timeout 60 {keys}",
        "batch": f"roughfilm batch STUDY --out DIR --executor dask --scheduler {address} "
        f"--tls {shlex.quote(str(directory))}",
    }
