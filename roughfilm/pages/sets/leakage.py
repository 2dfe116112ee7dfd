"""The page of the leakage of a seal whose surface is known in several windows."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.figures.sets import leakage as figures
from roughfilm.pages.render import render
from roughfilm.rom.seal.leakage.windows import SealOfWindows
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.average import HEADS, cells_of, count_in_words
from roughfilm.words.leakage import sealing_in_words
from roughfilm.words.numbers import digits
from roughfilm.words.scales import Scale, scale_for

KINDS = ("direct", "homogenized")
"""The flow through one period between reservoirs, and that of the periodic surface."""


def write_page(scene: Seal, seal: SealOfWindows, entries: Mapping[str, Any], path: Path) -> None:
    """Write the page of a seal over its windows and of the object of ``--json``; InputError if it cannot be written."""
    leak = seal.answer["leakage_per_width"]
    scale, gap, area = scale_for("kg/(m*s)", leak.value), Scale(factor=1e-6, unit="µm"), Scale(factor=0.01, unit="%")
    axis = scene.flow.direction
    leaks = {way: [one.scaled(leakage_of(scene, 1.0)) for one in seal.numbers[f"direct_{way}"]] for way in "xy"}
    render(
        "leakage_windows.html.j2",
        path,
        scene=scene,
        entries=entries,
        windows=count_in_words(seal.count, seal.independent),
        load=digits(seal.load * 1e-6),
        heads=HEADS,
        cards={
            f"leakage per width along {axis}, {scale.unit}": cells_of(leak, scale),
            "contact area over nominal area, %": cells_of(seal.answer["area_fraction"], area),
            "mean gap, µm": cells_of(seal.answer["mean_gap"], gap),
        },
        sealed=leak.zeros,
        lanes=scale.text(seal.answer_in_series) if seal.periods["xy".index(axis)] > 1 else "",
        periods=seal.periods["xy".index(axis)],
        thresholds={way: [sealing_in_words(seal.sealing[f"{kind}_{way}"]) for kind in KINDS] for way in "xy"},
        leakages=figures.leakages(scene, seal, scale),
        contacts=figures.contacts(seal),
        closed=figures.sealed(seal),
        unit=scale.unit,
        rows=[
            (
                load == seal.load,
                [
                    digits(load * 1e-6),
                    digits(100 * seal.numbers["area_fraction"][number].value),
                    digits(1e6 * seal.numbers["mean_gap"][number].value),
                    *cells_of(leaks[axis][number], scale),
                    f"{100 * leaks[axis][number].zeros:.3g}",
                ],
            )
            for number, load in enumerate(seal.loads)
        ],
    )
