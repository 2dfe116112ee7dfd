"""roughfilm new: an annotated scene to start from, on standard output."""

from typing import Annotated

import typer
from rich.table import Table

from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.scenes.annotated import annotated_scene, variants
from roughfilm.terminal.console import output


def command(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="[KIND]", help="Kind of the scene, such as pocket or bearing/journal (default: list)."),
    ] = None,
) -> None:
    """Print an annotated scene of a kind, with all its keys, to start from: roughfilm new bearing > scene.toml."""
    if kind is not None:
        name, _, variant = kind.partition("/")
        typer.echo(annotated_scene(name, variant or None).encode("utf-8"), nl=False)
        return
    table = Table("scene", "what it is", title="Annotated scenes: roughfilm new SCENE > scene.toml")
    for name, known in variants().items():
        table.add_row("\n".join(f"{name}/{variant}" for variant in known), kind_of_name(name).summary, end_section=True)
    output.print(table)
    output.print("A kind alone, such as bearing, is its first scene.")
