"""The pages of the studies, which their folders in ``scripts/studies`` hold as README.md."""

import re
from collections.abc import Mapping
from pathlib import Path

import scripts.studies

FOLDER = Path(scripts.studies.__file__).parent
NAMES = tuple(sorted(path.parent.name for path in FOLDER.glob("*/README.md")))
"""The studies that have a page."""

_OTHER_STUDY = re.compile(r"\(\.\./(\w+)/README\.md")
_MANUAL = re.compile(r"\((?:\.\./){3}docs/")


def pages() -> Mapping[str, str]:
    """The page of each study in Markdown, with its links as they hold beside the other studies, and an index.

    Examples
    --------
    >>> sorted(pages())[:3]
    ['coverage', 'dimples', 'index']
    """
    index = ["# Studies", "", "Each study is a program in `scripts/studies` that recomputes published figures or tests"]
    index += ["published claims.", "", "```{toctree}", *NAMES, "```", ""]
    texts = {name: (FOLDER / name / "README.md").read_text(encoding="utf-8") for name in NAMES}
    own = {name: _MANUAL.sub("(../../", _OTHER_STUDY.sub(r"(\1.md", text)) for name, text in texts.items()}
    return own | {"index": "\n".join(index)}
