"""The provenance of a result: versions, commit, machine, the complete scene, and the model's sources."""

import ast
import hashlib
import json
import os
import platform
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import cache
from importlib.util import cache_from_source
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.timing import one_time
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import scene_entries

LIBRARY = Path(__file__).parents[2]
"""The folder of the package roughfilm, with contact, rom and foamcases in it."""

DEFERRED = re.compile(rb'\bdeferred\(\s*"([\w.]+)"')
"""Imports that wait until the first call, see ``roughfilm.contact.foundation.deferred``."""

OWN = Path(__file__).read_bytes()
"""This file, whose changes make what is kept about others unknown."""

MOST_KNOWN = 4000
"""Number of source files, changed ones counted again, from which on they are parsed anew."""

BLOCKS = (ast.stmt, ast.ExceptHandler, ast.match_case)
"""Classes of the nodes of a syntax tree that are statements or contain statements."""


@cache
@one_time("start")
def versions() -> dict[str, str]:
    """The versions of Python, of roughfilm and of the libraries with which it computes, by name."""
    from importlib import metadata  # slow to import

    names = ("roughfilm", "numpy", "scipy", "h5py", "foamlib", "pydantic", "pint", "numba", "pyfftw")
    return {"python": platform.python_version(), **{name: metadata.version(name) for name in names}}


@cache
@one_time("start")
def commit() -> str:
    """The commit of the source tree, with "+changes" if files were edited since; "unknown" outside of a checkout."""
    tree = Path(__file__).resolve().parents[2]
    if not (tree / ".git").exists():
        return "unknown"
    try:
        described = subprocess.run(
            ["git", "-C", str(tree), "describe", "--always", "--abbrev=12", "--dirty=+changes"],
            capture_output=True,
            text=True,
            timeout=10,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return "unknown"
    return described.stdout.strip()


@cache
@one_time("start")
def code() -> str:
    """A digest of all source files of contact, rom and foamcases: equal digests give equal numbers."""
    files = sorted(path for package in ("contact", "rom", "foamcases") for path in (LIBRARY / package).rglob("*.py"))
    return _digest({path.relative_to(LIBRARY).as_posix(): path.read_bytes() for path in files})


@cache
@one_time("start")
def model_code(kind: str, model: str) -> str:
    """A digest of the code that a model runs, 16 hexadecimal digits: equal digests give equal numbers.

    It covers the model's module and all modules of this library that it imports, directly or through others, at once or
    deferred, without docstrings and comments. The digest of a model without a module of its own is :func:`code`.
    """
    return _code_of([f"roughfilm.{package}.{kind}.models.{model}" for package in ("rom", "foamcases")])


@cache
@one_time("start")
def imported_code(*modules: str) -> str:
    """A digest of modules of this library, by their dotted names, and of all that they import, as :func:`model_code`.

    The digest of modules that do not exist is :func:`code`.
    """
    return _code_of(modules)


def _code_of(modules: Sequence[str]) -> str:
    statements: dict[str, bytes] = {}
    known = _known(place := _kept_at())
    pending, before = [*modules], len(known)
    while pending:
        name = pending.pop()
        if name in statements:
            continue
        path = LIBRARY.parent / f"{name.replace('.', '/')}.py"
        if not path.is_file():  # as for the name of an imported function
            statements[name] = b""
            continue
        text = path.read_bytes()
        source = hashlib.sha256(OWN + text).hexdigest()
        if source not in known:
            known[source] = _statements(text)
        of_module, *imports = known[source]
        statements[name] = of_module.encode()
        pending += imports
    if len(known) > before:
        _keep(known, place)
    return _digest(statements) if any(statements.values()) else code()


def _kept_at() -> Path:
    """The file of what is known about source files, beside the bytecode of this library."""
    return Path(cache_from_source(str(LIBRARY / "statements.py"))).with_suffix(".json")


@cache
def _known(place: Path) -> dict[str, list[str]]:
    """The digest of the statements of source files and what they import, by the digest of each file with ``OWN``.

    To parse them all takes half of the CPU time in which a process starts.
    """
    try:
        entries = json.loads(place.read_text(encoding="utf-8"))
        known = {source: [str(word) for word in words] for source, words in entries.items() if words}
        return known if len(known) < MOST_KNOWN else {}
    except (OSError, ValueError, AttributeError, TypeError):
        return {}


def _keep(known: Mapping[str, Sequence[str]], place: Path) -> None:
    """Keep it for later processes where that is possible, as Python keeps bytecode."""
    beside = place.with_suffix(f".{os.getpid()}")
    try:
        if not sys.dont_write_bytecode:
            place.parent.mkdir(exist_ok=True)
            beside.write_text(json.dumps(known), encoding="utf-8")
            beside.replace(place)
    except OSError:
        beside.unlink(missing_ok=True)


def _digest(contents: Mapping[str, bytes]) -> str:
    digest = hashlib.sha256()
    for name in sorted(contents):
        digest.update(name.encode() + b"\0" + contents[name] + b"\0")
    return digest.hexdigest()[:16]


def _statements(text: bytes) -> list[str]:
    """A digest of the statements of a module without docstrings, and then all names in this library that it imports."""
    tree = ast.parse(text)
    imports = {f"roughfilm.{module.decode()}" for module in DEFERRED.findall(text)}
    pending: list[ast.AST] = [tree]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            imports |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            imports |= {alias.name for alias in node.names}
        for entries in vars(node).values():
            if isinstance(entries, list) and entries and isinstance(entries[0], BLOCKS):
                entries[:] = [entry for entry in entries if not _is_text(entry)]
                pending += entries
    digest = hashlib.sha256(ast.dump(tree).encode()).hexdigest()
    return [digest, *sorted(name for name in imports if name.startswith("roughfilm."))]


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


@cache
def machine() -> dict[str, str]:
    """The machine on which times are measured: system, processor and number of cores."""
    processor = platform.processor() or platform.machine()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        processor = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), processor)
    except OSError:
        pass
    return {"system": platform.system(), "processor": processor, "cores": str(os.cpu_count())}


def provenance(
    scene: Scene, *, model: str = "", keeps: Sequence[str], sources: Sequence[str], **more: Any
) -> dict[str, Any]:
    """The data needed to compute a result again, as entries for JSON.

    Parameters
    ----------
    scene : the scene that was solved.
    model : name of the model, whose code has the digest ``code``.
    keeps : the effects that the model keeps.
    sources : DOIs of the equations and the method.
    **more : further entries.
    """
    return {
        "scene": scene_entries(scene),
        "keeps": sorted(keeps),
        "sources": list(sources),
        **circumstances(),
        "code": model_code(scene.kind, model),
        **more,
    }


def circumstances() -> dict[str, Any]:
    """The versions, machine, load and time of a computation, as entries for JSON."""
    return {
        "versions": versions(),
        "commit": commit(),
        "code": code(),
        "machine": machine(),
        "load_average": round(os.getloadavg()[0], 2),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
    }
