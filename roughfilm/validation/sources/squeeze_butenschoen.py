"""Butenschön's table of the full journal bearing whose shaft moves straight at the bore and does not turn."""

from collections.abc import Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.journal import (
    CLOSE,
    Grids,
    extrapolated,
    method,
    side_flow_of_din,
    sommerfeld_of_din,
    squeezed_journal,
)
from roughfilm.validation.published import Answer, Source
from roughfilm.validation.sources.butenschoen import SOURCE as ROTATION
from roughfilm.validation.sources.butenschoen import answered

USUAL = Grids(wide=64, close=144)
THOROUGH = Grids(wide=192, close=384)

EXTRAPOLATED = "extrapolated from these and half as many"
"""What is done with the films of the second grid, in words."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """Every row of the table, with the entries that the rest of the table or a second method contradicts."""
    grids = THOROUGH if thorough else USUAL

    def ours(eccentricity: float, width: float) -> Mapping[str, Quantity]:
        cells = grids.of(eccentricity)
        sizes = (cells // 2, cells) if eccentricity >= CLOSE else (cells,)
        results = [squeezed_journal(eccentricity, width, size) for size in sizes]
        loads = [sommerfeld_of_din(result, width, 1.0) for result in results]
        flows = [side_flow_of_din(result, 1.0) for result in results]
        return {name: one[0] if len(one) == 1 else extrapolated(*one) for name, one in (("So", loads), ("Q", flows))}

    return answered("squeeze_butenschoen", ours, progress, turns=False)


SOURCE = Source(
    name="squeeze_butenschoen",
    title="Butenschön 1976: journal that moves straight at the bore, 29 × 8 cases",
    citation=ROTATION.citation,
    obtained=ROTATION.obtained,
    methods=(f"{method(USUAL)}, {EXTRAPOLATED}", f"{method(THOROUGH)}, {EXTRAPOLATED}"),
    bar=ROTATION.bar,
    abscissa="eccentricity ε, negative from the far side",
    cost=(12.0, 90.0),
    answer=answer,
)
