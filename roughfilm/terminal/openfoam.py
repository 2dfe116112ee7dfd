"""The option that names the OpenFOAM to use, and the line on a release that was never tried."""

import functools
import inspect
import os
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.terminal.console import NUMERICS, print_message

OPENFOAM = inspect.Parameter(
    "openfoam",
    inspect.Parameter.KEYWORD_ONLY,
    default=None,
    annotation=Annotated[
        str | None,
        typer.Option(
            metavar="PATH",
            help="The OpenFOAM to use: its directory, its bashrc, or a command to put in front (default: "
            "ROUGHFILM_OPENFOAM, else the first that 'roughfilm doctor' finds).",
            rich_help_panel=NUMERICS,
        ),
    ],
)
"""The option ``--openfoam``."""


def naming_openfoam(command: Callable[..., None]) -> Callable[..., None]:
    """A command with the option ``--openfoam``, which sets the variable that programs started by the command read too.

    At its end the command says once if the release that it asked for was never tried.
    """

    @functools.wraps(command)
    def named(*arguments: Any, openfoam: str | None = None, **options: Any) -> None:
        from roughfilm.foamcases.openfoam.installation import VARIABLE, installation

        if openfoam is not None and not openfoam.strip():
            raise InputError("--openfoam: got an empty text; name a directory, a bashrc or a command, or leave it out")
        if openfoam is not None:  # a path is made absolute, because programs start in other directories
            os.environ[VARIABLE] = str(Path(openfoam).absolute()) if Path(openfoam).exists() else openfoam
            installation.cache_clear()
        command(*arguments, **options)
        release = installation().release if installation.cache_info().currsize else None
        if release is not None and release.caution:
            print_message("warning", release.caution)

    signature = inspect.signature(command, eval_str=True)
    named.__signature__ = signature.replace(parameters=[*signature.parameters.values(), OPENFOAM])  # type: ignore[attr-defined]
    named.__annotations__ = {**command.__annotations__, OPENFOAM.name: OPENFOAM.annotation}
    return named
