"""Discovery of generators: a broken one is named and does not affect others."""

import subprocess
import sys

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator
from swarmdsl.codegen.target_info import all_targets, as_json, as_page, one_target

GOOD = """
from swarmdsl.codegen.api import Generator, OutputFile
generator = Generator({target!r}, "A summary", lambda system, options, report: [])
"""


def test_an_installed_package_brings_its_target(roster):
    assert registry.target_names() == [*registry.BUILT_IN, "roster"]
    generator = registry.load("roster")
    assert isinstance(generator, Generator)
    assert generator.summary == "Who is in a swarm"


def test_no_such_target():
    assert registry.load("nowhere") is None


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("import nowhere_at_all", "ModuleNotFoundError: No module named 'nowhere_at_all'"),
        ("def (", "SyntaxError"),
        ("raise SystemExit(7)", "SystemExit: 7"),
        ("1 / 0", "ZeroDivisionError: division by zero"),
        ("other = 1", "AttributeError"),
        ("generator = 7", "an object of class `int`, not a `Generator`"),
        (GOOD.format(target="other"), "its `target` is `other`"),
        (
            GOOD.format(target="x").replace("[])", "[], api_version=99)"),
            "version 99 of the generator API, not 1",
        ),
        (
            GOOD.format(target="x").replace("[])", "[], options_type=int)"),
            "`options_type` is not a dataclass",
        ),
        (
            "from dataclasses import dataclass\n@dataclass\nclass O:\n  a: float = 1.0\n"
            + GOOD.format(target="x").replace("[])", "[], options_type=O)"),
            "option `a` is neither",
        ),
        (
            "from dataclasses import dataclass\n@dataclass\nclass O:\n  a: int\n"
            + GOOD.format(target="x").replace("[])", "[], options_type=O)"),
            "option `a` has no default",
        ),
        (
            "from dataclasses import dataclass\nfrom swarmdsl.codegen.api import option\n"
            "@dataclass\nclass O:\n  a: int = option(1, '', only='b=2')\n"
            + GOOD.format(target="x").replace("[])", "[], options_type=O)"),
            "option `a` counts only with an option `b`, which does not exist",
        ),
    ],
)
def test_a_broken_generator_harms_no_other(built_in, install, roster, source, reason):
    install("x", source)
    broken = registry.load("x")
    assert isinstance(broken, registry.Broken)
    assert reason in broken.reason
    report = Diagnostics()
    assert "roster" in [generator.target for generator in all_targets(report)]
    assert [(found.name, "`x`" in found.message) for found in report] == [
        ("broken-generator", True)
    ]
    asked = Diagnostics()
    assert one_target("x", asked) == []
    assert [found.name for found in asked] == ["generator-failed"]


def test_a_name_that_cannot_be_a_folder_is_refused(install):
    install("../evil", GOOD.format(target="../evil"), module="evil")
    assert isinstance(registry.load("../evil"), registry.Broken)


def test_two_packages_for_one_target_are_named(install):
    install("x", GOOD.format(target="x"), module="one")
    install("x", GOOD.format(target="x"), module="two")
    broken = registry.load("x")
    assert isinstance(broken, registry.Broken)
    assert "one:generator" in broken.reason
    assert "two:generator" in broken.reason


def test_a_built_in_target_cannot_be_replaced(built_in, install):
    built_in(Generator("x", "The real one", lambda system, options, report: []))
    install("x", GOOD.format(target="x"))
    report = Diagnostics()
    assert [generator.summary for generator in all_targets(report)] == ["The real one"]
    assert [found.name for found in report] == ["broken-generator"]


def test_the_built_in_targets_work():
    report = Diagnostics()
    assert [generator.target for generator in all_targets(report)] == list(registry.BUILT_IN)
    assert len(report) == 0


def test_a_built_in_target_is_found_without_the_list_of_packages():
    code = (
        "import sys\nfrom swarmdsl.codegen import registry\n"
        "registry.BUILT_IN['x'] = 'builtins:int'\nregistry.load('x')\n"
        "sys.exit('importlib.metadata' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_the_page_of_a_target(roster):
    (generator,) = one_target("roster", Diagnostics())
    assert as_page(generator) == (
        "roster: Who is in a swarm\n"
        "\n"
        "options, given as `--option roster.NAME=VALUE`\n"
        "  style: How a role is written.\n"
        '    takes `plain` or `markdown`; default: "plain"\n'
        "  title: A first line.\n"
        '    takes a string; default: ""\n'
        "  indent: Spaces before each role.\n"
        "    takes a whole number; default: 0\n"
        "  count: Whether to say how many.\n"
        "    takes `true` or `false`; default: true\n"
        "\n"
        "cannot express\n"
        "  a transition after a time\n"
    )


def test_json_of_a_target(roster):
    import json

    (found,) = json.loads(as_json(one_target("roster", Diagnostics())))
    assert found["name"] == "roster"
    assert found["options"][0] == {
        "name": "style",
        "type": "str",
        "default": "plain",
        "choices": ["plain", "markdown"],
        "help": "How a role is written.",
    }
    assert found["cannot_express"] == ["a transition after a time"]
