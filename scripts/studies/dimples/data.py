"""The sweep of dimples by families of shapes, and the choice of a dimple by each model."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.studies.sweep import Sweep

LOAD = "load_plus"

REFERENCE = "navier_stokes"

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
    stated : its load by the model, or 0 if no load of the model is above zero.
    true : its load by the reference.
    lost : relative loss of load, by the reference, against the best dimple by the reference.
    """

    covered: float
    depth: float
    stated: float
    true: float
    lost: float


@dataclass(frozen=True, kw_only=True)
class Dimples:
    """The sweep by family and Reynolds number.

    Attributes
    ----------
    sweep : the sweep.
    settings : the name of the setting of each model, the cheapest first and the reference last.
    """

    sweep: Sweep
    settings: Mapping[str, str]

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
        """The load of every case by a model, NaN where it is missing, shape (cases,)."""
        return self.sweep.found[self.settings[model]][LOAD]

    def choice(self, family: str, number: float, model: str) -> Choice | None:
        """The best dimple by a model; None if it solved no case."""
        cases = self.cases(family, number)
        own, true = self.load(model)[cases], self.load(REFERENCE)[cases]
        if not np.isfinite(own).any():
            return None
        best = int(np.nanargmax(own))
        given = self.sweep.given
        return Choice(
            covered=float(given["covered"][cases[best]]),
            depth=float(given["depth_plus"][cases[best]]),
            stated=float(max(own[best], 0.0)),
            true=float(true[best]),
            lost=float(1 - true[best] / true.max()),
        )

    def errors(self, model: str) -> Array:
        """The relative errors of the load by a model against the reference, of the cases with a sizeable load."""
        found = self.sweep.found[self.settings[REFERENCE]]
        pressure = np.maximum(np.abs(found["pressure_max_plus"]), np.abs(found["pressure_min_plus"]))
        sizeable = np.abs(found[LOAD]) > MIN_LOAD * pressure
        relative = np.abs(self.load(model) - found[LOAD])[sizeable] / np.abs(found[LOAD][sizeable])
        return np.asarray(relative[np.isfinite(relative)])


def dimples_of(sweep: Sweep) -> Dimples:
    """The sweep with the setting of each model on its finest grid."""
    finest: dict[str, tuple[float, str]] = {}
    for name, values in sweep.resolution.items():
        if np.isfinite(values).any():
            model = name.partition("-")[0]
            finest[model] = max(finest.get(model, (0.0, "")), (float(np.nanmax(values)), name))
    order = sorted(finest, key=lambda model: (model == REFERENCE, float(np.nanmedian(sweep.cpu_s[finest[model][1]]))))
    return Dimples(sweep=sweep, settings={model: finest[model][1] for model in order})
