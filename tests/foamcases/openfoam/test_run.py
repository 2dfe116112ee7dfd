"""A run is believed only when it is whole: every way it can fail is one of our errors, with the log's end."""

import numpy as np
import pytest
from foamlib import FoamCase, FoamFile

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome, UnavailableError
from roughfilm.foamcases.openfoam import run
from roughfilm.foamcases.openfoam.installation import Installation, installation
from roughfilm.foamcases.pocket.fields import read_channel
from roughfilm.foamcases.pocket.models.navier_stokes import MODEL as NAVIER_STOKES
from roughfilm.foamcases.pocket.run import run_case
from roughfilm.rom.ladder.request import Request

pytestmark = pytest.mark.openfoam


@pytest.fixture
def case(make_scene, tmp_path):
    NAVIER_STOKES.write(make_scene(0.3, 0.25, 40), tmp_path, Request(resolution=30, tolerance=1e-5))
    return tmp_path


def test_a_good_run(case):
    seen = []
    done = run_case(case, progress=lambda part, words: seen.append((part, words)))
    assert 0 < done.residual <= 2e-5
    assert [(one.recipe, one.outcome) for one in done.tries] == [("", Outcome.CONVERGED)]
    assert done.tries[0].iterations > 20
    assert done.version == str(installation().release)
    assert done.warnings == ()


def test_a_run_that_stops_at_its_last_iteration_is_no_success(case):
    with FoamFile(case / "system" / "controlDict") as control:
        control["endTime"] = 5
    with pytest.raises(ConvergenceError, match="unfinished after 5 iterations") as caught:
        run_case(case)
    assert caught.value.outcome is Outcome.UNFINISHED
    assert "End" in caught.value.__notes__[0]


def test_a_broken_mesh_is_no_success(case):
    points = FoamFile(case / "constant" / "polyMesh" / "points")
    turned = np.array(points[None])
    turned[:, 1] *= np.where(turned[:, 0] > 3, -1, 1)
    points[None] = turned
    with pytest.raises(ConvergenceError, match=r"mesh check|checkMesh stopped") as caught:
        run_case(case)
    assert caught.value.__notes__


def test_a_broken_dictionary_is_no_success(case):
    (case / "system" / "fvSolution").write_text("nonsense {")
    with pytest.raises(ConvergenceError, match="stopped with code") as caught:
        run_case(case)
    assert "FATAL" in caught.value.__notes__[0]


def test_fields_on_disk_that_do_not_satisfy_the_equations_are_no_success(case, monkeypatch):
    succeed = run.succeed

    def spoil_before_verifying(directory, command, log_name):
        if log_name == "log.verify":
            velocity = FoamCase(directory)[-1]["U"]
            velocity.internal_field = np.array(velocity.internal_field) * 1.01
        return succeed(directory, command, log_name)

    monkeypatch.setattr(run, "succeed", spoil_before_verifying)
    with pytest.raises(ConvergenceError, match="fields on disk leave a residual"):
        run_case(case)


def test_fields_that_are_not_finite_are_refused(case):
    run_case(case)
    pressure = FoamCase(case)[-1]["p"]
    values = np.array(pressure.internal_field)
    values[7] = np.nan
    pressure.internal_field = values
    with pytest.raises(ConvergenceError, match="not finite"):
        read_channel(case)


def test_a_pressure_that_overflows_in_its_unit_is_refused(case):
    run_case(case)
    pressure = FoamCase(case)[-1]["p"]
    pressure.internal_field = np.array(pressure.internal_field) + 1e307
    with pytest.raises(ConvergenceError, match="its numbers overflow"):
        read_channel(case)


def test_a_case_that_was_not_run_is_refused(case):
    with pytest.raises(ConvergenceError, match="run the case first"):
        read_channel(case)


def test_no_openfoam_is_said_in_one_line(case, monkeypatch):
    monkeypatch.setattr(run, "installation", lambda: Installation(release=None, detail="no simpleFoam; install it"))
    with pytest.raises(UnavailableError, match="no simpleFoam; install it"):
        run_case(case)


def test_no_mpirun_is_said_in_one_line(make_scene, tmp_path, monkeypatch):
    NAVIER_STOKES.write(make_scene(0.3, 0.25, 40), tmp_path, Request(resolution=30, processes=2))
    monkeypatch.setattr(Installation, "has", lambda _, program: program != "mpirun")
    with pytest.raises(UnavailableError, match="no mpirun on the PATH; take one process, or"):
        run_case(tmp_path)
