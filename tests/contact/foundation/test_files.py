"""A file is whole or absent, whatever happens while it is written, and replaces no input and no other kind of file."""

import errno
import fcntl
import os

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import locked, replacing, write_json
from roughfilm.contact.foundation.toml import read_toml
from roughfilm.contact.foundation.writing.kinds import PAGE, as_input, beginning_with

TEXT = beginning_with("a text", b"old", b"new")


@pytest.fixture(autouse=True)
def no_inputs(monkeypatch):
    monkeypatch.setattr("roughfilm.contact.foundation.writing.kinds._inputs", {})


def test_failure_leaves_the_old_file_and_nothing_beside_it(tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old")

    def write_half():
        with replacing(target, TEXT) as scratch:
            scratch.write_text("half")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        write_half()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_reader_sees_the_old_file_until_the_new_one_is_whole(tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old")
    with replacing(target, TEXT) as scratch:
        scratch.write_text("new")
        assert target.read_text() == "old"
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


def test_missing_directories_are_made(tmp_path):
    with replacing(tmp_path / "b" / "c" / "a.txt", TEXT) as scratch:
        scratch.write_text("x")
    assert (tmp_path / "b" / "c" / "a.txt").read_text() == "x"


def test_a_file_in_the_way_of_the_directory_is_named(tmp_path):
    (tmp_path / "b").write_text("")
    with pytest.raises(InputError, match="cannot be written"), replacing(tmp_path / "b" / "a.txt", TEXT):
        pass


def test_a_device_or_pipe_is_never_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(InputError, match="is a device or a pipe"), replacing(pipe, TEXT):
        pass
    assert pipe.is_fifo()


def test_a_link_stays_a_link(tmp_path):
    target, link = tmp_path / "a.txt", tmp_path / "link.txt"
    target.write_text("old")
    link.symlink_to(target)
    with replacing(link, TEXT) as scratch:
        scratch.write_text("new")
    assert link.is_symlink()
    assert target.read_text() == "new"


def test_a_directory_is_refused(tmp_path):
    with pytest.raises(InputError, match="is a directory"), replacing(tmp_path, TEXT):
        pass


@pytest.mark.parametrize("overwrite", [False, True])
def test_only_its_own_kind_is_replaced_unless_the_user_allows_another(tmp_path, overwrite):
    target = tmp_path / "a.txt"
    target.write_text("a letter")

    def write():
        with replacing(target, TEXT, overwrite=overwrite) as scratch:
            scratch.write_text("new")

    if overwrite:
        write()
        assert target.read_text() == "new"
    else:
        with pytest.raises(InputError, match="exists and is not a text; name another place or remove it"):
            write()
        assert target.read_text() == "a letter"
    assert list(tmp_path.iterdir()) == [target]


def test_an_empty_file_is_replaced(tmp_path):
    target = tmp_path / "a.txt"
    target.touch()
    with replacing(target, TEXT) as scratch:
        scratch.write_text("new")
    assert target.read_text() == "new"


@pytest.mark.parametrize("name", ["a.txt", "b/../a.txt", "symbolic.txt", "hard.txt"])
def test_an_input_is_never_replaced_by_whatever_name(tmp_path, name):
    target = tmp_path / "a.txt"
    target.write_text("old")
    (tmp_path / "b").mkdir()
    (tmp_path / "symbolic.txt").symlink_to(target)
    (tmp_path / "hard.txt").hardlink_to(target)
    as_input(target)
    with pytest.raises(InputError, match="is an input"), replacing(tmp_path / name, TEXT, overwrite=True):
        pass
    assert target.read_text() == "old"


def test_a_file_that_becomes_another_kind_meanwhile_is_kept(tmp_path):
    target = tmp_path / "a.txt"

    def write():
        with replacing(target, TEXT) as scratch:
            scratch.write_text("new")
            target.write_text("a letter")

    with pytest.raises(InputError, match="exists and is not"):
        write()
    assert target.read_text() == "a letter"
    assert list(tmp_path.iterdir()) == [target]


def test_what_is_read_as_toml_is_an_input(tmp_path):
    target = tmp_path / "a.toml"
    target.write_text("a = 1")
    read_toml(target, "a = 1")
    with pytest.raises(InputError, match="is an input"), replacing(target, TEXT, overwrite=True):
        pass


def test_a_file_in_the_place_of_a_removed_input_may_be_replaced(tmp_path):
    target, other = tmp_path / "a.txt", tmp_path / "b.txt"
    target.write_text("old")
    as_input(target)
    target.rename(other)
    target.write_text("old")
    with replacing(target, TEXT) as scratch:
        scratch.write_text("new")
    assert target.read_text() == "new"
    assert other.read_text() == "old"


def test_entries_replace_entries_that_begin_with_the_same_key(tmp_path):
    own, other = tmp_path / "own.json", tmp_path / "package.json"
    write_json({"family": "a", "n": 1}, own)
    write_json({"family": "b"}, own)
    assert own.read_text() == '{\n "family": "b"\n}\n'
    other.write_text('{\n  "name": "mine"\n}\n')
    with pytest.raises(InputError, match="exists and is not"):
        write_json({"family": "b"}, other)
    write_json({"family": "b"}, other, overwrite=True)
    assert other.read_text() == own.read_text()


def test_a_file_on_its_way_is_named_by_its_final_place(tmp_path):
    def full(path):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    with (
        pytest.raises(InputError, match=rf"^{tmp_path}/page\.html: cannot be written \(No space left"),
        replacing(tmp_path / "page.html", PAGE) as outer,
        replacing(outer, PAGE) as inner,
    ):
        full(inner)
    assert not [*tmp_path.iterdir()]


def test_a_file_system_without_locks_is_not_taken_for_another_process(tmp_path, monkeypatch):
    def lacking(_file, _operation):
        raise OSError(errno.ENOSYS, "Function not implemented")

    monkeypatch.setattr(fcntl, "flock", lacking)
    with (
        pytest.raises(InputError, match=r"cannot be locked \(Function not implemented\)"),
        locked(tmp_path / "l", "other"),
    ):
        pass
