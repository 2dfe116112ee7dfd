"""The attacks by name: each is a function of a number of points and a seed that yields points."""

import os
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from attack.points import Finding, Point

SIGNS = {
    "traceback": "Traceback|Fatal Python|ended with status|exit -",
    "hang": "[Ee]ndless|no end",
    "scratch": "temporary|left",
    "incomplete": "incomplete|not complete|not whole",
}
"""Patterns of words on a fault by which it is of a kind; every other fault is a wrong answer."""


@dataclass(frozen=True, kw_only=True)
class Attack:
    """An attack: what it does, in words, its usual number of points, and the function that makes them."""

    about: str
    count: int
    points: Callable[..., Iterator[Point]]


def _kills(count: int, seed: int, commands: Sequence[str] = ()) -> Iterator[Point]:
    from attack import kills

    return kills.points(count, seed, commands)


def _mutated_scenes(count: int, seed: int) -> Iterator[Point]:
    from attack.mutated_scenes import answered

    os.environ |= {"ROUGHFILM_PROGRESS": "off", "COLUMNS": "4000"}
    with tempfile.TemporaryDirectory(prefix="mutated-") as place:
        os.environ["ROUGHFILM_CACHE"] = f"{place}/cache"
        for number in range(seed, seed + count):
            answer = answered(number, Path(place))
            words = answer.words if answer.outcome == "fault" else ""
            yield _point(
                f"{answer.scene}: {'; '.join(answer.mutations)}", f"mutated_scenes --seed {number} --count 1", words
            )


def _damaged_files(count: int, seed: int) -> Iterator[Point]:
    from attack.damaged_files import answers

    for answer in answers(range(seed, seed + count)):
        words = (answer.words or "no word") if answer.outcome == "fault" else ""
        yield _point(f"{answer.kind}: {answer.damage}", f"damaged_files --seed {answer.seed} --count 1", words)


def _full_disk(count: int, seed: int, commands: Sequence[str] = ()) -> Iterator[Point]:
    from attack import full_disk

    return full_disk.points(count, seed, commands)


def _point(name: str, repeat: str, words: str) -> Point:
    """A point with the fault that the words describe; without one where they are empty."""
    if not words:
        return Point(name=name, repeat=repeat)
    kind = next((kind for kind, sign in SIGNS.items() if re.search(sign, words)), "answer")
    return Point(name=name, repeat=repeat, findings=(Finding(kind=kind, seen=words[-2000:]),))


ATTACKS: Mapping[str, Attack] = {
    "mutated_scenes": Attack(about="scenes with one or two entries changed", count=5000, points=_mutated_scenes),
    "damaged_files": Attack(about="damaged and forged files of every kind", count=10_000, points=_damaged_files),
    "full_disk": Attack(about="commands that write on a full disk", count=200, points=_full_disk),
    "kills": Attack(about="signals at random moments of commands that write", count=300, points=_kills),
}
"""The attacks by the name of their module."""
