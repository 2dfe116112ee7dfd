"""The mesh of a rough gap: what is cut out of it, what is closed in, and that OpenFOAM finds no fault."""

import re

import numpy as np
import pytest

from roughfilm.foamcases.openfoam.block_mesh import write_block
from roughfilm.foamcases.openfoam.dictionaries import control, parts_of, schemes, write_files
from roughfilm.foamcases.openfoam.program import succeed
from roughfilm.foamcases.rough_gap.case import GapCard
from roughfilm.foamcases.rough_gap.dictionaries import CONTACT, SIDES
from roughfilm.foamcases.rough_gap.mesh import columns_between
from roughfilm.rom.homogenization.paths import leads_round
from roughfilm.rom.rough_gap.walls import Walls


def between(gap, spacing=(1.0, 1.0)):
    gap = np.asarray(gap, dtype=float)
    return Walls(lower=-gap, upper=np.zeros(gap.shape), spacing=spacing)


def disc(points, radius):
    x = (np.arange(points) + 0.5) / points - 0.5
    return np.where(np.hypot(x[:, None], x) < radius, 0.0, 1.0)


def box(points):
    """A wall of contact round a pool in an open gap."""
    gap = np.ones((points, points))
    gap[2:8, 2:8] = 0
    gap[3:7, 3:7] = 1
    return gap


def test_vertices_lie_on_the_walls_and_the_last_are_the_first_a_period_on():
    random = np.random.default_rng(5)
    walls = Walls(lower=-random.random((5, 3)), upper=random.random((5, 3)), spacing=(2e-6, 3e-6))
    found = columns_between(walls, 1e-6, 4).vertices
    assert found.shape == (6, 4, 5, 3)
    assert found[:-1, :-1, 0, 2] == pytest.approx(walls.lower / 1e-6)
    assert found[:-1, :-1, -1, 2] == pytest.approx(walls.upper / 1e-6)
    assert np.array_equal(found[-1, ..., 2], found[0, ..., 2])
    assert np.array_equal(found[:, -1, :, 2], found[:, 0, :, 2])
    assert found[-1, -1, 0, :2] == pytest.approx([10.0, 9.0])
    assert np.diff(found[..., 2], n=2, axis=2) == pytest.approx(0, abs=1e-9)


def test_mean_heights_of_columns_are_those_of_a_bilinear_gap():
    """Against Gauss's rule with two points each way, which is exact for the square of a bilinear function."""
    gap = 1 + np.random.default_rng(8).random((4, 6))
    columns = columns_between(between(gap), 1.0, 4)
    h = np.pad(gap, ((0, 1), (0, 1)), mode="wrap")
    first = second = 0
    for s in (0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5):
        for t in (0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5):
            there = (h[:-1, :-1] * (1 - s) + h[1:, :-1] * s) * (1 - t) + (h[:-1, 1:] * (1 - s) + h[1:, 1:] * s) * t
            first, second = first + there / 4, second + there**2 / 4
    assert columns.height == pytest.approx(first, rel=1e-13)
    assert columns.squared_height == pytest.approx(second, rel=1e-13)


def test_columns_with_a_corner_in_contact_are_cut_out():
    gap = np.ones((6, 6))
    gap[2, 3] = 0
    kept = columns_between(between(gap), 1.0, 4).kept
    assert sorted(zip(*np.nonzero(~kept), strict=True)) == [(1, 2), (1, 3), (2, 2), (2, 3)]
    gap = np.ones((6, 6))
    gap[0, 0] = 0
    kept = columns_between(between(gap), 1.0, 4).kept
    assert sorted(zip(*np.nonzero(~kept), strict=True)) == [(0, 0), (0, 5), (5, 0), (5, 5)]


def test_what_contact_closes_in_is_left_out_and_named():
    columns = columns_between(between(box(12)), 1.0, 4)
    assert not columns.kept[2:7, 2:7].any()
    assert columns.kept.sum() == 144 - 49
    assert columns.closed_in == pytest.approx(9 / (144 - 40))


def test_a_pool_is_what_no_path_leads_round_from():
    channel = np.zeros((8, 8), dtype=bool)
    channel[:, 1] = True
    with_pool = channel.copy()
    with_pool[3:5, 4:6] = True
    with_pool[[0, 7], 6] = True  # one pool, over the seam
    assert np.array_equal(leads_round(with_pool), channel)
    staircase = np.eye(5, dtype=bool) | np.roll(np.eye(5, dtype=bool), 1, axis=1)
    assert np.array_equal(leads_round(staircase), staircase)
    bay = channel.copy()
    bay[3, 1:4] = True
    assert np.array_equal(leads_round(bay), bay)


BARE = ("dictionary", {"solvers": {}})

SHAPES = {
    "disc": disc(12, 0.3),
    "contact on the seams": np.roll(disc(12, 0.3), (6, 6), axis=(0, 1)),
    "two channels": np.where(np.isin(np.arange(12), (3, 8)), 0.0, 1.0) * np.ones((12, 1)),
    "ridges": 1 + 0.5 * np.cos(np.arange(12) * np.pi / 6)[:, None] * np.ones(2),
    "one column": 1 + 0.5 * np.cos(np.arange(12) * np.pi / 6)[:, None],
}


@pytest.mark.openfoam
@pytest.mark.parametrize("shape", SHAPES)
def test_openfoam_finds_no_fault_and_the_volume(tmp_path, shape):
    columns = columns_between(between(SHAPES[shape], (0.7, 1.3)), 1.0, 4)
    kept = np.repeat(columns.kept[..., None], 4, axis=2)
    write_block(columns.vertices, SIDES, tmp_path, kept=kept, cut=CONTACT)
    write_files(
        tmp_path, {"system/controlDict": control(1), "system/fvSchemes": schemes(""), "system/fvSolution": BARE}
    )
    log = succeed(tmp_path, ["checkMesh"], "log").log
    assert "Mesh OK" in log
    volume = float(re.search(r"Total volume = ([0-9.e+-]+)\.", log)[1])
    assert volume == pytest.approx(columns.height[columns.kept].sum() * 0.7 * 1.3, rel=1e-5)
    assert int(re.search(r"cells:\s+(\d+)", log)[1]) == kept.sum()


def test_processes_share_a_period_in_squares():
    assert parts_of(4, (1.0, 1.0)) == (2, 2)
    assert parts_of(2, (3.0, 1.0)) == (2, 1)
    assert parts_of(2, (1.0, 3.0)) == (1, 2)
    assert parts_of(7, (1.0, 1.0)) in {(7, 1), (1, 7)}
    assert parts_of(12, (3.0, 1.0)) == (6, 2)


def test_a_card_says_what_each_drive_is_judged_by():
    card = GapCard(
        layers=4,
        cells=16,
        reynolds_number=1.0,
        resolution=8,
        tolerance=1e-5,
        scheme="",
        processes=1,
        judged={"across": ["Uy", "Uz", "p"]},
        relaxation={"across": 0.9},
        dialect="com",
    )
    assert (card.drives["across"].main, card.drives["across"].fields) == ("Uy", ("Uy", "Uz", "p"))
