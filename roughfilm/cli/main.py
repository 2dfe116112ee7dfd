"""The ``roughfilm`` command: one subcommand a file, imported when it is called."""

import importlib
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from roughfilm.terminal.console import in_one_line, launch

COMMANDS = {
    "models": "Show the models of each kind of scene: what each adds, and whether it can run here or why not.",
    "advise": "Choose the cheapest model and resolution that are accurate enough, with their expected error and cost.",
    "solve": "Solve a scene by one model, or by the cheapest that is accurate enough.",
    "compare": "Run every model that applies and write report.html, results (.h5) and figures.",
    "batch": "Solve every case of a study by every model and write table.csv and table.h5.",
    "report": "Write the report of a sweep: errors of every model, the number that orders them, speed and accuracy.",
    "charts": "Chart CPU time against error for every model and resolution: charts.html, .json, .csv, .png and an "
    ".svg each.",
    "stability": "Map where solvers converge, and write stability.csv, .json and report.html.",
    "generate": "Write the OpenFOAM cases alone; run each with its ./Allrun.",
    "surface": "Read a surface, prepare it as a periodic cell, and show it before and after.",
    "factors": "Compute pressure, shear and friction flow factors of a rough surface.",
    "stribeck": "Sweep speed and load of a bearing whose walls may touch, to Stribeck curves.",
    "leakage": "Compute contact, gap and leakage of a seal, directly and averaged, from the first touch until it is "
    "sealed.",
    "effects": "Switch the effects of a bearing on one at a time: what each adds to load, friction and flow, and to "
    "the film.",
    "export": "Write a gap, a surface or a result as a mesh for other tools: lengths in metres, data named with "
    "their units.",
    "doctor": "Check Python, OpenFOAM, MPI, rendering and the reader of instrument files; give remedies.",
    "cache": "Show what is kept for later runs, tables of surfaces and series of leakage, or remove it.",
    "contact": "Press a rough surface against a flat plane: area, gap and pressures by load.",
}
"""The help of each command, in one line; ``roughfilm/cli/<command>.py`` has the command."""


class _Commands(TyperGroup):
    """The commands as their help shows them, until one is called."""

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        name, _, rest = super().resolve_command(ctx, args)
        alone = typer.Typer(add_completion=False)
        alone.command(name)(in_one_line(importlib.import_module(f"roughfilm.cli.{name}").command))
        return name, typer.main.get_command(alone), rest


app = typer.Typer(
    name="roughfilm",
    cls=_Commands,
    help="Thin lubricant films by a ladder of models, from Reynolds to Navier-Stokes in OpenFOAM.",
    add_completion=False,
    pretty_exceptions_enable=False,
)
for command, line in COMMANDS.items():
    app.command(command, help=line)(lambda: None)


def _show_version(wanted: bool) -> None:
    if wanted:
        from importlib import metadata  # no other command pays for it

        typer.echo(f"roughfilm {metadata.version('roughfilm')}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """Options that stand before a command."""


def main() -> None:
    """Run the command line; alone it shows the help."""
    launch(app, sys.argv[1:] or ["--help"])


if __name__ == "__main__":
    main()
