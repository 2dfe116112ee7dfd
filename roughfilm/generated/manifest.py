"""The manifest of generated cases, ``manifest.json``: study, scenes, options, and the digests of all written files."""

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import named_path, opened, read_bytes
from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.studies.study import Case, Study, digest_of_entries

MANIFEST = "manifest.json"

INPUTS = "inputs"
"""Directory with copies of the files that the scenes name, such as surfaces."""

VERSION = 2
"""Version of the manifest that is written."""

WITHOUT_DIGEST = 1
"""Version that is read too; it has no digest, so that it cannot be checked."""

MAX_MANIFEST_BYTES = 1_000_000_000
"""Largest size of a manifest that is read, bytes; a case takes about 5000."""


@dataclass(frozen=True, kw_only=True)
class GeneratedSetting:
    """A setting of the study: model, resolution, scheme, and the digest of the code of the model."""

    model: str
    resolution: int | None
    scheme: str | None
    code: str


@dataclass(frozen=True, kw_only=True)
class GeneratedCase:
    """A case of the study: the digest and the entries of its scene, and the varied values."""

    digest: str
    varied: Mapping[str, Any]
    scene: Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Generated:
    """An OpenFOAM case that was written.

    Attributes
    ----------
    case : name of the case of the study.
    setting : name of the model with resolution and scheme.
    directory : its directory, relative to that of the manifest.
    files : SHA-256 digest of each written file, by its path in the directory.
    """

    case: str
    setting: str
    directory: str
    files: Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class Manifest:
    """The generated cases of a study, and all that is needed to read their results on another machine.

    Attributes
    ----------
    version : version of the manifest.
    name : name of the study.
    dialect : dialect of OpenFOAM in which the cases are written.
    tolerance : tolerance of the runs; None for the default of each model.
    processes : number of processes of each run.
    keys : location in the scene of each varied entry, by short name.
    settings : the settings by name.
    cases : the cases by name; the name of the only case of a scene is empty.
    inputs : the copy, relative to the manifest, of each file that a scene names.
    generated : the cases that were written.
    digest : the SHA-256 digest of all other entries.
    """

    version: int
    name: str
    dialect: str
    tolerance: float | None
    processes: int
    keys: Mapping[str, Sequence[str | int]]
    settings: Mapping[str, GeneratedSetting]
    cases: Mapping[str, GeneratedCase]
    inputs: Mapping[str, str]
    generated: Sequence[Generated]
    digest: str = ""

    @property
    def has_digest(self) -> bool:
        """Whether a digest tells if an entry was edited."""
        return self.version != WITHOUT_DIGEST

    @property
    def expected_digest(self) -> str:
        """The digest that these entries have."""
        return hashlib.sha256(json.dumps(asdict(replace(self, digest="")), sort_keys=True).encode()).hexdigest()

    def study(self, out: Path) -> Study:
        """The study; a file that a scene names and that is not on this machine is replaced by its copy below ``out``.

        Raises
        ------
        InputError
            If a scene or a model is not one of this version.
        """
        cases = []
        for name, about in self.cases.items():
            scene = read_scene(_with_copies(about.scene, self.inputs, out))
            cases.append(Case(name=name, digest=about.digest, scene=scene, varied=about.varied))
        settings = tuple(
            Setting(model=find(cases[0].scene.kind, one.model), resolution=one.resolution, scheme=one.scheme)
            for one in self.settings.values()
        )
        keys = {name: tuple(key) for name, key in self.keys.items()}
        return Study(name=self.name, keys=keys, cases=tuple(cases), settings=settings)


def write_manifest(manifest: Manifest, out: Path) -> None:
    """Write a manifest into a directory; InputError if it cannot be written."""
    write_json(asdict(replace(manifest, digest=manifest.expected_digest)), out / MANIFEST)


def read_manifest(out: Path) -> Manifest:
    """Read the manifest in a directory.

    Raises
    ------
    InputError
        If there is none, or it is damaged, edited or of another version.
    """
    path = out / MANIFEST
    if not path.is_file():
        raise InputError(f"{out}: holds no {MANIFEST}; name a directory that 'roughfilm generate' wrote")
    text = read_bytes(path, MAX_MANIFEST_BYTES, "generate the cases again")
    try:
        manifest = from_json(text, Manifest)
    except ValueError as error:
        raise InputError(f"{path}: is damaged ({error}); generate the cases again") from error
    if manifest.version not in (WITHOUT_DIGEST, VERSION):
        known = f"{WITHOUT_DIGEST} and {VERSION}"
        raise InputError(f"{path}: has version {manifest.version}; this one reads {known}, generate again")
    unknown = {name for one in manifest.cases.values() for name in one.varied} - {*manifest.keys}
    if not manifest.cases or not manifest.settings or unknown:
        raise InputError(f"{path}: is damaged (it lacks cases, settings, or keys of cases); generate the cases again")
    places = [one.directory for one in manifest.generated]
    for name in (*manifest.cases, *manifest.settings, *places, *manifest.inputs.values()):
        if Path(name).is_absolute() or ".." in Path(name).parts:
            raise InputError(f"{path}: names a place outside of its directory, {name!r:.80}; generate the cases again")
        named_path(str(path), name)
    if manifest.has_digest and manifest.digest != manifest.expected_digest:
        edited = [name for name, one in manifest.cases.items() if one.digest != digest_of_entries(one.scene)]
        what = "the scene" + (f" of the case {edited[0]}" if edited[0] else "") if edited else "an entry"
        raise InputError(f"{path}: {what} was edited, as its digest says; put the original back, or generate again")
    return manifest


def digests(directory: Path) -> dict[str, str]:
    """The SHA-256 digest of each file below a directory, by its path in it; links are left out."""
    found = {}
    for place, _, names in os.walk(directory):
        for path in (Path(place) / name for name in names):
            if not path.is_symlink():
                found[path.relative_to(directory).as_posix()] = digest(path)
    return dict(sorted(found.items()))


def digest(path: Path) -> str:
    """The SHA-256 digest of a file; "" if it is no regular file or cannot be read."""
    try:
        with opened(path, "generate the cases again") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except InputError:
        return ""


def _with_copies(entries: Any, copies: Mapping[str, str], out: Path) -> Any:
    """The entries with the copy of each file that is not at its place."""
    if isinstance(entries, Mapping):
        return {key: _with_copies(value, copies, out) for key, value in entries.items()}
    if isinstance(entries, list):
        return [_with_copies(value, copies, out) for value in entries]
    if isinstance(entries, str) and entries in copies and not Path(entries).expanduser().exists():
        return str(out / copies[entries])
    return entries
