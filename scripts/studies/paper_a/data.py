"""The sweep of Paper A by what the paper calls its cases, and depths read between its points."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.conformal.cells import centres
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.store import load
from roughfilm.rom.studies.sweep import Sweep

Shape = tuple[str, float]
"""Profile and xd+."""

SHAPES: dict[str, Shape] = {
    "cylindrical": ("cylindrical", 0.0),
    "splined, xd+ = -0.3": ("splined", -0.3),
    "splined, xd+ = 0": ("splined", 0.0),
    "splined, xd+ = 0.3": ("splined", 0.3),
}
WIDTHS = (0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
DEPTHS = (0.25, 0.5, 0.75, 1.0, 1.25)
NUMBERS = (40.0, 80.0, 120.0, 160.0)


@dataclass(frozen=True, kw_only=True)
class PaperA:
    """A sweep, where its results lie, and the settings that stand for each model."""

    sweep: Sweep
    directory: Path
    best: str
    stokes: str
    upwind: str | None

    def rows(
        self, shape: Shape, *, width: float | None = None, depth: float | None = None, number: float | None = None
    ) -> NDArray[np.int64]:
        """The cases of a shape with the given w+, d+ and Re, in the order of (w+, d+, Re)."""
        given = self.sweep.given
        chosen = (given["profile"] == shape[0]) & (np.abs(given["shift_plus"] - shape[1]) < 1e-6)
        for name, value in (("width_plus", width), ("depth_plus", depth), ("reynolds_number", number)):
            if value is not None:
                chosen &= np.isclose(given[name], value)
        index = np.flatnonzero(chosen)
        return index[np.lexsort([given[name][index] for name in ("reynolds_number", "depth_plus", "width_plus")])]

    def of(self, quantity: str, rows: NDArray[np.int64], setting: str | None = None) -> Array:
        """A quantity of some cases by a setting, by default the best one."""
        return self.sweep.found[setting or self.best][quantity][rows]

    def table(self, shape: Shape, quantity: str, number: float, setting: str | None = None) -> Array:
        """A quantity over (w+, d+), shape (8, 5); InputError where the sweep lacks a case."""
        lines = [[self.rows(shape, width=width, depth=depth, number=number) for depth in DEPTHS] for width in WIDTHS]
        if any(rows.size != 1 for line in lines for rows in line):
            raise InputError(f"{self.directory}: lacks cases of {shape[0]} at Re = {number:g}; run paper_a.toml there")
        return np.array([[self.of(quantity, rows, setting)[0] for rows in line] for line in lines])

    def path(self, rows: NDArray[np.int64], setting: str) -> Path:
        """The file of the result of one case; InputError if the sweep lacks it."""
        if rows.size != 1:
            raise InputError(f"{self.directory}: lacks a case that a figure shows; run paper_a.toml there")
        case = self.sweep.names[int(rows[0])]
        return self.directory / "cases" / case / f"{setting}.h5"

    def result(self, rows: NDArray[np.int64], setting: str) -> Result:
        """The stored result of one case, with its fields; InputError if it is not there."""
        return load(self.path(rows, setting))


def highest(depths: Array, loads: Array) -> float:
    """The depth of the greatest load: of the parabola through the greatest value and its neighbours, or an end."""
    top = int(np.argmax(loads))
    if top in (0, depths.size - 1):
        return float(depths[top])
    a, b, _ = np.polyfit(depths[top - 1 : top + 2], loads[top - 1 : top + 2], 2)
    return float(-b / (2 * a))


def still_wall_shear(result: Result) -> float:
    """The least shear rate on the still wall, in sliding speeds a film thickness outside the groove.

    Negative where the flow turns back. From the velocity along the wall in the layer next to it, at first order.
    """
    vertices, velocity = result.fields["vertices"].values, result.fields["cell_velocity"].values
    wall = vertices[:, 0]
    along = np.diff(wall, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    away = centres(vertices[:, :2])[:, 0] - (wall[1:] + wall[:-1]) / 2
    height = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    film = vertices[0, -1, 1] - wall[0, 1]
    speed = velocity[..., 0].max()
    return float(((velocity[:, 0] * along).sum(axis=1) / height).min() * film / speed)


def first_zero(depths: Array, shear: Array) -> float:
    """The least depth at which the shear falls through zero: 0 if it is negative all along, inf if never.

    Between the depths the shear is a monotone cubic; below the first one it falls from 1 at depth 0.
    """
    from scipy.interpolate import PchipInterpolator

    curve = PchipInterpolator(np.concatenate([[0.0], depths]), np.concatenate([[1.0], shear]))
    zeros = curve.roots(extrapolate=False)
    return float(zeros.min()) if zeros.size else float("inf")
