"""roughfilm fit: a description whose seeds scatter as the windows of a surface do, and how well."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from roughfilm.contact.fitting.profile import fit_profile
from roughfilm.contact.fitting.text import DESCRIPTION, description_text
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.contact.preparation.profile import prepare_profile
from roughfilm.contact.preparation.recipe import load_recipe
from roughfilm.contact.surfaces.files import read_measurement
from roughfilm.contact.surfaces.profile import Profile
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import RandomField, description_entries
from roughfilm.fitting.run import AREA, COUNT, SEEDS, fit_windows
from roughfilm.terminal.console import OUTPUT, AsJson, Overwrite, ReportFile, progress_bar
from roughfilm.terminal.output_file import refuse_same, refuse_unwritable, replacing_together
from roughfilm.terminal.ranges import in_si
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.fit import HEADS, entries_of, headline, length, notes, rows
from roughfilm.words.numbers import in_unit

EXAMPLES = (
    "roughfilm fit measured.x3p --out fitted.toml --report fitted.html",
    "roughfilm fit measured.x3p --size 0.2mm --windows 64 --area 5% --out fitted.toml",
)

SOURCES = ("10.1103/PhysRevLett.77.635", "A. Gelman et al., Bayesian Data Analysis, section 3.6")

SOURCES_OF_PROFILE = ("P. R. Nayak, 10.1115/1.3451608", "P. D. Welch, 10.1109/TAU.1967.1161901")

OF_PROFILE = (
    "a profile says nothing of the direction across it: the waves are taken to be alike in all directions, or "
    "stretched by the anisotropy given",
    "seeds differ by chance alone, not as windows of the surface do",
)
"""Warnings about a description that a profile gave."""

COMPUTED = 0.97
"""Done fraction before the page is drawn."""


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A measured surface, or a description (TOML).")],
    out: Annotated[Path | None, typer.Option(help="Write the description here (TOML).", rich_help_panel=OUTPUT)] = None,
    report: ReportFile = None,
    windows: Annotated[int, typer.Option("--windows", help="Windows, half of which are held out in turn.")] = COUNT,
    size: Annotated[
        str | None,
        typer.Option(metavar="L", help="Side of the windows, e.g. 0.1mm (default: all fit without overlap)."),
    ] = None,
    area: Annotated[
        str, typer.Option(metavar="A", help="Contact area at which windows and seeds are compared.")
    ] = f"{100 * AREA:g}%",
    seeds: Annotated[int, typer.Option(help="Seeds by which each half is judged.")] = SEEDS,
    anisotropy: Annotated[
        float | None,
        typer.Option(metavar="G", help="Of a profile: length of ridges, along y, over their width (default: 1)."),
    ] = None,
    recipe: Annotated[Path | None, typer.Option("--prepare", help="The recipe (TOML; default: the usual one).")] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Override a key of it, e.g. form=tilt; repeatable."),
    ] = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Fit a random description to the windows of a surface, and test it with windows that were not fitted.

    A profile gives the spectrum of an isotropic surface, or of one with ridges across the profile (--anisotropy).
    """
    refuse_same({"FILE": file, "--prepare": recipe, "--out": out, "--report": report})
    spent, steps = stopwatch(), load_recipe(recipe, set_ or ())
    side = None if size is None else in_si("--size", size, "m")
    fraction = in_si("--area", area, "%") / 100
    with progress_bar(1.0) as advance:
        advance(0.0, f"reading {file.name}")
        given: Surface | Profile | Path = file
        if file.suffix.lower() != ".toml":
            given = read_measurement(file, **dict(steps.read))
        elif recipe or set_:
            raise InputError(f"{file}: is described and periodic; leave out --prepare and --set")
        if isinstance(given, Profile):
            for option, value in (("--report", report), ("--size", size)):
                if value is not None:
                    raise InputError(f"{option}: {file} is a profile, which has no windows; leave it out")
        elif anisotropy is not None:
            raise InputError(f"--anisotropy: {file} is a surface, which has its own lay; leave it out")
        refuse_unwritable((out, DESCRIPTION), (report, PAGE), overwrite=overwrite)
        if isinstance(given, Profile):
            gamma = 1.0 if anisotropy is None else anisotropy
            field = fit_profile(prepare_profile(given, steps), anisotropy=gamma)
            _show_field(file.name, given, field, spent, out, overwrite=overwrite, as_json=as_json)
            return
        fit = fit_windows(
            given,
            steps,
            count=windows,
            size=side,
            area=fraction,
            seeds=seeds,
            name=file.name,
            progress=lambda done, words: advance(COMPUTED * done, words),
        )
        entries = {
            **entries_of(fit),
            "numerics": {"windows": len(fit.windows), "seeds": 3 * seeds, **spent()},
            "provenance": origin(SOURCES, fit.warnings, surface=dict(fit.plan.source)),
        }
        with replacing_together((out, DESCRIPTION), (report, PAGE), overwrite=overwrite) as (text, page):
            if text is not None:
                text.write_text(description_text(fit.description, notes(fit)), encoding="utf-8")
            if page is not None:
                from roughfilm.pages.fit import write_page  # matplotlib is slow to import

                advance(COMPUTED, "drawing the page")
                write_page(fit, entries, page)

    def shown() -> Iterator[Table | str]:
        side = length(fit.group.size)
        title = f"{len(fit.windows)} windows of {side} and {seeds} seeds at {100 * fit.area:.3g} % contact"
        yield table_of(HEADS, rows(fit), title=title, left=1)
        for one in fit.findings:
            yield f"{'lacking' if one.lacking else 'windows'}: {one.text}"

    show_result(entries, shown(), as_json=as_json, summary=written(headline(fit), out, report))


def _show_field(
    name: str,
    profile: Profile,
    field: RandomField,
    spent: Callable[[], dict[str, float]],
    out: Path | None,
    *,
    overwrite: bool,
    as_json: bool,
) -> None:
    """Write the description that a profile gave, and show it."""
    with replacing_together((out, DESCRIPTION), overwrite=overwrite) as (text,):
        if text is not None:
            text.write_text(description_text(field, [f"From the profile {name}.", *OF_PROFILE]), encoding="utf-8")
    rms = Quantity(value=field.population.rms_height, unit="m")
    entries = {
        "description": description_entries(field),
        "quantities": {"rms_height": {"value": rms.value, "unit": rms.unit}},
        "numerics": {"points": profile.heights.size, **spent()},
        "provenance": origin(SOURCES_OF_PROFILE, OF_PROFILE, profile=dict(profile.source)),
    }
    sides = " x ".join(" ".join(in_unit(Quantity(value=side, unit="m"))) for side in field.size)
    points = " x ".join(map(str, field.points))
    summary = written(f"{name}: a surface of {points} points, {sides}, rms height {' '.join(in_unit(rms))}", out)
    show_result(entries, iter(()), as_json=as_json, summary=summary)
