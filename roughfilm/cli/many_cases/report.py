"""roughfilm report: the page of a study: its answers, the models that would have done, and the cost."""

from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer

from roughfilm.batch.plan import read_batch
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.writing.kinds import PAGE, entries_from
from roughfilm.rom.ladder.provenance import machine
from roughfilm.terminal.console import AsJson, Overwrite, make_directory, print_json, print_message, progress_bar
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.results import print_all, table_of, written
from roughfilm.words.numbers import span

EXAMPLES = (
    "roughfilm batch scripts/examples/studies/pocket.toml --out sweep",
    "roughfilm report sweep",
)


def command(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="The output directory of 'roughfilm batch'.")],
    out: Annotated[Path | None, typer.Option(help="Write the page here (default: DIR/report.html).")] = None,
    want: Annotated[
        str | None,
        typer.Option(metavar="QUANTITY", help="The quantity that is asked for (default: the first that varies)."),
    ] = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Write the page of a study: the best case and curves, the models that would have done, and cost."""
    path = out or directory / "report.html"
    with ExitStack() as stack:
        advance = stack.enter_context(progress_bar(1.0))
        advance(0.0, "reading the results")
        batch = read_batch(directory)
        make_directory(path.parent)
        refuse_unwritable((path, PAGE), (path.with_suffix(".json"), entries_from("reference")), overwrite=overwrite)
        stack.enter_context(alone(path, "report"))
        from roughfilm.pages.sweep import study_of, write_sweep  # matplotlib is slow to import

        study = study_of(batch)
        advance(0.2, "drawing the page")
        entries, sentence = write_sweep(study, want, path, overwrite=overwrite)
        write_json({**entries, "machine": machine()}, path.with_suffix(".json"), overwrite=overwrite)
    if as_json:
        print_json({**entries, "report": str(path)})
        return
    rows = [
        (row["setting"], title, _span(spans["median"]), _span(spans["worst"]), f"{row['cpu_s']:.2g} s")
        for row in entries["settings"]
        for name, title in study.kind.compared.items()
        if row["setting"] != entries["reference"] and (spans := row["error"][name]["intervals"])["median"] is not None
    ]
    if rows:
        heads = ("setting", "error in", "median", "largest", "CPU")
        table = table_of(heads, rows, title=f"errors against {entries['reference']}", left=2)
        table.columns[0].no_wrap = True
        print_all([table])
    for line in entries["missing"]:
        print_message("missing", line)
    for line in entries["edited"]:
        print_message("warning", line)
    if entries["unranked"]:
        print_message("warning", entries["unranked"])
    print_all([written(sentence, path)])


def _span(ends: list[float | None] | None) -> str:
    return "-" if ends is None else span(ends[0], ends[1])
