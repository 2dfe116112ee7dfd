"""Solve one problem of a size by one method in this process and write its cost: growth.py METHOD SIZE.

The output is JSON: CPU time in s, the growth of memory during the solution in bytes, and the number of unknowns.
"""

import json
import resource
import sys
import time
from pathlib import Path

import numpy as np

from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.ladder import find
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.seal.leakage.direct import direct_flow

SCENES = Path(__file__).resolve().parents[2] / "scripts" / "examples" / "scenes"
SIDE, WAVES = 1e-3, 8
CONTACT_LOAD = 0.00466
"""Mean pressure over E* at which a tenth of the surface is in contact, which has an rms slope of 0.1."""


def heights(points):
    """A self-affine surface of the same statistics on every grid, whose shortest wave has eight points, rms slope 1."""
    surface = self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=20071,
        hurst=0.8,
        roll_off=SIDE / WAVES,
        cut_off=8 * SIDE / points,
        rms_height=1e-6,
    ).heights
    slope = np.sqrt(sum(np.mean(((np.roll(surface, -1, axis) - surface) * points / SIDE) ** 2) for axis in (0, 1)))
    return surface * 0.1 / slope


def gap(points):
    """The surface cut off at a fifth of its area, over its mean."""
    surface = heights(points)
    cut = np.maximum(np.quantile(surface, 0.8) - surface, 0.0)
    return cut / cut.mean()


def contact(points):
    surface = heights(points)
    return lambda: Press(surface, (SIDE / points,) * 2, 1.0, threads=1).at(CONTACT_LOAD)


def cell(points):
    h = gap(points)
    return lambda: flow_factors(h, (1.0, 1.0))


def leakage(points):
    h = gap(points)
    return lambda: direct_flow(h, (1.0, 1.0), 0)


def film(points, changes=()):
    entries = ["lubricant.compressibility.bulk_modulus=0.07 GPa", "boundary.inlet.theta=0.55", *changes]
    problem = load_scene(SCENES / "parabolic_slider.toml", entries).problem()
    return lambda: solve(problem, (points, points if changes else 1))


def plane(points):
    return film(points, ["geometry.width=76.2 mm"])


def model(scene, name):
    def prepare(resolution):
        here = load_scene(SCENES / f"{scene}.toml")
        return lambda: find(here.kind, name).solve(here, Request(resolution=resolution))

    return prepare


METHODS = {
    "contact": (contact, lambda n: n**2, 128),
    "flow_factors": (cell, lambda n: n**2, 128),
    "direct_flow": (leakage, lambda n: n**2, 128),
    "film_plane": (plane, lambda n: n**2, 32),
    "film_line": (film, lambda n: n, 100),
    "film_slope": (model("pocket", "film_slope"), lambda n: n, 50),
    "mixed": (model("rough_washer", "mixed"), lambda n: n**2, 32),
    "navier_stokes": (model("pocket", "navier_stokes"), lambda n: n**2, 30),
    "stokes": (model("random_gap", "stokes"), lambda n: n**3, 8),
}
"""How a problem is prepared, what its size means, and the size of a first problem, which imports and compiles."""


def memory(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith(name))


def cost(run):
    Path("/proc/self/clear_refs").write_text("5")  # resets the peak
    before, children = memory("VmRSS"), resource.getrusage(resource.RUSAGE_CHILDREN)
    started = time.process_time()
    run()
    spent, after = time.process_time() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    spent += after.ru_utime + after.ru_stime - children.ru_utime - children.ru_stime
    return {
        "cpu_s": spent,
        "bytes": memory("VmHWM") - before,
        "largest_child_bytes": after.ru_maxrss * 1024,
    }


def main():
    name, size = sys.argv[1], int(sys.argv[2])
    prepare, unknowns, small = METHODS[name]
    prepare(small)()
    sys.stdout.write(json.dumps({"size": size, "unknowns": unknowns(size), **cost(prepare(size))}))


if __name__ == "__main__":
    main()
