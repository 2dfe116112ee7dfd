"""The fused loops: that they compile wherever the package stands."""

import os
import subprocess
import sys
from pathlib import Path

from roughfilm.contact.mechanics import kernels

PROGRAM = """
import sys
import numpy as np
module = {"__name__": "kernels"}
exec(compile(open(sys.argv[1]).read(), "/proc/nowhere/kernels.py", "exec"), module)
modes = np.array([[1 + 2j, 3j], [5j, 1 + 0j]])
module["scale_modes"](modes, 1, np.array([[2.0], [3.0]]))
print(modes.tolist() == [[1 + 2j, 6j], [5j, 3 + 0j]])
"""


def test_they_compile_where_nothing_can_be_kept():
    nowhere = dict.fromkeys(("HOME", "XDG_CACHE_HOME"), "/proc/nowhere")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, Path(kernels.__file__)],
        env={name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"} | nowhere,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.stdout.strip() == "True", done.stderr
