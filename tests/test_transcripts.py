"""What the pages of docs/start and docs/howto show as the output of a command or a program is what it prints.

The blocks of a page run in order in one empty directory:

- ``toml`` after a line that ends with "Save this as `NAME`:" is written to that file;
- ``console`` runs each line after ``$ ``, a command of roughfilm, and compares what follows with its output on a
  terminal of 80 columns;
- ``python`` runs in one namespace for the page; a ``text`` block directly below it shows what it prints;
- ``console norun`` and ``python norun`` are not run.

In what is shown, ``…`` stands for any text. Numbers may differ by one in the last digit that is shown; times, residuals
and numbers of iterations by any amount. Lines may be broken anywhere.
"""

import contextlib
import functools
import io
import re
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from empty_figures import empty_figures
from places import MEASURED, ROOT
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.terminal import console

RUN = re.compile(r"^```(console|python)$", re.MULTILINE)
POCKET = 'kind = "pocket"'
PAGES = [
    pytest.param(page, id=f"{page.parent.name}/{page.stem}", marks=[pytest.mark.openfoam] if POCKET in text else [])
    for part in ("start", "howto")
    for page in sorted((ROOT / "docs" / part).glob("*.md"))
    if RUN.search(text := page.read_text())
]
"""The pages; the advice on a pocket counts the cost of the models that run in OpenFOAM."""

MEASUREMENTS = {"milled.opd": "milled_NT1100.opd"}
"""Files of the reader's instrument that pages name, and the measured surface that stands for each."""

COLUMNS = 80
BLOCK = re.compile(
    r"(?:Save this as `(?P<file>[^`]+)`:\n\n)?^```(?P<language>\w+)(?P<norun> norun)?\n(?P<text>.*?)^```$"
    r"(?:\n\n```text\n(?P<printed>.*?)^```$)?",
    re.MULTILINE | re.DOTALL,
)
COMMAND = re.compile(r"^\$ (?P<line>(?:.*\\\n)*.*)\n(?P<printed>(?:(?!\$ ).*\n)*)", re.MULTILINE)
VARYING = re.compile(r"\b\d[\d.e+-]*(?=\s+(?:(?:CPU\s+)?(?:s|ms|min|h)|iterations)\b)")
"""Times and numbers of iterations."""

ONE_TIME = re.compile(r"\s*\(\+\s[^)]*\)")
"""Times of what is done once, such as compiling or loading kernels; it depends on what ran before."""

RULE = re.compile("─+")
"""The line below the titles of a table, as long as its columns are wide."""

RESIDUAL = re.compile(r"(?<=residual )\d[\d.e+-]*")
NUMBER = re.compile(r"(?<![A-Za-z_\d.])[−-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
TIMES = re.compile(r"(?<=\S) {2,}CPU s(?= {2,}|$)")
"""Title of a column of times in a table, beside another title; it ends where the times end."""

ANY = "…"


def _masked(text: str) -> str:
    """The text without times, residuals and numbers of iterations."""
    lines, ends = [], set[int]()
    for line in ONE_TIME.sub("", text).splitlines():
        titles = {found.end() for found in TIMES.finditer(line)}
        if titles or not line.strip():
            ends = titles
        kept = [" " * len(word[0]) if word.end() in ends else word[0] for word in re.finditer(r"\S+|\s+", line)]
        lines.append(line if titles else "".join(kept))
    varying = [(RULE, "─"), (VARYING, ""), (RESIDUAL, "")]
    return functools.reduce(lambda kept, rule: rule[0].sub(rule[1], kept), varying, "\n".join(lines))


def _last_digit(number: str) -> float:
    """One in the last digit of a number that is not a zero before the decimal point."""
    mantissa, _, power = number.lower().partition("e")
    whole, point, decimals = mantissa.partition(".")
    zeros = 0 if point else len(whole) - len(whole.rstrip("0"))
    return 10.0 ** (zeros - len(decimals) + int(power or 0))


def _same(shown: str, printed: str) -> bool:
    """Whether two words are the same but for the last digit of their numbers."""
    if NUMBER.sub("0", shown) != NUMBER.sub("0", printed):
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(printed), strict=True)
    return all(
        abs(float(one.replace("−", "-")) - float(other.replace("−", "-"))) <= 1.001 * _last_digit(one)
        for one, other in pairs
    )


def agree(shown: str, printed: str) -> bool:
    """Whether a page shows what was printed."""
    words = _masked(printed).split()
    *parts, last = [part.split() for part in _masked(shown).split(ANY)]

    def matches(part: list[str], place: int) -> bool:
        return all(map(_same, part, words[place : place + len(part)])) and place + len(part) <= len(words)

    if not parts:
        return len(last) == len(words) and matches(last, 0)
    if not matches(parts[0], 0):
        return False
    place = len(parts[0])
    for part in parts[1:]:
        found = next((start for start in range(place, len(words)) if matches(part, start)), None)
        if found is None:
            return False
        place = found + len(part)
    return place <= len(words) - len(last) and matches(last, len(words) - len(last))


def typed(line: str) -> str:
    """What a command prints, on standard output and standard error as on a terminal."""
    program, *words = shlex.split(line.replace("\\\n", " "), comments=True)
    assert program == "roughfilm", line
    return CliRunner().invoke(app, words).output


def transcripts(page: str) -> Iterator[tuple[str, str, str]]:
    """Run the blocks of a page here; yield each command or program, the output that is shown, and what it printed."""
    names: dict[str, object] = {}
    for block in BLOCK.finditer(page):
        if block["file"]:
            Path(block["file"]).write_text(block["text"])
        elif block["norun"]:
            continue
        elif block["language"] == "console":
            for command in COMMAND.finditer(block["text"]):
                yield command["line"], command["printed"], typed(command["line"])
        elif block["language"] == "python":
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile(block["text"], "a block of the page", "exec"), names)
            yield block["text"], block["printed"] or "", printed.getvalue()


@pytest.mark.parametrize("page", PAGES)
def test_pages_show_what_is_printed(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    empty_figures(monkeypatch)
    for stream in (console.output, console.messages):
        monkeypatch.setattr(stream, "width", COLUMNS)
    text = page.read_text()
    for name, measured in MEASUREMENTS.items():
        if name in text:
            if not MEASURED.is_dir():
                pytest.skip(f"measured surfaces are not here: {MEASURED} is absent")
            shutil.copy(MEASURED / measured, name)
    for command, shown, printed in transcripts(text):
        assert agree(shown, printed), f"{command}\nprinted\n{printed}"


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("load 19.54 kPa", "load 19.55\n  kPa", True),
        ("load 19.54 kPa", "load 19.56 kPa", False),
        ("load 19.54 kPa", "load 19.54 MPa", False),
        ("load −0.5", "load 0.5", False),
        ("890 ± 30", "886 ± 28", True),
        ("load 1; 0.02 CPU s", "load 1; 3\n  CPU s", True),
        ("load 1; 2 CPU s (+ 1 s to load\n kernels)", "load 1; 2 CPU s", True),
        ("load 1; 2 CPU s", "load 1; 2 CPU s (+\n  0.519 s to load the program)", True),
        ("a 1; 2 CPU s;\nbees 12 um", "a 1; 2\nCPU s (+ 0.519 s to load the\nprogram);\nbees 12 um", True),
        ("residual 2e-16, 37\n iterations", "residual 7e-12, 45 iterations", True),
        ("model  CPU s  error\nfilm    0.02    1 %", "model  CPU s  error\nfilm     1.5    1 %", True),
        ("model  CPU s  error\nfilm    0.02    1 %", "model  CPU s  error\nfilm     1.5    3 %", False),
        ("a\n…\nd", "a b c d", True),
        ("a … d …", "a b d", True),
        ("a … d", "a b d e", False),
        ("a … b", "a", False),
        ("a", "a b", False),
        ("", "a", False),
    ],
)
def test_agreement(shown: str, printed: str, same: bool) -> None:
    assert agree(shown, printed) is same
