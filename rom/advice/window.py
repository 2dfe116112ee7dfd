"""The scatter between windows and the error of the input, which no model includes, as sentences beside the advice."""

import math

from roughfilm.contact.windows.one_window import MAX_SCATTER, rms_height_scatter
from roughfilm.rom.ladder.kind import Scene, kind_of_scene

OF_TWO = 1.96 * math.sqrt(2)
"""Difference that two windows exceed in 5 of 100 cases, over the standard deviation between windows."""


def window_note(scene: Scene, within: float) -> str:
    """The sentence on the difference in Sq to another window of the size of the surface in a scene.

    It is empty if the scene has no rough surface, if one window does not show the difference
    (:func:`roughfilm.contact.windows.one_window.rms_height_scatter`), or if it is at most the tolerance ``within``.
    """
    surface = kind_of_scene(scene).window(scene)
    if surface is None or surface.invalid.any():
        return ""
    one = rms_height_scatter(surface)
    if one is None or OF_TWO * one <= within:
        return ""
    size = f"{float(f'{100 * OF_TWO * min(one, MAX_SCATTER):.1g}'):g}"
    amount = f"by up to about {size} % (95 %, to a factor of two)" if one <= MAX_SCATTER else f"by {size} % and more"
    return (
        f"the surface is one window: Sq of another one of its size differs {amount}, contact area about as much and "
        "leakage several times as much, which no error here includes; run roughfilm windows"
    )


def input_note(scene: Scene, quantity: str, within: float) -> str:
    """The sentence on the error of the input in a quantity; empty if it is at most the tolerance ``within``."""
    own = kind_of_scene(scene).of_input(scene, quantity)
    return "" if own is None or own.part <= within else f"{own.reason}, which no error here includes"
