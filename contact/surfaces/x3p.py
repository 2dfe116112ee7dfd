"""Archives of X3P (ISO 25178-72) that SurfaceTopography refuses: in a folder, or with an empty offset."""

import io
import zipfile
from pathlib import Path
from xml.etree import ElementTree

from roughfilm.contact.foundation.errors import InputError

INDEX = "main.xml"
"""Name of the member that describes the measurement."""

MAX_INDEX_BYTES = 10_000_000
"""Size of the index, bytes, above which an archive is refused."""


def repaired(path: Path, most: int) -> io.BytesIO | None:
    """An X3P archive with its index at the root and with offsets; None if the file needs no repair or is none.

    Members in the folder of the index are moved to the root, all others are left out. An empty ``Offset`` becomes 0,
    an empty ``Increment`` of the heights 1.

    Parameters
    ----------
    path : any file.
    most : largest number of bytes of the unpacked members.

    Raises
    ------
    InputError
        If the archive holds several measurements or claims more bytes than ``most``, or its index is damaged.
    """
    try:
        archive = zipfile.ZipFile(path)
    except zipfile.BadZipFile:
        return None
    with archive:
        folder = _folder(archive)
        if folder is None:
            return None
        members = [
            one for one in archive.infolist() if one.filename.startswith(folder) and not one.filename.endswith("/")
        ]
        claimed = sum(one.file_size for one in members)
        if claimed > most or archive.getinfo(folder + INDEX).file_size > MAX_INDEX_BYTES:
            raise InputError(f"claims {claimed} bytes of members; at most {most} fit an archive of its length")
        index, changed = _with_offsets(archive.read(folder + INDEX))
        if not folder and not changed:
            return None
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as whole:
            for one in members:
                name = one.filename.removeprefix(folder)
                whole.writestr(name, index if name == INDEX else archive.read(one))
    packed.seek(0)
    return packed


def _folder(archive: zipfile.ZipFile) -> str | None:
    """The folder of the index, with a slash at its end; empty for the root, None without an index."""
    names = [name for name in archive.namelist() if name == INDEX or name.endswith("/" + INDEX)]
    if INDEX in names:
        return ""
    if len(names) > 1:
        raise InputError(f"is an archive of {len(names)} measurements; give each X3P by itself")
    return names[0].removesuffix(INDEX) if names else None


def _with_offsets(index: bytes) -> tuple[bytes, bool]:
    """The index without empty offsets, and whether it had any."""
    try:
        root = ElementTree.fromstring(index)
    except ElementTree.ParseError as error:
        raise InputError(f"has a damaged {INDEX} ({error}); export it again from the instrument") from None
    empty = [one for one in root.iter("Offset") if not (one.text or "").strip()]
    empty_scales = [one for axis in root.iter("CZ") for one in axis.iter("Increment") if not (one.text or "").strip()]
    for one in empty:
        one.text = "0"
    for one in empty_scales:
        one.text = "1"
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True), bool(empty or empty_scales)
