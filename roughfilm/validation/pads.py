"""Pads with one rectangular pocket: the scene of two published tables."""

from typing import Any

from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.ladder.scene import read_scene


def pocketed_pad(
    *,
    length: float,
    inlet: float,
    outlet: float,
    start: float,
    pocket: float,
    depth: float,
    speed: float,
    lubricant: dict[str, Any],
    widths: tuple[float, float] | None = None,
) -> dict[str, Any]:
    """The entries of a scene: a film that falls linearly, with one pocket of uniform additional depth.

    Parameters
    ----------
    length, inlet, outlet : length of the pad and film thickness at its ends, m.
    start, pocket, depth : start, length and depth of the pocket, m.
    speed : speed of the flat wall, m/s.
    lubricant : the entries of the lubricant.
    widths : width of the pad and of the pocket, m; None for an infinitely wide pad.
    """
    across = ({}, {}) if widths is None else tuple({"width": f"{one!r} m"} for one in widths)
    return {
        "name": "pocketed pad",
        "kind": "bearing",
        "geometry": {
            "shape": "linear",
            "length": f"{length!r} m",
            "film": f"{outlet!r} m",
            "rise": f"{inlet - outlet!r} m",
            **across[0],
            "texture": {
                "profile": "box",
                "start": f"{start!r} m",
                "length": f"{pocket!r} m",
                "depth": f"{depth!r} m",
                **across[1],
            },
        },
        "lubricant": lubricant,
        "motion": {"speed": f"{speed!r} m/s"},
    }


def film_of(entries: dict[str, Any], cells: tuple[int, int]) -> Solution:
    """The film of the scene with these entries, on so many cells along and across."""
    scene = read_scene(entries)
    assert isinstance(scene, Bearing)
    return solve(scene.problem(), cells)
