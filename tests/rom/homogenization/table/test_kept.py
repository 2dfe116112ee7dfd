"""Tables in the cache: the same to the last digit, continued after a stop, made again after damage."""

import subprocess
import sys
import textwrap
from dataclasses import fields

import numpy as np
import pytest

from roughfilm.contact.foundation import cache
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.table import kept
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.kept import kept_table, table_inputs
from roughfilm.rom.homogenization.table.tabulate import tabulate
from roughfilm.rom.ladder.model import silent

SPACING = (1e-5, 1e-5)
ABOUT = {"surface": "egg box", "kind": "flow factors"}


@pytest.fixture
def heights() -> np.ndarray:
    x = 2 * np.pi * np.arange(12) / 12
    return 1e-6 * np.add.outer(np.cos(x), np.sin(x))


def inputs(heights, **settings):
    return table_inputs(heights, SPACING, "rom.homogenization.table.tabulate", **settings)


def made(heights, solved: list[Point], *, stop_after: int | None = None) -> FactorTable:
    """The table, from the cache or made; ``solved`` collects the new points."""

    def keep(point: Point) -> None:
        solved.append(point)
        if len(solved) == stop_after:
            raise KeyboardInterrupt

    def work(known, keep):
        return tabulate(heights, SPACING, tolerance=0.05, known=known, keep=keep)

    return kept_table(inputs(heights, tolerance=0.05), work, about=ABOUT, keep=keep, progress=silent)


def numbers(table: FactorTable) -> list[object]:
    """All numbers of a table but the CPU times."""
    found: list[object] = [table.peak, table.rms]
    for point in table.points:
        for entry in fields(Point):
            value = getattr(point, entry.name)
            if isinstance(value, FlowFactors):
                found += [np.asarray(getattr(value, part.name)).tobytes() for part in fields(FlowFactors)]
            elif entry.name != "cpu_s":
                found.append(np.asarray(value).tobytes())
    return found


def test_a_kept_table_is_the_same_to_the_last_bit_and_solves_nothing(heights):
    first, second = [], []
    one, other = made(heights, first), made(heights, second)
    alone = tabulate(heights, SPACING, tolerance=0.05)
    assert len(first) >= len(one.points)
    assert second == []
    assert numbers(one) == numbers(other) == numbers(alone)
    assert (one.origin["kept"], other.origin["kept"]) == (False, True)
    assert (one.origin["stored"], other.origin["stored"]) == (True, True)
    assert one.origin["digest"] == other.origin["digest"]


def test_another_surface_or_setting_is_another_entry(heights):
    digests = {
        inputs(heights, tolerance=0.05).digest,
        inputs(heights, tolerance=0.04).digest,
        inputs(heights * 1.0000001, tolerance=0.05).digest,
    }
    assert len(digests) == 3


def test_a_stopped_table_goes_on(heights):
    first, second = [], []
    with pytest.raises(KeyboardInterrupt) as stop:
        made(heights, first, stop_after=6)
    (note,) = stop.value.__notes__
    assert note.endswith("points; the same command goes on")
    table = made(heights, second)
    assert not {point.separation for point in first} & {point.separation for point in second}
    assert numbers(table) == numbers(tabulate(heights, SPACING, tolerance=0.05))


@pytest.mark.parametrize("damage", [b"", b"no table", None])
def test_a_damaged_entry_is_made_again(heights, damage):
    first, second, third = [], [], []
    table = made(heights, first)
    (entry,) = cache.entries()
    content = bytearray(entry.path.read_bytes())
    content[len(content) // 2] ^= 1
    entry.path.write_bytes(bytes(content) if damage is None else damage)
    assert numbers(made(heights, second)) == numbers(table)
    assert len(second) == len(first)
    made(heights, third)
    assert third == []


def test_without_a_directory_the_table_is_made(heights, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ROUGHFILM_CACHE", str(tmp_path / "file"))
    solved = []
    table = made(heights, solved)
    assert len(solved) >= len(table.points)
    assert (table.origin["kept"], table.origin["stored"]) == (False, False)


def test_a_full_disk_costs_the_entry_and_not_the_table(heights, monkeypatch, caplog):
    def full(path, *_):
        raise InputError(f"{path}: cannot be written (No space left on device); choose another place")

    monkeypatch.setattr(kept, "save_table", full)
    assert made(heights, []).points
    assert len(caplog.records) == 1
    assert not cache.entries()


def test_points_from_elsewhere_are_used_and_not_kept(heights):
    known = tabulate(heights, SPACING, tolerance=0.05).points
    work = lambda known, keep: tabulate(heights, SPACING, tolerance=0.05, known=known, keep=keep)  # noqa: E731
    solved = []
    kept_table(
        inputs(heights, tolerance=0.05), work, about=ABOUT, foreign=known[:5], keep=solved.append, progress=silent
    )
    assert not {point.separation for point in known[:5]} & {point.separation for point in solved}
    assert not cache.entries()


PROGRAM = """
    import os, sys
    import numpy as np
    from roughfilm.rom.homogenization.table.kept import kept_table, table_inputs
    from roughfilm.rom.homogenization.table.tabulate import tabulate

    x = 2 * np.pi * np.arange(12) / 12
    heights = 1e-6 * np.add.outer(np.cos(x), np.sin(x))
    solved = []

    def keep(point):
        solved.append(point)
        if sys.argv[1:] and len(solved) == int(sys.argv[1]):
            os.kill(os.getpid(), 9)

    table = kept_table(
        table_inputs(heights, (1e-5, 1e-5), "rom.homogenization.table.tabulate", tolerance=0.05),
        lambda known, keep: tabulate(heights, (1e-5, 1e-5), tolerance=0.05, known=known, keep=keep),
        about={}, keep=keep, progress=lambda done, words: None,
    )
    print(len(solved), len(table.points), table.points[3].factors.pressure.tobytes().hex())
"""


def started(*arguments: str) -> "subprocess.Popen[str]":
    program = [sys.executable, "-c", textwrap.dedent(PROGRAM), *arguments]
    return subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


@pytest.mark.slow
def test_processes_at_the_same_time_make_a_table_once():
    running = [started() for _ in range(3)]
    answers = [process.communicate()[0].split() for process in running]
    assert [process.returncode for process in running] == [0, 0, 0]
    solved = sorted(int(answer[0]) for answer in answers)
    assert solved[:2] == [0, 0]
    assert solved[2] > 0
    assert len({tuple(answer[1:]) for answer in answers}) == 1


@pytest.mark.slow
def test_a_killed_process_leaves_a_cache_that_works(heights):
    killed = started("9")
    killed.communicate()
    assert killed.returncode == -9
    assert numbers(made(heights, [])) == numbers(tabulate(heights, SPACING, tolerance=0.05))
