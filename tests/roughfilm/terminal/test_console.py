"""What the terminal makes of exceptions that end a command."""

import pytest

from roughfilm.terminal.console import in_one_line


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit])
def test_the_note_of_what_stops_a_command_is_printed_and_the_command_stops(kind, capsys):
    def command() -> None:
        stop = kind(130)
        stop.add_note("stopped: 3 of 5 loads; the same command goes on")
        raise stop

    with pytest.raises(kind):
        in_one_line(command)()
    assert capsys.readouterr().err == "stopped: 3 of 5 loads; the same command goes on\n"


def test_a_stop_without_a_note_prints_nothing(capsys):
    def command() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        in_one_line(command)()
    assert capsys.readouterr().err == ""
