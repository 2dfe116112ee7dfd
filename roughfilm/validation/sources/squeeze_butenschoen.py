"""Butenschön's table of the full journal bearing whose shaft moves straight at the bore and does not turn."""

from collections.abc import Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.journal import Grids, method, side_flow_of_din, sommerfeld_of_din, squeezed_journal
from roughfilm.validation.published import Answer, Source
from roughfilm.validation.sources.butenschoen import SOURCE as ROTATION
from roughfilm.validation.sources.butenschoen import answered

USUAL = Grids(wide=64, close=128)
THOROUGH = Grids(wide=192, close=384)


def answer(thorough: bool, progress: Progress) -> Answer:
    """Every row of the table, with the entries that the rest of the table or a second method contradicts."""
    grids = THOROUGH if thorough else USUAL

    def ours(eccentricity: float, width: float) -> Mapping[str, Quantity]:
        result = squeezed_journal(eccentricity, width, grids)
        return {"So": sommerfeld_of_din(result, width, 1.0), "Q": side_flow_of_din(result, 1.0)}

    return answered("squeeze_butenschoen", ours, progress, turns=False)


SOURCE = Source(
    name="squeeze_butenschoen",
    title="Butenschön 1976: journal that moves straight at the bore, 29 × 8 cases",
    citation=ROTATION.citation,
    obtained=ROTATION.obtained,
    methods=(method(USUAL), method(THOROUGH)),
    bar=ROTATION.bar,
    abscissa="eccentricity ε, negative from the far side",
    cost=(12.0, 90.0),
    answer=answer,
)
