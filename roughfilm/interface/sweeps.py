"""Sweeps of a scene over values of its entries by several models, as rows of a table."""

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.interface.rows import Rows
from roughfilm.interface.scenes import checked_scene, with_entries
from roughfilm.interface.solving import answer_of, chosen_models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.ladder.scene import scene_entries


def sweep(
    scene: Scene,
    values: Mapping[str, Sequence[object]],
    *,
    models: Sequence[str] | None = None,
    progress: Progress = silent,
) -> Rows:
    """Solve a scene by several models for every combination of values of its entries, and return the rows of a table.

    Parameters
    ----------
    scene : the scene in which the entries vary.
    values : list of values by dotted key, such as ``{"geometry.depth": ["5 um", "10 um"]}``; :func:`roughfilm.replace`
        says what a value may be.
    models : names of the models; by default all for this kind of scene.
    progress : called with the done fraction and a few words.

    Returns
    -------
    list of dict
        A row for each combination and model, which pandas.DataFrame accepts. The columns are the keys of ``values``,
        "model", "resolution", "outcome" ("solved" or the reason for a missing result), the quantities by name,
        "<name>_uncertainty" (95 % half width, if known), "<name>_expected_error" (error of the model over the size of
        the quantity, if a law gives it), "cpu_s", "warnings" and "outside" (how the scene is outside the range of the
        model, if it is). Numbers are in SI units; ``units`` holds them by column.

    Raises
    ------
    InputError
        If a key or model is unknown or a value is out of range; this is checked before the first solution.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> rows = rf.sweep(scene, {"geometry.depth": ["5 um", "10 um"]}, models=["reynolds", "film"])
    >>> [(row["geometry.depth"], row["model"]) for row in rows]
    [(5e-06, 'reynolds'), (5e-06, 'film'), (1e-05, 'reynolds'), (1e-05, 'film')]
    >>> rows.units["geometry.depth"], rows.units["load_per_area"]
    ('m', 'Pa')
    """
    known = chosen_models(checked_scene(scene).kind, models)
    if not isinstance(values, Mapping):
        raise InputError(f"values: got {values!r:.60}; give a dict such as {{'geometry.depth': ['5 um', '10 um']}}")
    for key, taken in values.items():
        if isinstance(taken, str) or not isinstance(taken, Sequence | np.ndarray) or not len(taken):
            raise InputError(f"values: got {taken!r:.60} for {key}; give a list of the values that it takes")
    combinations = [dict(zip(values, taken, strict=True)) for taken in itertools.product(*values.values())]
    scenes = [with_entries(scene, combination) for combination in combinations]
    rows = Rows()
    for number, (case, varied) in enumerate(zip(scenes, combinations, strict=True)):
        for place, model in enumerate(known):
            progress((number + place / len(known)) / len(scenes), f"{model.name}, case {number + 1} of {len(scenes)}")
            row: dict[str, Any] = {}
            for key, value in varied.items():
                row[key], rows.units[key] = _si(case, key, value)
            answer = answer_of(case, model)
            row |= {"model": model.name}
            rows.append(row)
            if isinstance(answer, str):
                row["outcome"] = answer
                continue
            row |= {"resolution": answer.numerics.resolution, "outcome": "solved"}
            for name, quantity in answer.quantities.items():
                row[name], rows.units[name] = quantity.value, quantity.unit
                if quantity.uncertainty is not None:
                    row[f"{name}_uncertainty"], rows.units[f"{name}_uncertainty"] = quantity.uncertainty, quantity.unit
                if name in answer.expected_error:
                    row[f"{name}_expected_error"], rows.units[f"{name}_expected_error"] = (
                        answer.expected_error[name],
                        "1",
                    )
            row |= {"cpu_s": answer.numerics.cpu_s, "warnings": "; ".join(answer.warnings)}
            row["outside"] = "; ".join(answer.outside)
            rows.units["cpu_s"] = "s"
    return rows


def _si(scene: Scene, key: str, value: object) -> tuple[object, str]:
    """The value and unit that the scene holds at a key; the given value if the scene has no entry there."""
    entry: Any = scene_entries(scene)
    for part in key.split("."):
        if isinstance(entry, list):
            entry = dict(enumerate(entry)).get(int(part)) if part.isdigit() else None
        else:
            entry = entry.get(part) if isinstance(entry, dict) else None
    if isinstance(entry, str):
        number, _, unit = entry.partition(" ")
        try:
            return float(number), unit
        except ValueError:
            return entry, ""
    return (value if entry is None else entry), "1"
