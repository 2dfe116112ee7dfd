"""Formulas of the manual as MathML, which browsers draw without a script and without a network."""

from typing import Any

from docutils import nodes
from latex2mathml.converter import convert

Translator = Any
"""The writer of HTML in Sphinx."""


def inline(translator: Translator, node: nodes.math) -> None:
    """Write a formula inside a line."""
    _write(translator, node, "inline")


def displayed(translator: Translator, node: nodes.math_block) -> None:
    """Write a formula on a line of its own, with its number if it has one."""
    number = f'<span class="eqno">({node["number"]})</span>' if node.get("number") else ""
    identifier = f' id="{node["ids"][0]}"' if node.get("ids") else ""
    translator.body.append(f'<div class="formula"{identifier}>{number}')
    _write(translator, node, "block")


def end_displayed(translator: Translator, _node: nodes.math_block) -> None:
    """Close the line of a formula."""
    translator.body.append("</div>\n")


def _write(translator: Translator, node: nodes.Element, display: str) -> None:
    translator.body.append(convert(node.astext().strip(), display=display))
    if display == "inline":
        raise nodes.SkipNode
    translator.add_secnumber(node)
    raise nodes.SkipChildren
