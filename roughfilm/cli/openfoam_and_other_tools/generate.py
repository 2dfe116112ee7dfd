"""roughfilm generate: the OpenFOAM cases of a scene or of a study, to run by hand or on a cluster."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.dialect import dialect_named
from roughfilm.foamcases.openfoam.installation import dialect_here
from roughfilm.generated.scripts import ALL, SLURM
from roughfilm.generated.write import study_of_scene, study_to_generate, write_cases
from roughfilm.rom.ladder.provenance import circumstances, provenance
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import (
    NUMERICS,
    OUTPUT,
    AsJson,
    Processes,
    Resolution,
    Scheme,
    Tolerance,
    print_json,
    progress_bar,
)
from roughfilm.terminal.results import print_all, written

EXAMPLES = (
    "roughfilm generate scripts/examples/scenes/pocket.toml --out cases",
    "roughfilm generate scripts/examples/studies/openfoam_gaps.toml --out sweep",
)

SHOWN = 5
"""Largest number of cases whose scripts are listed."""


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The scene or the study (TOML).")],
    out: Annotated[
        Path,
        typer.Option(
            help="The cases, their scripts and a manifest are written here. It must be empty or not exist.",
            rich_help_panel=OUTPUT,
        ),
    ],
    set_: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=VALUE",
            help="Override a key of a scene, e.g. geometry.depth=22.5um; repeatable; not for studies.",
        ),
    ] = None,
    resolution: Resolution = None,
    tolerance: Tolerance = None,
    scheme: Scheme = None,
    processes: Processes = 1,
    dialect: Annotated[
        str | None,
        typer.Option(
            metavar="com|org",
            help="Family of OpenFOAM that will run the cases (default: that of this machine's OpenFOAM, else com).",
            rich_help_panel=NUMERICS,
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Write the OpenFOAM cases of a scene or a study, with scripts that run them by hand or in Slurm."""
    study = study_to_generate(file)
    if study is None:
        scene = load_scene(file, set_ or ())
        request = Request(resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
        study, source, origin = study_of_scene(scene, request), None, provenance(scene, keeps=(), sources=())
    else:
        for name, given in {"set": set_, "resolution": resolution, "tolerance": tolerance, "scheme": scheme}.items():
            if given is not None:
                raise InputError(f"--{name}: {file} is a study, which states it itself; change the study")
        source, origin = file, circumstances()
    written_in = dialect_named(dialect) if dialect else dialect_here()
    with progress_bar(1.0) as advance:
        manifest = write_cases(
            study, out, written_in, tolerance=tolerance, processes=processes, file=source, progress=advance
        )
    models = {name: about.model for name, about in manifest.settings.items()}
    cases = [
        {"case": one.case, "model": models[one.setting], "directory": str(out / one.directory)}
        for one in manifest.generated
    ]
    if as_json:
        print_json({"cases": cases, "dialect": written_in.name, "provenance": origin})
        return
    listed = [f"{case['model']}: {quote(case['directory'])}/Allrun" for case in cases[:SHOWN]]
    if len(cases) > SHOWN:
        listed.append(f"and {len(cases) - SHOWN} more")
    reduced = [setting.name for setting in study.settings if not setting.model.outside]
    left = [f"'collect' solves {', '.join(reduced)} itself, without OpenFOAM"] if reduced else []
    place = quote(str(out))
    steps = f"run all with {quote(str(out / ALL))}, or as a Slurm array: cd {place} && sbatch {SLURM}; "
    steps += f"then: roughfilm collect {place}"
    answer = f"{len(cases)} OpenFOAM cases for {written_in.releases}"
    print_all([*listed, *left, steps, written(answer, out)])
