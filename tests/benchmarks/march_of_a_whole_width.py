"""Print the CPU time, s, of a march of a misaligned journal, whose whole width is solved."""

import sys
import time

import roughfilm as rf

SCENE = rf.read_scene(
    {
        "name": "misaligned",
        "kind": "bearing",
        "geometry": {
            "shape": "lobes",
            "radius": "25 mm",
            "clearance": "40 um",
            "width": "25 mm",
            "misalignment": ["0.1 mrad", "0.2 mrad"],
        },
        "lubricant": {"viscosity": "15 mPa*s", "cavitation_pressure": "-0.1 MPa"},
        "motion": {"speed": "6000 rpm"},
        "load": {"force": "300 N"},
        "body": {"mass": "3 kg"},
    }
)

if __name__ == "__main__":
    rf.march(SCENE, end=1e-4, steps=2, cells=(16, 8), uncertainty=False)
    started = time.process_time()
    rf.march(SCENE, end=1e-3, steps=4, cells=(24, 64), uncertainty=False)
    sys.stdout.write(f"{time.process_time() - started}\n")
