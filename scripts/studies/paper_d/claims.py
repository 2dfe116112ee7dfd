"""Judgement of the claims of Paper D on dry contact, by pressed profiles."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.synthetic.profile import STEEL_PROFILES
from scripts.studies.paper_d.data import LENGTH, SPECTRA, STEEL, PaperD
from scripts.studies.study import Claim, Judgement, claims_of, verdict

MIN_CONTACT_NODES = 4
"""Least mean number of nodes in contact at the loads that are fitted."""


def judge(paper: PaperD) -> list[Claim]:
    """Judge claims 15 to 18."""
    judges = {15: area_grows, 16: area_by_roughness, 17: plasticity, 18: highest_waves}
    return claims_of(__file__, {number: judge_one(paper) for number, judge_one in judges.items()})


def power_of(x: Array, y: Array) -> float:
    """Return the exponent of the power law through points, by least squares."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def straightness(x: Array, y: Array) -> float:
    """Return R² of the line through the origin that fits the points by least squares."""
    line = x * float(x @ y) / float(x @ x)
    return 1 - float(((y - line) ** 2).sum() / ((y - y.mean()) ** 2).sum())


def settled(waves: Array, area: Array, part: float) -> int:
    """Return the least number of waves from which on the area stays within the fraction ``part`` of its last value."""
    outside = np.flatnonzero(np.abs(area / area[-1] - 1) > part)
    return int(waves[outside[-1] + 1]) if outside.size else int(waves[0])


def _in_words(values: dict[str, float], form: str) -> str:
    return ", ".join(f"{name} {value:{form}}" for name, value in values.items())


def area_grows(paper: PaperD) -> Judgement:
    """Judge claim 15."""
    loads, powers, fits = np.array(paper.loads), {}, {}
    for (spectrum, name), state in paper.pressed.items():
        area = state["area"].mean(axis=0)
        used = area * paper.profiles[spectrum, name][0].size >= MIN_CONTACT_NODES
        key = f"{name} {spectrum}"
        powers[key] = power_of(loads[used], area[used])
        fits[key] = straightness(loads[used], area[used])
    worst = max(abs(power - 1) for power in powers.values())
    straight = min(fits.values())
    return (
        verdict(worst <= 0.1 and straight >= 0.99, partly=worst <= 0.25),
        f"exponents {_in_words(powers, '.2f')}; R² of the line through the origin at least {straight:.3f} "
        f"(loads at which {MIN_CONTACT_NODES} nodes or more are in contact on average)",
    )


def area_by_roughness(paper: PaperD) -> Judgement:
    """Judge claim 16."""
    rough = np.array([row.average for row in STEEL_PROFILES.values()])
    bound = paper.loads[-1] / LENGTH / STEEL.hardness
    powers, ratios, said = {}, {}, []
    for spectrum in SPECTRA:
        areas = np.array([paper.pressed[spectrum, name]["area"][:, -1].mean() for name in STEEL_PROFILES])
        powers[spectrum], ratios[spectrum] = power_of(rough, areas), float(areas.max() / areas.min())
        said.append(
            f"{spectrum}: {', '.join(f'{n} {100 * a:.1f} %' for n, a in zip(STEEL_PROFILES, areas, strict=True))}"
        )
    worst = max(ratios.values())
    return (
        verdict(worst <= 1.2, partly=max(abs(p) for p in powers.values()) <= 0.5),
        f"at the highest load {'; '.join(said)}; the greatest is {_in_words(ratios, '.2f')} times the least "
        f"while Ra spans {rough.max() / rough.min():.1f}, A ~ Ra^n with n: {_in_words(powers, '.2f')}; this must "
        f"be so where most contact is plastic, because no surface can have less than W/H = {100 * bound:.1f} %",
    )


def plasticity(paper: PaperD) -> Judgement:
    """Judge claim 17."""
    rough = [row.average for row in STEEL_PROFILES.values()]
    said, ranked, starts = [], [], []
    for spectrum in SPECTRA:
        index = {
            name: float(paper.pressed[spectrum, name]["plasticity_index"][:, -1].mean()) for name in STEEL_PROFILES
        }
        light = {name: float(paper.pressed[spectrum, name]["plasticity_index"][:, 0].mean()) for name in STEEL_PROFILES}
        finer = {name: float(paper.finer[spectrum, name]["plasticity_index"][:, 0].mean()) for name in STEEL_PROFILES}
        ranked.append(bool((np.argsort(list(index.values())) == np.argsort(rough)).all()))
        starts += list(finer.values())
        said.append(
            f"{spectrum}: {_in_words(index, '.2f')} at the highest load; {_in_words(light, '.2f')} at the least load, "
            f"which one or two nodes carry; {_in_words(finer, '.2f')} at that load on a finer grid"
        )
    spread = min(
        paper.pressed[spectrum, "A"]["plasticity_index"][:, -1].mean()
        / paper.pressed[spectrum, "C"]["plasticity_index"][:, -1].mean()
        for spectrum in SPECTRA
    )
    strong, always = all(ranked) and spread > 1.5, min(starts) > 0.01
    return (
        verdict(strong and always, partly=strong or always),
        "; ".join(said),
    )


def highest_waves(paper: PaperD) -> Judgement:
    """Judge claim 18."""
    waves, said, kept = np.array(paper.waves), [], []
    for spectrum, state in paper.cut.items():
        for name, areas in state.items():
            mean = areas.mean(axis=0)
            fives = [settled(waves, area, 0.05) for area in areas]
            n1, n5 = settled(waves, mean, 0.01), settled(waves, mean, 0.05)
            kept.append(n5 <= waves[-1] / 2)
            said.append(
                f"{spectrum}, {name}: within 5 % from n = {n5} on, within 1 % from {n1} on "
                f"(single profiles 5 %: {min(fives)} to {max(fives)})"
            )
    return (
        verdict(all(kept), partly=any(kept)),
        f"mean area of profile D at the highest load, of {waves[-1]} waves: "
        + "; ".join(said)
        + f"; the smooth profiles have no waves beyond {SPECTRA['smooth']}",
    )
