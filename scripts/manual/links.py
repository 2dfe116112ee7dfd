"""Check that every link of built pages leads to a place that exists: ``python -m scripts.manual.links DIR``."""

import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Page(HTMLParser):
    """The links and the places of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self.places: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep the links and the places of a tag."""
        for name, value in attrs:
            if value and name == "id":
                self.places.add(value)
            elif value and (name == "src" or (name == "href" and tag != "base")):
                self.links.add(value)
                if tag != "a":
                    self.loaded.add(value)


def broken(directory: Path) -> Iterator[str]:
    """The links of the pages below a directory that lead nowhere, as "page: link".

    Links to other sites are not followed; a page, script, style or picture that is loaded from another site is named,
    because pages work without a network. Templates of the theme in ``_static`` are no pages.
    """
    paths = (path for path in sorted(directory.rglob("*.html")) if "_static" not in path.parts)
    pages = {path.resolve(): _Page(path.read_text(encoding="utf-8")) for path in paths}
    for path, page in pages.items():
        for link in sorted(page.links):
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loaded and parts.scheme != "data":
                    yield f"{path.relative_to(directory.resolve())}: loads {link}"
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            place = unquote(parts.fragment)
            if not target.exists() or (target in pages and place and place not in pages[target].places):
                yield f"{path.relative_to(directory.resolve())}: {link}"


def main() -> None:
    """Print the broken links below the directory of the command line; the exit code is 1 if there are any."""
    faults = [*broken(Path(sys.argv[1]))]
    print(*faults, sep="\n", file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
