"""Standard streams that are closed, full, or have lost their reader."""

import os

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.terminal.streams import _Stream


def test_what_a_reader_that_has_ended_would_get_is_left_out():
    reader, writer = os.pipe()
    os.close(reader)
    with _Stream(writer, "wb") as stream:
        assert stream.write(b"four") == 4
        assert stream.write(b"more") == 4


def test_a_full_device_is_an_error_once():
    with _Stream(os.open("/dev/full", os.O_WRONLY), "wb") as stream:
        with pytest.raises(InputError, match=r"standard output: cannot be written \(No space left"):
            stream.write(b"lost")
        assert stream.write(b"what the buffer above it still holds") == 36
