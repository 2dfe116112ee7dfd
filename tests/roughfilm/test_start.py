"""What is imported before anything is computed: no more than the command at hand needs."""

import importlib
import inspect
import subprocess
import sys

import pytest

from roughfilm.cli.main import COMMANDS, MODULES

SLOW = ("matplotlib", "pyvista", "numba", "pint", "foamlib", "pyfftw", "scipy.interpolate", "scipy.optimize")

COMMAND = "import sys; sys.argv = ['roughfilm', '--help']; from roughfilm.cli.main import main; main()"


def imported(program):
    """The modules that a program has imported at its end."""
    listed = f"import atexit, sys; atexit.register(lambda: print(*sys.modules, file=sys.stderr)); {program}"
    done = subprocess.run([sys.executable, "-c", listed], capture_output=True, text=True, timeout=120, check=True)
    return set(done.stderr.split())


@pytest.mark.parametrize(
    ("program", "absent"),
    [
        ("import roughfilm", (*SLOW, "typer")),
        (COMMAND, (*SLOW, "numpy", "pydantic", "roughfilm.rom", "roughfilm.cli.first_steps.solve")),
    ],
)
def test_nothing_slow_is_imported_where_it_is_not_needed(program, absent):
    assert not imported(program).intersection(absent)


@pytest.mark.parametrize("kind", ["bearing", "dry_contact", "pocket", "rough_gap", "seal"])
def test_a_kind_and_its_models_import_no_more_than_their_data_needs(kind):
    models = f"from roughfilm.rom.ladder.model import ladder; ladder(rom, foamcases, kind='{kind}')"
    program = f"import roughfilm.rom.{kind}.kind; from roughfilm import foamcases, rom; {models}"
    assert not imported(program).intersection((*SLOW, "typer"))


@pytest.mark.parametrize("name", COMMANDS)
def test_the_table_of_commands_gives_the_first_paragraph_of_their_help(name):
    command = importlib.import_module(MODULES[name]).command
    assert COMMANDS[name] == " ".join(inspect.getdoc(command).partition("\n\n")[0].split())
