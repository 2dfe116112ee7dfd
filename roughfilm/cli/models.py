"""roughfilm models: the ladder of each kind of scene: name, what it adds, available here or why not."""

from rich.table import Column, Table

from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.terminal.console import AsJson, in_one_line, output, print_json


@in_one_line
def command(as_json: AsJson = False) -> None:
    """Show the ladder: each model, what it adds, whether it can run here or why not."""
    rows = [(model, model.available(), model.resolutions) for model in models()]
    if as_json:
        print_json(
            {
                "models": [
                    {
                        "name": model.name,
                        "kind": model.kind,
                        "adds": model.summary,
                        "keeps": sorted(model.keeps),
                        "resolution": offered.default if isinstance(offered, Resolutions) else None,
                        "resolution_meaning": model.resolution_meaning,
                        "schemes": model.schemes,
                        "available": found.available,
                        "detail": found.detail,
                    }
                    for model, found, offered in rows
                ]
            }
        )
        return
    for kind in kinds().values():
        name = Column("model", no_wrap=True)
        title = f"The ladder of {kind.name}, {kind.summary}, plainest first"
        table = Table(name, "what it adds", "resolution and schemes", "here", title=title)
        for model, found, offered in rows:
            if model.kind == kind.name:
                own = offered.default if isinstance(offered, Resolutions) else "the scene's own"
                table.add_row(
                    model.name,
                    model.summary,
                    "; ".join((f"{own} {model.resolution_meaning}", *model.schemes)),
                    ("[green]yes[/]: " if found.available else "[red]no[/]: ") + found.detail,
                )
        output.print(table)
