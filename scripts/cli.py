"""The ``roughfilm`` command: one subcommand a file."""

import typer

from scripts import compare, doctor, generate, models, solve

app = typer.Typer(
    name="roughfilm",
    help="Thin lubricant films by a ladder of models, from Reynolds to Navier-Stokes in OpenFOAM.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
for module in (models, solve, compare, generate, doctor):
    app.command(module.__name__.rpartition(".")[2])(module.command)


def main() -> None:
    """Run the command line."""
    app()


if __name__ == "__main__":
    main()
