"""The table of a batch, with a row of inputs and results for each case and setting."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from roughfilm.batch.jobs import Failure, Job
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import models
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.ladder.kind import kind_of_name, kind_of_scene
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.studies.study import Case, Key
from roughfilm.rom.studies.table import Column

Cell = Quantity | str


TableRow = tuple[Mapping[str, Cell], Mapping[str, Cell], Mapping[str, Cell]]
"""The inputs of a job, its outcome with the quantities, and its numerics, each by the name of the column."""


def row_of(keys: Mapping[str, Key], case: Case, job: Job, answer: Result | Failure) -> TableRow:
    """The row of a job in a case of a study; ``keys`` are the locations of the varied entries by name."""
    setting = job.setting
    entries = scene_entries(case.scene)
    if isinstance(answer, Result):
        scheme, resolution = answer.numerics.scheme, answer.numerics.resolution
    else:
        scheme, resolution = setting.scheme or "", setting.resolution or setting.model.resolution_of(case.scene)
    requested: dict[str, Cell] = {
        "case": job.path.parent.name,
        "kind": case.scene.kind,
        **_sought(case),
        "setting": setting.name,
        "model": setting.model.name,
        "scheme": scheme,
        "resolution": _number(resolution),
        **{label: _cell(_at(entries, keys[label], written)) for label, written in case.varied.items()},
        **kind_of_name(case.scene.kind).columns(case.scene),
    }
    if isinstance(answer, Failure):
        return requested, {"outcome": f"{answer.kind}: {answer.message}"}, {}
    numbers, answer = answer.numerics, _with_errors(case, job, answer)
    solved = {
        "outcome": "solved",
        **dict(sorted(answer.quantities.items())),
        **_uncertainties(answer),
        **_expected_errors(case, answer),
    }
    return (
        requested,
        solved,
        {
            "residual": _number(numbers.residual),
            "iterations": _number(numbers.iterations),
            "cpu_s": Quantity(value=numbers.cpu_s, unit="s"),
            "warnings": "; ".join(answer.warnings),
            "outside": "; ".join(answer.outside),
        },
    )


def _sought(case: Case) -> dict[str, Cell]:
    """The quantity that a scene asks for by a table of its own, such as the film under a load."""
    own = kind_of_scene(case.scene)
    return {"sought": next(iter(own.compared))} if own.compared != kind_of_name(own.name).compared else {}


def _uncertainties(answer: Result) -> dict[str, Cell]:
    """The known uncertainties, as <quantity>_uncertainty."""
    return {
        f"{name}_uncertainty": Quantity(value=one.uncertainty, unit=one.unit)
        for name, one in sorted(answer.quantities.items())
        if one.uncertainty is not None
    }


def _with_errors(case: Case, job: Job, answer: Result) -> Result:
    """The answer with its errors by the fitted laws; without them if the numbers of the scene cannot be found."""
    try:
        return with_errors(answer, case.scene, job.setting.model, models(case.scene.kind))
    except (InputError, ConvergenceError):
        return answer


def _expected_errors(case: Case, answer: Result) -> dict[str, Cell]:
    """The errors by the fitted laws of compared quantities of unknown uncertainty, as <quantity>_expected_error."""
    unknown = [name for name in kind_of_scene(case.scene).shared(answer) if answer.quantities[name].uncertainty is None]
    errors = answer.expected_error
    return {f"{name}_expected_error": _number(errors[name]) for name in unknown if name in errors}


def warned(rows: Iterable[TableRow]) -> int:
    """The number of rows with a warning, or outside the range of their model."""
    return sum(bool(numerics.get("warnings") or numerics.get("outside")) for _, _, numerics in rows)


def columns(rows: Sequence[TableRow]) -> dict[str, Column]:
    """The columns of a table from its rows, in the order in which their names first appear."""
    table: dict[str, Column] = {}
    for parts in zip(*rows, strict=True):
        names = dict.fromkeys(name for part in parts for name in part)
        table |= {name: _column([part.get(name) for part in parts]) for name in names}
    return table


def _column(cells: Sequence[Cell | None]) -> Column:
    if any(isinstance(cell, str) for cell in cells):
        texts = [f"{cell.value!r} {cell.unit}" if isinstance(cell, Quantity) else cell or "" for cell in cells]
        return Column(values=texts, unit="")
    unit = next(cell.unit for cell in cells if isinstance(cell, Quantity))
    return Column(values=[cell.value if isinstance(cell, Quantity) else float("nan") for cell in cells], unit=unit)


def _number(value: float) -> Quantity:
    return Quantity(value=float(value), unit="1")


def _at(entries: Any, key: Key, written: Any) -> Any:
    """The entry of the scene at a key, or the value in the study if the scene stores it in another way."""
    try:
        for part in key:
            entries = entries[part]
    except (LookupError, TypeError):
        return written
    return entries


def _cell(value: Any) -> Cell:
    """The cell of a value: a quantity for a number or a text such as "3e-05 m", otherwise a text."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _number(value)
    if isinstance(value, str):
        number, _, unit = value.partition(" ")
        try:
            return Quantity(value=float(number), unit=unit) if unit else value
        except ValueError:
            return value
    return json.dumps(value)
