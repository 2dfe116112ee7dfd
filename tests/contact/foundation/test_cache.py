"""The cache of files: place, bound, order of removal, locks, and machines where nothing can be kept."""

import os
import threading
import time

import pytest

from roughfilm.contact.foundation import cache
from roughfilm.contact.foundation.timing import claimed_costs, one_time, working_time
from roughfilm.contact.foundation.writing.scratch import HOST


def entry(number: int, size: int, age: float) -> str:
    path = cache.entry_path("tables", f"{number:064x}")
    assert path is not None
    path.write_bytes(bytes(size))
    used = time.time() - age
    os.utime(path, (used, used))
    return path.name


def names() -> list[str]:
    return [one.path.name for one in cache.entries()]


def test_the_entry_unused_for_the_longest_time_goes_first():
    old, older, new = entry(1, 100, 20.0), entry(2, 100, 30.0), entry(3, 100, 10.0)
    assert names() == [older, old, new]
    cache.use(cache.user_directory() / "tables" / older)
    assert [one.path.name for one in cache.trim(200)] == [old]
    assert names() == [new, older]


def test_what_is_no_entry_is_never_removed():
    entry(1, 100, 0.0)
    folder = cache.user_directory() / "tables"
    (folder / "notes.h5").write_bytes(bytes(500))
    (cache.user_directory() / f"{2:064x}.h5").write_bytes(bytes(500))
    assert len(cache.trim(0)) == 1
    assert (folder / "notes.h5").exists()
    assert (cache.user_directory() / f"{2:064x}.h5").exists()


def test_what_killed_processes_leave_is_removed_and_their_locks_after_a_day():
    name = entry(1, 10, 0.0)
    folder = cache.user_directory() / "tables"
    old, fresh = (folder / f"{number:064x}.lock" for number in (1, 2))
    left = folder / f".roughfilm-{HOST}-0123abcd"
    left.mkdir()
    (left / name).write_bytes(b"half")
    for path in (old, fresh, left.with_suffix(".lock")):
        path.touch()
    os.utime(old, (0, 0))
    assert cache.trim() == []
    assert {path.name for path in folder.iterdir()} == {name, fresh.name}


def test_the_variable_names_the_directory_before_the_home_of_caches(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home"))
    monkeypatch.setenv("ROUGHFILM_CACHE", str(tmp_path / "own"))
    assert cache.user_directory() == tmp_path / "own"
    monkeypatch.delenv("ROUGHFILM_CACHE")
    assert cache.user_directory() == tmp_path / "home" / "roughfilm"


def test_a_directory_that_cannot_be_made_is_reported_once(monkeypatch, tmp_path, caplog):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ROUGHFILM_CACHE", str(tmp_path / "file"))
    assert [cache.entry_path("tables", "0" * 64) for _ in range(3)] == [None] * 3
    (record,) = caplog.records
    assert "nothing is kept for later runs" in record.getMessage()
    assert "set ROUGHFILM_CACHE" in record.getMessage()


def test_a_second_writer_waits_for_the_first():
    path = cache.entry_path("tables", "1" * 64)
    order, holds, waited = [], threading.Event(), threading.Event()

    def first() -> None:
        with cache.alone_with(path, lambda: None):
            holds.set()
            assert waited.wait(60)
            order.append("first")

    other = threading.Thread(target=first)
    other.start()
    assert holds.wait(60)
    with cache.alone_with(path, waited.set):
        order.append("second")
    other.join()
    assert order == ["first", "second"]


def test_a_cost_within_another_counts_once():
    claimed_costs()
    clock = iter([0.0, 1.0, 4.0, 10.0])
    read = lambda: next(clock)  # noqa: E731
    with one_time("table", read), one_time("compilation", read):
        pass
    found = claimed_costs()
    assert found == pytest.approx({"table": 7.0, "compilation": 3.0})
    assert list(found) == ["table", "compilation"]
    assert claimed_costs() == {}


def test_one_time_costs_are_no_work():
    with one_time("example", iter([0.0, 1000.0]).__next__):
        before = working_time()
    assert working_time() < before - 900
