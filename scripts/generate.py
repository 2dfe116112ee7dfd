"""roughfilm generate: the OpenFOAM cases of a scene, to run by hand."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from rom.ladder import chosen_scheme
from rom.provenance import provenance
from rom.scene import load_scene
from scripts.common import (
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
    run_alone,
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
    make_directory(out)
    for model in models():
        if model.write is not None and model.schemes:
            chosen_scheme(model.name, model.schemes, scheme)  # refused before anything is written
    cases = []
    for model in models():
        if model.write is not None:
            model.write(
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


if __name__ == "__main__":
    run_alone(command)
