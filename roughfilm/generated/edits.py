"""Find what was edited in a generated case since it was written."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.foamcases.openfoam.allrun import ALLRUN
from roughfilm.generated.manifest import Generated, digest

LONGEST = 40
"""Greatest number of characters of a value that is shown."""

MOST = 6
"""Greatest number of edits of a case that are shown; the others are counted."""


def edits_of(directory: Path, generated: Generated, write: Callable[[Path], None]) -> tuple[str, ...]:
    """The edits of a case in words, one for each entry of a dictionary and for each other file; empty without edits.

    Parameters
    ----------
    directory : the directory of the case.
    generated : the case as it was written, with the digest of each file.
    write : write(place), which writes the case anew; it is called only if a file differs.
    """
    found = {name: digest(directory / name) for name in generated.files}
    differing = [name for name, one in found.items() if one != generated.files[name]]
    if not differing:
        return ()
    with scratch_directory() as place:
        original = place / "case"
        try:
            write(original)
        except Exception:  # without the original the names of the files are known, and no entries
            original = place
        words = [
            edit
            for name in differing
            for edit in _edits_of_file(
                name,
                directory / name,
                original / name if digest(original / name) == generated.files[name] else None,
                missing=not found[name],
            )
        ]
    shown = words[:MOST]
    if len(words) > MOST:
        shown.append(f"{len(words) - MOST} more")
    return tuple(shown)


def _edits_of_file(name: str, path: Path, original: Path | None, *, missing: bool) -> Iterator[str]:
    """The edits of one file: each entry that differs, or that it differs at all if it is not a dictionary."""
    if missing:
        yield f"{name} is missing"
        return
    try:
        before, after = (None, None) if original is None else (_entries(original), _entries(path))
    except Exception:  # a file that is no dictionary, or is damaged
        before = after = None
    if before is None or after is None:
        yield f"{name} differs"
        return
    keys = [key for key in {**before, **after} if not _same(before.get(key), after.get(key))]
    if not keys:
        yield f"{name} differs in its layout alone"
    for key in keys:
        old, new = _shown(before.get(key)), _shown(after.get(key))
        entry = f"{name}: {key}" if key else name
        yield f"{entry} differs" if old == new else f"{entry} {old} → {new}"


def _entries(path: Path) -> dict[str, Any]:
    """The entries of a dictionary of OpenFOAM by their dotted keys."""
    from foamlib import FoamFile  # slow to import

    if path.name == ALLRUN or path.suffix:
        raise ValueError("is not a dictionary")
    return dict(_flat(FoamFile(path).as_dict()))


def _flat(entries: Mapping[Any, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in entries.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key or ''}", value


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(np.asarray(one), np.asarray(other))
    return bool(one == other)


def _shown(value: Any) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, np.ndarray) and value.size > 3:
        return f"{value.shape[0]} values"
    text = " ".join(map(str, value)) if isinstance(value, tuple) else str(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."
