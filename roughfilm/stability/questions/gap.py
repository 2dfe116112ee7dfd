"""What the models of a rough gap are tried on: near walls, contact, steep ones, flat and tall cells, inertia."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.stability.wave import Wave

GAP = 1e-5
"""m, the mean gap of waves."""

CREEPING = 1e-3
"""Reynolds number where inertia is not asked for."""

NEAREST = (0.5, 0.2, 0.1, 0.05, 0.02, 1e-2, 1e-3, 1e-4)
CUTS = (0.2, 0.1, 0.05, 0.02, 1e-2, 3e-3, 1e-3)
"""Over the mean gap: how near waves come, and below what gap a pressed wall touches."""

AMPLITUDES, BUMP_AMPLITUDES = (0.05, 0.2, 0.5, 0.8), (0.2, 0.5, 0.8)
WAVELENGTHS, BUMP_WAVELENGTHS = (100.0, 10.0, 5.0, 2.5, 1.25, 0.7), (10.0, 5.0, 2.5, 1.25)
PERIODS, LAYERS = (0.5, 1.0, 5.0, 20.0, 100.0, 1000.0), (4, 8, 16, 32, 64)
REYNOLDS_NUMBERS = (1.0, 10.0, 100.0, 300.0, 1000.0, 5000.0, 20000.0)
LAMINAR = 300.0
"""Bumps are solved on the finer mesh up to it: above, steady flow is not found on any, at a great cost."""

PRESSED = (("bumps", "0.3 GPa"), ("bumps", "2 GPa"), ("a rough surface", "2 GPa"))
"""What is pressed, and how hard."""

THIN_LAYERS, THIN_CUTS = (8, 16, 32), (0.1, 1e-2, 1e-3)
"""More layers than usual on the coarser mesh between pressed rough walls, for these smallest gaps."""

NEAR, CUT, THIN, STEEP = "near walls", "contact", "thin cells at contact", "slope"
CELLS, INERTIA = "shape of cells", "inertia"


@dataclass(frozen=True, kw_only=True)
class Probe:
    """One question: where it stands on the page, and a scene in a setting; ``place`` names the scene.

    ``wave`` is None of a pressed wall.
    """

    group: str
    row: str
    column: str
    place: str
    scene: RoughGap
    setting: Setting
    wave: Wave | None = None


def probes(models: Sequence[Model], columns: int) -> Iterator[Probe]:
    """Every probe of these models; the finest mesh has so many columns, of ridges twice as many."""
    by_name = {model.name: model for model in models}

    def settings(*resolved: int) -> list[Setting]:
        plain = [Setting(model=by_name[name]) for name in ("homogenized", "slope_corrected") if name in by_name]
        return plain + [Setting(model=by_name["stokes"], resolution=n) for n in resolved if "stokes" in by_name]

    half, twice = columns // 2, 2 * columns
    for bumps, meshes in ((False, (columns, twice)), (True, (half, columns))):
        kind = "bumps" if bumps else "ridges"
        for setting in settings(*meshes):
            for nearest in NEAREST:
                wave = Wave(amplitude=1 - nearest, wavelength=10.0, bumps=bumps)
                yield _waves(f"{NEAR}: {kind}", setting.name, f"{nearest:g}", wave, setting)
        for setting in settings(*meshes):
            for amplitude in BUMP_AMPLITUDES if bumps else AMPLITUDES:
                for length in BUMP_WAVELENGTHS if bumps else WAVELENGTHS:
                    wave = Wave(amplitude=amplitude, wavelength=length, bumps=bumps)
                    group = f"{STEEP}: {kind}, {setting.name}"
                    yield _waves(group, f"a = {amplitude:g}", f"L = {length:g}", wave, setting)
    yield from _pressed(settings(half, columns))
    for length in PERIODS:
        wave = Wave(amplitude=0.3, wavelength=length)
        for setting in settings(columns):
            for layers in LAYERS if setting.resolution else (LAYERS[0],):
                row = f"{layers} layers" if setting.resolution else setting.name
                yield _waves(CELLS, row, f"L = {length:g}", wave, setting, layers=layers)
    for wave, meshes in (
        (Wave(amplitude=0.3, wavelength=5.0), (columns, twice)),
        (Wave(amplitude=0.6, wavelength=2.5), (columns, twice)),
        (Wave(amplitude=0.5, wavelength=5.0, bumps=True), (half, columns)),
    ):
        yield from _inertia(by_name.get("navier_stokes"), wave, meshes)


def _inertia(model: Model | None, wave: Wave, meshes: tuple[int, int]) -> Iterator[Probe]:
    coarse, fine = meshes
    for resolution, scheme in ((coarse, "linear_upwind"), (fine, "linear_upwind"), (coarse, "upwind")):
        for number in REYNOLDS_NUMBERS:
            if model is None or (wave.bumps and resolution == fine and number > LAMINAR):
                continue
            setting = Setting(model=model, resolution=resolution, scheme=scheme)
            kind = f"{'bumps' if wave.bumps else 'ridges'}, a = {wave.amplitude:g}, L = {wave.wavelength:g}"
            yield _waves(f"{INERTIA}: {kind}", setting.name, f"Re = {number:g}", wave, setting, reynolds_number=number)


def _waves(
    group: str,
    row: str,
    column: str,
    wave: Wave,
    setting: Setting,
    *,
    layers: int | None = None,
    reynolds_number: float = CREEPING,
) -> Probe:
    place = wave.name + (f"-{layers}" if layers else "") + (f"-Re{reynolds_number:g}" * (reynolds_number != CREEPING))
    return Probe(
        group=group,
        row=row,
        column=column,
        place=place,
        scene=wave_scene(wave, layers=layers, reynolds_number=reynolds_number),
        setting=setting,
        wave=wave,
    )


def wave_scene(wave: Wave, *, layers: int | None = None, reynolds_number: float = CREEPING) -> RoughGap:
    """A gap of mean height ``GAP`` over a wave, open everywhere."""
    size, height = f"{wave.wavelength * GAP!r} m", f"{wave.amplitude * GAP!r} m"
    geometry: dict[str, Any] = {"surface": "sinusoid", "amplitude": height, "wavelength": size}
    if wave.bumps:
        geometry = {"surface": _bumps(size, height)}
    mesh: dict[str, Any] = {"smallest_gap": f"{GAP * min(NEAREST) / 10!r} m"}
    return gap_scene(
        geometry={**geometry, "mean_gap": f"{GAP!r} m"},
        flow={"reynolds_number": reynolds_number},
        mesh=mesh | ({"layers": layers} if layers else {}),
    )


def gap_scene(**entries: Any) -> RoughGap:
    """A rough gap with an oil in it; raises InputError for entries that make no sense."""
    given = {"flow": {"reynolds_number": CREEPING}, **entries}
    oil = {"viscosity": "10 mPa*s", "density": "870 kg/m^3"}
    scene = read_scene({"name": "a gap", "kind": "rough_gap", "lubricant": oil, **given})
    assert isinstance(scene, RoughGap)
    return scene


def _bumps(size: str, amplitude: str, points: int = 64) -> dict[str, Any]:
    return {
        "kind": "sinusoid",
        "size": [size, size],
        "points": [points, points],
        "amplitude": amplitude,
        "wavelength_x": size,
        "wavelength_y": size,
    }


def _pressed(settings: Sequence[Setting]) -> Iterator[Probe]:
    """Walls pressed together, that touch where they are nearer than a smallest gap of the mean one."""
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
        pressed = {
            "geometry": {"surface": surfaces[name]},
            "solid": {"modulus": "200 GPa", "poisson": 0.3},
            "load": {"pressure": pressure},
        }
        mean_gap = gap_scene(**pressed).mean_gap
        kind = f"{name}, {pressure}"
        for setting in settings:
            for cut in CUTS:
                yield _cut(f"{CUT}: {kind}", setting.name, cut, pressed, mean_gap, setting)
        coarse = [setting for setting in settings if setting.resolution][:1]
        for setting in coarse if (name, pressure) == PRESSED[-1] else []:
            for layers in THIN_LAYERS:
                for cut in THIN_CUTS:
                    yield _cut(f"{THIN}: {kind}", f"{layers} layers", cut, pressed, mean_gap, setting, layers=layers)


def _cut(
    group: str,
    row: str,
    cut: float,
    pressed: dict[str, Any],
    mean_gap: float,
    setting: Setting,
    *,
    layers: int | None = None,
) -> Probe:
    mesh = {"smallest_gap": f"{cut * mean_gap!r} m"} | ({"layers": layers} if layers else {})
    name = group.partition(": ")[2].replace(",", "").replace(" ", "-")
    return Probe(
        group=group,
        row=row,
        column=f"{cut:g}",
        place=f"pressed-{name}-{cut:g}" + (f"-{layers}" if layers else ""),
        scene=gap_scene(**pressed, mesh=mesh),
        setting=setting,
    )
