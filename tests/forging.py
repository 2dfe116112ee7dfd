"""Files changed on purpose whose header is right: its digest is computed again."""

import hashlib
from collections.abc import Callable
from pathlib import Path

import h5py

from roughfilm.contact.foundation.checked_hdf5 import HEADER_BYTES, header_block


def forge(path: Path, change: Callable[[h5py.File], None]) -> None:
    """Change the content of a file with a digest, and write the digest of what it then holds."""
    with h5py.File(path, "r+") as file:
        change(file)
    sign(path, path.read_bytes())


def sign(path: Path, data: bytes) -> None:
    """Write the bytes of such a file with the digest of what follows its header."""
    mark = data[: data.index(b"sha256 ") + len(b"sha256 ")]
    rest = data[HEADER_BYTES:]
    path.write_bytes(header_block(mark, hashlib.sha256(rest).hexdigest()) + rest)
