"""Sphinx: how the manual is built, without a network, into pages that open from a disk."""

import os
import sys
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

from sphinx.util import logging

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from scripts.manual import commands, formulas, interface, kept_examples, parameters, scene_keys, studies  # noqa: E402

GALLERY, KEPT = ROOT / "docs" / "gallery", ROOT / "docs" / "kept_examples"
EXAMPLES = ROOT / "scripts" / "examples" / "gallery"
KINDS = ("pocket", "bearing", "dry_contact", "seal", "rough_gap")

LOG = logging.getLogger(__name__)
project, author, copyright = "roughfilm", "the authors of roughfilm", "the authors of roughfilm"  # noqa: A001
version = release = version_of("roughfilm")
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
]
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
exclude_patterns = ["**/README.rst", "kept_examples", "sg_execution_times.rst", "**/sg_execution_times.rst"]
smartquotes = False  # options such as --within and the quotes of scene files stay as they are typed
html_theme = "pydata_sphinx_theme"
html_title = f"roughfilm {release}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_show_search_summary = False  # excerpts are fetched, which a browser forbids for pages on a disk
html_math_renderer = "mathml"
html_context = {"default_mode": "auto"}
html_copy_source = html_show_sourcelink = False
html_theme_options: dict[str, Any] = {
    "navigation_with_keys": False,
    "header_links_before_dropdown": 8,
    "secondary_sidebar_items": ["page-toc"],
    "show_prev_next": True,
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
}
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented_params"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_rtype = False
nitpicky = False

RUN_LONG = os.environ.get("ROUGHFILM_LONG_EXAMPLES") == "yes"
sphinx_gallery_conf = {
    "examples_dirs": [str(EXAMPLES)],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"\.py$" if RUN_LONG else rf"/(?!{kept_examples.BEGINNING})\w+\.py$",
    "download_all_examples": False,
    "notebook_extensions": set(),
    "show_signature": False,
    "show_memory": False,
    "min_reported_time": 1e9,
    "remove_config_comments": True,
    "plot_gallery": "True",
    "abort_on_example_error": True,
    "backreferences_dir": None,
    "within_subsection_order": "FileNameSortKey",
    "thumbnail_size": (400, 280),
    "image_scrapers": ("scripts.manual.outcomes.scraper", "matplotlib"),  # the second closes the figures
    "reset_modules": ("matplotlib", "scripts.manual.outcomes.apart"),
    "reset_modules_order": "both",
}


def _write_references(_app: Any) -> None:
    """Write the pages that follow from the code and the studies, where they have changed."""
    pages = {f"reference/generated/keys_{kind}": scene_keys.page(kind) for kind in KINDS}
    pages |= {"reference/generated/commands": commands.page(), "reference/generated/api": interface.page()}
    pages |= {"reference/generated/parameters": parameters.page()}
    pages |= {f"source/studies/{name}": text for name, text in studies.pages().items()}
    for name, text in pages.items():
        path = ROOT / "docs" / f"{name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def _restore_long_examples(_app: Any) -> None:
    """Take the kept pages of examples that take long, unless these are run."""
    if RUN_LONG:
        return
    kept_examples.restore(KEPT, GALLERY, EXAMPLES)
    for name in kept_examples.outdated(EXAMPLES, KEPT):
        LOG.warning("the kept page of %s is missing or that of another program; run ./scripts/docs --all", name)


def _keep_long_examples(_app: Any, error: Exception | None) -> None:
    """Keep the pages of examples that take long, if they were run."""
    if RUN_LONG and error is None:
        kept_examples.keep(GALLERY, KEPT)


def _docstring(_app: Any, _what: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    lines[:] = interface.with_meanings_below(lines)


def setup(app: Any) -> None:
    """Add what the manual takes from the code, and its formulas."""
    app.add_html_math_renderer("mathml", (formulas.inline, None), (formulas.displayed, formulas.end_displayed))
    app.connect("builder-inited", _write_references, priority=1)
    app.connect("builder-inited", _restore_long_examples, priority=1)
    app.connect("build-finished", _keep_long_examples)
    app.connect("autodoc-process-docstring", _docstring, priority=1)
