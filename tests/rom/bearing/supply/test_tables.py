"""Faults of [[supply]], each in one line with its remedy, and the laws of restrictors."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.supply.patches import Patch
from roughfilm.rom.bearing.supply.restrictors import GivenFlow, LaminarTube, SharpOrifice
from roughfilm.rom.ladder.scene import read_scene

JOURNAL = {"shape": "lobes", "radius": "25 mm", "clearance": "25 um", "width": "40 mm", "eccentricity": [0.3, 0.2]}
PAD = {"shape": "parallel", "length": "100 mm", "width": "100 mm", "film": "20 um"}
WIDE = {"shape": "parallel", "length": "100 mm", "film": "20 um"}
SECTOR = {
    "shape": "sector",
    "inner_radius": "40 mm",
    "outer_radius": "80 mm",
    "angle": "40 deg",
    "film": "20 um",
    "rise": "20 um",
}
FED = {"pressure": "1 MPa"}
HOLE = {"kind": "hole", "diameter": "4 mm", "angle": "90 deg"} | FED
AXIAL = {"kind": "groove", "length": "4 mm", "extent": "10 mm"} | FED


def scene(geometry, *supply, **tables):
    tables = {"lubricant": {"viscosity": "20 mPa*s"}, "motion": {"speed": "1 m/s"}} | tables
    return read_scene({"name": "fed", "kind": "bearing", "geometry": geometry, "supply": list(supply), **tables})


@pytest.mark.parametrize(
    ("geometry", "supplies", "line"),
    [
        (JOURNAL, [{"kind": "grove"}], "supply.0.kind: got 'grove'; it must be 'groove', 'hole', 'pocket'"),
        (JOURNAL, [{"angle": "3 deg"}], "supply.0.kind: is missing"),
        (JOURNAL, [AXIAL | {"presure": "1 MPa"}], "supply.0.presure: unknown key; did you mean 'pressure'?"),
        (JOURNAL, [{"kind": "groove", "extent": "4 mm"}], "supply.0.pressure: is missing; give it, or a flow"),
        (JOURNAL, [HOLE | {"flow": "1 l/min"}], "supply.0.pressure: got both"),
        (JOURNAL, [{"kind": "groove"} | FED], "supply.0.length: is missing, and extent too"),
        (JOURNAL, [{"kind": "groove", "extent": "50 mm"} | FED], "supply.0.y: reaches from -0.005 to 0.045 m"),
        (JOURNAL, [{"kind": "groove", "length": "4 mm"} | FED], "supply.0.extent: is missing"),
        (JOURNAL, [AXIAL], "supply.0.angle: is missing"),
        (JOURNAL, [AXIAL | {"angle": "90 deg", "pressure": "-1 MPa"}], "supply.0.pressure: got -1000000.0 Pa"),
        (JOURNAL, [HOLE | {"x": "10 mm"}], "supply.0.x: got one for the shape lobes"),
        (JOURNAL, [HOLE | {"diameter": "4 nm"}], "supply.0.diameter: got 4e-09 m; it must be at least"),
        (JOURNAL, [HOLE | {"orifice": {"diameter": "1 mm"}}], "supply.0.orifice: got one without lubricant.density"),
        (JOURNAL, [HOLE | {"capillary": {"diameter": "1 mm"}}], "supply.0.capillary.length: missing"),
        (JOURNAL, [HOLE, HOLE | {"angle": "95 deg"}], "supply.1: meets supply.0"),
        (JOURNAL, [AXIAL | {"angle": "1 deg", "length": "1 m"}], "supply.0.length: got one as long as the film"),
        (JOURNAL, [AXIAL | {"angle": "1 deg", "length": "-1 mm"}], "supply.0.length: got -0.001 m"),
        (JOURNAL | {"lobes": 2, "arc": "170 deg"}, [HOLE | {"angle": "0 deg"}], "supply.0.angle: reaches into the gap"),
        (PAD, [{"kind": "groove", "extent": "4 mm"} | FED], "supply.0.length: is missing; only lobes"),
        (PAD, [{"kind": "hole", "diameter": "4 mm", "x": "1 mm"} | FED], "supply.0.x: reaches from -0.000694426"),
        (SECTOR, [HOLE | {"angle": "39 deg"}], "supply.0.angle: reaches from 0.652438 to 0.708919 rad"),
        (SECTOR, [HOLE | {"angle": "20 deg", "y": "1 mm"}], "supply.0.y: got one for the shape sector"),
        (WIDE, [{"kind": "groove", "length": "0 mm", "x": "5 cm", "flow": "1 l/min"}], "infinitely wide film"),
        (WIDE, [AXIAL | {"x": "50 mm"}], "supply.0.kind: got a groove with an extent"),
    ],
)
def test_a_fault_is_one_line_with_its_place(geometry, supplies, line):
    with pytest.raises(InputError) as fault:
        scene(geometry, *supplies)
    assert line in str(fault.value)
    assert len(str(fault.value).splitlines()) == 1


def test_models_that_leave_out_what_a_supply_needs_do_not_apply():
    fed = scene(PAD, {"kind": "hole", "diameter": "4 mm", "x": "50 mm"} | FED)
    applies = {name: find("bearing", name).applies(fed).applies for name in ("infinitely_wide", "film", "reynolds")}
    assert applies == {"infinitely_wide": False, "film": False, "reynolds": True}


@pytest.mark.parametrize(
    "law", [LaminarTube(2e-12), SharpOrifice(1e-9, 20.0), SharpOrifice(1e-9, 1.0), GivenFlow(1e-6)]
)
def test_the_derivative_of_a_flow_is_its_difference(law):
    for drop in (-1e6, -3e3, -20.0, 0.0, 5.0, 1e5):
        step = 1e-3 * max(abs(drop), 1.0)
        difference = (law.flow(drop + step)[0] - law.flow(drop - step)[0]) / (2 * step)
        assert law.flow(drop)[1] == pytest.approx(difference, rel=1e-5, abs=1e-30)


def test_an_orifice_passes_as_much_back_as_forth():
    law = SharpOrifice(0.6 * math.pi * 1e-6 / 4 * math.sqrt(2 / 870), 10.0)
    assert law.flow(1e6)[0] == pytest.approx(0.6 * math.pi * 1e-6 / 4 * math.sqrt(2e6 / 870), rel=1e-9)
    assert law.flow(-1e6)[0] == -law.flow(1e6)[0]


def test_a_patch_over_the_end_of_a_periodic_film_covers_both_of_its_parts():
    patch = Patch(x=(0.9, 1.2), y=(0.2, 0.4), period=1.0, slack=(1e-9, 1e-9))
    x = np.array([0.0, 0.2, 0.21, 0.89, 0.9, 0.99])
    assert patch.covers(x, 0.3 + 0 * x).tolist() == [True, True, False, False, True, True]
    assert not patch.covers(x, 0.5 + 0 * x).any()
    assert patch.meets(Patch(x=(0.1, 0.3), y=(0.4, 0.5), period=1.0, slack=(1e-9, 1e-9)))
    assert not patch.meets(Patch(x=(0.3, 0.8), y=None, period=1.0, slack=(1e-9, 1e-9)))


def test_a_pocket_covers_the_whole_width_of_an_infinitely_wide_film_and_needs_an_extent_in_another():
    entries = {
        "name": "pad",
        "kind": "bearing",
        "geometry": {"shape": "parallel", "length": "20 mm", "film": "20 um"},
        "lubricant": {"viscosity": "20 mPa*s"},
        "motion": {"speed": "1 m/s"},
        "supply": [{"kind": "pocket", "x": "10 mm", "length": "3 mm", "depth": "1 mm", "pressure": "1 MPa"}],
    }
    read_scene(entries)
    narrow = entries | {"geometry": entries["geometry"] | {"width": "20 mm"}}
    with pytest.raises(InputError, match=r"extent: is missing; the pocket must end"):
        read_scene(narrow)


def test_the_first_of_the_speeds_over_time_is_that_of_steady_films():
    over_time = {"time": ["0 s", "1 s"], "speed": ["2 m/s", "3 m/s"]}
    entries = {
        "name": "pad",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "20 mm", "film": "20 um", "rise": "20 um"},
        "lubricant": {"viscosity": "20 mPa*s"},
        "motion": {"over_time": over_time},
    }
    assert read_scene(entries).motion.speed == 2.0
    listed = {"time": "[0 s, 1 s]", "speed": over_time["speed"]}
    with pytest.raises(InputError, match=r"it is no list of TOML, write numbers with units in quotes"):
        read_scene(entries | {"motion": {"over_time": listed}})
