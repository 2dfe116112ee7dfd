"""March plates that close through time, and keep the loads reached so far in a file after every step."""

from pathlib import Path

import numpy as np
from roughfilm.rom.cavitation.transient import march

from roughfilm.contact.foundation.files import write_json
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.motion.coupled import full_film
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.motion.march import Course, begun, march
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape


def wedge() -> MovingFilm:
    """A wedge whose walls approach each other."""
    shape = Shape(thickness=lambda x, y: 0.5 - x + 0 * y, breaks=(0.0, 1.0))
    problem = Problem(shape=shape, ends=Ends(inlet=0.0), speed=1.0, viscosity=1e-3)
    return MovingFilm(problem=problem, grid=grid(shape, (100, 1)), normals=(lambda x, y: 1 + 0 * x + 0 * y,))


COURSE = Course(
    free=np.zeros(1, dtype=bool),
    place=lambda time: np.array([1 - 0.3 * time]),
    speed=lambda _time: 1.0,
    force=lambda _time: np.zeros(1),
    mass=np.zeros((1, 1)),
    stiffness=np.zeros((1, 1)),
    velocity_scale=np.ones(1),
)


if __name__ == "__main__":
    loads = {}
    film = wedge()
    for moving in march(film, COURSE, begun(film, full_film(film, np.ones(1))), 0.5, largest_step=0.0125, error=None):
        loads[f"{moving.now.time:.4f}"] = float(moving.instant.state.pressure.mean())
        write_json({"mean_pressure": loads}, Path("march.json"))
