"""What a file of curves depends on: points of another scene are never used again."""

import pytest

from roughfilm.rom.bearing.mixed.curves import curve_inputs
from roughfilm.rom.ladder.scene import read_scene

LOBES = {"shape": "lobes", "radius": "20 mm", "clearance": "20 um", "width": "20 mm", "lobes": 2, "arc": "160 deg"}
PAD = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": 0.6}
FED = {"kind": "hole", "angle": "90 deg", "diameter": "2 mm", "pressure": "1 MPa"}


def digest(geometry=LOBES, density="870 kg/m^3", inlet=None, **tables):
    entries = {"name": "curves", "kind": "bearing", "geometry": geometry, "load": {"force": "1 kN"}}
    oil = {"viscosity": "30 mPa*s", "density": density}
    rest = {"motion": {"speed": "5 m/s"}, "boundary": {"inlet": inlet or {}}, **tables}
    return curve_inputs(read_scene({**entries, "lubricant": oil, **rest}), None, 32).digest


def test_the_size_of_the_load_and_the_speed_are_those_of_the_points():
    assert digest(load={"force": "2 kN"}) == digest() == digest(motion={"speed": "9 m/s"})


@pytest.mark.parametrize("geometry", [LOBES, LOBES | {"pivot": 0.5, "arc": "150 deg"}])
def test_the_direction_of_the_load_counts_for_shafts(geometry):
    assert digest(geometry, load={"force": "1 kN", "angle": "0 deg"}) != digest(geometry)


def test_moments_count_for_pads():
    assert digest(PAD, load={"force": "1 kN", "moment_y": "1 N*m"}) != digest(PAD)


def test_the_density_counts_as_it_determines_flows_and_pressures_and_whether_a_film_is_laminar():
    other = "800 kg/m^3"
    assert digest(density=other) != digest()
    orifice = {"supply": [FED | {"orifice": {"diameter": "0.5 mm"}}]}
    assert digest(density=other, **orifice) != digest(**orifice)
    assert digest(PAD, other, {"ram_factor": 1.0}) != digest(PAD, inlet={"ram_factor": 1.0})
