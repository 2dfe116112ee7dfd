"""Compiled loops where their cache cannot be written."""

import numpy as np

from roughfilm.contact.foundation.cache import warn
from roughfilm.contact.foundation.compiled import _keep, compiled
from roughfilm.contact.foundation.timing import running_cost


def test_a_full_disk_costs_what_is_kept_and_not_the_loop(caplog):
    def full(*_compilation):
        raise OSError(28, "No space left on device")

    warn.cache_clear()
    _keep(full, "signature", "code")
    _keep(full, "signature", "code")
    (record,) = caplog.records
    assert "compiled kernels: cannot be written (No space left on device); set NUMBA_CACHE_DIR" in record.getMessage()


def test_a_loop_saves_through_the_function_that_warns():
    @compiled
    def doubled(values):
        for place in range(values.size):
            values[place] *= 2

    assert doubled._dispatcher._cache.save_overload.func is _keep


def test_a_loop_is_read_from_the_disk_as_a_one_time_cost(monkeypatch):
    from numba.core.caching import FunctionCache

    costs = []
    monkeypatch.setattr(FunctionCache, "load_overload", lambda *_: costs.append(running_cost()))

    @compiled
    def tripled(values):
        for place in range(values.size):
            values[place] *= 3

    tripled(np.ones(2))
    assert costs == ["start"]
