"""Jobs on a full disk."""

import errno
import os

import pytest

from roughfilm.batch import jobs
from roughfilm.contact.foundation.errors import InputError, writing
from roughfilm.ladder import find


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
