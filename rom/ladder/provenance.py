"""Where a number came from: versions, commit, machine, the complete scene, and the models' sources."""

import hashlib
import os
import platform
import subprocess
from collections.abc import Sequence
from datetime import UTC, datetime
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import scene_entries


@cache
def versions() -> dict[str, str]:
    """Versions of roughfilm, of Python and of the libraries that compute."""
    names = ("roughfilm", "numpy", "scipy", "h5py", "foamlib", "pydantic", "pint", "numba", "pyfftw")
    return {"python": platform.python_version(), **{name: metadata.version(name) for name in names}}


@cache
def commit() -> str:
    """The commit of the source tree, with "+changes" if it was edited since; "unknown" outside a checkout."""
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
def code() -> str:
    """A digest of the source of the three packages that compute: equal digests give equal numbers."""
    tree = Path(__file__).parents[2]
    digest = hashlib.sha256()
    for path in sorted(path for package in ("contact", "rom", "foamcases") for path in (tree / package).rglob("*.py")):
        digest.update(path.relative_to(tree).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


@cache
def machine() -> dict[str, str]:
    """What the times were measured on: system, processor and cores."""
    processor = platform.processor() or platform.machine()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        processor = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), processor)
    except OSError:
        pass
    return {"system": platform.system(), "processor": processor, "cores": str(os.cpu_count())}


def provenance(scene: Scene, *, keeps: Sequence[str], sources: Sequence[str], **more: Any) -> dict[str, Any]:
    """Everything needed to compute a result again, as entries that JSON can hold."""
    return {"scene": scene_entries(scene), "keeps": sorted(keeps), "sources": list(sources), **circumstances(), **more}


def circumstances() -> dict[str, Any]:
    """With what, where and when something was computed, as entries that JSON can hold."""
    return {
        "versions": versions(),
        "commit": commit(),
        "code": code(),
        "machine": machine(),
        "load_average": round(os.getloadavg()[0], 2),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
    }
