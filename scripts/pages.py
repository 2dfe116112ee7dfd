"""Self-contained HTML pages from the templates beside this file."""

from pathlib import Path
from typing import Any

import jinja2

from contact.files import replacing


def render(template: str, path: Path, **entries: Any) -> None:
    """Fill a template and write the page; InputError if it cannot be written."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("scripts", "."),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        percent=percent, share=share, seconds=seconds, number=number, si=pascals, micro=length, embedded=embedded
    )
    page = environment.get_template(template).render(**entries)
    with replacing(path) as scratch:
        scratch.write_text(page, encoding="utf-8")
