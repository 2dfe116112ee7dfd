"""Batches whose workers are jobs of Slurm."""

import json
import shlex
import sys

import pytest
from batches import Batch, results, same_later, wait_for, write_study
from dask_programs import DaskPrograms
from slurm_node import SlurmNode
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.studies.table import read_table


@pytest.fixture
def slurm():
    node = SlurmNode()
    yield node
    node.end()


@pytest.mark.slow
def test_workers_are_tasks_of_an_array_and_one_may_be_cancelled(tmp_path, slurm):
    pytest.importorskip("cryptography")
    programs, out = DaskPrograms(tmp_path / "programs"), tmp_path / "out"
    study = write_study(tmp_path / "s.toml", models=["moody"], numbers=list(range(10, 50)))
    keys = tmp_path / "keys"
    shown = json.loads(CliRunner().invoke(app, ["cluster", "keys", str(keys), "--json"]).stdout)["commands"]
    files = ("--tls-ca-file", keys / "ca.pem", "--tls-cert", keys / "cert.pem", "--tls-key", keys / "key.pem")
    try:
        programs.scheduler("--protocol", "tls", *files)
        _, *worker = shlex.split(shown["workers"].replace("tls://127.0.0.1:8786", programs.address))
        worker = [sys.executable, "-m", "dask", *worker, "--nworkers", "1", "--preload", str(programs.preload)]
        worker += ["--local-directory", str(tmp_path)]
        script = f"#!/bin/sh\nexport MOODY_NOTES={tmp_path}/notes MOODY_SECONDS=0.3\nexec {shlex.join(worker)}\n"
        job = slurm.submitted(script, "--array=1-2")
        logs = [slurm.place / f"job-{task}.out" for task in (1, 2)]
        wait_for(lambda: all(log.exists() and "Registered to" in log.read_text() for log in logs))
        place = ("--executor", "dask", "--scheduler", programs.address, "--tls", keys, "--wait", "2 min")
        batch = Batch(study, out, tmp_path, *place, seconds=0.3)
        wait_for(lambda: len(results(out)) >= 4)
        slurm.answer("scancel", f"{job}_1")
        stamps = same_later({}, out)
        assert len(stamps) < 40
        code, _, error = batch.end()
        assert code == 0, error
        assert len(same_later(stamps, out)) == 40
        assert set(read_table(out / "table.h5")["outcome"]) == {"solved"}
        assert slurm.answer("squeue", "--noheader", "--array", "--format=%K %T") == "2 RUNNING"
    finally:
        programs.end()
