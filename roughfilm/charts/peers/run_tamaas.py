"""Tamaas: conjugate gradients of Polonsky, Keer and Rey; with a hardness, projected gradients (KatoSaturated)."""

import os
import tempfile
from pathlib import Path

import numpy as np
import tamaas

NAME = "tamaas"
SIDE = 6.0
"""Of the surface, in units where E* is 1. The gradients of KatoSaturated have a step of 1 in whatever units they are
given: it converges while side/(π E*), the largest compliance, is below 2, and fastest a little under that."""

MOST_ITERATIONS = 20000


def prepare(heights, problem):
    tamaas.set_log_level(tamaas.LogLevel.info)
    unit = SIDE / (problem["spacing"][0] * heights.shape[0])
    sides = [unit * n * step for n, step in zip(heights.shape, problem["spacing"], strict=True)]
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, sides, list(heights.shape))
    model.E, model.nu = 1.0, 0.0
    surface = heights * unit
    solvers = {}

    def solver(tolerance):
        if tolerance not in solvers:
            if problem["hardness"] is None:
                made = tamaas.PolonskyKeerRey(model, surface, tolerance)
            else:
                made = tamaas.KatoSaturated(model, surface, tolerance, problem["hardness"])
            made.max_iter, made.dump_freq = MOST_ITERATIONS, 10 * MOST_ITERATIONS
            solvers[tolerance] = made
        return solvers[tolerance]

    def solve(load, tolerance, start):
        if start is None:
            model.traction[:] = 0.0  # any other is where it begins from
        with heard() as lines:
            solver(tolerance).solve(load)
        return np.array(model.traction), last_iteration(lines), True

    return solve


class heard:  # noqa: N801
    """What the library writes to the standard error, as a list of lines once it is over."""

    def __enter__(self):
        self.lines = []
        self.kept = os.dup(2)
        self.file, self.name = tempfile.mkstemp()
        os.dup2(self.file, 2)
        return self.lines

    def __exit__(self, *_):
        os.dup2(self.kept, 2)
        os.close(self.kept)
        os.close(self.file)
        self.lines += Path(self.name).read_text().splitlines()
        Path(self.name).unlink()


def last_iteration(lines):
    counts = [line.split()[0] for line in lines if line.split() and line.split()[0].isdigit()]
    return int(counts[-1]) if counts else None
