"""Lines that fit the width of the terminal and its character set: no name is cut, no number is broken."""

import codecs
import re
import textwrap

INDENT = "  "

NO_BREAK = "\xa0"

TOGETHER = re.compile(r"(?<=\d) (?=[%±])|(?<=±) (?=[\d.])|(?<=[=<>]) (?=[-\d.])|(?<=\w) (?=[=<>] [-\d.])")
"""The spaces of "5 %", "4.2 ± 0.1" and "Re = 160", at which no line is broken."""

PLAIN = str.maketrans(
    {
        "±": "+-",
        "µ": "u",
        "μ": "u",
        "−": "-",
        "–": "-",
        "—": "-",
        "·": "*",
        "×": "x",
        "°": " deg",
        "≤": "<=",
        "≥": ">=",
        "≈": "~",
        "…": "...",
        "→": "->",
        "ĥ": "h",
        "θ": "theta",
        "η": "eta",
        "λ": "lambda",
        "ρ": "rho",
        "τ": "tau",
        "σ": "sigma",
        "ω": "omega",
        "Δ": "Delta",
        "∞": "inf",
        "√": "sqrt ",
        "⁻": "^-",
        "⁰": "0",
        "¹": "1",
        "²": "^2",
        "³": "^3",
        "⁴": "^4",
        "⁶": "6",
        "₀": "0",
        "å": "a",
        "ä": "ae",
        "ö": "oe",
        "é": "e",
        "“": '"',
        "”": '"',
        "‘": "'",
        "’": "'",
        "─": "-",
        "━": "-",
        "│": "|",
        "╭": "+",
        "╮": "+",
        "╰": "+",
        "╯": "+",
        "•": "*",
    }
)
"""Characters that a terminal may lack, in ASCII."""


BIDI_CONTROLS = (0x061C, 0x200E, 0x200F, *range(0x2028, 0x202F), *range(0x2066, 0x206A))
"""Characters that change the direction of the text around them, and two that break lines."""

VISIBLE = {
    code: f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"
    for code in (*range(0x20), *range(0x7F, 0xA0), *BIDI_CONTROLS)
    if chr(code) not in "\t\n"
}
"""Control characters, and what is shown in their place."""


def visible(text: str) -> str:
    r"""The text with each control character as its code, so that it cannot act on a terminal or reorder a page.

    >>> visible("a\x1b[31m name\u202e")
    'a\\x1b[31m name\\u202e'
    """
    return text.translate(VISIBLE)


def in_charset(text: str, encoding: str) -> str:
    """The text, with ASCII in place of the characters that the encoding lacks.

    >>> in_charset("4.2 ± 0.1 µm", "ascii")
    '4.2 +- 0.1 um'
    >>> in_charset("4.2 ± 0.1 µm", "utf-8")
    '4.2 ± 0.1 µm'
    """
    return text.encode(encoding, CHARSET_ERRORS).decode(encoding)


def _replaced(error: UnicodeError) -> tuple[str, int]:
    """Replace one character that an encoding lacks."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    replaced = error.object[error.start].translate(PLAIN)
    return replaced if replaced.isascii() else "?", error.start + 1


CHARSET_ERRORS = "roughfilm-plain"
codecs.register_error(CHARSET_ERRORS, _replaced)


def wrapped(line: str, width: int) -> str:
    r"""The line, broken between words, its further lines indented; a word such as a path is never broken.

    >>> wrapped("report: a page with figures", 16)
    'report: a page\n  with figures'
    """
    own = line[: len(line) - len(line.lstrip())]
    lines = textwrap.wrap(
        TOGETHER.sub(NO_BREAK, line),
        max(width, 1),
        subsequent_indent=own + INDENT,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return "\n".join(lines).replace(NO_BREAK, " ")
