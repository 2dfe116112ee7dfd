"""What becomes of a run that does not converge, and the second try that rescues some."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.foamcases.openfoam import iterate as tries
from roughfilm.foamcases.openfoam.dictionaries import strengthen
from roughfilm.foamcases.openfoam.residuals import PATIENCE, Judged, Residuals
from roughfilm.foamcases.pocket.fields import read_channel
from roughfilm.foamcases.pocket.models import navier_stokes, stokes
from roughfilm.foamcases.pocket.run import run_case
from roughfilm.rom.ladder.request import Request


def logged(values):
    lines = []
    for number, (along, across, pressure) in enumerate(values, start=1):
        lines += [
            f"Time = {number}\n",
            f"DILUPBiCGStab:  Solving for Ux, Initial residual = {along}, Final residual = 1e-9, No Iterations 1",
            f"DILUPBiCGStab:  Solving for Uy, Initial residual = {across}, Final residual = 1e-9, No Iterations 1",
            f"GAMG:  Solving for p, Initial residual = {pressure}, Final residual = 1e-9, No Iterations 2",
            f"GAMG:  Solving for p, Initial residual = {7 * pressure}, Final residual = 1e-9, No Iterations 2",
        ]
    return "\n".join(lines) + "\n"


@pytest.fixture
def read(tmp_path):
    def residuals(values):
        (tmp_path / "log").write_text(logged(values))
        found = Residuals(tmp_path / "log", Judged())
        found.read()
        return found

    return residuals


def test_a_log_that_grows_byte_by_byte_is_read_once(tmp_path):
    text = logged([(0.1, 0.3, 0.2), (0.01, 0.02, 0.03), (1e-3, 1e-3, 5e-4)])
    found = Residuals(tmp_path / "log", Judged())
    for end in range(0, len(text) + 1, 7):
        (tmp_path / "log").write_text(text[:end])
        found.read()
    assert found.main == [0.1, 0.01, 1e-3]
    assert found.greatest == [0.3, 0.03, 1e-3]


def falling(halved_every, count):
    return [(1e-3 * 0.5 ** (n / halved_every), 0.5 ** (n / halved_every), 1e-9) for n in range(count)]


def test_who_gets_nearer_is_let_go_on_and_who_does_not_is_given_up(read):
    assert not read(falling(0.9 * PATIENCE, 3 * PATIENCE)).stagnant
    assert read(falling(1.1 * PATIENCE, 3 * PATIENCE)).stagnant


@pytest.mark.parametrize(
    ("values", "outcome"),
    [
        ([(0.02, 0.5, 0.1)] * (PATIENCE + 10), Outcome.UNSTEADY),
        ([(1e-12, 3e-6, 1e-8)] * (PATIENCE + 10), Outcome.STALLED),
        ([(1e-12, 3e-6, 1e-8)] * 10, Outcome.UNFINISHED),
        ([(0.02, 0.5, 0.1), (0.02, float("nan"), 0.1)], Outcome.DIVERGED),
        ([(0.02, 0.5, float("inf"))], Outcome.DIVERGED),
    ],
)
def test_outcomes(read, values, outcome):
    assert read(values).outcome(1e-7) is outcome


@pytest.mark.openfoam
@pytest.mark.parametrize(
    ("model", "scene", "resolution", "outcome"),
    [
        (navier_stokes.MODEL, (0.3, 0.75, 1e12), 120, Outcome.DIVERGED),
        (navier_stokes.MODEL, (0.3, 0.75, 5000), 120, Outcome.UNSTEADY),
        (stokes.MODEL, (0.3, 1e-9, 160), 30, Outcome.STALLED),
    ],
)
def test_a_failure_says_which(make_scene, monkeypatch, model, scene, resolution, outcome):
    monkeypatch.setattr(tries, "RETRIED", set())
    with pytest.raises(ConvergenceError, match=f"OpenFOAM: {outcome} after") as caught:
        model.solve(make_scene(*scene), Request(resolution=resolution))
    assert caught.value.outcome is outcome
    assert "\n" not in str(caught.value)


@pytest.mark.openfoam
def test_what_fails_twice_states_both_tries(make_scene):
    with pytest.raises(
        ConvergenceError, match=r"stalled after .*; second try .*: stalled after .*; loosen the tolerance"
    ):
        stokes.MODEL.solve(make_scene(0.3, 1e-9, 160), Request(resolution=30))


@pytest.mark.openfoam
def test_a_rescued_run_says_so_and_is_right(make_scene):
    """The load of so shallow a groove is proportional to its depth; at d+ = 1e-4 no rescue is needed."""
    deeper, shallower = (
        navier_stokes.MODEL.solve(make_scene(0.3, depth, 2000), Request(resolution=30)) for depth in (1e-4, 1e-6)
    )
    runs = shallower.numerics.runs
    assert [run.outcome for run in deeper.numerics.runs] == ["converged"]
    assert [run.outcome for run in runs] == ["stalled", "converged"]
    assert [bool(run.recipe) for run in runs] == [False, True]
    assert runs[1].iterations == shallower.numerics.iterations
    ratio = deeper.quantities["load_plus"].value / shallower.quantities["load_plus"].value
    assert ratio == pytest.approx(100, rel=1e-3)


@pytest.mark.openfoam
@pytest.mark.slow
def test_a_half_circle_is_solved_on_the_default_mesh(make_scene):
    """Its groove's steep walls skew the cells; an independent check of the load is its own coarser mesh, to 10 %."""
    fine, coarse = (navier_stokes.MODEL.solve(make_scene(0.3, 5, 160), Request(resolution=n)) for n in (240, 120))
    assert fine.numerics.residual <= 2e-7
    assert fine.quantities["load_plus"].value == pytest.approx(coarse.quantities["load_plus"].value, rel=0.1)


@pytest.mark.openfoam
def test_the_recipe_does_not_change_the_answer(make_scene, tmp_path):
    loads = []
    for name in ("usual", "strengthened"):
        navier_stokes.MODEL.write(make_scene(0.3, 2.25, 160), tmp_path / name, Request(resolution=60))
        if name == "strengthened":
            strengthen(tmp_path / name)
        run_case(tmp_path / name)
        channel = read_channel(tmp_path / name)
        loads.append(channel.mean(channel.wall_pressure))
    assert loads[1] == pytest.approx(loads[0], rel=1e-4)
