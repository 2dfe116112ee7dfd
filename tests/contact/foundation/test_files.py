"""A file is whole or absent, whatever happens while it is written."""

import os

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing


def test_failure_leaves_the_old_file_and_nothing_beside_it(tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old")

    def write_half():
        with replacing(target) as scratch:
            scratch.write_text("half")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        write_half()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_reader_sees_the_old_file_until_the_new_one_is_whole(tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old")
    with replacing(target) as scratch:
        scratch.write_text("new")
        assert target.read_text() == "old"
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


def test_missing_directories_are_made(tmp_path):
    with replacing(tmp_path / "b" / "c" / "a.txt") as scratch:
        scratch.write_text("x")
    assert (tmp_path / "b" / "c" / "a.txt").read_text() == "x"


def test_a_file_in_the_way_of_the_directory_is_named(tmp_path):
    (tmp_path / "b").write_text("")
    with pytest.raises(InputError, match="cannot be written"), replacing(tmp_path / "b" / "a.txt"):
        pass


def test_a_device_or_pipe_is_never_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(InputError, match="is a device or a pipe"), replacing(pipe):
        pass
    assert pipe.is_fifo()


def test_a_link_stays_a_link(tmp_path):
    target, link = tmp_path / "a.txt", tmp_path / "link.txt"
    target.write_text("old")
    link.symlink_to(target)
    with replacing(link) as scratch:
        scratch.write_text("new")
    assert link.is_symlink()
    assert target.read_text() == "new"


def test_a_directory_is_refused(tmp_path):
    with pytest.raises(InputError, match="is a directory"), replacing(tmp_path):
        pass
