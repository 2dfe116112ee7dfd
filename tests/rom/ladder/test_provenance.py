"""The digest of a model's code changes with all that may change its numbers, and with nothing else."""

import sys

import pytest

from roughfilm import foamcases, rom
from roughfilm.rom.ladder import provenance
from roughfilm.rom.ladder.model import ladder
from roughfilm.rom.ladder.provenance import code, model_code

LIBRARY = {
    "rom/gap/models/thin.py": "from roughfilm.rom.gap.film import solve\nMODEL = solve\n",
    "rom/gap/film.py": "def solve(scene):\n    import roughfilm.contact.solver\n",
    "contact/solver.py": "def limit():\n    return 3\n",
    "contact/unrelated.py": "OTHER = 1\n",
}
PROSE = '"""The solver."""\n# a comment\n\ndef limit():\n    """Greatest number."""\n    return 3\n'


@pytest.fixture
def digest(tmp_path_factory, monkeypatch):
    """digest(changes): that of the model thin in a library whose files are changed so."""

    def of(changes):
        package = tmp_path_factory.mktemp("library") / "roughfilm"
        for name, text in (LIBRARY | changes).items():
            (package / name).parent.mkdir(parents=True, exist_ok=True)
            (package / name).write_text(text)
        monkeypatch.setattr(provenance, "LIBRARY", package)
        model_code.cache_clear()
        return model_code("gap", "thin")

    yield of
    model_code.cache_clear()


@pytest.mark.parametrize(
    "changes",
    [
        {"contact/solver.py": PROSE},
        {"contact/unrelated.py": "OTHER = 2"},
        {"rom/gap/models/thick.py": "MODEL = 7"},
    ],
)
def test_prose_and_modules_that_are_not_imported_do_not_count(digest, changes):
    assert digest(changes) == digest({})


@pytest.mark.parametrize(
    "changes",
    [
        {"contact/solver.py": "def limit():\n    return 4\n"},
        {"rom/gap/models/thin.py": LIBRARY["rom/gap/models/thin.py"] + "NAME = 1\n"},
        {"contact/solver.py": "from roughfilm.contact import unrelated\n" + PROSE},
    ],
)
def test_a_change_of_what_is_imported_directly_or_not_counts(digest, changes):
    assert digest(changes) != digest({})


def test_a_change_of_what_is_imported_at_the_first_call_counts(digest):
    thin = {"rom/gap/models/thin.py": 'MODEL = deferred("contact.unrelated", "OTHER")\n'}
    assert digest(thin | {"contact/unrelated.py": "OTHER = 2"}) != digest(thin)


@pytest.fixture
def anew(monkeypatch):
    """The digest in a process that finds what others have kept in a file."""
    monkeypatch.setattr(sys, "dont_write_bytecode", False)

    def digest(kept):
        monkeypatch.setattr(provenance, "_kept_at", lambda: kept)
        provenance._known.cache_clear()
        model_code.cache_clear()
        return model_code("seal", "effective_medium")

    yield digest
    model_code.cache_clear()


def test_source_files_that_are_known_are_not_parsed_again(anew, tmp_path, monkeypatch):
    first = anew(tmp_path / "known.json")
    monkeypatch.setattr(provenance, "_statements", None)
    assert anew(tmp_path / "known.json") == first


@pytest.mark.parametrize("words", ["", "[", "[1]", '{"a": 3}', '{"a": []}'])
def test_the_digest_does_not_depend_on_what_is_kept(anew, tmp_path, words):
    (tmp_path / "damaged.json").write_text(words)
    assert anew(tmp_path / "damaged.json") == anew(tmp_path / "none.json") == anew(tmp_path / "none" / "cannot" / "be")


def test_every_model_has_a_digest_of_its_own():
    models = ladder(rom, foamcases)
    digests = {model_code(model.kind, model.name) for model in models}
    assert len(digests) == len(models)
    assert code() not in digests


def test_a_model_without_a_module_has_the_digest_of_everything():
    assert model_code("pocket", "none") == code()
