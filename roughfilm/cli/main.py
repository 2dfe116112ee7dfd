"""The ``roughfilm`` command: one subcommand a file."""

import sys

import typer

from roughfilm.cli import (
    advise,
    batch,
    charts,
    compare,
    doctor,
    effects,
    export,
    factors,
    generate,
    leakage,
    models,
    report,
    solve,
    stability,
    stribeck,
    surface,
)
from roughfilm.cli import contact as contact_series
from roughfilm.terminal.console import launch

app = typer.Typer(
    name="roughfilm",
    help="Thin lubricant films by a ladder of models, from Reynolds to Navier-Stokes in OpenFOAM.",
    add_completion=False,
    pretty_exceptions_enable=False,
)
for module in (
    models,
    advise,
    solve,
    compare,
    batch,
    report,
    charts,
    stability,
    generate,
    surface,
    factors,
    stribeck,
    leakage,
    effects,
    export,
    doctor,
):
    app.command(module.__name__.rpartition(".")[2])(module.command)
app.command("contact")(contact_series.command)


def main() -> None:
    """Run the command line; alone it shows the help."""
    launch(app, sys.argv[1:] or ["--help"])


if __name__ == "__main__":
    main()
