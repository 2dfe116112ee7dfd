"""Models are found by kind and name, from the folders that hold them."""

import subprocess
import sys

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find, models
from roughfilm.rom.ladder.model import model_modules


@pytest.mark.parametrize("model", models(), ids=lambda model: f"{model.kind}-{model.name}")
def test_a_model_is_found_by_its_kind_and_name(model):
    assert find(model.kind, model.name) is model
    assert model in models(model.kind)


def test_models_of_one_name_are_stated_apart_by_their_kind():
    assert {find(kind, "stokes").kind for kind in ("pocket", "rough_gap")} == {"pocket", "rough_gap"}


@pytest.mark.parametrize(("kind", "name"), [("pocket", "mixed"), ("bearing", "elastic"), ("seal", ".."), ("x", "y")])
def test_an_unknown_name_is_refused_with_those_of_its_kind(kind, name):
    with pytest.raises(InputError, match=r"^model: got '.*'; it must be one of ") as caught:
        find(kind, name)
    assert str(caught.value).endswith(", ".join(model.name for model in models(kind)))


def test_one_model_is_imported_without_the_others():
    names = "print(*(name for name in sys.modules if '.models.' in name))"
    code = f"import sys; from roughfilm.ladder import find; find('seal', 'effective_medium'); {names}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["roughfilm.rom.seal.models.effective_medium"]


def test_a_folder_on_the_path_of_a_kind_adds_its_models(tmp_path, monkeypatch):
    from roughfilm import rom
    from roughfilm.rom.seal import models as folder

    (tmp_path / "added.py").write_text("MODEL = 'a model'\n")
    monkeypatch.setattr(folder, "__path__", [*folder.__path__, str(tmp_path)])
    monkeypatch.delitem(sys.modules, f"{folder.__name__}.added", raising=False)
    assert model_modules(rom, kind="seal")["seal", "added"] == f"{folder.__name__}.added"
    assert find("seal", "added") == "a model"
