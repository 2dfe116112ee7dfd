"""A set of windows warns of joints at which its cells do not fit."""

from pathlib import Path

from roughfilm.sampling.cells import Cells


def test_windows_with_a_bad_joint_are_counted():
    cells = Cells(
        paths=(Path("a"), Path("b"), Path("c")),
        size=(1e-4, 1e-4),
        independent=3.0,
        source={},
        mismatches=(0.0, 0.4, 0.2),
    )
    (warning,) = cells.warnings
    assert warning.startswith("2 of 3 windows have a periodicity mismatch above 0.1, up to 0.40")
