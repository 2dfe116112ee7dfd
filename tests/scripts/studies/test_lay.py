"""The lay against the flow on coarse grids: closed forms, what is equal, verdicts on the opposite, and the page."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.surfaces.periodicity import periodicity_mismatch
from roughfilm.stability.joint import cut_grooves, joined
from scripts.studies.lay import __main__ as lay
from scripts.studies.lay.claims import judge
from scripts.studies.lay.data import ROUGHNESS, THICKNESSES, TURNS, angle, compare, gap_at, grooves_exactly, heights_of
from scripts.studies.lay.joint import mirrored, passed
from scripts.studies.lay.measured import OBLIQUE, STRIATED, over_separations, prepared_surfaces

COARSE = {"points": 128, "coarser": 4}


@pytest.fixture(scope="module")
def found():
    return lay.compute(**COARSE)


def test_grooves_have_the_closed_form_of_a_sinusoid():
    part = np.sqrt(2) / 3
    (across, along), (drag, whole) = grooves_exactly(3.0)
    assert across == pytest.approx((1 - part**2) ** 2.5 / (1 + part**2 / 2), rel=1e-10)
    assert along == pytest.approx(1 + 1.5 * part**2, rel=1e-10)
    assert drag == pytest.approx((1 - part**2) / (1 + part**2 / 2), rel=1e-10)
    assert whole == pytest.approx(1, rel=1e-12)


def test_closed_ridges_let_nothing_across():
    assert grooves_exactly(1.0)[0][0] == 0
    assert grooves_exactly(1.0)[1].tolist() == [0, 1]


@pytest.mark.parametrize("turn", TURNS)
def test_turned_grooves_lie_at_their_angle(turn):
    """By the structure tensor of the heights: the least gradient lies along the lay."""
    heights = heights_of("grooves", turn, 64)
    gradients = np.stack([(np.roll(heights, -1, k) - np.roll(heights, 1, k)).ravel() for k in (0, 1)])
    lay_direction = np.linalg.eigh(gradients @ gradients.T)[1][:, 0]
    across = abs(lay_direction @ [-np.sin(angle(turn)), np.cos(angle(turn))])
    assert across < 0.06
    assert heights.std() == pytest.approx(ROUGHNESS)


@pytest.mark.parametrize("texture", ["grooves", "crossed grooves"])
def test_a_quarter_turn_exchanges_the_directions(texture):
    one, other = (compare(gap_at(heights_of(texture, turn, 64), 2e-6), (1.0, 1.0)) for turn in ((5, 0), (0, 5)))
    turned = [[one.cell.pressure[1, 1], -one.cell.pressure[0, 1]], [-one.cell.pressure[0, 1], one.cell.pressure[0, 0]]]
    assert other.cell.pressure == pytest.approx(np.array(turned), rel=1e-6, abs=1e-8)
    assert other.box.pressure == pytest.approx(one.box.pressure[::-1], rel=1e-6)


def test_the_cell_follows_the_turned_tensor_and_the_box_does_not(found):
    for thickness in THICKNESSES:
        one = found.turned.found["grooves", thickness, (4, 4)]
        assert one.cell.pressure == pytest.approx(found.turned.tensor("grooves", thickness, np.pi / 4), rel=0.08)
        assert one.box.pressure.prod() < 0.9 * np.diag(one.cell.pressure).prod()


def test_the_shape_of_the_box_takes_its_factor_from_one_mean_to_the_other(found):
    across, along = grooves_exactly(2.0)[0]
    shapes, factors = found.turned.boxes
    assert (np.diff(factors) < 0).all()
    assert factors[0] == pytest.approx((across + along) / 2, rel=0.1)
    assert factors[list(shapes).index(1)] == pytest.approx(np.sqrt(across * along), rel=0.1)
    assert factors[-1] == pytest.approx(2 * across * along / (across + along), rel=0.1)


def test_cut_grooves_pass_all_where_they_meet_and_less_where_they_do_not(found):
    for thickness, first in zip(THICKNESSES, found.joints.cut[0.0], strict=True):
        assert first.thickness == thickness
        assert first.passed == pytest.approx((1, 1), abs=0.01)
    for shift, row in found.joints.cut.items():
        if shift > 0:
            assert [one.passed[0] for one in row] == sorted((one.passed[0] for one in row), reverse=True)
            assert row[0].mismatch[1] < row[0].mismatch[0]


def test_a_joint_of_whole_shift_is_none_and_a_mirror_image_has_none():
    assert periodicity_mismatch(cut_grooves(1.0, 64)) < 1e-12
    half = cut_grooves(0.5, 64)
    assert periodicity_mismatch(half) > 1
    assert periodicity_mismatch(mirrored(half)) < 0.1
    assert passed(mirrored(half), 2e-6, 0.0) > 1.1 * passed(half, 2e-6, 0.0)
    assert periodicity_mismatch(joined(half)) < periodicity_mismatch(half)


def test_what_an_offset_adds_to_a_thick_film_is_three_times_its_part(found):
    for name, row in found.offsets.items():
        roughness = 2e-6 if "2 µm" in name and "0.2" not in name else 2e-7
        assert row[0].separation == 3
        assert row[0].added == pytest.approx((1 + 1e-8 / (3 * roughness)) ** 3 - 1, rel=0.3)
        assert (np.diff([one.added.max() for one in row]) > 0).all()


def verdicts(made):
    return {claim.number: claim.verdict for claim in judge(made)}


def test_claims(found):
    assert verdicts(found) == {20: "true", 21: "partly", 26: "partly"}


def test_claims_on_gaps_that_do_the_opposite(found):
    def open_joint(one):
        return replace(one, passed=(1.0, 1.0))

    cut = {shift: [open_joint(one) for one in row] for shift, row in found.joints.cut.items()}
    joints = replace(found.joints, cut=cut, windows=[open_joint(one) for one in found.joints.windows])

    def same(one):
        return replace(one, box=replace(one.box, pressure=np.diag(one.cell.pressure)))

    equal = replace(found.turned, found={key: same(one) for key, one in found.turned.found.items()})
    offsets = {name: [replace(one, offset=2 * one.closed) for one in row] for name, row in found.offsets.items()}
    opposite = replace(found, joints=joints, turned=equal, offsets=offsets)
    assert verdicts(opposite) == {20: "false", 21: "false", 26: "false"}


def test_claims_on_gaps_that_do_all_that_is_said(found):
    crossed = dict(found.turned.found)
    for texture, thickness, turn in found.turned.found:
        if texture == "crossed grooves":
            crossed[texture, thickness, turn] = found.turned.found["grooves", thickness, (4, 4)]
    offsets = {
        name: [replace(one, offset=one.closed) for one in row if (one.closed > 0).all()]
        for name, row in found.offsets.items()
    }
    said = replace(found, turned=replace(found.turned, found=crossed), offsets=offsets)
    assert verdicts(said) == {20: "true", 21: "true", 26: "true"}


def test_the_page(monkeypatch, tmp_path, found):
    monkeypatch.setattr(lay, "compute", lambda _: found)
    lay.command(tmp_path)
    page = (tmp_path / "lay.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 5
    assert "are absent" in page
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:|https://doi)|url\(\s*["']?(?!#|data:)|@import""", page)
    stated = json.loads((tmp_path / "lay.json").read_text(encoding="utf-8"))
    assert [claim["number"] for claim in stated["claims"]] == [20, 21, 26]
    assert len(stated["turned"]) == 3 * 3 * 3


@pytest.mark.measured
def test_a_measured_oblique_lay(measured_file):
    """What Fig. E.22 shows of its crossed surface: A has directions and off-diagonals where the box sees less."""
    prepared = prepared_surfaces(measured_file(OBLIQUE).parent, 128)
    assert set(prepared) == {OBLIQUE, STRIATED}
    oblique = over_separations(OBLIQUE, prepared[OBLIQUE], (4, 1, 0.2))
    assert oblique.lay == pytest.approx(31, abs=3)
    thick, touching, deep = oblique.found.values()
    assert max(map(abs, thick.short)) < 0.02
    assert touching.cell.pressure[0, 1] > 0.4 * touching.cell.pressure[0, 0]
    assert max(touching.short) < -0.2
    assert touching.box.pressure == pytest.approx(oblique.boxes[1], rel=0.25)
    assert deep.cell.sealed == (False, False)
    assert deep.box.sealed == (False, True)
    assert deep.cell.pressure[1, 1] > 1
    straight = over_separations(STRIATED, prepared[STRIATED], (1,)).found[1]
    assert max(map(abs, straight.short)) < 0.03
