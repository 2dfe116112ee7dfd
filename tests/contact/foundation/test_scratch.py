"""A scratch directory ends with its process, or is removed by the next one, which removes nothing that is in use."""

import errno
import fcntl
import os
import signal
import subprocess
import sys
import tempfile
import threading

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing import scratch
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.contact.foundation.writing.scratch import scratch_directory, sweep

KILLED = """
import os, signal, sys
from pathlib import Path
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.contact.foundation.writing.scratch import scratch_directory
with scratch_directory() as place, replacing(Path(sys.argv[1]), beginning_with("a text", b"")) as half:
    (place / "field").write_bytes(b"0" * 1000)
    half.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """The temporary directory of the test."""
    place = tmp_path / "tmp"
    place.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(place))
    return place


def killed(directory, *, host=scratch.HOST):
    """What a killed process leaves in a directory: a scratch directory and its lock file."""
    lock = directory / f".roughfilm-{host}-0123abcd.lock"
    lock.touch()
    left = lock.with_suffix("")
    left.mkdir()
    (left / "field").write_text("half")
    return lock


@pytest.mark.parametrize("call", ["flock", "samestat", "rmdir"], ids=["locking", "made", "removing"])
def test_a_signal_to_stop_that_comes_while_it_is_made_or_removed_leaves_nothing(temporary, monkeypatch, call):
    module = fcntl if call == "flock" else os.path if call == "samestat" else os
    own = getattr(module, call)

    def stopped(*arguments, **options):
        os.kill(os.getpid(), signal.SIGINT)
        return own(*arguments, **options)

    monkeypatch.setattr(module, call, stopped)
    handlers = [signal.getsignal(number) for number in scratch.STOPS]
    end = threading.Event()
    other = threading.Thread(target=end.wait)  # the system may deliver the signal to any thread
    other.start()
    try:
        with pytest.raises(KeyboardInterrupt), scratch_directory():
            pass
    finally:
        end.set()
        other.join()
    assert list(temporary.iterdir()) == []
    assert [signal.getsignal(number) for number in scratch.STOPS] == handlers


def test_it_is_empty_and_removed_at_the_end_whatever_happens(temporary):
    def work():
        with scratch_directory() as place:
            assert list(place.iterdir()) == []
            assert place.parent == temporary
            (place / "a").mkdir()
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        work()
    assert list(temporary.iterdir()) == []


def test_what_a_killed_process_leaves_is_removed_at_the_next_use(temporary, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    command = [sys.executable, "-c", KILLED, str(out / "a.txt")]
    subprocess.run(command, env={**os.environ, "TMPDIR": str(temporary)}, check=False)
    assert len(list(temporary.iterdir())) == len(list(out.iterdir())) == 2
    with scratch_directory() as place:
        assert set(temporary.iterdir()) == {place, place.with_suffix(".lock")}
    with replacing(out / "b.txt", beginning_with("a text", b"")) as half:
        half.write_text("new")
    assert [path.name for path in out.iterdir()] == ["b.txt"]
    assert list(temporary.iterdir()) == []


def test_nothing_in_use_is_removed(tmp_path):
    with scratch_directory(beside=tmp_path / "a.txt") as place:
        (place / "field").write_text("half")
        sweep(tmp_path)
        assert (place / "field").read_text() == "half"
    lock = killed(tmp_path)
    with lock.open("a") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        sweep(tmp_path)
        assert lock.exists()
    sweep(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_nothing_of_another_machine_another_user_or_another_name_is_removed(tmp_path, monkeypatch):
    killed(tmp_path, host="ffffffff" if scratch.HOST != "ffffffff" else "00000000")
    (tmp_path / "roughfilm-notes.lock").touch()
    (tmp_path / "roughfilm-notes").mkdir()
    before = set(tmp_path.iterdir())
    sweep(tmp_path)
    assert set(tmp_path.iterdir()) == before
    lock = killed(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(os, "getuid", lambda: lock.stat().st_uid + 1)
        sweep(tmp_path)
    assert lock.exists()


def test_a_lock_that_is_a_link_is_not_followed(tmp_path):
    target = tmp_path / "mine"
    target.mkdir()
    (target / "thesis").touch()
    (tmp_path / "empty").touch()
    (tmp_path / f"roughfilm-{scratch.HOST}-0123abcd.lock").symlink_to(tmp_path / "empty")
    (tmp_path / f"roughfilm-{scratch.HOST}-0123abcd").symlink_to(target)
    sweep(tmp_path)
    assert (target / "thesis").exists()


def test_a_temporary_directory_that_cannot_be_written_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "missing"))
    with pytest.raises(InputError, match=r"missing.*cannot be written.*set TMPDIR"), scratch_directory():
        pass


@pytest.mark.usefixtures("temporary")
def test_an_error_of_another_place_is_not_one_of_the_temporary_directory(tmp_path):
    with pytest.raises(FileNotFoundError, match="elsewhere"), scratch_directory():
        (tmp_path / "elsewhere" / "file").read_bytes()
    with pytest.raises(InputError, match="set TMPDIR"), scratch_directory() as place:
        (place / "missing" / "file").write_text("half")
    with pytest.raises(InputError, match=r"free some space.*set TMPDIR"), scratch_directory():
        raise OSError(errno.ENOSPC, "No space left on device")


def test_the_temporary_directory_is_found_without_writing_into_it(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", None)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    os.utime(tmp_path, ns=(1, 1))
    assert scratch.temporary_directory() == tmp_path
    assert tmp_path.stat().st_mtime_ns == 1
