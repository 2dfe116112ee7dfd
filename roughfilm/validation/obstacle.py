"""The film of a full journal bearing as an obstacle problem: a second solution without common code."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse
from scipy.sparse.linalg import splu

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome

MAX_CHANGES = 60
"""Largest number of changes of the full cells."""

CLUSTERING = 4.0
"""Refinement towards the narrowest place: the smallest cell is about a seventh of the mean one."""


@dataclass(frozen=True, kw_only=True)
class ObstacleFilm:
    """So = F ψ²/(B D η ω), the attitude angle, degrees, and Q, the flow out of both ends over R³ ψ ω.

    For a shaft that moves straight at the bore ε' takes the place of ω.
    """

    sommerfeld: float
    attitude: float
    side_flow: float


def journal_by_obstacle(
    eccentricity: float, width_over_diameter: float, cells: tuple[int, int], *, turns: bool
) -> ObstacleFilm:
    """The film of a full journal bearing that turns, or moves at the bore with c ε', by finite volumes.

    With H = 1 - ε cos ψ, the angle ψ from the narrowest place and lengths over R, the pressure P, in units of η ω/ψ²
    (η ε'/ψ²), has P >= 0 and ∇·(H³ ∇P) + s <= 0, with equality where P > 0; s is -6 ∂H/∂ψ of a shaft that turns, whose
    film is full at the widest place with P = 0, and 12 cos ψ of one that moves. The set of full cells is changed until
    both hold everywhere. The equation is solved over half of the width, and if the shaft moves straight over half of
    the circumference. Cells are refined towards ψ = 0; load and flows are second-order accurate.

    Parameters
    ----------
    eccentricity : relative eccentricity ε, -1 < ε < 1; if it is negative, the shaft moves from the far side.
    width_over_diameter : B/D.
    cells : number of cells over the circumference or half of it, and over half of the width.
    turns : whether the shaft turns, and does not move.

    Raises
    ------
    ConvergenceError
        If the set of full cells does not settle.

    Source: Hintermüller, Ito and Kunisch 2002, doi:10.1137/S1052623401383558, for the changes of the set.
    """
    (nx, ny), half = cells, width_over_diameter
    fractions = np.linspace(-1.0 if turns else 0.0, 1.0, nx + 1)
    edges = math.pi * np.sinh(CLUSTERING * fractions) / math.sinh(CLUSTERING)
    places, dx, dy = (edges[1:] + edges[:-1]) / 2, np.diff(edges), half / ny
    at_edges = 1 - eccentricity * np.cos(edges)
    along = at_edges**3 / 12 * dy
    along[1:-1] /= np.diff(places)
    along[[0, -1]] *= np.array([2 / dx[0], 2 / dx[-1]]) if turns else 0.0
    across = (1 - eccentricity * np.cos(places)) ** 3 / 12 * dx / dy
    source = -np.diff(at_edges) / 2 if turns else np.diff(np.sin(edges))
    matrix = _outflows(along, across, ny)
    driven = np.repeat(source * dy, ny)
    full = driven > 0
    for _ in range(MAX_CHANGES):
        pressure, inside = np.zeros(nx * ny), np.flatnonzero(full)
        pressure[inside] = splu(matrix[inside][:, inside].tocsc()).solve(driven[inside])
        kept = np.where(full, pressure > 0, driven - matrix @ pressure > 0)
        if (kept == full).all():
            break
        full = kept
    else:
        raise ConvergenceError(
            f"obstacle: the full cells still change after {MAX_CHANGES} steps; take another grid",
            outcome=Outcome.UNFINISHED,
        )
    field = pressure.reshape(nx, ny)
    line = field.sum(axis=1) * dx * dy / (2 * half if turns else half)
    towards, aside = float((line * np.cos(places)).sum()), float((line * np.sin(places)).sum())
    return ObstacleFilm(
        sommerfeld=math.hypot(towards, aside) if turns else towards,
        attitude=math.degrees(math.atan2(abs(aside), towards)) if turns else 0.0,
        side_flow=(2 if turns else 4) * float((2 * across * field[:, -1]).sum()),
    )


def _outflows(along: Array, across: Array, ny: int) -> Any:
    """The matrix of outflows by pressures; P = 0 beyond the last cell across and beyond both ends along.

    Parameters
    ----------
    along : conductances of the edges along, shape (nx + 1,), 0 at an end without flow.
    across : conductances between two cells across, shape (nx,).
    """
    first = scipy.sparse.diags_array([along[:-1] + along[1:], -along[1:-1], -along[1:-1]], offsets=[0, 1, -1])
    inner = np.full(ny, 2.0)
    inner[0], inner[-1] = 1.0, 3.0
    second = scipy.sparse.diags_array([inner, -np.ones(ny - 1), -np.ones(ny - 1)], offsets=[0, 1, -1])
    return (
        scipy.sparse.kron(first, scipy.sparse.eye_array(ny))
        + scipy.sparse.kron(scipy.sparse.diags_array(across), second)
    ).tocsr()
