"""Limits on the memory that reading or making something may take."""

from pathlib import Path

from roughfilm.contact.foundation.errors import InputError


def memory_available(table: Path = Path("/proc/meminfo")) -> float:
    """The memory that programs can still use on this machine, bytes; infinite where ``table`` does not state it."""
    try:
        for line in table.read_text(encoding="ascii").splitlines():
            name, _, value = line.partition(":")
            if name == "MemAvailable":
                return 1024.0 * int(value.split()[0])
    except (OSError, ValueError, IndexError):
        pass
    return float("inf")


def refuse_beyond_memory(place: str, needed: float, remedy: str) -> None:
    """Raise InputError if what is asked for at a place needs more memory, bytes, than is available.

    Parameters
    ----------
    place : the beginning of the message, such as the name of a file with what it holds.
    needed : estimate of the memory, bytes.
    remedy : the end of the message.
    """
    if needed > (there := memory_available()):
        raise InputError(
            f"{place} takes about {needed / 2**30:.3g} GiB of memory, and {there / 2**30:.3g} GiB are available; "
            f"{remedy}"
        )
