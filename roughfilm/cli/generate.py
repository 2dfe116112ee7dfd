"""roughfilm generate: the OpenFOAM cases of a scene, to run by hand."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.model import CaseModel
from roughfilm.ladder import models
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import (
    OUTPUT,
    AsJson,
    Overrides,
    Processes,
    Resolution,
    ScenePath,
    Scheme,
    Tolerance,
    make_directory,
    print_json,
)
from roughfilm.terminal.results import print_all, written

EXAMPLES = ("roughfilm generate scripts/examples/scenes/pocket.toml --out cases",)


def command(
    scene: ScenePath,
    out: Annotated[
        Path, typer.Option(help="One case directory for each OpenFOAM model is made here.", rich_help_panel=OUTPUT)
    ],
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
    request = Request(resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
    requests = [(model, request if model.schemes else replace(request, scheme=None)) for model in writers]
    for model, its in requests:
        model.checked(read, its)  # before anything is written
    make_directory(out)
    for model, its in requests:
        model.write(read, out / model.name, its)
    cases = [{"model": model.name, "directory": str(out / model.name)} for model in writers]
    if as_json:
        print_json({"cases": cases, "provenance": provenance(read, keeps=(), sources=())})
    else:
        scripts = [f"{case['model']}: {case['directory']}/Allrun" for case in cases]
        print_all([*scripts, written(f"{len(cases)} OpenFOAM cases, each is run by its Allrun", out)])
