"""A dry contact, and a bearing whose asperities are known in closed form, that tests of scenes and rungs share."""

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.store import save_table
from roughfilm.rom.ladder.scene import read_scene

ROUGH = {
    "kind": "self_affine",
    "size": ["100 um", "100 um"],
    "points": [64, 64],
    "seed": 20071,
    "hurst": 0.8,
    "roll_off": "25 um",
    "cut_off": "12.5 um",
    "rms_slope": 0.1,
}


@pytest.fixture
def make_contact():
    """A dry contact from its surface (a description or a file), E*, P and H, Pa; the body is rigid but for E*."""

    def make(
        surface: object = ROUGH,
        *,
        modulus: float = 1e11,
        pressure: float = 1e8,
        hardness: float | None = None,
        **geometry: Any,
    ) -> DryContact:
        surface = str(surface) if isinstance(surface, Path) else surface
        solid = {"modulus": f"{modulus!r} Pa", "poisson": 0.0}
        if hardness is not None:
            solid["hardness"] = f"{hardness!r} Pa"
        scene = read_scene(
            {
                "name": "test",
                "kind": "dry_contact",
                "geometry": {"surface": surface, **geometry},
                "solid": solid,
                "load": {"pressure": f"{pressure!r} Pa"},
            }
        )
        assert isinstance(scene, DryContact)
        return scene

    return make


@pytest.fixture
def tips(tmp_path):
    """Scenes of tips that do nothing to a film, p_c = P0 (1 - α/T)^1.5, which a table interpolates exactly."""
    touching, stiffness, closest, friction = 2e-6, 50e6, 0.2e-6, 0.1

    def pressure(separation: object) -> np.ndarray:
        return stiffness * np.clip(1 - np.asarray(separation) / touching, 0, None) ** 1.5

    def point(h: float, **factors: Any) -> Point:
        load = float(pressure(h))
        smooth = {"pressure": h**3 * np.eye(2), "shear": np.array([h, 0.0]), "couette": 1 / h, "shear_couette": 0.0}
        exact = FlowFactors(mean_gap=0.0, pressure=np.zeros((2, 2)), shear=np.zeros(2), couette=0.0, shear_couette=0.0)
        return Point(
            separation=h,
            contact=load / 1e9,
            factors=FlowFactors(mean_gap=h, **(smooth | factors)),
            uncertainty=exact,
            unsolved=0.0,
            iterations=1,
            residual=0.0,
            cpu_s=0.0,
            load=load,
            area_fraction=load / 1e9,
        )

    def table(*, peak: float = math.nan, **last: Any) -> AsperityTable:
        """``peak`` is the largest pressure of the spots, Pa, and ``last`` are factors of the closest point."""
        pressed = [point(touching - g) for g in np.geomspace(touching - closest, 0.01 * touching, 7)[1:]]
        points = (point(closest, **last), *pressed, *(point(h) for h in (touching, 4e-6, 50e-6)))
        points = tuple(replace(one, peak_pressure=peak) if one.load else one for one in points)
        return AsperityTable(factors=FactorTable(points=points, peak=touching, rms=1e-6))

    def scene(geometry: dict[str, Any], *, path: Path = tmp_path / "table.h5", **more: Any) -> Bearing:
        if not path.exists():
            stored(path)
        found = read_scene(
            {
                "name": "mixed",
                "kind": "bearing",
                "geometry": geometry,
                "lubricant": {"viscosity": "0.1 Pa*s"},
                "motion": {"speed": "0.1 m/s"},
                "roughness": {"kind": "table", "table": str(path)},
                "asperities": {"friction": friction},
                **more,
            }
        )
        assert isinstance(found, Bearing)
        return found

    def stored(path: Path, *, modulus: float | None = None, **last: Any) -> Path:
        settings = {"code": "closed form", "composite_modulus": modulus}
        inputs = Inputs(heights=np.eye(2), spacing=(1e-6, 1e-6), settings=settings)
        save_table(path, inputs, table(**last).factors)
        return path

    return SimpleNamespace(
        touching=touching,
        stiffness=stiffness,
        closest=closest,
        friction=friction,
        pressure=pressure,
        table=table,
        stored=stored,
        scene=scene,
    )
