"""The chart families, each with its scene, quantity, reference and peers."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from roughfilm.charts.cells import flow_factors_family
from roughfilm.charts.family import ChartFamily, ReferenceValue, extrapolated, of_scene, solved
from roughfilm.charts.openfoam import on_pocket
from roughfilm.charts.peer_runs import contact_peers, gapflow
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.exact import exact
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, find
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.seal.scene import Seal

SomeScene = TypeVar("SomeScene", bound=Scene)

SEED = 20071
"""Seed of the rough surfaces."""

OIL = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
STEEL = {"modulus": "210 GPa", "poisson": 0.3}


def self_affine(size: str, points: int, roll_off: str, cut_off: str, **height: Any) -> dict[str, Any]:
    """The scene entries of an isotropic rough surface whose shape does not depend on the number of points.

    ``height`` is its rms height or its rms slope.
    """
    return {
        "kind": "self_affine",
        "size": [size, size],
        "points": [points, points],
        "seed": SEED,
        "hurst": 0.8,
        "roll_off": roll_off,
        "cut_off": cut_off,
        **height,
    }


def pocket(models: Sequence[Model]) -> ChartFamily:
    """The chart family of the groove of Sahlin et al. 2005, doi:10.1115/1.1828067, at Re = 160."""
    scene = _read(
        Pocket,
        kind="pocket",
        name="pocket",
        geometry={"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "7.5 um"},
        lubricant=OIL,
        motion={"reynolds_number": 160},
    )
    best = find(models, "pocket", "navier_stokes")
    return of_scene(
        models,
        scene,
        name="pocket",
        work="Load of a film over a cylindrical groove, w+ = 0.3, d+ = 0.25, Re = 160 (doi:10.1115/1.1828067).",
        quantity="load F_y+",
        unit="1",
        key="load_plus",
        truth=lambda: extrapolated(
            lambda columns: solved(best, scene, columns, "load_plus"), (180, 360, 720), "Navier–Stokes"
        ),
        truth_cost=50.0,
        resolution_meaning="Gauss points on a piece, cells, or mesh columns along the film",
        peers=(on_pocket(scene, {30: 1.0, 60: 1.5, 120: 3.0, 240: 8.0}),),
    )


def slider(models: Sequence[Model]) -> ChartFamily:
    """The chart family of the parabolic slider of Vijayaraghavan and Keith 1989."""
    scene = _read(
        Bearing,
        kind="bearing",
        name="parabolic slider",
        geometry={"shape": "parabolic", "length": "76.2 mm", "film": "25.4 um", "rise": "25.4 um"},
        lubricant={
            "viscosity": "0.039 Pa*s",
            "cavitation_pressure": "0 Pa",
            "compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "0.069 GPa"},
        },
        motion={"speed": "4.57 m/s"},
        boundary={"inlet": {"theta": 1}},
    )

    def truth() -> ReferenceValue:
        words = "exact: the one film integrated as an ordinary differential equation (rom/cavitation/exact.py)"
        return ReferenceValue(value=exact(scene.problem()).load, uncertainty=1e-10, source=words)

    return of_scene(
        models,
        scene,
        name="cavitating slider",
        work="Load of the infinitely wide parabolic slider of Vijayaraghavan and Keith (1989) in a liquid of constant "
        "bulk modulus, which ruptures downstream of the narrowest place.",
        quantity="load per width",
        unit="N/m",
        key="load_per_width",
        truth=truth,
        truth_cost=1.0,
        resolution_meaning="cells along the sliding",
        peers=(gapflow(scene, {50: 25.0, 100: 55.0, 200: 50.0}),),
    )


def rough_gap(models: Sequence[Model]) -> ChartFamily:
    """The chart family of creeping flow across steep ridges."""
    amplitude, wavelength = 0.3, 5.0
    scene = _read(
        RoughGap,
        kind="rough_gap",
        name="wavy gap",
        geometry={"surface": "sinusoid", "amplitude": "3 um", "wavelength": "50 um", "mean_gap": "10 um"},
        lubricant=OIL,
        flow={"reynolds_number": 1e-3},
    )

    def truth() -> ReferenceValue:
        tolerance = 1e-6
        flow = sinusoidal_ridge_flow(amplitude, wavelength, tolerance=tolerance)
        words = "exact Stokes flow by Ritz's method in polynomials (rom/rough_gap/flow/exact.py)"
        return ReferenceValue(value=flow.across, uncertainty=tolerance, source=words)

    return of_scene(
        models,
        scene,
        name="rough gap",
        work="Creeping flow across sinusoidal ridges, amplitude 0.3 and wavelength 5 mean gaps (rms slope 0.27), over "
        "that through a smooth gap.",
        quantity="flow A11",
        unit="1",
        key="A11",
        truth=truth,
        truth_cost=2.0,
        resolution_meaning="points, or mesh columns, along a wave",
    )


def dry_contact(models: Sequence[Model]) -> ChartFamily:
    """The chart family of a rough elastic half-space with a tenth of its area in contact."""

    def scene(points: int) -> DryContact:
        return _read(
            DryContact,
            kind="dry_contact",
            name="rough contact",
            geometry={"surface": self_affine("100 um", points, "25 um", "6.25 um", rms_slope=0.1)},
            solid=STEEL,
            counter=STEEL,
            load={"pressure": "500 MPa"},
        )

    charted = scene(512)
    elastic = find(models, "dry_contact", "elastic")
    fast, slow = ({n: cost * (n / 512) ** 2 + 0.5 for n in (64, 128, 256, 512)} for cost in (4.0, 60.0))
    return of_scene(
        models,
        charted,
        name="dry contact",
        work="Mean gap of a self-affine rough elastic surface (Hurst 0.8, rms slope 0.1, waves of 6.25 to 25 µm and "
        "longer on 100 µm) pressed at 500 MPa to about a tenth of contact.",
        quantity="mean gap",
        unit="m",
        key="mean_gap",
        truth=lambda: extrapolated(
            lambda points: solved(elastic, scene(points), points, "mean_gap"), (1024, 2048), "the surface pressed"
        ),
        truth_cost=6.0,
        resolution_meaning="points along a side",
        peers=contact_peers(charted, {"run_aspher": fast, "run_tamaas": slow, "run_contact_mechanics": slow}),
    )


def mixed_bearing(models: Sequence[Model]) -> ChartFamily:
    """The chart family of a rough pad in mixed lubrication."""
    scene = _read(
        Bearing,
        kind="bearing",
        name="rough pad",
        geometry={"shape": "parabolic", "length": "20 mm", "width": "20 mm", "film": "0.8 um", "rise": "2 um"},
        lubricant={"viscosity": "0.1 Pa*s"},
        motion={"speed": "1 m/s"},
        roughness={
            "kind": "surface",
            "surface": self_affine("0.5 mm", 128, "125 um", "31.25 um", rms_height="0.5 um"),
        },
        asperities={"friction": 0.1, "solid": {**STEEL, "hardness": "4 GPa"}},
    )
    best = find(models, "bearing", "mixed")
    return of_scene(
        models,
        scene,
        name="mixed bearing",
        work="Load per width of a parabolic pad, 20 mm × 20 mm, whose mean planes (rms height 0.5 µm) are 0.8 µm apart "
        "where they are nearest; asperities carry a sixth of it. Tables of flow factors and of contact are made once, "
        "before the clock starts.",
        quantity="load per width",
        unit="N/m",
        key="load_per_width",
        truth=lambda: extrapolated(
            lambda cells: solved(best, scene, cells, "load_per_width"), (512, 1024), "the mixed model, from one table,"
        ),
        truth_cost=60.0,
        resolution_meaning="cells along a side, or along the sliding",
    )


def seal(models: Sequence[Model]) -> ChartFamily:
    """The chart family of an elastomer seal on steel."""

    def scene(points: int) -> Seal:
        return _read(
            Seal,
            kind="seal",
            name="elastomer seal",
            geometry={"surface": self_affine("42 um", points, "10.5 um", "2.625 um", rms_height="0.125 um")},
            solid={"modulus": "10 MPa", "poisson": 0.5},
            counter=STEEL,
            load={"pressure": "0.1 MPa"},
            liquid={"density": "1000 kg/m^3", "viscosity": "1 mPa*s"},
            flow={"pressure_drop": "1 MPa", "length": "0.5 mm", "direction": "x"},
        )

    best = find(models, "seal", "direct_leakage")
    return of_scene(
        models,
        scene(256),
        name="seal",
        work="Leakage of water past an elastomer (rms height 0.125 µm) that 0.1 MPa press on steel, through 12 periods "
        "of its surface.",
        quantity="leakage per width",
        unit="kg/(m*s)",
        key="leakage_per_width",
        truth=lambda: extrapolated(
            lambda points: solved(best, scene(points), points, "leakage_per_width"), (320, 448, 576), "all periods"
        ),
        truth_cost=10.0,
        resolution_meaning="points along a side of the period",
    )


def _read(of: type[SomeScene], **entries: Any) -> SomeScene:
    scene = read_scene(entries)
    assert isinstance(scene, of)
    return scene


FAMILIES: Mapping[str, Callable[[Sequence[Model]], ChartFamily]] = {
    "pocket": pocket,
    "cavitating slider": slider,
    "rough gap": rough_gap,
    "dry contact": dry_contact,
    "flow factors": lambda _models: flow_factors_family(),
    "mixed bearing": mixed_bearing,
    "seal": seal,
}
"""Functions that make the families, by name, in the order of the page."""
