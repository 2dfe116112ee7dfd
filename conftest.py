"""Tests and examples keep nothing in the cache of the user, and their messages do not depend on their duration.

Linear algebra runs in one thread here and in all children, since two processes of tests share the cores: threads that
wait for each other in loops take several times as long as one.
"""

import os
import shutil
import tempfile

import pytest

CACHE = "ROUGHFILM_CACHE"

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # read when numpy is imported, which is later


@pytest.fixture(autouse=True)
def _apart_from_the_user(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give each test an empty cache, and no lines about progress."""
    monkeypatch.setenv("ROUGHFILM_PROGRESS", "off")
    monkeypatch.setenv(CACHE, str(tmp_path_factory.getbasetemp() / "cache" / os.urandom(8).hex()))


def pytest_configure(config: pytest.Config) -> None:
    """Give what runs outside of a test, such as fixtures of a module, a cache that ends with the run."""
    place = os.environ[CACHE] = tempfile.mkdtemp(prefix="roughfilm-cache-")
    config.add_cleanup(lambda: shutil.rmtree(place, ignore_errors=True))
