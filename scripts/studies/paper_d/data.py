"""Profiles made to Table D.1 of Paper D, pressed at every load, and with their waves cut off one after the other."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import Solid, composite_modulus
from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.contact.synthetic.profile import STEEL_PROFILES, ground_profile
from scripts.studies.study import Advance

STEEL = Solid(modulus=210e9, poisson=0.3, hardness=4e9)
LENGTH = 0.42e-3
POINTS = 512
LOADS = tuple(1e3 * load for load in (2, 5, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100))
"""N per metre of width."""

WAVES = (*range(1, 21), *range(22, 41, 2), 45, 50, 60, 70, 80, 90, 100, 120, 150, 180, 220, 255)
SEEDS = tuple(range(101, 109))
SPECTRA = {"self-affine": 256, "smooth": 32}
"""Highest wave number of each spectrum: the highest on the nodes, or a lower one for smoother profiles."""

ROLL_OFF = LENGTH / 4
"""Roll-off wavelength, m; longer waves have constant height. The plasticity indices are close to those of Fig. D.4."""

REFINEMENT = 8
"""Number of nodes of the finer grid over that of the coarser grid."""

CONTACT_TOLERANCE = 1e-7

State = dict[str, Array]
"""Values by quantity, shape (seeds, loads) or (seeds, waves)."""


MACHINING = {
    "A": "ground, phosphated, dephosphated",
    "B": "ground",
    "C": "ground, chemically deburred",
    "D": "ground, shot-peened",
}


@dataclass(frozen=True, kw_only=True)
class PaperD:
    """All data that are drawn and judged, by spectrum and profile."""

    loads: Sequence[float]
    waves: Sequence[int]
    profiles: dict[tuple[str, str], list[Array]]
    pressed: dict[tuple[str, str], State]
    cut: dict[str, State]
    """Area of profile D at the highest load with waves 1 to n, "elastic" and "elastic-plastic", by spectrum."""
    shown: Contact
    """Contact of the self-affine profile D of the first seed at the highest load."""
    finer: dict[tuple[str, str], State]
    """Quantities of ``pressed`` on ``REFINEMENT`` times as many nodes, at the least and the greatest load."""


def low_pass(heights: Array, waves: int) -> Array:
    """Return the profile without the waves of wave number above ``waves``."""
    modes = np.fft.rfft(heights)
    modes[waves + 1 :] = 0
    return np.fft.irfft(modes, heights.size)


def refined(heights: Array, times: int) -> Array:
    """Return the profile with the same waves on ``times`` as many nodes."""
    return np.fft.irfft(np.fft.rfft(heights), times * heights.size) * times


def line_contacts(heights: Array, loads: Sequence[float], *, hardness: float = STEEL.hardness) -> list[Contact]:
    """Return the contacts of a profile of length ``LENGTH`` under loads in N/m."""
    spacing = LENGTH / heights.size
    press = Press(heights[:, None], (spacing, spacing), composite_modulus(STEEL), hardness=hardness)
    return [press.at(load / LENGTH, tolerance=CONTACT_TOLERANCE) for load in loads]


QUANTITIES: dict[str, Callable[[Contact], float]] = {
    "area": lambda contact: contact.area_fraction_pixel,
    "plasticity_index": lambda contact: contact.plasticity_index,
    "Ra": lambda contact: height_statistics(contact.loaded_heights).average,
    "Rq": lambda contact: height_statistics(contact.loaded_heights).rms,
    "skewness": lambda contact: height_statistics(contact.loaded_heights).skewness,
    "kurtosis": lambda contact: height_statistics(contact.loaded_heights).kurtosis,
    "separation": lambda contact: contact.mean_gap,
}


def press_all(profiles: Sequence[Array], loads: Sequence[float]) -> State:
    """Return every quantity of every profile under every load."""
    state = {name: np.empty((len(profiles), len(loads))) for name in QUANTITIES}
    for i, heights in enumerate(profiles):
        for j, contact in enumerate(line_contacts(heights, loads)):
            for name, of in QUANTITIES.items():
                state[name][i, j] = of(contact)
    return state


def area_by_waves(profiles: Sequence[Array], waves: Sequence[int], load: float) -> State:
    """Return the area fraction under a load, N/m, with waves 1 to n only, elastic and elastic-plastic."""
    state = {name: np.empty((len(profiles), len(waves))) for name in ("elastic", "elastic-plastic")}
    for (i, heights), (j, n) in product(enumerate(profiles), enumerate(waves)):
        for name, hardness in (("elastic", np.inf), ("elastic-plastic", STEEL.hardness)):
            state[name][i, j] = line_contacts(low_pass(heights, n), [load], hardness=hardness)[0].area_fraction_pixel
    return state


def compute(
    advance: Advance,
    *,
    seeds: Sequence[int] = SEEDS,
    loads: Sequence[float] = LOADS,
    waves: Sequence[int] = WAVES,
) -> PaperD:
    """Compute all data of the page; ``advance`` is called 5 times for each spectrum."""
    profiles, pressed, cut, finer = {}, {}, {}, {}
    for spectrum, highest in SPECTRA.items():
        for name, moments in STEEL_PROFILES.items():
            advance(f"pressing profile {name}, {spectrum}")
            made = [
                low_pass(ground_profile(moments, length=LENGTH, points=POINTS, seed=seed, roll_off=ROLL_OFF), highest)
                for seed in seeds
            ]
            profiles[spectrum, name] = made
            pressed[spectrum, name] = press_all(made, loads)
            finer[spectrum, name] = press_all([refined(z, REFINEMENT) for z in made], (loads[0], loads[-1]))
        advance(f"cutting off waves, {spectrum}")
        made = profiles[spectrum, "D"]
        cut[spectrum] = area_by_waves(made, waves, loads[-1])
    return PaperD(
        loads=tuple(loads),
        waves=tuple(waves),
        profiles=profiles,
        pressed=pressed,
        cut=cut,
        shown=line_contacts(profiles["self-affine", "D"][0], loads[-1:])[0],
        finer=finer,
    )
