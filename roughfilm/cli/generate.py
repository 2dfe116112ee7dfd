"""roughfilm generate: the OpenFOAM cases of a scene, to run by hand."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.model import CaseModel
from roughfilm.ladder import models
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    Processes,
    Resolution,
    ScenePath,
    Scheme,
    Tolerance,
    in_one_line,
    make_directory,
    output,
    print_json,
)


@in_one_line
def command(
    scene: ScenePath,
    out: Annotated[Path, typer.Option(help="One case directory for each OpenFOAM model is made here.")],
    set_: Overrides = None,
    resolution: Resolution = None,
    tolerance: Tolerance = None,
    scheme: Scheme = None,
    processes: Processes = 1,
    as_json: AsJson = False,
) -> None:
    """Write the OpenFOAM cases alone; run each with its ./Allrun."""
    read = load_scene(scene, set_ or ())
    writers = [model for model in models(read.kind) if isinstance(model, CaseModel)]
    if not writers:
        known = " or ".join(sorted({model.kind for model in models() if model.outside}))
        raise InputError(f"scene.kind: got {read.kind!r}, which no model solves in OpenFOAM; give a scene of {known}")
    requests = [
        Request(
            resolution=resolution,
            tolerance=tolerance,
            scheme=scheme if model.schemes else None,
            processes=processes,
        )
        for model in writers
    ]
    for model, request in zip(writers, requests, strict=True):
        model.checked(read, request)  # before anything is written
    make_directory(out)
    cases = []
    for model, request in zip(writers, requests, strict=True):
        model.write(read, out / model.name, request)
        cases.append({"model": model.name, "directory": str(out / model.name)})
    if as_json:
        print_json({"cases": cases, "provenance": provenance(read, keeps=(), sources=())})
    else:
        for case in cases:
            output.print(f"{case['model']}: {escape(case['directory'])}/Allrun", soft_wrap=True)
