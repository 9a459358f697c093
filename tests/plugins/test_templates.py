"""Templates of generators are compiled once, wherever that can be kept."""

import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from jinja2 import (
    Environment,
    FileSystemLoader,
    TemplateAssertionError,
    TemplateNotFound,
    UndefinedError,
)

from swarmdsl.templates import Templates


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


@pytest.mark.parametrize("content", [b"", b"swarmdsl", b"\0" * 100])
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


def test_a_filter_of_another_name_needs_another_compilation(folder):
    (folder / "hello.j2").write_text("hello {{ name | loud }}\n", encoding="utf-8")
    with pytest.raises(TemplateAssertionError):
        hello(folder)
    loud = Templates(folder, loud=str.upper)
    assert loud.fill("hello.j2", name="you") == "hello YOU\n"
    with pytest.raises(TemplateAssertionError):
        hello(folder)


VALUES = {
    "words": ["one", "Two", "three"],
    "numbers": (3, 1, 2),
    "nothing": [],
    "table": {"key": "value", "items": "hidden"},
    "point": SimpleNamespace(x=1, y="a\n\nb", on=True),
    "points": [SimpleNamespace(name="p", on=True), SimpleNamespace(name="q", on=False)],
    "add": lambda a, b=1: a + b,
}
PLAIN = [
    "{{ point.x }} {{ table.key }} {{ table['key'] }} {{ words[-1] }}",
    "{% for word in words %}{{ loop.first }}{{ word }}{{ loop.last }} {% endfor %}",
    "{% for word in nothing %}{{ loop.first }}{% else %}nothing{% endfor %}",
    "{% for word in words if word != 'Two' %}{{ word }}{{ ', ' if not loop.last }}{% endfor %}",
    "{% for a in words %}{% for b in numbers %}{{ loop.last }}{{ a ~ b }}{% endfor %}{% endfor %}",
    "{% for key, value in table.items() %}{{ key }}={{ value }}{% endfor %}",
    "{{ add(2) }} {{ add(2, b=3) }} {{ -point.x + 2 * 3 }} {{ words[0].upper() }}",
    "{% set sum = add(1) %}{% set sum = sum + 1 %}{{ sum }}",
    "{% macro twice() %}{{ words[0] }}{{ words[0] }}{% endmacro %}{{ twice() }} {{ twice() }}",
    "{% include 'inner.j2' %}",
    "{% set words = ['set'] %}{% include 'inner.j2' %}",
    "{% for words in [['a'], ['b']] %}{% include 'inner.j2' %}{% endfor %}",
    "{{ words | join('-') }} {{ numbers | join }} {{ numbers | sort }} {{ numbers | list }}",
    "{{ points | selectattr('on') | map(attribute='name') | list }}",
    "{{ points | rejectattr('on') | map(attribute='name') | join }}",
    "  {{ point.y | indent }}|{{ '' | indent }}|{{ 'a' | indent }}|{{ 'a\n' | indent }}",
    "{{ 'yes' if point.on }}{{ 'no' if not point.on }}{{ 'no' if not point.on else 'yes' }}",
    "{% if words and not nothing or point.x < 0 %}{{ 1 < 2 <= 2 }}{% elif 1 %}{% endif %}",
    "{{ words | repr }} {{ None }} {{ true }} {{ 1.5 }} {{ ('a', 1) }} {{ {'a': 1} }}",
]
# What the run time here does not know.
OTHERS = [
    "{% for word in words %}{{ loop.index }}{{ loop.cycle('a', 'b') }}{% endfor %}",
    "{% macro say(word, end='!') %}{{ word }}{{ end }}{% endmacro %}{{ say('a', end=1) }}",
    "{% set found = namespace(word='') %}{% set found.word = 'x' %}{{ found.word }}",
    "{{ words | first }} {{ 'a b' | title }} {{ point['x'] }} {{ point.x is odd }}",
    "{{ other is defined }} {% for nothing in words %}{% include 'inner.j2' %}{% endfor %}",
    "{% from 'library.j2' import greet %}{{ greet('a') }}",
    "{% for word in words recursive %}{{ word }}{% endfor %}",
]


@pytest.fixture
def beside(folder):
    (folder / "inner.j2").write_text("<{{ words | join(',') }}>", encoding="utf-8")
    library = "{% macro greet(name) %}hello {{ name }}{% endmacro %}"
    (folder / "library.j2").write_text(library, encoding="utf-8")
    return folder


def by_jinja(folder: Path, template: str) -> str:
    environment = Environment(loader=FileSystemLoader(folder), trim_blocks=True, lstrip_blocks=True)
    environment.filters["repr"] = repr
    return environment.from_string(template).render(VALUES)


@pytest.mark.parametrize("template", PLAIN)
def test_a_plain_template_prints_what_jinja_prints(beside, template, monkeypatch):
    (beside / "some.j2").write_text(template, encoding="utf-8")
    wanted = by_jinja(beside, template)
    assert Templates(beside).fill("some.j2", **VALUES) == wanted
    # What was compiled is run without it.
    monkeypatch.delattr(Environment, "compile")
    assert Templates(beside).fill("some.j2", **VALUES) == wanted


@pytest.mark.parametrize("template", OTHERS)
def test_what_else_a_template_can_say_is_left_to_jinja(beside, template):
    (beside / "some.j2").write_text(template, encoding="utf-8")
    assert Templates(beside).fill("some.j2", **VALUES) == by_jinja(beside, template)
