"""Where each model of a pocket with each scheme converges, over Reynolds number and depth."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.table import Table

from foamcases.residuals import PATIENCE
from foamcases.tries import RECIPE
from rom.ladder import of_kind
from rom.pocket import Pocket
from rom.provenance import code, commit, machine, versions
from rom.scene import load_scene
from rom.setting import Setting
from rom.validity import TURBULENT
from scripts.common import models
from scripts.runs import Job
from scripts.stability_made import Made
from scripts.stability_map import MEANING, Map, State, columns, in_words, spot_of
from scripts.stability_runs import answers_to

KIND = "pocket"
RUNS = "runs"


@dataclass(frozen=True, kw_only=True)
class Family:
    """A scene file, and the Reynolds numbers and depths (in film thicknesses) that it is varied to."""

    scene: Path
    reynolds_numbers: tuple[float, ...]
    depths_plus: tuple[float, ...]
    resolution: int = 120
    resolution_meaning: str = "mesh columns of the OpenFOAM models"

    @property
    def places(self) -> tuple[tuple[float, float], ...]:
        """Every Reynolds number with every depth."""
        return tuple((number, depth) for number in self.reynolds_numbers for depth in self.depths_plus)

    def at(self, reynolds_number: float, depth_plus: float) -> Pocket:
        """The scene at a place of the map."""
        depth = depth_plus * _pocket(self.scene).geometry.film
        return _pocket(self.scene, f"motion.reynolds_number={reynolds_number!r}", f"geometry.depth={depth!r} m")

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Made:
        """Solve what is not in ``out`` already, and put all of it together."""
        ladder = of_kind(models(), KIND)
        absent = {model.name: found.detail for model in ladder if not (found := model.available()).available}
        settings = [
            Setting(model=model, resolution=resolution if model.write else None, scheme=scheme)
            for model in ladder
            if model.name not in absent
            for scheme in model.schemes or (None,)
        ]
        maps = _maps(self, settings, out / RUNS, processes, scratch)
        return Made(
            entries=_entries(resolution, maps, absent),
            columns=columns(maps),
            table=_table_of(maps),
            template="stability.html.j2",
            page=_shown(self, maps),
            absent=absent,
        )


def _maps(family: Family, settings: Sequence[Setting], place: Path, processes: int, scratch: Path) -> list[Map]:
    """Solve what is not on disk, store each answer as it comes, and put all of them together."""
    scenes = {at: family.at(*at) for at in family.places}
    jobs = {
        (setting.name, at): Job(
            scene=scene, setting=setting, path=place / f"Re{at[0]:g}-d{at[1]:g}" / f"{setting.name}.h5"
        )
        for setting in settings
        for at, scene in scenes.items()
    }
    answers = answers_to(list(jobs.values()), processes, scratch)
    return [
        Map(
            setting=setting,
            spots=tuple(spot_of(*at, answers[jobs[setting.name, at].path]) for at in family.places),
        )
        for setting in settings
    ]


def _entries(resolution: int, maps: Sequence[Map], absent: dict[str, str]) -> dict[str, Any]:
    return {
        "family": KIND,
        "resolution": resolution,
        "maps": [
            {
                "model": map_.setting.model.name,
                "scheme": map_.setting.scheme or "",
                "counts": {state.value: map_.count(state) for state in State},
                "cpu_s": map_.cpu_s,
                "in_words": in_words(map_, maps),
                "runs": [asdict(spot) for spot in map_.spots],
            }
            for map_ in maps
        ],
        "absent": absent,
        "provenance": {"machine": machine(), "code": code(), "commit": commit(), "versions": versions()},
    }


def _shown(family: Family, maps: Sequence[Map]) -> dict[str, Any]:
    return {
        "family": family,
        "scene": _pocket(family.scene),
        "maps": maps,
        "told": [in_words(map_, maps) for map_ in maps],
        "states": [(state, MEANING[state], sum(map_.count(state) for map_ in maps)) for state in State],
        "recipe": RECIPE,
        "patience": PATIENCE,
        "turbulent": TURBULENT,
    }


def _pocket(path: Path, *overrides: str) -> Pocket:
    scene = load_scene(path, overrides)
    assert isinstance(scene, Pocket)
    return scene


def _table_of(maps: Sequence[Map]) -> Table:
    states = [state for state in State if any(map_.count(state) for map_ in maps)]
    table = Table("model", "scheme", *(state.value for state in states), "CPU s")
    for map_ in maps:
        counts = (str(map_.count(state)) for state in states)
        table.add_row(map_.setting.model.name, map_.setting.scheme or "-", *counts, f"{map_.cpu_s:.3g}")
    return table


POCKET = Family(
    scene=Path(__file__).parent / "scenes" / "pocket.toml",
    reynolds_numbers=(40.0, 160.0, 500.0, 1000.0, 2000.0, 5000.0),
    depths_plus=(0.25, 0.5, 0.75, 1.25, 2.0, 3.0),
)
