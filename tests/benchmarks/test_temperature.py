"""CPU time of the models with temperatures over that of the isothermal film, measured in one run, as JSON."""

import json
import os

import pytest
from places import BENCHMARKS

import roughfilm as rf
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.provenance import circumstances

RESULTS = BENCHMARKS / "temperature.json"
CELLS, REPEATS = 256, 4
MODELS = ("reynolds_cavitating", "adiabatic", "across")

TARGETS = {"adiabatic": 3.0, "across": 10.0}
"""CPU time over that of the isothermal film that the models are to stay below at given film thickness."""

MARGIN = 1.3
"""What ratios may be above their targets, as the least CPU times of one run differ by so much."""

OIL = {
    "viscosity": "0.03 Pa*s",
    "density": "860 kg/m^3",
    "temperature": "40 degC",
    "heat_capacity": "2000 J/(kg*K)",
    "conductivity": "0.14 W/(m*K)",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.035 1/K"},
}
PAD = {"shape": "linear", "length": "0.1 m", "width": "0.1 m", "film": "40 um", "rise": "40 um"}
JOURNAL = {"shape": "journal", "radius": "50 mm", "width": "80 mm", "clearance": "60 um"}
SCENES = {
    "pad": {"geometry": PAD, "motion": {"speed": "10 m/s"}},
    "journal": {"geometry": JOURNAL | {"eccentricity": 0.7}, "motion": {"speed": "3000 rpm"}},
    "journal under load": {"geometry": JOURNAL, "motion": {"speed": "3000 rpm"}, "load": {"force": "20 kN"}},
    "journal under load, pressure at the inlet": {
        "geometry": JOURNAL | {"width": "70 mm", "clearance": "80 um"},
        "motion": {"speed": "3000 rpm"},
        "load": {"force": "10 kN"},
        "boundary": {"inlet": {"pressure": "0.1 MPa"}},
    },
}
GIVEN = ("pad", "journal")
"""Scenes with a given film thickness, whose ratios are judged; those under a load are recorded."""


def cost(entries):
    """The least CPU time of each model, s; the models in turn, so that all meet the same load of the machine."""
    scene = rf.read_scene({"kind": "bearing", "name": "benchmark", "lubricant": OIL, **entries})
    runs = [
        {model: rf.solve(scene, model=model, resolution=CELLS).numerics.cpu_s for model in MODELS}
        for _ in range(REPEATS)
    ]
    return {model: min(run[model] for run in runs) for model in MODELS}


@pytest.mark.benchmark
def test_cost_of_temperatures_over_that_of_an_isothermal_film():
    rows = {}
    for name, entries in SCENES.items():
        cpu = cost(entries)
        rows[name] = {"cpu_s": cpu, "ratios": {model: cpu[model] / cpu[MODELS[0]] for model in TARGETS}}
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "load_average": os.getloadavg()[0], "rows": rows}, indent=1))
    for name in GIVEN:
        for model, target in TARGETS.items():
            assert rows[name]["ratios"][model] <= MARGIN * target, (name, model)
