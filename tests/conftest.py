"""Scenes that the tests share, and skips with a reason."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

from foamcases.openfoam import availability
from rom.kind import Scene
from rom.scene import load_scene

POCKET = Path(__file__).parent.parent / "scripts" / "scenes" / "pocket.toml"
MEASURED = Path(__file__).parent.parent.parent / "shared" / "surfaces"
"""Instrument files that are not the project's own; ROUGHFILM_SURFACES may name another place."""

settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.register_profile("long", max_examples=5000, deadline=None)
settings.load_profile("fixed")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if any(item.get_closest_marker("openfoam") for item in items) and not availability().available:
        reason = f"OpenFOAM is not here: {availability().detail}"
        for item in items:
            if item.get_closest_marker("openfoam"):
                item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture(scope="session")
def measured_file():
    """The path of a measured surface by its name; skips where the files are absent."""
    folder = Path(os.environ.get("ROUGHFILM_SURFACES", MEASURED))

    def find(name: str) -> Path:
        if not folder.is_dir():
            pytest.skip(f"measured surfaces are not here: {folder} is absent")
        return folder / name

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
