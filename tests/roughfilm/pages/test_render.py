"""Pages are whole and harmless, whatever the names in them."""

import pytest

from roughfilm.pages.render import render


@pytest.mark.parametrize("name", ["\x1b[31mred", "a\x9b2J", "a\u202etxt.exe", "<script>", "a\x00b"])
def test_a_name_on_a_page_neither_acts_nor_is_lost(name, tmp_path):
    template, page = tmp_path / "page.html.j2", tmp_path / "page.html"
    template.write_text("<title>{{ name }} – roughfilm</title>{{ drawing|safe }}")
    render(template, page, name=name, drawing="<svg>\n</svg>")
    text = page.read_text(encoding="utf-8")
    assert all(character == "\n" or character.isprintable() for character in text)
    assert "<script>" not in text
    assert text.endswith("<svg>\n</svg>")
    assert len(text) > len("<title> – roughfilm</title><svg>\n</svg>") + len(name)
