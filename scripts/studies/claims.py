"""What a source claims, judged: how commands that judge tell it, and keep the numbers."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape

from roughfilm.contact.foundation.files import replacing
from roughfilm.terminal.console import output, print_json

Surfaces = Annotated[
    Path | None, typer.Option(envvar="ROUGHFILM_SURFACES", help="The folder of measured surfaces, if there is one.")
]
"""Where a command finds instrument files that are not the project's own."""


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One claim, whether it holds, and the evidence."""

    number: int
    text: str
    verdict: str
    evidence: str


def write_numbers(told: Mapping[str, Any], path: Path) -> None:
    """Write what a page tells as JSON; InputError if the file cannot be written."""
    with replacing(path) as scratch:
        scratch.write_text(json.dumps(told, indent=1, allow_nan=False) + "\n", encoding="utf-8")


def tell(claims: Sequence[Claim], told: Mapping[str, Any], page: Path, *, as_json: bool) -> None:
    """Print the verdicts and where the page is, or one JSON object."""
    if as_json:
        print_json({**told, "report": str(page)})
        return
    for claim in claims:
        output.print(
            f"{claim.number}. {claim.text}: [bold]{claim.verdict}[/]; {escape(claim.evidence)}", soft_wrap=True
        )
    output.print(f"page: {escape(str(page))}", soft_wrap=True)
