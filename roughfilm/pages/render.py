"""Self-contained HTML pages from templates."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import jinja2

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import FIGURE, PAGE
from roughfilm.figures.rendering import viewer
from roughfilm.rom.lubricants.thermal.law import celsius
from roughfilm.terminal.layout import VISIBLE
from roughfilm.words.cost import seconds
from roughfilm.words.numbers import share, span
from roughfilm.words.scales import scale_for

TEMPLATES = Path(__file__).parent / "templates"


def render(template: str | Path, path: Path, *, overwrite: bool = False, **entries: Any) -> None:
    """Fill a template and write the page, which replaces a page, and with ``overwrite`` any file but an input.

    Raises InputError if it cannot be written.

    ``template`` is a name in ``templates`` beside this file, or a path elsewhere; such a template may extend those of
    ``templates`` and of the folder above it.
    """
    template = Path(template)
    folder = TEMPLATES / template.parent
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([folder, folder.parent, TEMPLATES]),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        finalize=_visible,
    )
    environment.filters.update(
        share=share,
        seconds=seconds,
        number=_number,
        si=partial(_in_unit, unit="Pa"),
        micro=partial(_in_unit, unit="m"),
        celsius=celsius,
        span=lambda ends: "–" if ends is None else span(*ends),
    )
    held = iter(("viewer",))
    environment.globals["viewer"] = lambda: viewer() if next(held, None) else ""  # once a page
    page = environment.get_template(template.name).render(**entries)
    with replacing(path, PAGE, overwrite=overwrite) as scratch:
        scratch.write_text(page, encoding="utf-8", errors="replace")


def write_figures(plots: Mapping[str, str], directory: Path) -> None:
    """Write each figure, SVG text by name, as a file of its own; InputError if it cannot be written."""
    for name, text in plots.items():
        with replacing(directory / f"{name}.svg", FIGURE) as scratch:
            scratch.write_text('<?xml version="1.0" encoding="utf-8"?>\n' + text, encoding="utf-8")


def _visible(value: Any) -> Any:
    """The value, with control characters in a text such as a name as their codes."""
    return value.translate(VISIBLE) if isinstance(value, str) else value


def _number(value: float) -> str:
    return "0" if abs(value) < 5e-5 else f"{value:.4g}".replace("-", "−")


def _in_unit(value: float, unit: str) -> str:
    """A value in an SI unit in the unit that its size chooses."""
    scale = scale_for(unit, abs(value))
    return f"{value / scale.factor:.4g} {scale.unit}".replace("-", "−")
