"""roughfilm schema: the JSON Schema of scene files, for editors."""

import json
from typing import Annotated

import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import kind_names
from roughfilm.scenes.json_schema import schema_of, schema_of_scenes
from roughfilm.terminal.completion import kinds_beginning_with

EXAMPLES = ("roughfilm schema > scenes.schema.json", "roughfilm schema bearing > bearing.schema.json")


def command(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="KIND",
            help="Kind of the scenes (default: all, selected by their key kind).",
            autocompletion=kinds_beginning_with,
        ),
    ] = None,
) -> None:
    """Print the JSON Schema of scene files, with which editors check and complete them."""
    if kind is not None and kind not in kind_names():
        raise InputError(f"KIND: got {kind!r:.60}; it must be one of {', '.join(kind_names())}")
    schema = schema_of_scenes() if kind is None else schema_of(kind)
    typer.echo((json.dumps(schema, indent=1, ensure_ascii=False) + "\n").encode("utf-8"), nl=False)
