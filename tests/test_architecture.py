"""Imports go one way only: contact <- rom <- foamcases <- scripts."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ORDER = ("contact", "rom", "foamcases", "scripts")


def imported(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, f"{path}: relative import"
            names.add(node.module.split(".")[0])
    return names


@pytest.mark.parametrize("package", ORDER)
def test_a_package_imports_only_those_below_it(package):
    files = list((ROOT / package).rglob("*.py"))
    assert files
    above = set(ORDER[ORDER.index(package) + 1 :])
    offenders = {str(path.relative_to(ROOT)): imported(path) & above for path in files if imported(path) & above}
    assert not offenders


@pytest.mark.parametrize("package", ["rom", "foamcases"])
def test_models_never_import_models(package):
    for path in (ROOT / package / "models").glob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        modules = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        assert not [name for name in modules if ".models" in name], path


@pytest.mark.parametrize("package", ["contact", "rom", "foamcases"])
def test_packages_do_not_print_or_plot(package):
    for path in (ROOT / package).rglob("*.py"):
        assert not imported(path) & {"matplotlib", "pyvista", "rich", "typer"}, path
        calls = [node.func for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call)]
        assert not [call for call in calls if isinstance(call, ast.Name) and call.id == "print"], path


@pytest.mark.parametrize("package", ORDER)
def test_no_file_holds_two_ideas(package):
    for path in (ROOT / package).rglob("*.py"):
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 400, path
