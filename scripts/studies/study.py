"""The skeleton of every study: progress, results kept for the next run, claims, and the page with its numbers."""

import json
import math
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, is_dataclass
from pathlib import Path
from typing import Annotated, Any, Protocol

import numpy as np
import typer
from matplotlib.figure import Figure
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.figures import base
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.terminal.console import make_directory, output, print_json, progress_bar

Out = Annotated[
    Path, typer.Option(help="Directory for the page, its figures and its numbers; finished work there is used again.")
]
Surfaces = Annotated[
    Path | None, typer.Option(envvar="ROUGHFILM_SURFACES", help="Directory of measured surfaces, if there is one.")
]
"""The instrument files are not part of the project."""


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim of the source with a verdict (true, partly or false) and the evidence for it."""

    number: int
    text: str
    verdict: str
    evidence: str


Judgement = tuple[str, str]
"""Verdict on a claim and its evidence."""


def texts(folder: Path) -> dict[str, Any]:
    """Return the texts of a study from its ``study.toml``: claims of the source, captions, and open choices."""
    path = folder / "study.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def claims_of(module: str, judgements: Mapping[int, Judgement]) -> list[Claim]:
    """Return the claims with these numbers, whose texts are in ``study.toml`` beside a module."""
    claims = texts(Path(module).parent)["claims"]
    return [
        Claim(number=number, text=claims[str(number)], verdict=judged, evidence=evidence)
        for number, (judged, evidence) in judgements.items()
    ]


def verdict(holds: bool | np.bool, *, partly: bool | np.bool) -> str:
    """Return ``true`` where a claim holds, else ``partly`` or ``false``."""
    return "true" if holds else "partly" if partly else "false"


class Advance(Protocol):
    """Report that some steps of the work begin, and in words which."""

    def __call__(self, words: str, steps: int = 1) -> None:
        """Advance the progress bar."""


@contextmanager
def counted(total: int) -> Iterator[Advance]:
    """Show a progress bar of ``total`` steps; yields a function that is called at the beginning of each."""
    done = 0
    with progress_bar(total) as bar:

        def advance(words: str, steps: int = 1) -> None:
            nonlocal done
            bar(done, words)
            done += steps

        yield advance


def plain(value: Any) -> Any:
    """Return a value as JSON can hold it: dictionaries for dataclasses, lists for arrays, null for NaN and infinity."""
    if is_dataclass(value) and not isinstance(value, type):
        return plain(asdict(value))
    if isinstance(value, Mapping):
        return {str(name): plain(one) for name, one in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def kept(path: Path | None, inputs: Mapping[str, Any], make: Callable[[], Any]) -> Any:
    """Return ``plain(make())``, read from the file if that was made from the same inputs by the same code.

    A file that is damaged or was made from other inputs is replaced. Nothing is kept if ``path`` is None.
    """
    if path is None:
        return plain(make())
    identity = json.loads(json.dumps({"inputs": inputs, "code": code(), "versions": versions()}))
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        if stored["identity"] == identity:
            return stored["found"]
    except (OSError, ValueError, LookupError, TypeError):
        pass  # is made again and replaced
    made = plain(make())
    make_directory(path.parent)
    with replacing(path, JSON) as scratch:
        scratch.write_text(json.dumps({"identity": identity, "found": made}) + "\n", encoding="utf-8")
    return made


def write(
    folder: Path, out: Path, figures: Mapping[str, Figure], numbers: Mapping[str, Any], **entries: Any
) -> tuple[dict[str, Any], Path]:
    """Write a study's figures, numbers and page into ``out``; returns the numbers as written and the page's path.

    Parameters
    ----------
    folder : that of the study, whose name is the name of the files, with ``page.html.j2`` (see ``study.html.j2``) and,
        if it has any texts, ``study.toml``.
    out : directory for the files; made where it does not exist.
    figures : by name. A figure is written as an SVG file, and the page has it as ``plots[name]``.
    numbers : entries of the JSON file, as :func:`plain` takes them.
    entries : what the page shows besides.

    Raises
    ------
    InputError
        If a file cannot be written.
    """
    make_directory(out)
    plots = {name: base.svg(figure) for name, figure in figures.items()}
    write_figures({name.replace(" ", "_"): text for name, text in plots.items()}, out)
    written: dict[str, Any] = plain(numbers)
    with replacing(out / f"{folder.name}.json", JSON) as scratch:
        scratch.write_text(json.dumps(written, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    page = out / f"{folder.name}.html"
    render(folder / "page.html.j2", page, **{**texts(folder), "study": folder.name, "plots": plots, **entries})
    return written, page


def publish(
    folder: Path,
    out: Path,
    figures: Mapping[str, Figure],
    numbers: Mapping[str, Any],
    *,
    claims: Sequence[Claim] | None = None,
    tables: Sequence[Table | str] = (),
    as_json: bool,
    **entries: Any,
) -> None:
    """Write a study (see :func:`write`) and print its tables, claims and page, or one JSON object."""
    judged = {} if claims is None else {"claims": claims}
    written, page = write(folder, out, figures, {**judged, **numbers}, **judged, **entries)
    if as_json:
        print_json({**written, "report": str(page)})
        return
    for table in tables:
        output.print(table)
    for claim in claims or ():
        line = f"{claim.number}. {claim.text}: [bold]{claim.verdict}[/]; {escape(claim.evidence)}"
        output.print(line, soft_wrap=True)
    output.print(f"page: {escape(str(page))}", soft_wrap=True)
