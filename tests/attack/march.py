"""March plates that close through time, and keep the loads reached so far in a file after every step."""

from pathlib import Path

import numpy as np
from roughfilm.rom.cavitation.transient import march

from roughfilm.contact.foundation.files import write_json
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape


def closing(time: float) -> Problem:
    """A wedge whose walls approach each other."""
    shape = Shape(thickness=lambda x, y: (1 - 0.3 * time) * (1.5 - x) + 0 * y, breaks=(0.0, 1.0))
    return Problem(shape=shape, ends=Ends(), speed=1.0, viscosity=1e-3)


if __name__ == "__main__":
    loads = {}
    for time, film in march(closing, (100, 1), np.linspace(0.0, 0.5, 41)):
        loads[f"{time:.4f}"] = float(film.state.pressure.mean())
        write_json({"mean_pressure": loads}, Path("march.json"))
