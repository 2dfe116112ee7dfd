"""The commands as a page in Markdown, from the help of the command line itself."""

import re
from collections.abc import Iterator

import typer
from typer.core import TyperGroup

from roughfilm.cli.main import GROUPS, MODULES, app
from roughfilm.terminal.console import EXIT_CODES

EXIT_CODE = re.compile(r"^ *(\d+) +(.*)$", re.MULTILINE)


def page() -> str:
    """The page of all commands in Markdown, by their use: usage, arguments, options and examples of each.

    Examples
    --------
    >>> "## First steps" in page(), "### solve" in page()
    (True, True)
    """
    lines = ["# Commands", "", "`roughfilm COMMAND --help` prints the same in a terminal.", ""]
    lines += ["| exit code | meaning |", "|---|---|"]
    lines += [f"| {code} | {meaning} |" for code, meaning in EXIT_CODE.findall(EXIT_CODES)]
    lines += [""]
    for group, commands in GROUPS.items():
        lines += [f"## {group}", ""]
        for name in commands:
            lines += [*_command(name), ""]
    return "\n".join(lines)


def _command(name: str) -> Iterator[str]:
    group = typer.main.get_command(app)
    assert isinstance(group, TyperGroup)
    above = group.make_context("roughfilm", [name])
    _, command, _ = group.resolve_command(above, [name])
    assert command is not None
    context = typer.Context(command, parent=above, info_name=name)
    yield from (f"### {name}", "", _plain(command.help or "").replace("\n", " ").strip(), "")
    yield from ("```text", " ".join(command.get_usage(context).split()).removeprefix("Usage: "), "```", "")
    rows = [record for one in command.get_params(context) if (record := one.get_help_record(context)) is not None]
    yield from ("| argument or option | meaning |", "|---|---|")
    for option, meaning in dict(rows).items():
        yield f"| `{_plain(option)}` | {_plain(meaning)} |".replace("``", "`")
    examples = getattr(__import__(MODULES[name], fromlist=["EXAMPLES"]), "EXAMPLES", ())
    if examples:
        yield from ("", "```sh", *examples, "```")


def _plain(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
