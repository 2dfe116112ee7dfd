"""The ``roughfilm`` command: one subcommand a file, imported when it is called."""

import importlib
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from roughfilm.contact.foundation.writing.scratch import sweep_machine
from roughfilm.terminal.console import HELP_MODE, help_below, in_one_line, launch
from roughfilm.terminal.openfoam import naming_openfoam

GROUPS = {
    "First steps": {
        "new": "Print an annotated scene of a kind, with all its keys, to start from.",
        "models": "List the models of each kind of scene: what each keeps, its cost, and whether it can run here.",
        "advise": "Choose the cheapest model and resolution that are accurate enough, with their expected error and "
        "cost.",
        "solve": "Solve a scene by the cheapest model that is accurate enough, or by a given one.",
        "compare": "Run every model that applies and write report.html, results (.h5) and figures.",
    },
    "Bearings and seals": {
        "stribeck": "Sweep speed and load of a bearing, smooth or with walls that may touch, to Stribeck curves.",
        "dynamics": "Sweep speed and load of a bearing: stiffness, damping and the stability of its rotor.",
        "march": "March a bearing in time: film, pressure, load, friction and flows as loads and speeds change.",
        "effects": "Switch the effects of a bearing on one at a time: what each adds to load, friction and flow, and "
        "to the film.",
        "leakage": "Compute contact, gap and leakage of a seal, directly and averaged, from the first touch until it "
        "is sealed.",
    },
    "Surfaces": {
        "surface": "Read a surface, prepare it as a periodic cell, and show it before and after.",
        "windows": "Take many windows of a surface, or seeds: their scatter, and how many are needed.",
        "combine": "Subtract two measurements of one place, which shows wear, or add two walls that face each other.",
        "fit": "Fit a random description to the windows of a surface, and test it with windows that were not fitted.",
        "contact": "Press a rough surface against a flat plane: area, gap and pressures by load.",
        "factors": "Compute pressure, shear and friction flow factors of a rough surface.",
    },
    "Many cases": {
        "batch": "Solve every case of a study by every model and write table.csv and table.h5.",
        "cluster": "Write keys that close a dask cluster to others, and show the commands that use them.",
        "report": "Write the page of a study: the best case and curves, the models that would have done, and cost.",
    },
    "OpenFOAM and other tools": {
        "generate": "Write the OpenFOAM cases of a scene or a study, with scripts that run them by hand or in Slurm.",
        "collect": "Read the generated OpenFOAM cases that have finished, and write the results and tables of 'batch'.",
        "export": "Write a gap, a surface or a result as a mesh for other tools: lengths in metres, data named with "
        "their units.",
    },
    "Upkeep": {
        "schema": "Print the JSON Schema of scene files, with which editors check and complete them.",
        "cache": "Show what is kept for later runs, tables of surfaces and series of leakage, or remove it.",
        "doctor": "Check Python, OpenFOAM, MPI, rendering and the reader of instrument files; give remedies.",
        "charts": "Chart CPU time against error for every model and resolution: charts.html, .json, .csv, .png and an "
        ".svg each.",
        "stability": "Map where solvers converge, and write stability.csv, .json and report.html.",
        "validate": "Compare published numbers with ours: report.html, validation.json and .md, and an .svg each.",
    },
}
"""The commands by their use, each with its help in one line."""

MODULES = {
    name: f"roughfilm.cli.{use.lower().replace(' ', '_')}.{name}" for use, group in GROUPS.items() for name in group
}
"""The module of each command, in the folder that is named after its use."""

WITH_OPENFOAM = frozenset(
    {"models", "advise", "solve", "compare", "batch", "generate", "doctor", "charts", "stability"}
)
"""The commands that take the option ``--openfoam``."""

COMMANDS = {name: line for group in GROUPS.values() for name, line in group.items()}


class _Commands(TyperGroup):
    """The commands as their help shows them, until one is called."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        for option in {"--install-completion", "--show-completion"}.intersection(args[:1]):
            from roughfilm.terminal.completion import needs_shell  # no other command pays for it

            needs_shell(option)
        return super().parse_args(ctx, args)

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        name, _, rest = super().resolve_command(ctx, args)
        sweep_machine()
        module = importlib.import_module(MODULES[str(name)])
        alone = typer.Typer(add_completion=False, rich_markup_mode=HELP_MODE)
        function = naming_openfoam(module.command) if name in WITH_OPENFOAM else module.command
        alone.command(name, epilog=help_below(getattr(module, "EXAMPLES", ())))(in_one_line(function))
        return name, typer.main.get_command(alone), rest


app = typer.Typer(
    name="roughfilm",
    cls=_Commands,
    help="Thin lubricant films by a ladder of models, from Reynolds to Navier-Stokes in OpenFOAM.",
    epilog=help_below(
        [
            "roughfilm models pocket",
            "roughfilm solve pocket.toml",
            "roughfilm compare pocket.toml --out study",
            "roughfilm COMMAND --help",
        ],
        "rich",
    ),
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
for group, commands in GROUPS.items():
    for command, line in commands.items():
        app.command(command, help=line, rich_help_panel=group)(lambda: None)


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
    launch(app, sys.argv[1:] or ["--help"], "roughfilm")
