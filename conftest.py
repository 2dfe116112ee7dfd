"""Tests and examples keep nothing in the cache of the user, and their messages do not depend on their duration.

Linear algebra runs in one thread here and in all children, since two processes of tests share the cores: threads that
wait for each other in loops take several times as long as one.
"""

import gc
import os
import shutil
import sys
import tempfile
import threading
import time

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
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(Collecting())


def pytest_collectstart() -> None:
    """Look for no unused cycles of objects while modules are imported, which takes a tenth of the time."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Leave what has been imported and collected out of this search, which takes a twentieth of the time of tests."""
    gc.freeze()
    gc.enable()


class Collecting:
    """Says how long tests have been collected, every so many seconds, where pytest says nothing of its processes."""

    def __init__(self, every: float = 15.0) -> None:
        self.every = every
        self.ended = threading.Event()

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection(self) -> None:
        """Begin to say it, of this process and of those that it has started."""
        threading.Thread(target=self._wait, args=(time.monotonic(),), daemon=True).start()

    def _wait(self, begun: float) -> None:
        while not self.ended.wait(self.every):
            sys.stderr.write(f"test: collecting, {time.monotonic() - begun:.0f} s\n")

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """End it, of the tests of this process; there are none if others collect them."""
        if session.items:
            self.ended.set()

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_node_collection_finished(self) -> None:
        """End it at the first of several processes that has collected all."""
        self.ended.set()

    def pytest_sessionfinish(self) -> None:
        """End it after an error."""
        self.ended.set()
