"""roughfilm generate: the OpenFOAM cases of a scene, to run by hand."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.model import chosen_scheme, of_kind
from roughfilm.rom.ladder.provenance import provenance
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
    models,
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
    writers = [(model, model.write) for model in of_kind(models(), read.kind) if model.write is not None]
    if not writers:
        known = " or ".join(sorted({model.kind for model in models() if model.write is not None}))
        raise InputError(f"scene.kind: got {read.kind!r}, which no model solves in OpenFOAM; give a scene of {known}")
    make_directory(out)
    for model, _ in writers:
        if model.schemes:
            chosen_scheme(model.name, model.schemes, scheme)  # refused before anything is written
    cases = []
    for model, write in writers:
        write(
            read,
            out / model.name,
            resolution=resolution,
            tolerance=tolerance,
            scheme=scheme if model.schemes else None,
            processes=processes,
        )
        cases.append({"model": model.name, "directory": str(out / model.name)})
    if as_json:
        print_json({"cases": cases, "provenance": provenance(read, keeps=(), sources=())})
    else:
        for case in cases:
            output.print(f"{case['model']}: {escape(case['directory'])}/Allrun", soft_wrap=True)
