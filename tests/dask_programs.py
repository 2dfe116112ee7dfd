"""A scheduler and workers of dask as programs of this machine, which end with the test."""

import json
import os
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest
from batches import MOODY, wait_for

from roughfilm.contact.foundation.child_processes import terminate_with_parent


class DaskPrograms:
    """The programs, whose logs and files are in a directory; the address of the scheduler once it runs."""

    def __init__(self, place: Path) -> None:
        pytest.importorskip("distributed")
        self.place, self.address = place, ""
        self.running: list[subprocess.Popen] = []
        place.mkdir()
        self.preload = place / "preload.py"
        self.preload.write_text(
            f"from roughfilm.rom.pocket import models\nmodels.__path__.append({str(MOODY / 'models')!r})\n"
        )

    def scheduler(self, *arguments: object) -> subprocess.Popen:
        file = self.place / "scheduler.json"
        place = ("--host", "127.0.0.1", "--port", 0, "--scheduler-file", file)
        started = self._start("dask_scheduler", [*place, *arguments], {})
        wait_for(lambda: file.exists() and file.read_text())
        self.address = json.loads(file.read_text())["address"]
        return started

    def workers(self, count: int, *arguments: object, **environment: str) -> list[subprocess.Popen]:
        """Workers of one thread that have the model moody; returns when all are registered."""
        first = len(self.running)
        options = [self.address, "--nthreads", 1, "--no-nanny", "--death-timeout", 60, "--preload", self.preload]
        started = [self._start("dask_worker", [*options, *arguments], environment) for _ in range(count)]
        for number in range(first, first + count):
            wait_for(partial(lambda log: "Registered to" in log.read_text(), self.place / f"log-{number}"))
        return started

    def end(self) -> None:
        for process in reversed(self.running):
            process.kill()
            process.wait()

    def _start(self, program: str, arguments: list[object], environment: dict[str, str]) -> subprocess.Popen:
        command = [
            *terminate_with_parent(),
            sys.executable,
            "-m",
            f"distributed.cli.{program}",
            *map(str, arguments),
            "--no-dashboard",
        ]
        place = {"MOODY_NOTES": str(self.place / "notes"), "DASK_TEMPORARY_DIRECTORY": str(self.place)}
        variables = {**os.environ, **place, **environment}
        with (self.place / f"log-{len(self.running)}").open("w") as log:
            self.running.append(subprocess.Popen(command, env=variables, stdout=log, stderr=log))
        return self.running[-1]
