"""What is computed for each window: parameters of its cell, or quantities of a scene with the cell as surface."""

import copy
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.faults import EntriesFile
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import load_entries, read_scene, scene_entries

PLACES = {"dry_contact": "geometry", "seal": "geometry", "bearing": "roughness"}
"""The table of a scene of each kind whose entry ``surface`` the cell of a window replaces."""

HEADLINES = {"": "Sq", "dry_contact": "area_fraction", "seal": "leakage_per_width", "bearing": "friction_coefficient"}
"""The quantity that is sought most, by the kind of scene; "" without a scene."""

KINDS = "dry_contact, seal, or bearing with a roughness of the kind surface"


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What is computed for each cell.

    Attributes
    ----------
    scene : entries of a scene, whose surface is replaced; empty without a scene.
    gap : mean gap of the flow factors without a scene, m; None for the roughness parameters alone.
    sealing : whether the load is sought at which a seal closes.
    resolution : number of cells along and across a bearing.
    """

    scene: Mapping[str, Any] = field(default_factory=dict)
    gap: float | None = None
    sealing: bool = False
    resolution: int = 64

    @property
    def kind(self) -> str:
        """The kind of the scene; "" without one."""
        return str(self.scene.get("kind", ""))

    @property
    def headline(self) -> str:
        """The name of the quantity that is sought most."""
        return "A11" if not self.scene and self.gap is not None else HEADLINES[self.kind]

    @property
    def digest(self) -> str:
        """A digest of all that is asked, without the name of the scene."""
        scene = {key: entry for key, entry in self.scene.items() if key != "name"}
        text = json.dumps([scene, self.gap, self.sealing, self.resolution], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]


def asked_of(scene: Path | Scene | Mapping[str, Any], surface: Path, **more: Any) -> Asked:
    """The computation of a scene, with the surface taken out of its entries.

    Parameters
    ----------
    scene : a scene, its file, or its entries.
    surface : HDF5 file of any cell, with which the scene is checked.
    **more : further fields of `Asked`.

    Raises
    ------
    InputError
        If the scene has a fault, another kind, or a bearing no roughness of the kind surface.
    """
    file = None
    if isinstance(scene, Path):
        entries, file = load_entries(scene), EntriesFile(path=scene, changed=())
    else:
        entries = scene_entries(scene) if isinstance(scene, Scene) else copy.deepcopy(dict(scene))
    where = f"{scene}: " if isinstance(scene, Path) else "scene: "
    kind = entries.get("kind")
    if kind not in PLACES:
        raise InputError(f"{where}kind: got {kind!r:.40}; windows are put into scenes of the kinds {KINDS}")
    checked = read_scene(_with_surface(entries, surface, where), file)
    whole = scene_entries(checked)
    for key in ("surface", "digest"):
        whole[PLACES[kind]].pop(key, None)
    return Asked(scene=whole, **more)


def with_cell(asked: Asked, surface: Path) -> Scene:
    """The scene with the surface in a file, HDF5 of this package."""
    return read_scene(_with_surface(copy.deepcopy(dict(asked.scene)), surface, "scene: "))


def _with_surface(entries: dict[str, Any], surface: Path, where: str) -> dict[str, Any]:
    place = PLACES[entries["kind"]]
    table = entries.setdefault(place, {})
    if not isinstance(table, dict):
        raise InputError(f"{where}{place}: got {table!r:.40}; write a table [{place}]")
    if place == "roughness" and table.get("kind") != "surface":
        raise InputError(
            f"{where}roughness.kind: got {table.get('kind')!r:.40}; windows are put into a roughness of the kind "
            '"surface"'
        )
    for key in ("spacing", "digest"):
        table.pop(key, None)
    table["surface"] = str(surface)
    return entries
