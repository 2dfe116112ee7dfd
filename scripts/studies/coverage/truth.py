"""The true values of a scene with their uncertainty, by the module of its kind."""

import importlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughfilm.rom.ladder.kind import Scene, kind_of_scene


@dataclass(frozen=True, kw_only=True)
class Truth:
    """True values of the quantities of a scene.

    Attributes
    ----------
    values : by name of the quantity, in the unit of the models' results.
    uncertainty : of each of these values, in the same unit; it contains the difference from the exact solution.
    method : the solution method and its resolutions, in words.
    own : by model and quantity, value and uncertainty of the exact solution of the model's own equations, by which the
        uncertainty of that model is judged; models without an entry are judged by ``values``, those with an empty one
        are not judged.
    warnings : one sentence for each reason why the solution may be wrong.
    by : name of the model whose finer solutions are the truth, by which it is not judged; empty for other methods.
    runs : the quantities by that model at each of its resolutions, if laws are fitted to them.
    finer : by model, its quantities at each of the resolutions behind its entry in ``own``.
    """

    values: Mapping[str, float]
    uncertainty: Mapping[str, float]
    method: str
    own: Mapping[str, Mapping[str, tuple[float, float]]] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    by: str = ""
    runs: Mapping[int, Mapping[str, float]] = field(default_factory=dict)
    finer: Mapping[str, Mapping[int, Mapping[str, float]]] = field(default_factory=dict)


def kinds_with_truth() -> tuple[str, ...]:
    """Return the kinds of scene that have both a module in ``scenes`` and one in ``truths``."""
    here = Path(__file__).parent
    drawn, solved = ({path.stem for path in (here / name).glob("[!_]*.py")} for name in ("scenes", "truths"))
    return tuple(sorted(drawn & solved))


def truth_of(scene: Scene, kind: str = "") -> Truth:
    """Return the truth of a scene by ``truths/<kind>.py``; by default of the kind as its laws name it.

    Raises
    ------
    ConvergenceError
        If the solution does not converge; the scene is then left out of the study, and counted.
    """
    name = kind or kind_of_scene(scene).name_of_laws
    found: Any = importlib.import_module(f"scripts.studies.coverage.truths.{name}").truth(scene)
    assert isinstance(found, Truth)
    return found
