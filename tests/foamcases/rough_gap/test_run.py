"""Cases of rough gaps: what may stand in them, what does not fit, how a flow is judged, and rungs that use them."""

import re
import subprocess
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from foamlib import FoamFile

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.foamcases.openfoam import memory
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.dialect import COM
from roughfilm.foamcases.openfoam.memory import memory_available, memory_estimate
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals
from roughfilm.foamcases.openfoam.run import check_mesh
from roughfilm.foamcases.openfoam.settling import unsettled
from roughfilm.foamcases.rough_gap import case as gap_case
from roughfilm.foamcases.rough_gap.case import GapCard, judged_of, write_gap_case
from roughfilm.foamcases.rough_gap.dictionaries import DRIVES
from roughfilm.foamcases.rough_gap.models import navier_stokes as gap_navier_stokes
from roughfilm.foamcases.rough_gap.models import stokes as gap_stokes
from roughfilm.foamcases.rough_gap.run import run_gap
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.rough_gap.walls import Walls

ENTRIES = {
    "name": "gap",
    "kind": "rough_gap",
    "geometry": {"surface": "sinusoid", "amplitude": "3 um", "wavelength": "50 um", "mean_gap": "10 um"},
    "lubricant": {"viscosity": "0.01 Pa*s", "density": "870 kg/m^3"},
    "flow": {"reynolds_number": 0.5},
}

COARSE = Request(resolution=8)


@pytest.mark.parametrize("name", ['#calc "system(\\"touch /tmp/owned\\")"', "$include; }", "a; nu 1e9;"])
def test_a_hostile_name_never_reaches_a_case(tmp_path, name):
    gap_navier_stokes.MODEL.write(read_scene({**ENTRIES, "name": name}), tmp_path, COARSE)
    files = [path for path in tmp_path.rglob("*") if path.is_file() and not path.is_symlink()]
    assert len(files) > 20
    for path in files:
        content = path.read_bytes()
        assert name.encode() not in content, path
        if path.parent.name not in {"polyMesh", "0"} and path.name not in {"Allrun", "README", "case.json"}:
            assert not re.search(rb"[#$]", content), path


def test_a_case_can_be_moved(tmp_path):
    gap_navier_stokes.MODEL.write(read_scene(ENTRIES), tmp_path / "case", COARSE)
    (tmp_path / "case").rename(tmp_path / "moved")
    for drive in ("along", "across", "sliding"):
        assert (tmp_path / "moved" / drive / "constant" / "polyMesh" / "points").is_file()
    force = FoamFile(tmp_path / "moved" / "across" / "constant" / "fvOptions")["gradient", "injectionRateSuSp", "U"]
    assert np.array(force[0]) == pytest.approx([0.0, 24.0, 0.0])
    assert read_card(tmp_path / "moved", GapCard).cells == 8 * 2 * 4


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"resolution": 7}, "resolution: got 7; navier_stokes takes 8 to 256"),
        ({"resolution": 257}, "resolution: got 257"),
        ({"tolerance": 0.5}, "tolerance: got 0.5"),
        ({"processes": 99}, "processes: got 99; it must be 1 to 8"),
    ],
)
def test_numbers_out_of_range_are_refused(tmp_path, options, words):
    with pytest.raises(InputError, match=words):
        gap_navier_stokes.MODEL.write(read_scene(ENTRIES), tmp_path / "case", replace(COARSE, **options))
    assert not (tmp_path / "case").exists()


def test_a_mesh_that_does_not_fit_is_refused_before_it_is_made(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "memory_available", lambda: 2.0**29)
    monkeypatch.setattr(gap_case, "mesh_of", lambda *_: pytest.fail("a mesh was made"))
    scene = read_scene({**ENTRIES, "mesh": {"layers": 1000}})
    finest = gap_navier_stokes.MODEL.checked(scene, Request(resolution=256))
    with pytest.raises(InputError, match=r"256 × 2 × 1000 cells would take about .* GiB .* be run, and 0.5 GiB are"):
        write_gap_case(scene, tmp_path / "case", finest, 0.5, COM, run=True)
    assert not (tmp_path / "case").exists()
    assert memory_estimate(256 * 2, 1000, run=False) < memory_estimate(256 * 2, 1000)


def test_memory_is_what_the_system_tells(tmp_path):
    table = tmp_path / "meminfo"
    table.write_text("MemTotal:  9 kB\nMemAvailable:    2048 kB\n")
    assert memory_available(table) == 2048 * 1024
    assert memory_available(tmp_path / "none") == float("inf")


def test_what_is_left_of_a_geometric_series_is_exact():
    values = 3 + 0.5 * 0.8 ** np.arange(40)
    left = 0.5 * 0.8**39 / values[-1]
    assert unsettled(values) == pytest.approx(left * 0.8**-10 * 0.8, rel=1e-6)  # by the largest of the last ten steps
    assert unsettled(np.full(30, 2.0)) == 0
    assert unsettled(1 + 1e-3 * (-1.0) ** np.arange(60)) > 0.05


def test_only_fields_in_which_anything_moves_are_judged(tmp_path):
    log = "".join(
        f"s:  Solving for {name}, Initial residual = {value}, Final residual = 1, No Iterations 1\n"
        for name, value in (("Ux", 1e-6), ("Uy", 0.9), ("Uz", 1e-3), ("p", 1e-4), ("p", 0.5), ("Ux", 1e-7), ("Uy", 0.8))
    )
    (tmp_path / "log").write_text(log)
    found = Residuals(tmp_path / "log", Judged(fields=("Ux", "Uz", "p")))
    found.read()
    assert (found.main, found.greatest) == ([1e-6], [1e-3])


@pytest.mark.parametrize(
    ("along_x", "along_y", "expected"),
    [
        (0, 0, ({"Ux"}, {"Uy"}, {"Ux"})),
        (1, 0, ({"Ux", "Uz", "p"}, {"Uy"}, {"Ux", "Uz", "p"})),
        (0, 1, ({"Ux"}, {"Uy", "Uz", "p"}, {"Ux"})),
        (1, 1, ({"Ux", "Uy", "Uz", "p"},) * 3),
    ],
)
def test_symmetry_states_which_fields_vanish(along_x, along_y, expected):
    x = np.arange(6) % 3
    walls = Walls(lower=-1.0 - along_x * x[:, None] - along_y * x, upper=np.zeros((6, 6)), spacing=(1.0, 1.0))
    found = [judged_of(drive, walls) for drive in DRIVES]
    assert [set(fields) for fields in found] == [*expected]
    assert [fields[0] for fields in found] == ["Ux", "Uy", "Ux"]


def test_faults_of_a_mesh_are_borne_only_where_they_are_known_to_be_harmless(tmp_path, monkeypatch):
    flat, folded = " ***High aspect ratio cells found, Max: 2000", " ***Zero or negative cell volume detected."

    def found(*faults):
        ended = SimpleNamespace(log="\n".join([*faults, f"Failed {len(faults)} mesh checks."]), cpu_s=0.0)
        monkeypatch.setattr("roughfilm.foamcases.openfoam.run.succeed", lambda *_: ended)
        return check_mesh(tmp_path, tolerated=("High aspect ratio cells",))

    assert flat in found(flat).log
    with pytest.raises(ConvergenceError, match="the mesh check found faults"):
        found(flat, folded)
    with pytest.raises(ConvergenceError, match="the mesh check found faults"):
        found()


@pytest.mark.openfoam
def test_rungs_state_the_quantities_and_fields_of_their_kind():
    scene = read_scene(ENTRIES)
    result = gap_navier_stokes.MODEL.solve(scene, Request(resolution=16, scheme="upwind"))
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    assert {"A11", "A12", "A21", "A22", "B1", "B2", "friction", "flow_per_width_x", "contact_area"} < set(value)
    assert value["flow_per_width_x"] == pytest.approx(value["A11"] * 0.5 * 0.01 / 870, rel=1e-9)
    fields = {name: field.values for name, field in result.fields.items()}
    assert fields["vertices"].shape == (17, 3, 5, 3)
    assert fields["cell_velocity"].shape == (16, 2, 4, 3)
    assert fields["vertices"][-1, 0, 0, 0] == pytest.approx(50e-6)
    assert fields["flow"].mean() * 16 / 18 == pytest.approx(value["flow_per_width_x"], rel=1e-3)  # layers: 1 + 2/16
    assert result.numerics.residual < 3e-5
    assert max(run.imbalance for run in result.numerics.runs) < 0.02
    assert gap_stokes.MODEL.resolution_of(scene) == 64


@pytest.mark.openfoam
def test_cases_run_by_hand_state_the_flow_as_their_readme_says(tmp_path):
    case, a = tmp_path / "case", 0.3
    gap_stokes.MODEL.write(read_scene(ENTRIES), case, Request(resolution=32))
    assert subprocess.run([case / "Allrun"], check=False, capture_output=True).returncode == 0
    excess = float(re.search(r"times (\S+) by the layers", (case / "README").read_text())[1])
    thin = (1 - a**2) ** 2.5 / (1 + a**2 / 2)
    for drive, axis, exact in (("along", 0, 0.95383 * thin), ("across", 1, 0.94224 * (1 + 1.5 * a**2))):
        stated = (case / drive / "postProcessing" / "flow" / "0" / "volFieldValue.dat").read_text().splitlines()[-1]
        velocity = float(stated.split("(")[1].strip(")").split()[axis])
        assert velocity / excess == pytest.approx(exact, rel=6e-3)
        assert velocity != pytest.approx(exact, rel=6e-3)


@pytest.mark.openfoam
def test_a_run_that_stops_at_its_last_iteration_is_no_success(tmp_path):
    gap_navier_stokes.MODEL.write(read_scene(ENTRIES), tmp_path, COARSE)
    with FoamFile(tmp_path / "along" / "system" / "controlDict") as control:
        control["endTime"] = 3
    with pytest.raises(ConvergenceError, match="unfinished after 3 iterations"):
        run_gap(tmp_path)
