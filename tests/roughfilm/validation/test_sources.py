"""Our numbers against the published ones, on coarse grids."""

import numpy as np
import pytest

from roughfilm.rom.bearing.closed_forms.sliding import linear_slider
from roughfilm.rom.ladder.model import silent
from roughfilm.validation.finite_volumes import FinitePad, centre_line
from roughfilm.validation.journal import (
    RADIUS,
    SPEED,
    Grids,
    journal,
    side_flow_of_din,
    sommerfeld_of_din,
    squeezed_journal,
)
from roughfilm.validation.listing import source
from roughfilm.validation.obstacle import journal_by_obstacle
from roughfilm.validation.published import Verdict
from roughfilm.validation.sources import (
    bertocchi,
    butenschoen,
    dapp_mueser,
    fillon,
    lund_thomsen,
    patir_cheng,
    raimondi_boyd,
    ross,
    wang_mueser,
)

PAD = FinitePad(
    length=20e-3,
    width=10e-3,
    inlet=1.1e-6,
    outlet=1e-6,
    pocket=(4e-3, 10e-3),
    pocket_width=7e-3,
    depth=0.4e-6,
    speed=1.0,
    ambient=1e5,
    viscosity=0.01,
    barus=1.2e-8,
    c1=2.22e9,
    c2=1.66,
)


def answer(name):
    return source(name).answer(False, silent)


def verdicts(rows):
    return {row.verdict for row in rows}


@pytest.mark.parametrize("name", ["fowell", "hertz", "westergaard"])
def test_closed_forms_are_met(name):
    rows = answer(name).rows
    assert rows
    assert verdicts(rows) == {Verdict.WITHIN}
    assert all(row.uncertainty < row.bar for row in rows)


def test_butenschoens_journal_bearing_with_its_misprint(monkeypatch):
    every = butenschoen.published("butenschoen")
    chosen = [
        one
        for one in every
        if one["eccentricity_ratio [1]"] == "0.97"
        or (one["eccentricity_ratio [1]"], one["width_over_diameter [1]"]) in {("0.1", "1"), ("0.7", "0.4")}
    ]
    monkeypatch.setattr(butenschoen, "published", lambda _name: chosen)
    monkeypatch.setattr(butenschoen, "USUAL", Grids(wide=96, close=192))
    rows = answer("butenschoen").rows
    suspects = {(row.case, row.quantity): row for row in rows if row.verdict is not Verdict.WITHIN}
    assert set(suspects) == {("ε = 0.97, B/D = 0.25", "attitude angle"), ("ε = 0.1, B/D = 1", "side flow Q")}
    assert "interpolated, give 12.4" in suspects["ε = 0.97, B/D = 0.25", "attitude angle"].evidence
    assert "extrapolated, give 0.161" in suspects["ε = 0.1, B/D = 1", "side flow Q"].evidence


CONTRADICTED = {
    ("0.1", "0.5"): ("Sommerfeld number So", "interpolated, give 0.931"),
    ("0.1", "1"): ("side flow Q", "extrapolated, give 3.38"),
    ("0.9", "1"): ("side flow Q", "extrapolated, give 2.58"),
}
"""Entries outside of the bar, with a part of the evidence against them: a misprint, and flows of wide bearings."""

SQUEEZED = {("-0.99", "0.2"), ("-0.5", "0.4"), ("0.5", "0.166667"), ("0.97", "0.25"), *CONTRADICTED}
"""Entries that are compared, beside all others with ε = 0.1."""


def test_butenschoens_squeezed_journal_with_a_misprint_and_its_side_flows(monkeypatch):
    printed = {
        (one["eccentricity_ratio [1]"], one["width_over_diameter [1]"]): one
        for one in butenschoen.published("squeeze_butenschoen")
    }
    chosen = [one for key, one in printed.items() if key in SQUEEZED or key[0] == "0.1"]
    monkeypatch.setattr(butenschoen, "published", lambda _name: chosen)
    outside = {
        (row.case, row.quantity): row.evidence
        for row in answer("squeeze_butenschoen").rows
        if row.verdict is not Verdict.WITHIN
    }
    assert len(outside) == len(CONTRADICTED)
    for (eccentricity, width), (quantity, evidence) in CONTRADICTED.items():
        assert evidence in outside[f"ε = {eccentricity}, B/D = {width}", quantity]


@pytest.mark.parametrize(("eccentricity", "width", "turns"), [(0.5, 0.5, False), (-0.8, 1.0, False), (0.6, 0.5, True)])
def test_two_methods_without_common_code_agree_on_a_journal(eccentricity, width, turns):
    """Both are extrapolated from two grids at second order."""
    second = [journal_by_obstacle(eccentricity, width, cells, turns=turns) for cells in ((32, 16), (64, 32))]
    ours = [
        journal(eccentricity, width, Grids(wide=cells, close=cells))
        if turns
        else squeezed_journal(eccentricity, width, cells)
        for cells in (48, 96)
    ]
    rate = SPEED / RADIUS if turns else 1.0
    loads, flows = (
        [number(result).value for result in ours]
        for number in (lambda one: sommerfeld_of_din(one, width, rate), lambda one: side_flow_of_din(one, rate))
    )

    def limit(values):
        return (4 * values[1] - values[0]) / 3

    assert limit([one.sommerfeld for one in second]) == pytest.approx(limit(loads), rel=1e-3)
    assert limit([one.side_flow for one in second]) == pytest.approx(limit(flows), rel=1.5e-3)
    if turns:
        angles = [result["attitude_angle"].value for result in ours]
        assert limit([one.attitude for one in second]) == pytest.approx(limit(angles), rel=1e-3)


def test_raimondi_and_boyds_flows_and_attitudes_are_met_and_butenschoen_contradicts_what_is_not(monkeypatch):
    every = {name: raimondi_boyd.published(name) for name in ("raimondi_boyd", "butenschoen")}
    every["raimondi_boyd"] = [one for one in every["raimondi_boyd"] if one["eccentricity_ratio [1]"] in {"0.4", "0.97"}]
    monkeypatch.setattr(raimondi_boyd, "published", every.__getitem__)
    monkeypatch.setattr(raimondi_boyd, "USUAL", Grids(wide=96, close=192))
    rows = answer("raimondi_boyd").rows
    assert verdicts(row for row in rows if "flow" in row.quantity) == {Verdict.WITHIN}
    loads = [row for row in rows if row.quantity == "Sommerfeld number S"]
    assert Verdict.OUTSIDE not in verdicts(loads)
    assert {row.case for row in loads if row.verdict is Verdict.SUSPECT} >= {"ε = 0.97, B/D = 0.25"}


def test_lund_and_thomsens_static_points_stiffness_and_damping_are_met_within_2_per_cent(monkeypatch):
    monkeypatch.setattr(lund_thomsen, "CELLS", 128)
    rows = answer("lund_thomsen").rows
    assert len(rows) == 70
    small = [row for row in rows if row.verdict is not Verdict.WITHIN]
    assert {(row.case, row.published) for row in small} <= {("elliptical, S = 0.12", -0.01)}  # 0.1 % of Bxx
    assert all(abs(row.difference) < 0.03 for row in small)
    assert {row.quantity for row in rows} == {
        "eccentricity ε",
        "attitude angle",
        *(f"{matrix}{row}{column}" for matrix in "KB" for row in "xy" for column in "xy"),
    }


def test_the_highest_pad_temperature_of_fillon_is_met_and_his_theory_at_high_speed(monkeypatch):
    """At 1000 and 2000 rpm ours is that of the measurement, 6 K above the theory of the paper."""
    chosen = [one for one in fillon.published("fillon") if one["speed [rpm]"] in {"1000", "4000"}]
    monkeypatch.setattr(fillon, "published", lambda _name: chosen)
    monkeypatch.setattr(fillon, "CELLS", 64)
    rows = {(row.case, row.series): row for row in answer("fillon").rows}
    assert all(rows[f"{speed} rpm", "measured"].verdict is Verdict.WITHIN for speed in (1000, 4000))
    assert rows["4000 rpm", "theory"].verdict is Verdict.WITHIN
    assert 4 < rows["1000 rpm", "theory"].difference < 7
    assert abs(rows["1000 rpm", "measured"].difference) < 1


def test_another_program_agrees_on_heat_and_the_second_method_contradicts_its_loads(monkeypatch):
    lines = [one for one in ross.published("ross") if one["thinning [1/K]"] == "0.06"]
    monkeypatch.setattr(ross, "published", lambda _name: lines)
    rows = {row.quantity: row for row in answer("ross").rows}
    assert {name: row.verdict for name, row in rows.items()} == {
        "load": Verdict.SUSPECT,
        "power loss": Verdict.WITHIN,
        "highest temperature": Verdict.WITHIN,
    }
    second = float(rows["load"].evidence.rpartition(" ")[2])
    assert rows["load"].ours == pytest.approx(second, rel=1e-3)


def test_finite_volumes_meet_the_wide_slider_of_constant_viscosity():
    wide = FinitePad(**{**vars(PAD), "width": 2.0, "depth": 0.0, "barus": 0.0, "c1": 1e15})
    exact = linear_slider(film=1e-6, rise=0.1e-6, length=20e-3, speed=1.0, viscosity=0.01)
    _, pressure = centre_line(wide, (200, 8))
    assert pressure.max() - PAD.ambient == pytest.approx(exact.pressure_max, rel=0.01)


def test_two_methods_without_common_code_agree_on_bertocchis_narrow_pad_and_not_with_the_curve():
    ours = bertocchi.peak(bertocchi.NARROW, (128, 64))
    peaks = [centre_line(PAD, (cells, 20))[1].max() / 1e6 for cells in (50, 100, 200)]
    assert np.all(np.diff(peaks) < 0)
    assert 2 * peaks[-1] - peaks[-2] == pytest.approx(ours, rel=0.01)
    assert ours > 1.04 * 8.5038


def test_bertocchis_wide_pad_is_met():
    assert bertocchi.peak(bertocchi.WIDE, (128, 64)) == pytest.approx(41.81, abs=0.2)


def test_flow_factors_of_wide_gaps_are_those_of_patir_and_cheng(monkeypatch):
    monkeypatch.setattr(patir_cheng, "SEEDS", 2)
    monkeypatch.setattr(patir_cheng, "POINTS", 192)
    rows = [row for row in answer("patir_cheng").rows if row.at >= 3 and "pressure" in row.quantity]
    assert verdicts(rows) == {Verdict.WITHIN}


def test_the_resistance_of_a_closing_saddle_has_dapp_and_muesers_exponent():
    one = dapp_mueser.closing(128, silent)
    assert one.exponent(0.06) == pytest.approx(3.45, abs=0.1)
    assert np.all(np.diff(one.local[:12]) < 0)


def test_random_roughness_seals_near_wang_and_muesers_area(monkeypatch):
    monkeypatch.setattr(wang_mueser, "USUAL", (128, 6, 6))
    (row,) = answer("wang_mueser").rows
    assert row.ours == pytest.approx(0.415, abs=0.04)
