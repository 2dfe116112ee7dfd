"""The line of each key of a TOML file is found, whatever stands around it."""

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from roughfilm.contact.foundation.line_numbers import key_lines, line_of

TEXT = '''# [not] = "a table"
name = "x # no comment [" # a comment
geometry.film = "30 um"
"quoted key" = """
[no]
table = 1
"""
points = [
  [0, 1],  # width = 3
  [1, 2],
]
[lubricant]
law = { name = "barus",
  index = 2 }
viscosity = 1

[[grooves]]
width = 1
[grooves.edge]
radius = 2
[[grooves]]
width = 3
'''


def test_every_key_has_its_line():
    lines = key_lines(TEXT)
    assert lines == {
        ("name",): 2,
        ("geometry", "film"): 3,
        ("quoted key",): 4,
        ("points",): 8,
        ("lubricant",): 12,
        ("lubricant", "law"): 13,
        ("lubricant", "viscosity"): 15,
        ("grooves",): 17,
        ("grooves", 0): 17,
        ("grooves", 0, "width"): 18,
        ("grooves", 0, "edge"): 19,
        ("grooves", 0, "edge", "radius"): 20,
        ("grooves", 1): 21,
        ("grooves", 1, "width"): 22,
    }
    assert line_of(("lubricant", "law", "index"), lines) == 13
    assert line_of(("grooves", 1, "depth"), lines) == 21
    assert line_of(("motion",), lines) is None


@given(st.text(alphabet="ab.=[]{}\"'# \n1", max_size=60))
def test_any_text_is_scanned_without_an_error(text):
    key_lines(text)


def test_the_text_is_toml():
    assert tomllib.loads(TEXT.replace("\n  index", " index"))["lubricant"]["viscosity"] == 1
