"""Scenes that are compared by their entries, for results that are kept in memory."""

from dataclasses import dataclass, field

from roughfilm.rom.bearing.scene import Bearing


@dataclass(frozen=True, kw_only=True)
class KeyedScene:
    """A scene, which is compared by its entries without its name."""

    entries: str
    scene: Bearing = field(compare=False)


def keyed(scene: Bearing) -> KeyedScene:
    """The scene with its entries as the key."""
    return KeyedScene(entries=scene.model_dump_json(exclude_none=True, exclude={"name"}), scene=scene)
