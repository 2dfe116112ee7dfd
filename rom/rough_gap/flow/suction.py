"""The lowest pressure in a gap whose upper wall slides."""

from roughfilm.contact.foundation.arrays import Array


def suction(gap: Array, corrector: Array) -> float:
    """The mean pressure over the open nodes less the lowest one, over 6ηu, 1/m, of a gap without a mean gradient.

    Parameters
    ----------
    gap : h, m, shape (nx, ny); 0 in contact.
    corrector : χ₃ = p/(6ηu), 1/m, shape (nx, ny), as :class:`roughfilm.rom.homogenization.cell.Cell` has it.
    """
    pressure = corrector[gap > 0]
    return float(pressure.mean() - pressure.min())
