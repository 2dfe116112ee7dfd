"""Words that the shell completes after a Tab: kinds and models; files are completed by the shell itself."""

import pkgutil
from pathlib import Path

import shellingham
import typer

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import read_toml

SHELLS = "bash", "zsh", "fish", "powershell", "pwsh"
"""The shells that typer has scripts for."""


def needs_shell(option: str) -> None:
    """Refuse an option that is for the shell that runs, where that shell is none of ``SHELLS``."""
    try:
        name, _ = shellingham.detect_shell()
    except shellingham.ShellDetectionFailure:
        name = "unknown"
    if name not in SHELLS:
        raise InputError(
            f"{option}: the shell that runs this command is {name}; it must be one of {', '.join(SHELLS)}: "
            "start the command from one of them"
        )


def kinds_beginning_with(incomplete: str) -> list[str]:
    """The kinds of scenes whose names begin with a text, from the folders ``rom/<kind>/models``."""
    return sorted(name for name in _models_by_kind() if name.startswith(incomplete))


def models_beginning_with(ctx: typer.Context, incomplete: str) -> list[str]:
    """The models whose names begin with a text: those of the scene file before it, or of all kinds."""
    by_kind = _models_by_kind()
    files = (ctx.params.get("scene"), *ctx.args)  # an option that lacks its value leaves the file in the latter
    kind = next(filter(None, map(_kind_of_file, files)), "")
    names = by_kind.get(kind, frozenset[str]().union(*by_kind.values()))
    return sorted(name for name in names if name.startswith(incomplete))


def _models_by_kind() -> dict[str, frozenset[str]]:
    """The models of each kind, as the folders list them; no model is imported."""
    found: dict[str, frozenset[str]] = {}
    for package in (rom, foamcases):
        for place in package.__path__:
            for folder in sorted(Path(place).glob("*/models")):
                names = frozenset(module.name for module in pkgutil.iter_modules([str(folder)]))
                found[folder.parent.name] = found.get(folder.parent.name, frozenset()) | names
    return found


def _kind_of_file(path: Path | str | None) -> str | None:
    """The kind that a scene file names; None where it cannot be read."""
    try:
        kind = read_toml(Path(path or ""), "").get("kind")
    except InputError:
        return None
    return kind if isinstance(kind, str) else None
