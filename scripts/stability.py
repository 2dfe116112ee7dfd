"""roughfilm stability: where solvers converge, and what becomes of them elsewhere."""

import json
import os
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from contact.errors import InputError
from contact.files import replacing
from rom.table import write_csv
from scripts.common import AsJson, in_one_line, make_directory, messages, output, print_json, run_alone
from scripts.pages import render
from scripts.stability_cavitation import CAVITATION
from scripts.stability_cell import CELL
from scripts.stability_contact import CONTACT
from scripts.stability_gap import GAP
from scripts.stability_made import Family
from scripts.stability_pocket import POCKET
from scripts.workplace import alone

FAMILIES: dict[str, Family] = {
    "pocket": POCKET,
    "contact": CONTACT,
    "cavitation": CAVITATION,
    "cell": CELL,
    "rough_gap": GAP,
}


@in_one_line
def command(
    family: Annotated[str, typer.Argument(metavar="FAMILY", help=f"What is mapped: {', '.join(FAMILIES)}.")],
    out: Annotated[Path, typer.Option(help="Tables and the page go here, and runs of models, which are used again.")],
    resolution: Annotated[
        int | None,
        typer.Option(help="; ".join(f"{name}: {one.resolution_meaning}" for name, one in FAMILIES.items()) + "."),
    ] = None,
    jobs: Annotated[int | None, typer.Option(help="Processes; by default one for each core.")] = None,
    as_json: AsJson = False,
) -> None:
    """Map where solvers converge, and write stability.csv, .json and report.html."""
    if family not in FAMILIES:
        raise InputError(f"FAMILY: got {family!r}; it must be one of {', '.join(FAMILIES)}")
    processes = len(os.sched_getaffinity(0)) if jobs is None else jobs
    if processes < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    chosen = FAMILIES[family]
    make_directory(out)
    with alone(out) as scratch:
        made = chosen.make(
            resolution=chosen.resolution if resolution is None else resolution,
            out=out,
            processes=processes,
            scratch=scratch,
        )
        write_csv(made.columns, out / "stability.csv")
        with replacing(out / "stability.json") as path:
            path.write_text(json.dumps(made.entries, indent=1) + "\n", encoding="utf-8")
        render(made.template, out / "report.html", entries=made.entries, **made.page)
    if as_json:
        print_json(dict(made.entries))
        return
    output.print(made.table)
    output.print(f"page: {escape(str(out / 'report.html'))}", soft_wrap=True)
    for name, reason in made.absent.items():
        messages.print(f"[yellow]left out:[/] {name}: {escape(reason)}", soft_wrap=True)


if __name__ == "__main__":
    run_alone(command)
