"""The answers of a sweep in words: quantities with their unit, the best case, and what is missing."""

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.ladder.kind import Kind
from roughfilm.rom.studies.answers import Answer, Optimum, Sense, base_of
from roughfilm.rom.studies.parameters import Parameter
from roughfilm.words.numbers import share, with_error
from roughfilm.words.scales import Scale

CASES_NAMED = 3
"""Cases that a sentence names; the others are counted."""


def title_of(kind: Kind, quantity: str) -> str:
    """The name of a quantity in a sentence."""
    if quantity in kind.titles:
        return kind.titles[quantity] + (" (dimensionless)" if quantity.endswith("_plus") else "")
    base = next((title for name, title in kind.titles.items() if base_of(name) == base_of(quantity)), None)
    ending = quantity.removeprefix(base_of(quantity)).replace("_", " ")
    return quantity.replace("_", " ") if base is None else f"{base}{ending}"


def place_of(parameters: Sequence[Parameter], case: int) -> str:
    """The values of a case: "depth = 7.5 um, profile = splined"."""
    return ", ".join(f"{one.name} = {one.text(case)}" for one in parameters)


def best_sentence(answer: Answer, title: str, scale: Scale, parameters: Sequence[Parameter]) -> str:
    """The sentence with the best case, or with both ends where it is not clear which one is best.

    "Largest load: 12.3 ± 0.1 N/m at depth = 7.5 um (case 4 of 10), by film_slope"
    """
    total = answer.values.size

    def at(case: int) -> str:
        number = scale.text(answer.values[case], answer.uncertainty[case])
        if answer.uncertainty[case] > abs(answer.values[case]):
            number = f"{scale.text(answer.values[case])} with an error above 100 %"
        unknown = "" if np.isfinite(answer.uncertainty[case]) else ", uncertainty unknown"
        where = place_of(parameters, case)
        return f"{number}{unknown}{f' at {where}' if where else ''} (case {case + 1} of {total})"

    if len(answer.order) == 1:
        ranked = "that is ranked, " if np.isfinite(answer.values).sum() > 1 else ""
        return f"{_upper(title)}: {at(answer.best)}, the only case {ranked}by {answer.setting}"
    if answer.sense is Sense.UNCLEAR:
        return f"{_upper(title)}: largest {at(answer.best)}, smallest {at(answer.worst)}, by {answer.setting}"
    return f"{_upper(answer.sense)} {title}: {at(answer.best)}, by {answer.setting}"


def decision_sentence(answer: Answer, scale: Scale) -> str:
    """The sentence on whether the best two cases differ by more than their uncertainties; empty for one case."""
    if answer.decided is None and len(answer.order) < 2:
        return ""
    first, second = answer.order[:2]
    gap = scale.text(abs(answer.values[first] - answer.values[second]))
    end = "largest" if answer.sense is Sense.UNCLEAR else "best"
    if answer.decided is None:
        reason = "an uncertainty is unknown, so that it is not known whether they differ"
    elif answer.decided:
        reason = "this is more than their uncertainties"
    else:
        reason = "this is less than their uncertainties, so that either may be the best"
    return f"The {end} two cases, {first + 1} and {second + 1}, differ by {gap}; {reason}."


def optimum_sentence(found: Optimum, along: Parameter, answer: Answer, title: str, scale: Scale) -> str:
    """The sentence on the optimum between the cases."""
    place = with_error(found.place, found.place_uncertainty)
    value = scale.text(found.value, found.value_uncertainty)
    how = "logarithm of the parameter" if along.logarithmic else "parameter"
    return (
        f"Between the cases the {answer.sense} {title} is expected at {along.name} = {place} {along.unit}".rstrip()
        + f", with {value} (parabola over the {how} through three cases)."
    )


def unranked_sentence(answer: Answer, reason: str) -> str:
    """The sentence on cases that are left out of the order; empty if there are none.

    ``reason`` is the first warning of the first of these cases; it may be empty.
    """
    if not answer.unranked:
        return ""
    count = len(answer.unranked)
    numbers = ", ".join(str(case + 1) for case in answer.unranked[:CASES_NAMED])
    which = f" ({numbers}{', ...' if count > CASES_NAMED else ''})"
    why = f": {reason.rstrip('.')}" if reason else ""
    return f"Not ranked, as their error is above 100 %: {_cases(count)}{which}{why}."


def edited_sentences(edited: Mapping[str, Mapping[int, str]]) -> list[str]:
    """A sentence for each case that was edited since it was generated.

    Parameters
    ----------
    edited : the warnings of the edited cases by their number, by setting.
    """
    return [
        f"Case {case + 1} by {setting}: {words.rstrip('.')}"
        for setting, cases in edited.items()
        for case, words in cases.items()
    ]


def uncertainty_words(answer: Answer) -> str:
    """The meaning of ± in an answer."""
    known = np.isfinite(answer.values)
    laws, unknown = int((answer.by_laws & known).sum()), int((np.isnan(answer.uncertainty) & known).sum())
    numerical = int(known.sum()) - laws - unknown
    model = answer.setting.split("-")[0]
    parts = []
    if numerical:
        where = "" if numerical == known.sum() else f" in {_cases(numerical)}"
        parts.append(f"the numerical uncertainty{where}, which does not contain effects that {model} leaves out")
    if laws:
        where = "" if laws == known.sum() else f" in {_cases(laws)}"
        parts.append(f"the expected error of {model} by the fitted laws{where}")
    if unknown:
        parts.append(f"unknown in {'all' if unknown == known.sum() else ''} {_cases(unknown)}".replace("  ", " "))
    return f"± is {', and '.join(parts)}"


def outside_sentences(outside: Mapping[str, Sequence[str]]) -> list[str]:
    """A sentence for each setting with cases outside the range of its model, with the reasons of the first of them.

    ``outside`` holds the reasons of each case, by setting; "" where a case is inside.
    """
    found = []
    for setting, reasons in outside.items():
        beyond = [place for place, reason in enumerate(reasons) if reason]
        if beyond:
            named = ", ".join(str(place + 1) for place in beyond[:CASES_NAMED])
            named += ", ..." if len(beyond) > CASES_NAMED else ""
            are = "is" if len(beyond) == 1 else "are"
            found.append(
                f"{_cases(len(beyond))} ({named}) by {setting} {are} outside the range of the model, error unknown: "
                f"{reasons[beyond[0]]}"
            )
    return found


def missing_sentences(solved: Mapping[str, Array], failures: Sequence[tuple[str, str, str]], to_come: int) -> list[str]:
    """A sentence for each setting that lacks cases, with the reason, and one for the jobs of an unfinished batch.

    Parameters
    ----------
    solved : masks of the solved cases, shape (cases,), by setting.
    failures : case, setting and reason of the jobs without a result.
    to_come : number of jobs without an answer.
    """
    found = []
    for setting, mask in solved.items():
        lacking = [place for place, known in enumerate(mask) if not known]
        if not lacking:
            continue
        reasons = Counter(reason for case, name, reason in failures if name == setting)
        why = reasons.most_common(1)[0][0] if reasons else "not solved yet"
        more = f"; {len(reasons) - 1} other reasons" if len(reasons) > 1 else ""
        named = ", ".join(str(place + 1) for place in lacking[:CASES_NAMED])
        named += ", ..." if len(lacking) > CASES_NAMED else ""
        has = "has" if len(lacking) == 1 else "have"
        found.append(f"{_cases(len(lacking))} ({named}) {has} no {setting} result: {why}{more}")
    if to_come:
        jobs = "job has" if to_come == 1 else "jobs have"
        found.append(
            f"The batch is not finished: {to_come} {jobs} no answer; the same command 'roughfilm batch' goes on"
        )
    return found


def largest_error_text(error: float, bar: float) -> str:
    """A largest error in per cent with the uncertainty of the reference; NaN is unknown."""
    if np.isnan(error):
        return "–"
    return share(error) if np.isnan(bar) else f"{share(error)} ± {share(bar)}"


def count_text(within: tuple[int, int], cases: int) -> str:
    """The number of cases that are certainly, and those that are possibly, within a tolerance."""
    certain, possible = within
    number = str(certain) if certain == possible else f"{certain}–{possible}"
    return f"{number} of {cases}"


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:]


def _cases(count: int) -> str:
    return "1 case" if count == 1 else f"{count} cases"
