"""A model for the tests of clusters, which needs a program that only some machines have."""

import os
from dataclasses import replace

from roughfilm.rom.ladder.model import Availability
from roughfilm.rom.pocket.models.reynolds import MODEL as REYNOLDS


def available():
    version = os.environ.get("FITTER_VERSION")
    absent = "no fitter on the PATH; install it with: fetch fitter"
    return Availability(available=version is not None, detail=f"fitter {version}" if version else absent)


MODEL = replace(REYNOLDS, name="fitted", available=available)
