"""Templates of generators are compiled once, if a cache is available."""

import sys
from pathlib import Path

import pytest
from jinja2 import Environment, TemplateError, TemplateNotFound, UndefinedError

from swarmdsl.codegen.templates import Templates


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    folder = tmp_path / "templates"
    folder.mkdir()
    (folder / "hello.j2").write_text("hello {{ name }}\n", encoding="utf-8")
    return folder


def hello(folder: Path) -> str:
    return Templates(folder).fill("hello.j2", name="you")


def kept(folder: Path) -> list[Path]:
    return sorted((folder.parent / "cache" / "swarmdsl").iterdir())


def test_the_second_run_compiles_nothing(folder, monkeypatch):
    assert hello(folder) == "hello you\n"
    monkeypatch.delattr(Environment, "compile")
    assert hello(folder) == "hello you\n"


def test_a_template_that_changed_is_compiled_anew(folder):
    hello(folder)
    (folder / "hello.j2").write_text("good bye {{ name }}\n", encoding="utf-8")
    assert hello(folder) == "good bye you\n"
    assert len(kept(folder)) == 1


@pytest.mark.parametrize("content", [b"", b"j2", b"\0" * 100])
def test_a_damaged_file_does_no_harm(folder, content):
    hello(folder)
    (file,) = kept(folder)
    file.write_bytes(content)
    assert hello(folder) == "hello you\n"
    assert file.read_bytes() != content


def test_a_file_cut_short_does_no_harm(folder):
    hello(folder)
    (file,) = kept(folder)
    whole = file.read_bytes()
    file.write_bytes(whole[:-20])
    assert hello(folder) == "hello you\n"
    assert file.read_bytes() == whole


def test_where_nothing_can_be_kept_it_goes_without(folder, monkeypatch):
    cache = folder.parent / "cache"
    cache.write_text("a file", encoding="utf-8")
    assert hello(folder) == "hello you\n"

    cache.unlink()
    cache.mkdir()
    (cache / "swarmdsl").write_text("a file", encoding="utf-8")
    assert hello(folder) == "hello you\n"

    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", no_home)
    assert hello(folder) == "hello you\n"


def no_home() -> Path:
    raise RuntimeError("Could not determine home directory.")


def test_python_can_be_told_to_keep_nothing(folder, monkeypatch):
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    assert hello(folder) == "hello you\n"
    assert not (folder.parent / "cache").exists()


def test_what_is_undefined_is_an_error(folder):
    with pytest.raises(UndefinedError):
        Templates(folder).fill("hello.j2")


def test_a_template_that_is_not_there_is_an_error(folder):
    with pytest.raises(TemplateNotFound):
        Templates(folder).fill("bye.j2")


def test_a_filter_is_a_function_of_a_value(folder):
    (folder / "hello.j2").write_text("hello {{ name | loud }}\n", encoding="utf-8")
    with pytest.raises(TemplateError):
        hello(folder)
    loud = Templates(folder, loud=str.upper)
    assert loud.fill("hello.j2", name="you") == "hello YOU\n"
    with pytest.raises(TemplateError):
        hello(folder)
