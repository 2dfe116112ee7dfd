"""Archives of X3P (ISO 25178-72) that SurfaceTopography refuses, in the form that it reads."""

import io
import zipfile
from pathlib import Path
from typing import TypeVar
from xml.etree import ElementTree

import numpy as np

from roughfilm.contact.foundation.errors import InputError

INDEX = "main.xml"
"""Name of the member that describes the measurement."""

MAX_INDEX_BYTES = 10_000_000
"""Size of the index, bytes, above which an archive is refused."""

REVISION = "ISO5436 - 2000"
"""The revision that SurfaceTopography expects; instruments write it with other dashes and dates."""

N = TypeVar("N", int, float)

FROM_LIST = "heights.bin"
"""Name of the member with the heights that the index listed."""


def repaired(path: Path, most: int) -> io.BytesIO | None:
    """An X3P archive with its index at the root and its heights in a member; None if it needs no repair or is none.

    Members in the folder of the index are moved to the root, all others are left out. An empty ``Offset`` becomes 0,
    an empty ``Increment`` of the heights 1. Any revision is taken for that of the standard. Heights in the index itself
    (``DataList``) become a member of 64-bit floats, NaN where they are empty; a profile becomes a map of one line.

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
        root = _parsed(archive.read(folder + INDEX))
        changes = [_with_offsets(root), _with_revision(root), _as_map(root)]
        listed = _heights_of_list(root)
        if not folder and listed is None and not any(changes):
            return None
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as whole:
            for one in members:
                name = one.filename.removeprefix(folder)
                if name != INDEX:
                    whole.writestr(name, archive.read(one))
            if listed is not None:
                whole.writestr(FROM_LIST, listed)
            whole.writestr(INDEX, ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))
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


def _parsed(index: bytes) -> ElementTree.Element:
    try:
        return ElementTree.fromstring(index)
    except ElementTree.ParseError as error:
        raise InputError(f"has a damaged {INDEX} ({error}); export it again from the instrument") from None


def _with_offsets(root: ElementTree.Element) -> bool:
    """Give empty offsets and scales their usual values; whether there were any."""
    empty = [one for one in root.iter("Offset") if not (one.text or "").strip()]
    empty_scales = [one for axis in root.iter("CZ") for one in axis.iter("Increment") if not (one.text or "").strip()]
    for one in empty:
        one.text = "0"
    for one in empty_scales:
        one.text = "1"
    return bool(empty or empty_scales)


def _with_revision(root: ElementTree.Element) -> bool:
    """Write the revision as the standard does; whether it was another."""
    others = [one for one in root.iter("Revision") if one.text != REVISION]
    for one in others:
        one.text = REVISION
    return bool(others)


def _as_map(root: ElementTree.Element) -> bool:
    """Make a map of one line of a profile, whose points may be counted as a list; whether it is one."""
    kinds = [one for one in root.iter("FeatureType") if one.text == "PRF"]
    for one in kinds:
        one.text = "SUR"
    if kinds and root.find("Record1/Axes/CY/AxisType") is None:
        axes, along = root.find("Record1/Axes"), root.find("Record1/Axes/CX")
        if axes is not None and along is not None:
            across = ElementTree.fromstring(ElementTree.tostring(along).replace(b"CX>", b"CY>"))
            for old in axes.findall("CY"):
                axes.remove(old)
            axes.append(across)
    for record in root.iter("Record3"):
        for count in record.findall("ListDimension"):
            size = ElementTree.SubElement(record, "MatrixDimension")
            for name, number in (("SizeX", count.text), ("SizeY", "1"), ("SizeZ", "1")):
                ElementTree.SubElement(size, name).text = number
            record.remove(count)
            kinds.append(count)
    return bool(kinds)


def _heights_of_list(root: ElementTree.Element) -> bytes | None:
    """Replace the list of heights in the index by a link to a member; the bytes of that member, None without a list."""
    record, heights = root.find("Record3"), root.find("Record3/DataList")
    kind = root.find("Record1/Axes/CZ/DataType")
    if record is None or heights is None or kind is None:
        return None
    texts = [(one.text or "").rpartition(";")[2].strip() for one in heights.iter("Datum")]
    counts = [
        _number(record.findtext(f"MatrixDimension/Size{axis}") or "0", "gives the number of points", int)
        for axis in "XY"
    ]
    if len(texts) != counts[0] * counts[1]:
        raise InputError(
            f"lists {len(texts)} heights for {counts[0]} x {counts[1]} points; export it again from the instrument"
        )
    values = np.array([_number(text, "lists the height", float) if text else np.nan for text in texts], dtype="<f8")
    record.remove(heights)
    link = ElementTree.SubElement(record, "DataLink")
    ElementTree.SubElement(link, "PointDataLink").text = FROM_LIST
    kind.text = "D"
    return values.tobytes()


def _number(text: str, said: str, kind: type[N]) -> N:
    try:
        return kind(text)
    except (ValueError, OverflowError):
        raise InputError(f"{said} {text!r:.40}, which is no number; export it again from the instrument") from None
