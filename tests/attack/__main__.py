"""Attack the program by hand: ``python -m tests.attack --all``, or ``python -m tests.attack kills --count 300``."""

import argparse
import json
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # the modules of the tests import each other from there

from attack.attacks import ATTACKS
from attack.points import Point, Tally, table

BY_COMMAND = ("full_disk", "kills")
"""Attacks on commands, which ``--command`` names."""

SHOWN_S = 10.0
"""Time between two lines about progress, s."""


def main() -> int:
    """Run attacks, print their sums, and write what was found; the exit code is 1 if anything was."""
    names = "; ".join(f"{name}: {attack.about}" for name, attack in ATTACKS.items())
    parser = argparse.ArgumentParser(prog="python -m tests.attack", description=__doc__)
    parser.add_argument("attacks", nargs="*", metavar="ATTACK", help=names)
    parser.add_argument("--all", action="store_true", help="all attacks")
    parser.add_argument("--count", type=int, help="number of points of each attack (default: its usual number)")
    parser.add_argument("--seed", type=int, default=0, help="seed of the first point (default: 0)")
    parser.add_argument("--failures", type=Path, default=Path("attack.json"), help="file of what is found")
    parser.add_argument("--command", action="append", help="full_disk and kills: a command of attack/commands.py")
    asked = parser.parse_args()
    chosen = list(ATTACKS) if asked.all else asked.attacks
    if not chosen or set(chosen) - set(ATTACKS):
        parser.error(f"name attacks ({', '.join(ATTACKS)}), or give --all")
    tallies = {name: Tally() for name in chosen}
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with suppress(KeyboardInterrupt):  # what is done so far is shown
        for name, tally in tallies.items():
            options = {"commands": asked.command} if name in BY_COMMAND and asked.command else {}
            count = asked.count or ATTACKS[name].count
            for point in _shown(name, count, ATTACKS[name].points(count, asked.seed, **options)):
                tally.add(point)
    asked.failures.write_text(json.dumps({name: vars(one) for name, one in tallies.items()}, indent=1) + "\n")
    sys.stdout.write(f"{table(tallies)}\n")
    failed = sum(len(tally.failures) for tally in tallies.values())
    sys.stdout.write(f"{failed} points with faults; see {asked.failures}\n" if failed else "no faults\n")
    return int(failed > 0)


def _shown(name: str, count: int, points: Iterator[Point]) -> Iterator[Point]:
    """The points, with lines on standard error: the number done, the time left, and what was found."""
    start = shown = time.monotonic()
    for number, point in enumerate(points, start=1):
        for finding in point.findings:
            sys.stderr.write(f"{finding.kind}: {point.name}: {finding.seen:.300} [{point.repeat}]\n")
        now = time.monotonic()
        if now - shown > SHOWN_S or number == count:
            shown = now
            left = (now - start) * max(0, count - number) / number
            sys.stderr.write(f"{name}: {number} of {count}, {now - start:.0f} s, about {left:.0f} s left\n")
        yield point


if __name__ == "__main__":
    sys.exit(main())
