"""The sweep of dimples by families of shapes, and the choice of a dimple by each model."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.studies.sweep import Sweep

LOAD = "load_plus"

REFERENCE = "navier_stokes"

ORDER = 2
"""Order in the size of the columns at which the load of the reference converges on similar meshes."""

MIN_CHOICE = 1e-6
"""Largest load by a model over that by the reference below which it finds no load: what remains is round-off."""

MIN_LOAD = 0.05
"""Load over the largest pressure below which the load is a difference of larger numbers and errors are left out."""

FAMILIES = ("spherical", "conical", "ellipsoidal across", "ellipsoidal along", "box", "chevron")
"""Families of shapes; an ellipse lies across or along the sliding direction."""


@dataclass(frozen=True, kw_only=True)
class Choice:
    """The best dimple of a family at one Reynolds number by one model.

    Attributes
    ----------
    covered, depth : the covered part of the cell and the depth over the film thickness of the best dimple.
    deepest : whether the model solved no deeper dimple.
    load : its load by the model.
    true : its load by the reference.
    lost : relative loss of load, by the reference, against the best of the dimples that the model solved.
    """

    covered: float
    depth: float
    deepest: bool
    load: float
    true: float
    lost: float


@dataclass(frozen=True, kw_only=True)
class Dimples:
    """The sweep by family and Reynolds number.

    Attributes
    ----------
    sweep : the sweep.
    settings : the name of the setting of each model, the cheapest first and the reference last.
    coarser : the name of the setting of the reference on its coarser mesh.
    """

    sweep: Sweep
    settings: Mapping[str, str]
    coarser: str

    def family(self) -> NDArray[np.object_]:
        """The family of every case, shape (cases,)."""
        given = self.sweep.given
        names = np.array([str(one) for one in given["profile"]], dtype=object)
        across = np.asarray(given["breadth"], dtype=float) > np.asarray(given["width"], dtype=float)
        return np.where(names != "ellipsoidal", names, np.where(across, FAMILIES[2], FAMILIES[3]))

    @property
    def numbers(self) -> tuple[float, ...]:
        """The Reynolds numbers of the sweep."""
        return tuple(np.unique(self.sweep.given["reynolds_number"]).tolist())

    def cases(self, family: str, number: float) -> NDArray[np.int64]:
        """The cases of a family at a Reynolds number that the reference solved."""
        solved = np.isfinite(self.load(REFERENCE))
        return np.flatnonzero((self.family() == family) & (self.sweep.given["reynolds_number"] == number) & solved)

    def load(self, model: str) -> Array:
        """The load of every case by a model, NaN where it is missing, shape (cases,); by the reference, its limit."""
        load = self.sweep.found[self.settings[model]][LOAD]
        return load + self.change_of_mesh() / (self._refinement() ** ORDER - 1) if model == REFERENCE else load

    def change_of_mesh(self) -> Array:
        """The change of the load by the reference from its coarser to its finest mesh, shape (cases,)."""
        fine, coarse = (self.sweep.found[name][LOAD] for name in (self.settings[REFERENCE], self.coarser))
        return np.asarray(fine - coarse)

    def _refinement(self) -> Array:
        fine, coarse = (self.sweep.resolution[name] for name in (self.settings[REFERENCE], self.coarser))
        return np.asarray(fine / coarse)

    def choice(self, family: str, number: float, model: str) -> Choice | None:
        """The best dimple by a model; None if it solved no case or finds no load."""
        cases = self.cases(family, number)
        cases = cases[np.isfinite(self.load(model)[cases])]
        own, true = self.load(model)[cases], self.load(REFERENCE)[cases]
        if not own.size or own.max() <= MIN_CHOICE * np.abs(true).max():
            return None
        best = int(np.argmax(own))
        covered, depth = (self.sweep.given[name][cases] for name in ("covered", "depth_plus"))
        return Choice(
            covered=float(covered[best]),
            depth=float(depth[best]),
            deepest=bool(depth[best] == depth.max()),
            load=float(own[best]),
            true=float(true[best]),
            lost=float(1 - true[best] / true.max()),
        )

    def errors(self, model: str, cases: NDArray[np.bool_]) -> Array:
        """The relative errors of the load by a model in the cases of a mask that have a sizeable load."""
        load, found = self.load(REFERENCE), self.sweep.found[self.settings[REFERENCE]]
        pressure = np.maximum(np.abs(found["pressure_max_plus"]), np.abs(found["pressure_min_plus"]))
        own = cases & (np.abs(load) > MIN_LOAD * pressure)
        relative = np.abs(self.load(model)[own] / load[own] - 1)
        return np.asarray(relative[np.isfinite(relative)])


def joined(tables: Sequence[Mapping[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    """The rows of several tables in one; NaN or "" in columns that a table does not have."""
    columns = {name: column.dtype for table in tables for name, column in table.items()}
    return {
        name: np.concatenate(
            [
                table.get(name, np.full(len(table["case"]), np.nan if kind.kind == "f" else "", dtype=kind))
                for table in tables
            ]
        )
        for name, kind in columns.items()
    }


def dimples_of(sweep: Sweep) -> Dimples:
    """The sweep with the setting of each model on its finest grid.

    Raises
    ------
    InputError
        If the sweep has no two meshes of the reference.
    """
    grids: dict[str, list[tuple[float, str]]] = {}
    for name, values in sweep.resolution.items():
        if np.isfinite(values).any():
            grids.setdefault(name.partition("-")[0], []).append((float(np.nanmax(values)), name))
    finest = {model: max(own)[1] for model, own in grids.items()}
    if len(grids.get(REFERENCE, ())) < 2:
        raise InputError(f"the batch has no two meshes of {REFERENCE}; run dimples.toml with OpenFOAM")
    order = sorted(finest, key=lambda model: (model == REFERENCE, float(np.nanmedian(sweep.cpu_s[finest[model]]))))
    return Dimples(
        sweep=sweep, settings={model: finest[model] for model in order}, coarser=sorted(grids[REFERENCE])[-2][1]
    )
