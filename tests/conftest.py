"""Scenes that the tests share, and skips with a reason."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings
from places import MEASURED, ROOT, SAMPLES, SCENES

from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import load_scene

POCKET = SCENES / "pocket.toml"

LONG_FILES = (
    "roughfilm/batch/test_cluster.py",
    "roughfilm/batch/test_batch.py",
    "roughfilm/generated/test_generated.py",
    "attack/test_attack.py",
    "test_transcripts.py",
    "rom/ladder/test_properties.py",
    "roughfilm/stability/test_thermal.py",
    "roughfilm/cli/first_steps/test_compare.py",
    "roughfilm/pages/test_browser.py",
    "attack/test_damaged_files.py",
)
"""The files that take longest (14 s of CPU time and more), which come first: nothing long is left beside the last one.

The first of them start programs and wait for them, while types are checked and the manual is built. The pages that
``test_transcripts`` runs need nearly all kernels; most of these are compiled by then, where the manual is built.
"""

for name in ("FORCE_COLOR", "NO_COLOR", "PY_COLORS", "GITHUB_ACTIONS", "TTY_COMPATIBLE", "TTY_INTERACTIVE", "LINES"):
    os.environ.pop(name, None)  # what a terminal or a build service says about itself; typer reads some at its import
os.environ["COLUMNS"] = "400"  # before any console is made: no test of words depends on where a line is broken

settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.register_profile("long", max_examples=5000, deadline=None)
settings.load_profile("fixed")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    order = {ROOT / "tests" / name: place for place, name in enumerate(LONG_FILES)}
    items.sort(key=lambda item: order.get(item.path, len(order)))
    if any(item.get_closest_marker("openfoam") for item in items) and not availability().available:
        reason = f"OpenFOAM is not here: {availability().detail}"
        for item in items:
            if item.get_closest_marker("openfoam"):
                item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture(scope="session", autouse=True)
def default_signals() -> Iterator[None]:
    """Signals that the shell ignores or blocks (nohup, a command in the background) act here and in all children."""
    inherited = {
        number: signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGCHLD)
        if signal.getsignal(number) is signal.SIG_IGN
    }
    mask = signal.pthread_sigmask(signal.SIG_SETMASK, set())
    yield
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    for number, handler in inherited.items():
        signal.signal(number, handler)


@pytest.fixture(scope="session")
def measured_file():
    """The path of a measured surface by its name; skips where the files are absent."""

    def find(name: str) -> Path:
        known = next((folder / name for folder in (SAMPLES, MEASURED) if (folder / name).is_file()), None)
        for folder in (MEASURED, SAMPLES):
            if known is None and not folder.is_dir():
                pytest.skip(f"{name} is not here: {folder} is absent")
        return known or MEASURED / name

    return find


@pytest.fixture
def pocket_file() -> Path:
    return POCKET


@pytest.fixture
def make_scene():
    """A pocket from the dimensionless numbers of the source: w+ = w/Lx, d+ = d/Ly, Re."""

    def make(width_plus: float, depth_plus: float, reynolds_number: float) -> Scene:
        return load_scene(
            POCKET,
            [
                f"geometry.width={width_plus!r} mm",
                f"geometry.depth={depth_plus * 30!r} um",
                f"motion.reynolds_number={reynolds_number!r}",
            ],
        )

    return make
