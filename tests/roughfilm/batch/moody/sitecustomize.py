"""The model ``moody`` on the ladder of every Python that has this folder in ``PYTHONPATH``, and of its workers."""

from pathlib import Path

from roughfilm.rom.pocket import models

models.__path__.append(str(Path(__file__).parent / "models"))
