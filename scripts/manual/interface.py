"""The public interface of Python as a page, and its docstrings in the form that Sphinx reads."""

import re
from collections.abc import Mapping

import roughfilm

SUBJECTS: Mapping[str, str] = {
    "interface.scenes": "Scenes",
    "interface.solving": "Models and solutions",
    "interface.results": "Files of results",
    "interface.sweeps": "Sweeps",
    "interface.studies": "Studies",
    "interface.cases": "OpenFOAM cases",
    "interface.surfaces": "Surfaces",
    "interface.profiles": "Profiles",
    "interface.windows": "Windows of a surface",
    "interface.fitting": "Descriptions of measured surfaces",
    "interface.curves": "Curves and effects",
    "interface.motion": "Bearings in time",
    "rom.ladder": "Classes of scenes and results",
    "contact.": "Quantities, surfaces and errors",
}
"""Headings of the page, by the beginning of the modules whose names stand below them."""

_ENTRY = re.compile(r"^(\w+(?:, \w+)*) : (.*)$")


def page() -> str:
    """The page of the public interface in Markdown, with directives that show each docstring.

    Examples
    --------
    >>> "autofunction:: roughfilm.solve" in page()
    True
    """
    lines = ["# Python interface", "", "```python", "import roughfilm as rf", "```", ""]
    lines += ["All values are in SI units. [Python](../../howto/python.md) shows these names in use.", ""]
    shown: set[str] = set()
    for beginning, heading in SUBJECTS.items():
        names = [
            name
            for name in dir(roughfilm)
            if getattr(getattr(roughfilm, name), "__module__", "").startswith(f"roughfilm.{beginning}")
        ]
        shown |= {*names}
        lines += [f"## {heading}", "", "```{eval-rst}"]
        for name in names:
            is_class = isinstance(getattr(roughfilm, name), type)
            lines += [f".. auto{'class' if is_class else 'function'}:: roughfilm.{name}"]
            lines += ["   :members:", ""] if is_class else [""]
        lines += ["```", ""]
    missing = {*dir(roughfilm)} - shown - {"__version__"}
    if missing:
        raise ValueError(f"names without a heading: {', '.join(sorted(missing))}")
    return "\n".join(lines)


def with_meanings_below(lines: list[str]) -> list[str]:
    """The lines of a docstring with the meaning of each entry below its name, as Sphinx reads them.

    Examples
    --------
    >>> with_meanings_below(["Parameters", "----------", "load : mean pressure, Pa.", "", "Other text : here."])
    ['Parameters', '----------', 'load', '    mean pressure, Pa.', '', 'Other text : here.']
    """
    made: list[str] = []
    within = False
    for number, line in enumerate(lines):
        ruled = number + 1 < len(lines) and re.fullmatch(r"-{4,}", lines[number + 1].strip()) is not None
        within = line.strip() in ("Parameters", "Attributes") if ruled else within
        entry = _ENTRY.match(line) if within else None
        made += [entry[1], f"    {entry[2]}"] if entry else [line]
    return made
