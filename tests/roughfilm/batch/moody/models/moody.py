"""A model for the tests of batches: what it does depends on the Reynolds number, and it notes every attempt."""

import os
import signal
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.ladder.result import Field
from roughfilm.rom.pocket.models.reynolds import MODEL as REYNOLDS

DIVERGES, DIES, BREAKS, STOPS = 7.0, 8.0, 9.0, 9.5
SECONDS = float(os.environ.get("MOODY_SECONDS", "0"))
MEGABYTES = float(os.environ.get("MOODY_MEGABYTES", "0"))


def compute(model, scene, request, progress):
    with Path(os.environ["MOODY_NOTES"]).open("a") as notes:
        notes.write(f"{scene.reynolds_number:g}\n")
    if scene.reynolds_number == DIVERGES:
        raise ConvergenceError("moody: the residual grows;\nlower the Reynolds number", outcome=Outcome.DIVERGED)
    if scene.reynolds_number == STOPS:
        raise ConvergenceError("moody: its program was killed")
    if scene.reynolds_number == DIES:
        os.kill(os.getpid(), signal.SIGKILL)
    if scene.reynolds_number == BREAKS:
        raise TypeError("a fault in a model")
    time.sleep(SECONDS)
    result = REYNOLDS.compute(model, scene, request, progress)
    noise = np.random.default_rng(20051).random(int(MEGABYTES * 125_000))
    return replace(result, fields={**result.fields, "noise": Field(values=noise, unit="1")}) if noise.size else result


MODEL = replace(REYNOLDS, name="moody", compute=compute, cost=lambda _scene, _resolution: SECONDS)
