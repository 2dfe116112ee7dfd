"""Points of an attack, what was found at each, and their sum."""

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from typing import Any

KINDS = ("traceback", "hang", "lost", "changed", "incomplete", "orphan", "scratch", "answer")
"""What an attack can find.

A finished result that is lost or changed, an output that is incomplete under its final name, a process that outlives
its command, scratch that outlives the next command, and an answer or an exit code that is not the right one.
"""


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One fault: its kind, one of ``KINDS``, and what was seen."""

    kind: str
    seen: str

    def __post_init__(self) -> None:
        assert self.kind in KINDS, self.kind


@dataclass(frozen=True, kw_only=True)
class Point:
    """One attack.

    Attributes
    ----------
    name : what was attacked and how.
    repeat : arguments of ``python -m tests.attack`` that repeat it.
    effective : whether the attack came in time; a signal may reach a command that has ended.
    findings : the faults.
    """

    name: str
    repeat: str
    effective: bool = True
    findings: tuple[Finding, ...] = ()


@dataclass
class Tally:
    """The sum of the points of one attack."""

    points: int = 0
    effective: int = 0
    found: Counter[str] = field(default_factory=Counter)
    failures: list[dict[str, Any]] = field(default_factory=list)

    def add(self, point: Point) -> None:
        """Count a point, and keep it if something was found."""
        self.points += 1
        self.effective += point.effective
        self.found.update(finding.kind for finding in point.findings)
        if point.findings:
            self.failures.append(asdict(point))


def table(tallies: dict[str, Tally]) -> str:
    """The sums of all attacks as a table of text."""
    heads = ("attack", "points", "in time", *KINDS)
    rows = [
        (name, *map(str, (tally.points, tally.effective, *(tally.found[kind] for kind in KINDS))))
        for name, tally in tallies.items()
    ]
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    return "\n".join(
        "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in [heads, *rows]
    )


def tracebacks(texts: Iterable[str]) -> list[Finding]:
    """A finding for every text of a command that holds a traceback, a crash or a warning of Python."""
    sign = re.compile(r"Traceback \(most recent|Fatal Python error|Segmentation fault|\w+Warning: |Exception ignored")
    return [Finding(kind="traceback", seen=text[-2000:]) for text in texts if sign.search(text)]
