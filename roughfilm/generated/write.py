"""Write the OpenFOAM cases of a study into a directory that is complete on another machine."""

import shutil
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from roughfilm.batch.directory import CASES, put_scene
from roughfilm.batch.plan import plan_of, write_plan
from roughfilm.contact.foundation.errors import InputError, unwritable
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.model import CaseModel
from roughfilm.generated.manifest import (
    INPUTS,
    VERSION,
    Generated,
    GeneratedCase,
    GeneratedSetting,
    Manifest,
    digest,
    digests,
    write_manifest,
)
from roughfilm.generated.scripts import ALL, ALL_TEXT, LIST, SLURM, slurm_text
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Availability, Model, Progress, silent
from roughfilm.rom.ladder.provenance import model_code
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_entries, named_files, scene_entries
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.studies.study import Case, Study, digest_of_entries, load_study

STUDY = "study.toml"
"""Copy of the study file."""


def study_to_generate(path: Path) -> Study | None:
    """The study of a file, whether OpenFOAM is on this machine or not; None if the file is a scene.

    A file is a study if it has a table ``[study]`` or ``[[variants]]``, or a list that makes several cases.

    Raises
    ------
    InputError
        If the file is a study with a fault.
    """
    named = {"study", "variants"} & load_entries(path).keys()
    try:
        study = load_study(path, lambda kind: [_as_if_available(model) for model in models(kind)])
    except InputError:
        if named:
            raise
        return None
    return study if named or len(study.cases) > 1 else None


def _as_if_available(model: Model) -> Model:
    """The model; one that runs OpenFOAM does not look for it."""
    return replace(model, available=lambda: Availability(available=True)) if model.outside else model


def study_of_scene(scene: Scene, request: Request) -> Study:
    """The study of one scene by every model of its kind that runs OpenFOAM."""
    settings = [
        Setting(model=model, resolution=request.resolution, scheme=request.scheme if model.schemes else None)
        for model in models(scene.kind)
        if isinstance(model, CaseModel)
    ]
    case = Case(name="", digest=digest_of_entries(scene_entries(scene)), scene=scene, varied={})
    return Study(name=scene.name, keys={}, cases=(case,), settings=tuple(settings))


def write_cases(
    study: Study,
    out: Path,
    dialect: Dialect,
    *,
    tolerance: float | None = None,
    processes: int = 1,
    file: Path | None = None,
    progress: Progress = silent,
) -> Manifest:
    """Write the OpenFOAM cases of a study, their scripts and their manifest, completely or not at all.

    The case of each model is in ``out/cases/<case>/<setting>``, or in ``out/<model>`` for the study of one scene.

    Parameters
    ----------
    study : the study; its models that do not run OpenFOAM are left to ``collect``.
    out : the directory, which is made; it may exist if it is empty.
    dialect : the dialect of OpenFOAM.
    tolerance : tolerance of the runs; None for the default of each model.
    processes : number of processes of each run.
    file : the study file, which is copied.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If no model of the study runs OpenFOAM, an option is out of range, or the directory is not empty or is the
        current one.
    """
    requests = _requests(study, tolerance, processes)
    try:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise InputError(f"{out}: is not an empty directory; name another")
        if out.resolve() == Path.cwd():
            raise InputError(f"{out}: is the current directory; name another, which is made")
        target = out.resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        with scratch_directory(beside=target) as place:
            whole = place / target.name
            whole.mkdir()
            generated, inputs = [], _copied_inputs(study, whole)
            for number, (case, setting, request) in enumerate(requests):
                progress(number / len(requests), f"case {number + 1} of {len(requests)}")
                directory = Path(CASES) / case.name / setting.name if case.name else Path(setting.model.name)
                _writer(setting).write(case.scene, whole / directory, request, dialect=dialect)
                put_scene(case, (whole / directory).parent)
                files = digests(whole / directory)
                generated.append(
                    Generated(case=case.name, setting=setting.name, directory=directory.as_posix(), files=files)
                )
            if study.cases[0].name:
                write_plan(plan_of(study, {case.digest: case.name for case in study.cases}), whole)
            if file is not None:
                shutil.copyfile(file, whole / STUDY)
            _write_scripts([one.directory for one in generated], processes, whole)
            manifest = Manifest(
                version=VERSION,
                name=study.name,
                dialect=dialect.name,
                tolerance=tolerance,
                processes=processes,
                keys={name: list(key) for name, key in study.keys.items()},
                settings={one.name: _about(one, study) for one in study.settings},
                cases={case.name: _entries(case) for case in study.cases},
                inputs=inputs,
                generated=generated,
            )
            write_manifest(manifest, whole)
            whole.replace(target)
    except OSError as error:
        raise unwritable(out, error) from error
    return manifest


def _requests(study: Study, tolerance: float | None, processes: int) -> list[tuple[Case, Setting, Request]]:
    """The OpenFOAM runs of a study, all checked."""
    settings = [setting for setting in study.settings if setting.model.outside]
    if not settings:
        kind = study.cases[0].scene.kind
        known = " or ".join(model.name for model in models(kind) if model.outside)
        if known:
            raise InputError(f"study.models: none of them runs OpenFOAM; name {known}, or solve it with 'batch'")
        kinds = " or ".join(sorted({model.kind for model in models() if model.outside}))
        raise InputError(f"scene.kind: got {kind!r}, which no model solves in OpenFOAM; give a scene of {kinds}")
    requests = []
    for case in study.cases:
        for setting in settings:
            if setting.model.applies(case.scene).applies:
                request = Request(
                    resolution=setting.resolution, tolerance=tolerance, scheme=setting.scheme, processes=processes
                )
                setting.model.checked(case.scene, request)
                requests.append((case, setting, request))
    if not requests:
        models_of = {setting.model.name: setting.model for setting in settings}
        reasons = [f"{name}: {model.applies(study.cases[0].scene).reason}" for name, model in models_of.items()]
        raise InputError(f"scene: no model solves it in OpenFOAM: {'; '.join(reasons)}")
    return requests


def _writer(setting: Setting) -> CaseModel[Any, Any]:
    assert isinstance(setting.model, CaseModel)
    return setting.model


def _about(setting: Setting, study: Study) -> GeneratedSetting:
    return GeneratedSetting(
        model=setting.model.name,
        resolution=setting.resolution,
        scheme=setting.scheme,
        code=model_code(study.cases[0].scene.kind, setting.model.name),
    )


def _entries(case: Case) -> GeneratedCase:
    return GeneratedCase(digest=case.digest, varied=dict(case.varied), scene=scene_entries(case.scene))


def _copied_inputs(study: Study, out: Path) -> Mapping[str, str]:
    """The copies of all files that the scenes name, by the name in the scene."""
    copies: dict[str, str] = {}
    for case in study.cases:
        for name in sorted(named_files(case.scene) - copies.keys()):
            source = Path(name).expanduser()
            if source.is_file():
                copy = f"{INPUTS}/{digest(source)[:16]}-{source.name}"
                (out / INPUTS).mkdir(exist_ok=True)
                shutil.copyfile(source, out / copy)
                copies[name] = copy
    return copies


def _write_scripts(directories: Sequence[str], processes: int, out: Path) -> None:
    texts = {
        LIST: "".join(f"{directory}\n" for directory in directories),
        ALL: ALL_TEXT,
        SLURM: slurm_text(len(directories), processes),
    }
    for name, text in texts.items():
        (out / name).write_text(text, encoding="utf-8")
    (out / ALL).chmod(0o755)
