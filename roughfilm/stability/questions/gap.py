"""Rough gaps that test the models: near walls, contact, steep walls, shapes of mesh cells, and inertia."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.stability.wave import Wave

MEAN_GAP = 1e-5
"""Mean gap over waves, m."""

CREEPING = 1e-3
"""Reynolds number of probes without inertia."""

DISTANCES = (0.5, 0.2, 0.1, 0.05, 0.02, 1e-2, 1e-3, 1e-4)
"""Least distances of a wave from the flat wall, over the mean gap."""

CUTS = (0.2, 0.1, 0.05, 0.02, 1e-2, 3e-3, 1e-3)
"""Smallest open gaps of a pressed wall, over the mean gap; smaller gaps count as contact."""

RIDGE_AMPLITUDES = (0.05, 0.2, 0.5, 0.8)
"""Amplitudes of steep ridges, over the mean gap."""

BUMP_AMPLITUDES = (0.2, 0.5, 0.8)
"""Amplitudes of steep bumps, over the mean gap."""

RIDGE_WAVELENGTHS = (100.0, 10.0, 5.0, 2.5, 1.25, 0.7)
"""Wavelengths of steep ridges, over the mean gap."""

BUMP_WAVELENGTHS = (10.0, 5.0, 2.5, 1.25)
"""Wavelengths of steep bumps, over the mean gap."""

CELL_WAVELENGTHS = (0.5, 1.0, 5.0, 20.0, 100.0, 1000.0)
"""Wavelengths of the probes of the shape of mesh cells, over the mean gap."""

LAYERS = (4, 8, 16, 32, 64)
"""Numbers of layers in the probes of the shape of mesh cells."""

REYNOLDS_NUMBERS = (1.0, 10.0, 100.0, 300.0, 1000.0, 5000.0, 20000.0)
"""Reynolds numbers of probes with inertia."""

MAX_STEADY_REYNOLDS = 300.0
"""Largest Reynolds number of bumps on the finer mesh; no mesh has a steady flow above it, and runs are costly."""

PRESSED = (("bumps", "0.3 GPa"), ("bumps", "2 GPa"), ("a rough surface", "2 GPa"))
"""Names of the pressed surfaces and their loads."""

THIN_LAYERS = (8, 16, 32)
"""Numbers of layers on the coarser mesh between pressed rough walls."""

THIN_CUTS = (0.1, 1e-2, 1e-3)
"""Smallest open gaps, over the mean gap, that are solved with ``THIN_LAYERS``."""

NEAR, CUT, THIN, STEEP = "near walls", "contact", "thin cells at contact", "slope"
CELLS, INERTIA = "shape of cells", "inertia"


@dataclass(frozen=True, kw_only=True)
class GapProbe:
    """One run of a model and its place on the map.

    Attributes
    ----------
    group, row, column : names of the place on the map.
    place : name of the directory of the run.
    scene, setting : scene, and model with its numerical options.
    wave : wall of the gap, None for a pressed wall.
    """

    group: str
    row: str
    column: str
    place: str
    scene: RoughGap
    setting: Setting
    wave: Wave | None = None


def gap_runs(models: Sequence[Model], columns: int) -> Iterator[GapProbe]:
    """All runs of these models; the finest mesh has ``columns`` columns for bumps, and twice as many for ridges."""
    by_name = {model.name: model for model in models}

    def settings(*resolutions: int) -> list[Setting]:
        plain = [Setting(model=by_name[name]) for name in ("homogenized", "slope_corrected") if name in by_name]
        return plain + [Setting(model=by_name["stokes"], resolution=n) for n in resolutions if "stokes" in by_name]

    half, twice = columns // 2, 2 * columns
    steep = {
        False: ((columns, twice), RIDGE_AMPLITUDES, RIDGE_WAVELENGTHS),
        True: ((half, columns), BUMP_AMPLITUDES, BUMP_WAVELENGTHS),
    }
    for bumps, (meshes, amplitudes, wavelengths) in steep.items():
        for setting, distance in product(settings(*meshes), DISTANCES):
            wave = Wave(amplitude=1 - distance, wavelength=10.0, bumps=bumps)
            yield _over_wave(f"{NEAR}: {wave.kind}", setting.name, f"{distance:g}", wave, setting)
        for setting, amplitude, length in product(settings(*meshes), amplitudes, wavelengths):
            wave = Wave(amplitude=amplitude, wavelength=length, bumps=bumps)
            group = f"{STEEP}: {wave.kind}, {setting.name}"
            yield _over_wave(group, f"a = {amplitude:g}", f"L = {length:g}", wave, setting)
    yield from _pressed(settings(half, columns))
    for length, setting in product(CELL_WAVELENGTHS, settings(columns)):
        wave = Wave(amplitude=0.3, wavelength=length)
        for layers in LAYERS if setting.resolution else LAYERS[:1]:
            row = f"{layers} layers" if setting.resolution else setting.name
            yield _over_wave(CELLS, row, f"L = {length:g}", wave, setting, layers=layers)
    if (model := by_name.get("navier_stokes")) is not None:
        yield from _inertia(model, Wave(amplitude=0.3, wavelength=5.0), columns, twice)
        yield from _inertia(model, Wave(amplitude=0.6, wavelength=2.5), columns, twice)
        yield from _inertia(model, Wave(amplitude=0.5, wavelength=5.0, bumps=True), half, columns)


def _inertia(model: Model, wave: Wave, coarse: int, fine: int) -> Iterator[GapProbe]:
    settings = ((coarse, "linear_upwind"), (fine, "linear_upwind"), (coarse, "upwind"))
    for (resolution, scheme), number in product(settings, REYNOLDS_NUMBERS):
        if wave.bumps and resolution == fine and number > MAX_STEADY_REYNOLDS:
            continue
        setting = Setting(model=model, resolution=resolution, scheme=scheme)
        group = f"{INERTIA}: {wave.kind}, a = {wave.amplitude:g}, L = {wave.wavelength:g}"
        yield _over_wave(group, setting.name, f"Re = {number:g}", wave, setting, reynolds_number=number)


def _over_wave(
    group: str,
    row: str,
    column: str,
    wave: Wave,
    setting: Setting,
    *,
    layers: int | None = None,
    reynolds_number: float = CREEPING,
) -> GapProbe:
    place = wave.name + (f"-{layers}" if layers else "") + (f"-Re{reynolds_number:g}" * (reynolds_number != CREEPING))
    scene = wave_scene(wave, layers=layers, reynolds_number=reynolds_number)
    return GapProbe(group=group, row=row, column=column, place=place, scene=scene, setting=setting, wave=wave)


def wave_scene(wave: Wave, *, layers: int | None = None, reynolds_number: float = CREEPING) -> RoughGap:
    """The scene of a gap with the mean height ``MEAN_GAP`` over a wave, which is open everywhere."""
    size, height = f"{wave.wavelength * MEAN_GAP!r} m", f"{wave.amplitude * MEAN_GAP!r} m"
    geometry: dict[str, Any] = {"surface": "sinusoid", "amplitude": height, "wavelength": size}
    if wave.bumps:
        geometry = {"surface": _bumps(size, height)}
    return _scene(
        geometry={**geometry, "mean_gap": f"{MEAN_GAP!r} m"},
        flow={"reynolds_number": reynolds_number},
        mesh=_mesh(min(DISTANCES) / 10 * MEAN_GAP, layers),
    )


def _mesh(smallest_gap: float, layers: int | None) -> dict[str, Any]:
    return {"smallest_gap": f"{smallest_gap!r} m"} | ({"layers": layers} if layers else {})


def _scene(**entries: Any) -> RoughGap:
    given = {"flow": {"reynolds_number": CREEPING}, **entries}
    oil = {"viscosity": "10 mPa*s", "density": "870 kg/m^3"}
    scene = read_scene({"name": "a gap", "kind": "rough_gap", "lubricant": oil, **given})
    assert isinstance(scene, RoughGap)
    return scene


def _bumps(size: str, amplitude: str) -> dict[str, Any]:
    periods = {"wavelength_x": size, "wavelength_y": size}
    return {"kind": "sinusoid", "size": [size, size], "points": [64, 64], "amplitude": amplitude, **periods}


def _pressed(settings: Sequence[Setting]) -> Iterator[GapProbe]:
    """The runs of pressed walls, which count as touching where the gap is below a fraction of the mean gap."""
    size = "100 um"
    surfaces = {
        "bumps": _bumps(size, "1 um"),
        "a rough surface": {
            "kind": "self_affine",
            "size": [size, size],
            "points": [64, 64],
            "seed": 20071,
            "hurst": 0.8,
            "roll_off": "50 um",
            "cut_off": "12 um",
            "rms_height": "1 um",
        },
    }
    for name, pressure in PRESSED:
        entries = {
            "geometry": {"surface": surfaces[name]},
            "solid": {"modulus": "200 GPa", "poisson": 0.3},
            "load": {"pressure": pressure},
        }
        mean_gap = _scene(**entries).mean_gap
        kind = f"{name}, {pressure}"
        trials: list[tuple[str, Setting, float, int | None]] = [
            (f"{CUT}: {kind}", setting, cut, None) for setting, cut in product(settings, CUTS)
        ]
        if (name, pressure) == PRESSED[-1]:
            coarse = [setting for setting in settings if setting.resolution][:1]
            trials += [(f"{THIN}: {kind}", *trial) for trial in product(coarse, THIN_CUTS, THIN_LAYERS)]
        for group, setting, cut, layers in trials:
            place = f"pressed-{kind.replace(',', '').replace(' ', '-')}-{cut:g}" + (f"-{layers}" if layers else "")
            yield GapProbe(
                group=group,
                row=f"{layers} layers" if layers else setting.name,
                column=f"{cut:g}",
                place=place,
                scene=_scene(**entries, mesh=_mesh(cut * mean_gap, layers)),
                setting=setting,
            )
