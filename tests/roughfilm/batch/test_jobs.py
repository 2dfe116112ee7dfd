"""Jobs on a full disk, and the time of quick ones."""

import errno
import os
from dataclasses import replace

import pytest

from roughfilm.batch import jobs
from roughfilm.contact.foundation.errors import InputError, writing
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import silent
from roughfilm.rom.ladder.setting import Setting


def test_a_full_disk_is_no_failure_of_a_model(make_scene, monkeypatch, tmp_path):
    def full(_job, _answer):
        with writing("results"):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(jobs, "store", full)
    failed: dict[str, str] = {}
    scene = make_scene(0.3, 0.25, 40)
    asked = jobs.jobs_of(scene, [find("pocket", "reynolds"), find("pocket", "inertial_reynolds")], tmp_path)
    with pytest.raises(InputError, match=r"results: cannot be written .* free some space there"):
        jobs.run_all(asked, failed)
    assert failed == {}


def test_the_time_of_a_quick_model_is_the_shortest_of_several_runs(make_scene, monkeypatch, tmp_path):
    job, *_ = jobs.jobs_of(make_scene(0.3, 0.25, 40), [find("pocket", "reynolds")], tmp_path)
    result, times = job.setting.solve(job.scene), iter([3e-3, 1e-3, 2e-3])

    def solve(*_):
        return replace(result, numerics=replace(result.numerics, cpu_s=next(times), one_time={"start": 0.5}))

    monkeypatch.setattr(jobs, "REPEATS", 3)
    monkeypatch.setattr(Setting, "solve", solve)
    found = jobs.solved_once(job, silent)
    assert found.numerics.cpu_s == 1e-3
    assert found.numerics.one_time == {"start": 1.5}
