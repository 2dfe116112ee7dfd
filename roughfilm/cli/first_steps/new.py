"""roughfilm new: an annotated scene to start from, on standard output."""

import textwrap
from collections.abc import Iterator
from typing import Annotated

import typer

from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.scenes.annotated import annotated_scene, variants
from roughfilm.terminal.completion import kinds_beginning_with
from roughfilm.terminal.console import output
from roughfilm.terminal.results import print_all

EXAMPLES = (
    "roughfilm new",
    "roughfilm new pocket > pocket.toml",
    "roughfilm new bearing/washer > washer.toml",
)


def command(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="KIND",
            help="Kind of the scene, such as pocket or bearing/journal (default: list them).",
            autocompletion=kinds_beginning_with,
        ),
    ] = None,
) -> None:
    """Print an annotated scene of a kind, with all its keys, to start from."""
    if kind is None:
        print_all(_listed())
        return
    name, _, variant = kind.partition("/")
    typer.echo(annotated_scene(name, variant or None).encode("utf-8"), nl=False)


def _listed() -> Iterator[str]:
    """The annotated scenes of all kinds; the first of a kind is its default."""
    known = variants()
    for kind, named in known.items():
        yield f"{kind}: {kind_of_name(kind).summary}"
        scenes = ", ".join(f"{kind}/{variant}" for variant in named)
        yield from textwrap.wrap(scenes, output.width, initial_indent="  ", subsequent_indent="  ")
    yield ""
    count = sum(map(len, known.values()))
    yield f"{count} annotated scenes; print one by 'roughfilm new bearing/journal > scene.toml'"
