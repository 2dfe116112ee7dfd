"""How the code is laid out: which way imports go, how large a folder is, and that names are found from the listing."""

import ast
from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest
from places import ROOT

ORDER = ("contact", "rom", "foamcases", "roughfilm", "scripts")
LIBRARY = ORDER[:3]
"""One module a command, as many as there are commands."""


def files_of(package: str) -> list[Path]:
    """The modules of a top-level folder, without what it links to and without the programs for other Pythons."""
    found = [
        path
        for path in (ROOT / package).rglob("*.py")
        if "peers" not in path.parts and not (package == "roughfilm" and path.relative_to(ROOT).parts[1] in LIBRARY)
    ]
    assert found
    return found


def package_of(module: str) -> str:
    """The top-level folder of a module by its dotted name."""
    first, *rest = module.split(".")
    return rest[0] if first == "roughfilm" and rest and rest[0] in LIBRARY else first


def name_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
    return f"roughfilm.{name}" if parts[0] in LIBRARY else name


@cache
def imported(path: Path) -> frozenset[str]:
    """The dotted names of the modules that a file imports, anywhere in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, f"{path}: relative import"
            within = {f"{node.module}.{alias.name}" for alias in node.names}
            names |= within & MODULES or {node.module}
    return frozenset(names)


MODULES = {name_of(path) for package in ORDER for path in files_of(package)}


@pytest.mark.parametrize("package", ORDER)
def test_a_package_imports_only_those_below_it(package):
    above = set(ORDER[ORDER.index(package) + 1 :])
    offenders = {
        str(path.relative_to(ROOT)): wrong
        for path in files_of(package)
        if (wrong := {name for name in imported(path) if package_of(name) in above})
    }
    assert not offenders


@pytest.mark.parametrize("package", [*ORDER, "tests"])
def test_nothing_is_imported_by_the_bare_name_of_a_library_folder(package):
    bare = {str(path): {n for n in imported(path) if n.split(".")[0] in LIBRARY} for path in files_of(package)}
    assert not {path: names for path, names in bare.items() if names}


@pytest.mark.parametrize("package", ORDER)
def test_there_are_no_circles_of_imports(package):
    graph = {
        name_of(path): {name for name in imported(path) if name in MODULES} - {name_of(path)}
        for path in files_of(package)
    }
    done: set[str] = set()

    def visit(name: str, trail: tuple[str, ...]) -> None:
        assert name not in trail, " -> ".join([*trail, name])
        if name not in done:
            for other in graph.get(name, ()):
                visit(other, (*trail, name))
            done.add(name)

    for name in graph:
        visit(name, ())


@pytest.mark.parametrize("package", ORDER)
def test_no_two_folders_import_each_other(package):
    arrows = defaultdict(set)
    for path in files_of(package):
        here = name_of(path.parent / "__init__.py")
        for name in imported(path):
            there = (
                name if (ROOT / name.removeprefix("roughfilm.").replace(".", "/")).is_dir() else name.rpartition(".")[0]
            )
            nested = f"{here}.".startswith(f"{there}.") or f"{there}.".startswith(f"{here}.")
            if package_of(name) == package and not nested:
                arrows[here].add(there)
    both = {(a, b) for a, targets in arrows.items() for b in targets if a < b and a in arrows.get(b, ())}
    assert not both


@pytest.mark.parametrize("package", ORDER)
def test_no_command_is_imported_by_what_is_not_one(package):
    for path in files_of(package):
        if "cli" not in path.parts:
            assert not {name for name in imported(path) if name.startswith("roughfilm.cli.")} - {
                "roughfilm.cli.main"
            }, path


@pytest.mark.parametrize("package", LIBRARY)
def test_models_are_named_after_their_files_and_import_no_others(package):
    for path in (ROOT / package).glob("*/models/[!_]*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = [
            word.value.value
            for node in ast.walk(tree)
            if isinstance(node, ast.Call)
            for word in node.keywords
            if word.arg == "name" and isinstance(word.value, ast.Constant)
        ]
        assert names == [path.stem], path
        assert not [name for name in imported(path) if ".models." in name], path


@pytest.mark.parametrize("package", LIBRARY)
def test_the_library_neither_prints_nor_draws(package):
    for path in files_of(package):
        assert not {name.split(".")[0] for name in imported(path)} & {"matplotlib", "pyvista", "rich", "typer"}, path
        calls = [node.func for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call)]
        assert not [call for call in calls if isinstance(call, ast.Name) and call.id == "print"], path


@pytest.mark.parametrize("folder", [*LIBRARY, "roughfilm/interface", "roughfilm/batch", "roughfilm/ladder.py"])
def test_the_library_names_parameters_and_no_options_of_commands(folder):
    of_programs = {"--always", "--abbrev=12", "--dirty=+changes", "--pdeathsig"}
    path = ROOT / folder
    for file in [path] if path.is_file() else path.rglob("*.py"):
        nodes = ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        texts = {node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)}
        assert not {text for text in texts if text.startswith("--")} - of_programs, file


@pytest.mark.parametrize("package", ORDER)
def test_folders_stay_small_and_shallow(package):
    count = defaultdict(int)
    for path in files_of(package):
        count[path.parent] += path.name != "__init__.py"
        assert len(path.relative_to(ROOT / package).parts) <= 4, path
    assert {str(folder): n for folder, n in count.items() if n > 20} == {}


@pytest.mark.parametrize("package", ORDER)
def test_two_files_with_one_prefix_are_a_folder(package):
    names = defaultdict(set)
    for path in files_of(package):
        if path.name != "__init__.py" and path.parent.name != "models":
            names[path.parent, path.stem.split("_")[0]].add(path.name)
    assert [sorted(pair) for pair in names.values() if len(pair) > 1] == []
