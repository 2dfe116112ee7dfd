"""The plan of a batch, ``study.json`` in its directory, and the results that its directory holds at any moment."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from roughfilm.batch.directory import CASES
from roughfilm.batch.jobs import Failure, Job, read_failure
from roughfilm.batch.tabulate import TableRow, columns, row_of
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.ladder.store import load
from roughfilm.rom.studies.study import Case, Study
from roughfilm.rom.studies.table import Column, read_columns

PLAN = "study.json"

MAX_PLAN_BYTES = 1_000_000_000
"""Largest size of a plan that is read, bytes: that of a million cases."""

MAX_NAME_BYTES = 230
"""Longest name of a case or a setting, bytes; file systems allow 255 with the suffix."""

TO_COME = "not solved yet"
"""The outcome of a job without an answer."""


@dataclass(frozen=True, kw_only=True)
class PlannedSetting:
    """The name of a model with a resolution and a scheme; None for the default of the model."""

    model: str
    resolution: int | None = None
    scheme: str | None = None


@dataclass(frozen=True, kw_only=True)
class Plan:
    """The cases and settings of a batch.

    Attributes
    ----------
    name : name of the study.
    keys : location in the scene of each varied entry, by short name.
    settings : by name, the model, resolution and scheme of each setting.
    cases : by name of its directory, the varied values of each case, as the study file contains them.
    """

    name: str
    keys: Mapping[str, Sequence[str | int]]
    settings: Mapping[str, PlannedSetting]
    cases: Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, kw_only=True)
class Batch:
    """The content of the directory of a batch.

    Attributes
    ----------
    directory : the directory.
    plan : the plan; None for a directory of an older version.
    table : the columns of the results and failures, and of the jobs without an answer, whose numbers are NaN.
    missing : case and setting of each job without an answer.
    """

    directory: Path
    plan: Plan | None
    table: Mapping[str, Column]
    missing: tuple[tuple[str, str], ...]

    def result_path(self, case: str, setting: str) -> Path:
        """The file of the result of a case by a setting."""
        return self.directory / CASES / case / f"{setting}.h5"


def plan_of(study: Study, directories: Mapping[str, str]) -> Plan:
    """The plan of a study; ``directories`` are the names of the directories of its cases by digest."""
    return Plan(
        name=study.name,
        keys={name: list(key) for name, key in study.keys.items()},
        settings={
            one.name: PlannedSetting(model=one.model.name, resolution=one.resolution, scheme=one.scheme)
            for one in study.settings
        },
        cases={directories[case.digest]: dict(case.varied) for case in study.cases},
    )


def write_plan(plan: Plan, out: Path) -> None:
    """Write the plan of a batch into its directory; InputError if it cannot be written."""
    write_json(asdict(plan), out / PLAN)


def read_batch(directory: Path) -> Batch:
    """Read the directory of a batch, which may be unfinished.

    The table of the batch is read if it holds a row for every job of the plan. Otherwise the batch has not come to its
    end, and the files of the results are read one by one.

    Raises
    ------
    InputError
        If the directory holds neither a table nor a plan with results, or a file of them is broken.
    """
    plan = _read_plan(directory / PLAN)
    if plan is None and not (directory / "table.h5").is_file():
        raise InputError(f"{directory}: holds no batch; name the directory of a batch")
    if plan is None:
        return Batch(directory=directory, plan=None, table=read_columns(directory / "table.h5"), missing=())
    wanted = {(case, setting) for case in plan.cases for setting in plan.settings}
    if (directory / "table.h5").is_file():
        table = read_columns(directory / "table.h5")
        names = ("case", "setting")
        rows = zip(*(table[name].values for name in names), strict=True) if {*names} <= {*table} else ()
        if set(rows) == wanted:
            return Batch(directory=directory, plan=plan, table=table, missing=())
    return _collected(directory, plan)


def _read_plan(path: Path) -> Plan | None:
    if not path.is_file():
        return None
    try:
        plan = from_json(read_bytes(path, MAX_PLAN_BYTES, "start the batch again"), Plan)
        if unknown := {name for varied in plan.cases.values() for name in varied} - {*plan.keys}:
            raise ValueError(f"no location of {min(unknown)}")
        if wrong := [name for name in (*plan.cases, *plan.settings) if not _names_a_file(name)]:
            raise ValueError(f"{wrong[0][:80]!r} names no file")
        return plan
    except ValueError as error:
        raise InputError(f"{path}: is not the plan of a batch; start the batch again, which writes it") from error


def _names_a_file(name: str) -> bool:
    """Whether a file in a directory can have a name, also with a suffix."""
    wrong = name in {"", ".", ".."} or "/" in name or "\0" in name
    return not wrong and len(os.fsencode(name)) <= MAX_NAME_BYTES


def _collected(directory: Path, plan: Plan) -> Batch:
    """The batch from the files of its results and failures."""
    found: list[TableRow] = []
    missing: list[tuple[str, str]] = []
    keys = {name: tuple(key) for name, key in plan.keys.items()}
    for name, varied in plan.cases.items():
        answers = {setting: _answer(directory / CASES / name / f"{setting}.h5") for setting in plan.settings}
        entries = next((entries for entries, _ in filter(None, answers.values())), None)
        if entries is None:
            missing += [(name, setting) for setting in plan.settings]
            continue
        case = Case(name=name, digest=name.rpartition("-")[2], scene=read_scene(entries), varied=varied)
        for label, answer in answers.items():
            about = plan.settings[label]
            setting = Setting(
                model=find(case.scene.kind, about.model), resolution=about.resolution, scheme=about.scheme
            )
            job = Job(scene=case.scene, setting=setting, path=directory / CASES / name / f"{label}.h5")
            if answer is not None:
                found.append(row_of(keys, case, job, answer[1]))
            elif not (fits := setting.model.applies(case.scene)).applies:
                found.append(row_of(keys, case, job, Failure(kind="left out", message=fits.reason)))
            else:
                missing.append((name, label))
    if not found:
        raise InputError(f"{directory}: the batch has no result yet ({len(missing)} to come); wait, or start it again")
    alike = {name: cell for name, cell in found[0][0].items() if name in ("kind", "sought")}
    lacking: list[TableRow] = [
        ({"case": case, **alike, "setting": label, "model": plan.settings[label].model}, {"outcome": TO_COME}, {})
        for case, label in missing
    ]
    order = {case: number for number, case in enumerate(plan.cases)}
    rows = sorted([*found, *lacking], key=lambda row: order[str(row[0]["case"])])
    return Batch(directory=directory, plan=plan, table=columns(rows), missing=tuple(missing))


def _answer(path: Path) -> tuple[Mapping[str, Any], Any] | None:
    """The entries of the scene and the result or failure of a job; None without a readable answer."""
    try:
        if path.is_file():
            result = load(path, with_fields=False)
            return result.provenance["scene"], result
        record = read_failure(path.with_suffix(".failed.json"))
        return record.identity.scene, record.failure
    except InputError:
        return None
