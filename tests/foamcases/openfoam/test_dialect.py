"""Cases for both families of OpenFOAM: each entry in each spelling, two words by family, and banners of releases."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from foamlib import FoamFile
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam import run
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.dialect import COM, ORG, Release, dialect_named, release_in
from roughfilm.foamcases.openfoam.dictionaries import solution
from roughfilm.foamcases.openfoam.installation import Installation, dialect_here, environment
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.models.navier_stokes import MODEL as POCKET
from roughfilm.foamcases.pocket.run import run_case
from roughfilm.foamcases.rough_gap.models.navier_stokes import MODEL as GAP
from roughfilm.foamcases.snappy.dictionary import snappy_dictionary
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

ENTRIES = {
    "name": "gap",
    "kind": "rough_gap",
    "geometry": {"surface": "sinusoid", "amplitude": "3 um", "wavelength": "50 um", "mean_gap": "10 um"},
    "lubricant": {"viscosity": "0.01 Pa*s", "density": "870 kg/m^3"},
    "flow": {"reynolds_number": 0.5},
}

BANNERS = {
    "Using: OpenFOAM-v2412 (2412) - visit www.openfoam.com": ("com", "2412", COM),
    "Using: OpenFOAM- (1912) - visit www.openfoam.com": ("com", "1912", COM),
    "Using: OpenFOAM-13 (see https://openfoam.org)": ("org", "13", ORG),
    "Using: OpenFOAM-8-1c9b5879390b (see https://openfoam.org)": ("org", "8", ORG),
    "Using: OpenFOAM-7 (see www.openfoam.org)": None,
    "Using: OpenFOAM-7 (see https://openfoam.org)": ("org", "7", COM),
    "Using: OpenFOAM-dev (see https://openfoam.org)": ("org", "dev", ORG),
    "foam-extend-5.0 - visit www.foam-extend.org": None,
}


@pytest.mark.parametrize("banner", BANNERS)
def test_a_banner_states_the_release(banner):
    release = release_in(f"options:\n  -case <dir>\n\n{banner}\nBuild: _26\n")
    assert (release and (release.family, release.number, release.dialect)) == BANNERS[banner]


def test_only_tried_releases_carry_no_caution():
    assert Release(family="com", number="1912").caution == ""
    assert "OpenFOAM v2412 was never tried" in Release(family="com", number="2412").caution
    assert "OpenFOAM 1912 of openfoam.org was never tried" in Release(family="org", number="1912").caution


def test_dialects_are_known_by_name():
    assert dialect_named("org") is ORG
    with pytest.raises(InputError, match=r"dialect: got 'foundation'; it must be com \(.*\) or org \(.*\)"):
        dialect_named("foundation")


WORDS = {COM: ("vectorSemiImplicitSource", "abort"), ORG: ("semiImplicitSource", "stopAtFile")}
"""The types of the source and of the stop function in each dialect."""


@pytest.fixture(params=[COM, ORG], ids=["com", "org"])
def dialect(request):
    return request.param


def entries(path):
    """The entries of a dictionary as plain objects, with arrays as lists."""

    def plain(value):
        if isinstance(value, dict):
            return {key: plain(one) for key, one in value.items()}
        if isinstance(value, np.ndarray):
            return value.tolist()
        return [plain(one) for one in value] if isinstance(value, list | tuple) else value

    return plain(FoamFile(path).as_dict())


def test_every_spelling_stands_in_a_gap_case(dialect, tmp_path):
    GAP.write(read_scene(ENTRIES), tmp_path / "case", Request(resolution=8), dialect=dialect)
    source, stop = WORDS[dialect]
    case = tmp_path / "case" / "along"
    control = entries(case / "system" / "controlDict")
    assert control["application"] == "simpleFoam"
    assert control["solver"] == "incompressibleFluid"
    assert control["writePrecision"] == 12
    assert control["functions"]["flow"] == {
        "type": "volFieldValue",
        "libs": ['"libfieldFunctionObjects.so"'],
        "fields": ["U"],
        "operation": "volAverage",
        "regionType": "all",
        "select": "all",
        "cellZone": "all",
        "writeFields": False,
        "writePrecision": 12,
        "log": False,
    }
    assert control["functions"]["STOP"] == {
        "type": stop,
        "libs": ['"libutilityFunctionObjects.so"'],
        "action": "writeNow",
    }
    options = entries(case / "constant" / "fvOptions")
    assert options["gradient"] == {
        "type": source,
        "active": True,
        "selectionMode": "all",
        "select": "all",
        "cellZone": "all",
        "volumeMode": "specific",
        "injectionRateSuSp": {"U": [[24.0, 0.0, 0.0], 0.0]},
        "sources": {"U": {"explicit": [24.0, 0.0, 0.0], "implicit": 0.0}},
    }
    liquid = entries(case / "constant" / "transportProperties")
    assert (liquid["transportModel"], liquid["viscosityModel"], liquid["nu"]) == ("Newtonian", "constant", 2.0)
    assert entries(case / "constant" / "turbulenceProperties")["simulationType"] == "laminar"
    solution = entries(case / "system" / "fvSolution")
    assert "SIMPLE" in solution
    assert "PIMPLE" not in solution  # openfoam.org 11 and later would take it


@pytest.mark.parametrize(
    ("velocity", "pressure"),
    [(0.85, {COM: 1.0, ORG: 1.0}), (0.95, {COM: 1.0, ORG: 0.5}), (0.999, {COM: 1.0, ORG: 0.01})],
)
def test_pressure_is_relaxed_where_the_solver_limits_simplec(dialect, velocity, pressure):
    """Solvers of openfoam.org 11 and later limit the correction of SIMPLEC to ten times that of SIMPLE."""
    assert dialect.pressure_relaxation(velocity) == pytest.approx(pressure[dialect])
    _, solved = solution(
        dialect=dialect, tolerance=1e-5, linear=1e-3, relaxation=velocity, coarsest=20, velocity_gain=0.1
    )
    factors = solved["relaxationFactors"]
    assert factors["equations"]["U"] == velocity
    assert factors["fields"]["p"] == pytest.approx(pressure[dialect])


def test_a_case_says_which_releases_it_is_for(dialect, make_scene, tmp_path):
    POCKET.write(make_scene(0.3, 0.25, 40), tmp_path, Request(resolution=20), dialect=dialect)
    assert read_card(tmp_path, Card).dialect == dialect.name
    assert f"The case is written for {dialect.releases}" in (tmp_path / "README").read_text()


def test_the_dialect_of_generated_cases_can_be_chosen(pocket_file, tmp_path):
    arguments = ["generate", str(pocket_file), "--resolution", "20", "--json"]
    done = CliRunner().invoke(app, [*arguments, "--out", str(tmp_path / "made"), "--dialect", "org"])
    assert json.loads(done.stdout)["dialect"] == "org"
    assert read_card(tmp_path / "made" / "stokes", Card).dialect == "org"
    done = CliRunner().invoke(app, [*arguments, "--out", str(tmp_path / "not"), "--dialect", "foundation"])
    assert done.exit_code == 2
    assert "error: --dialect: got 'foundation'; it must be com (" in done.stderr
    assert not (tmp_path / "not").exists()


@pytest.mark.parametrize(
    ("written", "here"),
    [(COM, Release(family="org", number="13")), (ORG, Release(family="com", number="2412"))],
    ids=["com", "org"],
)
def test_a_run_refuses_a_case_of_the_other_dialect(written, here, make_scene, tmp_path, monkeypatch):
    POCKET.write(make_scene(0.3, 0.25, 40), tmp_path, Request(resolution=20), dialect=written)
    monkeypatch.setattr(run, "installation", lambda: Installation(release=here, detail=str(here)))
    words = re.escape(f"is written for {written.releases}, and here is {here}; write the case again in the dialect")
    with pytest.raises(InputError, match=words):
        run_case(tmp_path)


def test_snappy_has_the_settings_of_layers_that_old_releases_read():
    _, settings = snappy_dictionary((0.5, 0.5, 0.5), 1)
    asked = {"relativeSizes", "minThickness", "featureAngle", "nGrow", "maxFaceThicknessRatio", "nLayerIter", "layers"}
    asked |= {"nBufferCellsNoExtrude", "expansionRatio", "finalLayerThickness"}
    assert {*settings["addLayersControls"]} == asked
    assert settings["addLayers"] is False


NOT_READ = {
    "com": {
        "system/controlDict": [
            ("solver",),
            ("writePrecision",),
            ("functions", "flow", "select"),
            ("functions", "flow", "cellZone"),
        ],
        "constant/fvOptions": [("gradient", "select"), ("gradient", "cellZone"), ("gradient", "sources")],
        "constant/transportProperties": [("viscosityModel",)],
    },
    "org": {
        "system/controlDict": [
            ("functions", "flow", "select"),
            ("functions", "flow", "regionType"),
            ("functions", "flow", "writePrecision"),
        ],
        "constant/fvOptions": [
            ("gradient", "selectionMode"),
            ("gradient", "select"),
            ("gradient", "injectionRateSuSp"),
        ],
        "constant/transportProperties": [("transportModel",)],
    },
}
"""The entries that openfoam.com's v1912 and openfoam.org's 13 do not need."""


@pytest.mark.openfoam
def test_the_entries_of_other_releases_change_no_byte_of_an_answer(tmp_path):
    """A case gives the same fields and mean velocity with and without the spellings of other releases."""
    dialect = dialect_here()
    whole, bare = tmp_path / "whole" / "along", tmp_path / "bare" / "along"
    GAP.write(read_scene(ENTRIES), tmp_path / "whole", Request(resolution=8), dialect=dialect)
    with FoamFile(whole / "system" / "controlDict") as control:
        control["endTime"] = control["writeInterval"] = 25
    shutil.copytree(tmp_path / "whole", tmp_path / "bare", symlinks=True)
    for name, keys in NOT_READ[dialect.name].items():
        with FoamFile(bare / name) as file:
            for key in keys:
                del file[key]
    for case in (whole, bare):
        subprocess.run(["simpleFoam"], cwd=case, env=environment(), check=True, stdout=subprocess.DEVNULL)
    results = ["25/U", "25/p", "postProcessing/flow/0/volFieldValue.dat"]
    assert [(bare / name).read_bytes() == (whole / name).read_bytes() for name in results] == [True] * 3
