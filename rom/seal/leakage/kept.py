"""Leakage over the load that is kept in the cache: the thresholds of a surface, and the rows of a series of loads."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from roughfilm.contact.foundation.cache import entry_path, trim, use, warn
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.homogenization.table.kept import table_inputs
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import LeakageSeries, Row, save_series, stored_series


@dataclass(frozen=True, kw_only=True)
class KeptSeries:
    """An entry of the cache.

    Attributes
    ----------
    path : its file; None where nothing can be kept.
    surface : name of the surface for people.
    inputs : all that determines the series.
    series : what it holds.
    """

    path: Path | None
    surface: str
    inputs: Inputs
    series: LeakageSeries

    def save(self, rows: Mapping[float, Row], thresholds: Mapping[str, Threshold]) -> None:
        """Replace what the entry holds."""
        if self.path is None:
            return
        try:
            save_series(self.path, self.inputs, LeakageSeries(rows=rows, thresholds=thresholds), self.surface)
            trim()
        except InputError as error:
            warn(str(error))


def kept_series(inputs: Inputs, loads: Sequence[float], surface: str) -> KeptSeries:
    """The entry of a surface and its solids for a series of loads, or for the thresholds if there are none.

    Each contact starts from the one before, so that the last digits of a row depend on all loads. A damaged entry is
    removed. ``surface`` is its name for people.
    """
    settings = {name: value for name, value in inputs.settings.items() if name != "code"}
    own = table_inputs(
        inputs.heights, inputs.spacing, "rom.seal.leakage.curve", **settings, kind="leakage", loads=list(loads)
    )
    series, path = LeakageSeries(rows={}, thresholds={}), entry_path("leakage", own.digest)
    if path is not None:
        try:
            series = stored_series(path, own)
            use(path)
        except InputError:
            with suppress(OSError):
                path.unlink()
    return KeptSeries(path=path, surface=surface, inputs=own, series=series)
