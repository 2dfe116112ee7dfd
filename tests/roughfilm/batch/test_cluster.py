"""Batches on a dask cluster: programs that only workers have, keys, and faults of workers and schedulers."""

import json
import stat
import sys

import numpy as np
import pytest
from batches import MOODY, Batch, called, results, same_later, wait_for, write_study
from dask_programs import DaskPrograms
from places import STUDIES
from typer.testing import CliRunner

from roughfilm.batch import cluster
from roughfilm.cli.main import app
from roughfilm.ladder import models
from roughfilm.rom.pocket import models as pocket_models
from roughfilm.rom.studies.table import read_table

POCKET = STUDIES / "pocket.toml"


def on(address, *more):
    return ("--executor", "dask", "--scheduler", address, *more)


def one_line(text):
    (line,) = text.splitlines()
    return line


@pytest.fixture
def programs(tmp_path):
    """A scheduler and two slow workers."""
    started = DaskPrograms(tmp_path / "programs")
    started.scheduler()
    started.workers(2, MOODY_SECONDS="0.2")
    yield started
    started.end()


@pytest.fixture
def scheduler(tmp_path):
    """Start a scheduler in this process, with a number of workers and keys; its address."""
    distributed, config = pytest.importorskip("distributed"), pytest.importorskip("dask.config")
    running = []

    def start(workers=0, protocol="tcp://", security=None):
        running.append(
            distributed.LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=False,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                worker_dashboard_address=None,
                protocol=protocol,
                security=security,
            )
        )
        return running[-1].scheduler_address

    with config.set(temporary_directory=str(tmp_path)):
        yield start
        for one in running:
            one.close()


@pytest.fixture
def keys(tmp_path):
    """Write keys into a directory of this name."""
    pytest.importorskip("cryptography")

    def write(name):
        done = CliRunner().invoke(app, ["cluster", "keys", str(tmp_path / name)])
        assert done.exit_code == 0, done.output
        return tmp_path / name

    return write


def roles(directory):
    """The settings of dask for a scheduler and workers with keys."""
    parts = {"cert": str(directory / "cert.pem"), "key": str(directory / "key.pem")}
    by_role = {f"tls_{role}_{part}": path for role in ("scheduler", "worker", "client") for part, path in parts.items()}
    return {"tls_ca_file": str(directory / "ca.pem"), "require_encryption": True, **by_role}


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker_answers_as_this_machine_does(tmp_path, programs):
    study = write_study(tmp_path / "s.toml", models=["moody", "inertial_reynolds"], numbers=[7, *range(10, 25)])
    there, here = tmp_path / "there", tmp_path / "here"
    batch = Batch(study, there, tmp_path, *on(programs.address))
    wait_for(lambda: len(results(there)) >= 2)
    programs.running[1].kill()
    code, _, error = batch.end()
    assert code == 3, error
    assert sum(line.startswith("failed") for line in error.splitlines()) == 1
    assert Batch(study, here, tmp_path).end()[0] == 3
    far, near = read_table(there / "table.h5"), read_table(here / "table.h5")
    assert sum(far["outcome"] == "solved") == 31
    for name in set(near) - {"cpu_s"}:
        assert np.array_equal(far[name], near[name], equal_nan=far[name].dtype.kind == "f"), name
    same_later({}, there)


@pytest.mark.slow
def test_a_batch_whose_workers_all_die_ends_and_goes_on_with_others(tmp_path, programs):
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=list(range(10, 40)))
    batch = Batch(study, out, tmp_path, *on(programs.address, "--wait", "1 s"))
    wait_for(lambda: results(out))
    for worker in programs.running[1:]:
        worker.kill()
    code, _, error = batch.end()
    assert code == 4
    waiting, ended = error.splitlines()
    assert waiting.endswith("; waiting for 1 s (--wait)")
    assert ended.startswith(f"error: --scheduler: {programs.address} ")  # a busy machine may answer too late
    assert " for 1 s (--wait); start some with: dask worker" in ended
    stamps = same_later({}, out)
    assert 0 < len(stamps) < 30
    programs.workers(1)
    code, _, error = Batch(study, out, tmp_path, *on(programs.address)).end()
    assert code == 0, error
    assert len(same_later(stamps, out)) == 30


def test_a_scheduler_that_goes_ends_the_batch_in_one_line(tmp_path, programs):
    out = tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=list(range(10, 60)))
    batch = Batch(study, out, tmp_path, *on(programs.address))
    wait_for(lambda: results(out))
    programs.running[0].kill()
    code, _, error = batch.end()
    assert code == 4
    assert one_line(error) == "error: the scheduler is gone; what is stored stays, start again"
    assert 0 < len(same_later({}, out)) < 50


@pytest.fixture
def moody_here(monkeypatch):
    """The models for tests are on the ladder of this process."""
    monkeypatch.setattr(pocket_models, "__path__", [*pocket_models.__path__, str(MOODY / "models")])
    models.cache_clear()
    yield
    models.cache_clear()


@pytest.mark.usefixtures("moody_here")
def test_a_program_is_needed_on_a_worker_alone(tmp_path):
    """Of two workers one has the program; the sender has none and finds the results again."""
    programs, out = DaskPrograms(tmp_path / "programs"), tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["fitted", "reynolds"], numbers=list(range(10, 30)))
    everything = write_study(tmp_path / "all.toml", models=[])
    everything.write_text(everything.read_text().replace("models = []\n", ""))
    reason = "no worker can run it (no fitter on the PATH; install it with: fetch fitter)"
    try:
        programs.scheduler()
        programs.workers(1)
        code, _, error = called(study, out, *on(programs.address))
        assert code == 4
        assert one_line(error) == f"error: study.models: fitted: {reason}"
        code, output, error = called(everything, out, *on(programs.address, "--dry-run", "--json"))
        assert code == 0, error
        assert error.startswith("left out: ")
        assert f"fitted: {reason}" in one_line(error)
        assert "fitted" not in json.loads(output)["jobs"]

        programs.workers(1, FITTER_VERSION="3")
        code, _, error = called(study, out, *on(programs.address))
        assert code == 0, error
        assert set(read_table(out / "table.h5")["outcome"]) == {"solved"}
        assert len(results(out)) == 40
        code, output, error = called(study, out, *on(programs.address, "--dry-run", "--json"))
        assert [one["finished"] for one in json.loads(output)["jobs"].values()] == [20, 20]
    finally:
        programs.end()


@pytest.mark.openfoam
@pytest.mark.slow
def test_openfoam_is_needed_on_the_workers_alone(tmp_path):
    programs, out = DaskPrograms(tmp_path / "programs"), tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["navier_stokes"], more="resolution.navier_stokes = 24\n")
    nowhere = {"PATH": str(tmp_path), "ROUGHFILM_OPENFOAM": str(tmp_path / "none"), "WM_PROJECT_DIR": ""}
    code, _, error = Batch(study, out, tmp_path, environment=nowhere).end()
    assert code == 4, error
    try:
        programs.scheduler()
        programs.workers(1)
        code, _, error = Batch(study, out, tmp_path, *on(programs.address), environment=nowhere).end()
        assert code == 0, error
    finally:
        programs.end()
    assert list(read_table(out / "table.h5")["outcome"]) == ["solved"]


def test_a_batch_without_workers_ends_after_its_wait(tmp_path, scheduler):
    address = scheduler()
    code, output, error = called(POCKET, tmp_path / "out", *on(address, "--wait", "0 s"))
    assert code == 4
    _, line = error.splitlines()
    assert line.startswith(f"error: --scheduler: {address} has had no workers for 0 s (--wait); start some with: dask")
    assert output == ""


def test_workers_with_other_code_are_one_line_and_code_4(tmp_path, scheduler, monkeypatch):
    other = cluster.Offer(host="node7", code=("other", {}), models={})
    monkeypatch.setattr(cluster.Cluster, "_ask", lambda _: {"tcp://127.0.0.1:1": other})
    code, _, error = called(POCKET, tmp_path / "out", *on(scheduler(1)))
    assert code == 4
    assert "node7 has other code or libraries than the sender" in one_line(error)
    assert not (tmp_path / "out").exists()


def test_keys_are_private_and_are_not_replaced(keys):
    place = keys("keys")
    before = (place / "key.pem").read_bytes()
    assert {path.name for path in place.iterdir()} == {"ca.pem", "cert.pem", "key.pem"}
    assert stat.S_IMODE((place / "key.pem").stat().st_mode) == 0o600
    again = CliRunner().invoke(app, ["cluster", "keys", str(place)])
    assert again.exit_code == 2
    assert "key.pem: keys exist; delete them or name another directory" in one_line(again.stderr)
    assert (place / "key.pem").read_bytes() == before


def test_keys_open_a_scheduler_and_its_workers(tmp_path, scheduler, keys):
    distributed = pytest.importorskip("distributed")
    place, other = keys("keys"), keys("other")
    address = scheduler(1, protocol="tls://", security=distributed.Security(**roles(place)))
    assert address.startswith("tls://")
    code, _, error = called(POCKET, tmp_path / "out", *on(address, "--tls", place))
    assert code == 0, error
    assert one_line(error).endswith(" results have warnings; see the column warnings of the table")
    assert set(read_table(tmp_path / "out" / "table.h5")["outcome"]) == {"solved"}

    code, _, error = called(POCKET, tmp_path / "closed", *on(address, "--tls", other))
    assert code == 4
    assert one_line(error).startswith(f"error: --scheduler {address}: a scheduler answers but refuses these keys")
    assert not (tmp_path / "closed").exists()


def test_keys_of_the_configuration_of_dask_are_taken(tmp_path, scheduler, keys):
    distributed, config = pytest.importorskip("distributed"), pytest.importorskip("dask.config")
    place = keys("keys")
    address = scheduler(1, protocol="tls://", security=distributed.Security(**roles(place)))
    files = {
        "ca-file": str(place / "ca.pem"),
        "client.cert": str(place / "cert.pem"),
        "client.key": str(place / "key.pem"),
    }
    with config.set({f"distributed.comm.tls.{name}": path for name, path in files.items()}):
        code, _, error = called(POCKET, tmp_path / "out", *on(address, "--dry-run"))
    assert code == 0, error


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("tls://127.0.0.1:9",), "--tls: missing for tls://127.0.0.1:9"),
        (("tls://127.0.0.1:9", "--tls", "none"), "--tls none: has no ca.pem"),
        (("tcp://127.0.0.1:9", "--tls", "none"), "--tls: is for a scheduler at tls://HOST:PORT"),
        (("tcp://127.0.0.1:9", "--wait", "7"), "--wait: got '7', a number without a unit"),
        (("tcp://127.0.0.1:9", "--wait", "-1 s"), "--wait: got '-1 s'; it must be 0 s to 30 d"),
    ],
)
def test_wrong_options_are_one_line_and_code_2(tmp_path, arguments, words):
    pytest.importorskip("distributed")
    code, output, error = called(POCKET, tmp_path / "out", *on(*arguments))
    assert code == 2
    assert words in one_line(error)
    assert output == ""
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("address", "is_open"),
    [
        ("tcp://127.0.0.1:8786", False),
        ("tcp://127.8.8.8:8786", False),
        ("tcp://localhost:8786", False),
        ("tcp://[::1]:8786", False),
        ("tcp://10.0.0.5:8786", True),
        ("tcp://0.0.0.0:8786", True),
        ("tcp://login1:8786", True),
        ("ws://10.0.0.5:8786", True),
        ("tls://10.0.0.5:8786", False),
    ],
)
def test_an_address_without_tls_is_closed_on_this_machine_alone(address, is_open):
    pytest.importorskip("distributed")
    assert cluster.is_open(address) == is_open


def test_a_scheduler_that_is_open_to_others_is_named_in_a_warning(tmp_path, scheduler, monkeypatch):
    address = scheduler(1)
    monkeypatch.setattr(cluster, "is_open", lambda one: one == address)
    code, _, error = called(POCKET, tmp_path / "out", *on(address, "--dry-run"))
    assert code == 0
    assert one_line(error).startswith(f"warning: whoever reaches {address} can run programs there")


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nowhere"])
def test_a_scheduler_that_does_not_answer_is_one_line_and_code_4(tmp_path, address):
    pytest.importorskip("distributed")
    code, output, error = called(POCKET, tmp_path / "out", *on(address))
    assert code == 4
    assert one_line(error).startswith(f"error: --scheduler {address}: no dask scheduler answers")
    assert output == ""


def test_without_dask_it_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    code, _, error = called(POCKET, tmp_path / "out", *on("tcp://127.0.0.1:9"))
    assert code == 4
    assert "pip install 'roughfilm[cluster]'" in error


def test_the_remedy_without_workers_names_the_keys(tmp_path, scheduler, keys):
    distributed = pytest.importorskip("distributed")
    place = keys("keys")
    address = scheduler(0, protocol="tls://", security=distributed.Security(**roles(place)))
    code, _, error = called(POCKET, tmp_path / "out", *on(address, "--tls", place, "--wait", "0 s"))
    assert code == 4
    assert f"--tls-ca-file {place / 'ca.pem'}" in error
