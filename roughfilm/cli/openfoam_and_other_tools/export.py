"""roughfilm export: a gap, a surface or a result as a mesh that other tools read."""

from pathlib import Path
from typing import Annotated, Any

import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import as_input
from roughfilm.contact.meshes.files import KINDS, mesh_format, write_mesh
from roughfilm.contact.meshes.mesh import CellType, Mesh
from roughfilm.contact.meshes.surface import surface_mesh
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.plausibility import implausible
from roughfilm.contact.surfaces.store import is_surface
from roughfilm.contact.synthetic.description import make, read_description
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import kind_named, load_entries, load_scene, scene_entries
from roughfilm.rom.ladder.store import load
from roughfilm.rom.meshes.result_mesh import PLACES, labelled, result_mesh
from roughfilm.rom.meshes.walls_mesh import GapPart, gap_mesh, wall_mesh
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls
from roughfilm.terminal.console import OUTPUT, AsJson, Overrides, Overwrite, print_json, print_message
from roughfilm.terminal.output_file import refuse_same, refuse_unwritable
from roughfilm.terminal.results import print_all, written

EXAMPLES = (
    "roughfilm export scripts/examples/scenes/random_gap.toml --out gap.vtu",
    "roughfilm export scripts/examples/surfaces/milled.toml --out milled.stl",
)

RESOLUTION, LAYERS = 64, 8
MAX_CELLS = 20_000_000
CONTENT = {CellType.LINE: ("length", "m"), CellType.HEXAHEDRON: ("volume", "m^3")}


def command(
    file: Annotated[
        Path,
        typer.Argument(metavar="FILE", help="A scene of a rough gap, a surface, or a stored result."),
    ],
    out: Annotated[Path, typer.Option(help="Write the mesh here: .vtu, .stl or .msh (Gmsh).", rich_help_panel=OUTPUT)],
    what: Annotated[GapPart | None, typer.Option(help="Part of a rough gap: the liquid (default), or a wall.")] = None,
    resolution: Annotated[int | None, typer.Option(help="Columns along the longer side of a rough gap.")] = None,
    layers: Annotated[int | None, typer.Option(help="Layers of cells between the walls of a rough gap.")] = None,
    spacing: Annotated[
        str | None, typer.Option(help="Distance between the points of a surface whose file does not hold it: 1um.")
    ] = None,
    overwrite: Overwrite = False,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Write a gap, a surface or a result as a mesh for other tools: lengths in metres, data named with their units."""
    refuse_same({"FILE": as_input(file), "--out": out})
    refuse_unwritable((out, KINDS[mesh_format(out)]), overwrite=overwrite)
    mesh, origin = _mesh(file, what, resolution, layers, _metres(spacing), set_)
    mesh_out = write_mesh(mesh, out, overwrite=overwrite)
    name, unit = CONTENT.get(mesh_out.cell_type, ("area", "m^2"))
    origin["left_out"] = sorted({*origin["left_out"], *_data(mesh)} - set(_data(mesh_out)))
    if as_json:
        print_json(
            {
                "quantities": {name: {"value": mesh_out.content, "unit": unit}},
                "numerics": {
                    "cells": len(mesh_out.cells),
                    "points": len(mesh_out.points),
                    "sort": str(mesh_out.cell_type),
                },
                "provenance": {
                    "file": str(file),
                    "out": str(out),
                    "data": _data(mesh_out),
                    **origin,
                    **circumstances(),
                },
            }
        )
        return
    print_all(f"data: {known}" for known in _data(mesh_out))
    if origin["left_out"]:
        print_message("left out", ", ".join(origin["left_out"]))
    content = f"{len(mesh_out.cells)} cells ({mesh_out.cell_type}), {name} {mesh_out.content:.6g} {unit}"
    print_all([written(content, out)])


def _mesh(
    file: Path,
    what: GapPart | None,
    resolution: int | None,
    layers: int | None,
    spacing: float | None,
    set_: list[str] | None,
) -> tuple[Mesh, dict[str, Any]]:
    """The mesh of a file of any sort, and its origin for the provenance."""
    for_gaps = {"--what": what, "--resolution": resolution, "--layers": layers}
    if file.suffix.lower() == ".toml" and kind_named(load_entries(file)) is not None:
        return _of_scene(file, what or GapPart.GAP, resolution, layers, set_)
    for option, given in {**for_gaps, "--set": set_}.items():
        if given:
            raise InputError(f"{option}: got {given}, but {file} is not a scene of a rough gap; leave it out")
    if file.suffix.lower() == ".toml":
        return surface_mesh(make(read_description(file))), {"left_out": []}
    if file.suffix.lower() in (".h5", ".hdf5") and not (file.is_file() and is_surface(file)):
        result = load(file)
        mesh = result_mesh(result)
        names = [labelled(name, field) for name, field in result.fields.items() if name not in PLACES]
        left_out = sorted(set(names) - set(_data(mesh)))
        return mesh, {"model": result.model, "scene": result.provenance.get("scene"), "left_out": left_out}
    if spacing is None and file.suffix.lower() == ".npy" and file.is_file() and not is_surface(file):
        raise InputError(f"{file}: does not hold the distance of its points; give it by --spacing 1um")
    surface = read_surface(file, spacing=None if spacing is None else (spacing, spacing))
    for sentence in implausible(surface, file):
        print_message("warning", sentence)
    return surface_mesh(surface), {"surface": dict(surface.source), "left_out": []}


def _metres(spacing: str | None) -> float | None:
    try:
        return None if spacing is None else to_si(spacing, "m")
    except ValueError as error:
        raise InputError(f"--spacing: {error}") from None


def _of_scene(
    file: Path, part: GapPart, resolution: int | None, layers: int | None, set_: list[str] | None
) -> tuple[Mesh, dict[str, Any]]:
    scene = load_scene(file, set_ or ())
    if not isinstance(scene, RoughGap):
        raise InputError(f"{file}: got a scene of kind {scene.kind!r}; solve it with --out and export the result")
    if layers is not None and part is not GapPart.GAP:
        raise InputError(f"--layers: got {layers}, but a wall has none; leave it out")
    layers = (scene.layers or LAYERS) if layers is None else layers
    own = max(scene.surface().shape)
    resolution = min(own, RESOLUTION) if resolution is None else resolution
    if not 2 <= resolution <= own:
        raise InputError(
            f"--resolution: got {resolution}; the surface has {own} points along its longer side, take 2 to {own}"
        )
    if layers < 1 or resolution**2 * layers > MAX_CELLS:
        raise InputError(f"--layers: got {layers}; take 1 or more, and at most {MAX_CELLS} cells in all")
    walls = scene.walls(resolution)
    mesh = gap_mesh(walls, layers) if part is GapPart.GAP else wall_mesh(walls, part)
    return mesh, {"what": str(part), "walls": _wall_entries(walls), "scene": scene_entries(scene), "left_out": []}


def _wall_entries(walls: Walls) -> dict[str, Any]:
    nx, ny = walls.gap.shape
    return {"nodes": [nx, ny], "spacing": list(walls.spacing), "mean_gap": walls.mean_gap}


def _data(mesh: Mesh) -> list[str]:
    return sorted({*mesh.point_data, *mesh.cell_data})
