"""Checks of the core before and after a generator runs."""

import logging
from dataclasses import replace
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen.api import ALL_FEATURES, Feature, Generator, OutputFile
from swarmdsl.codegen.emit import Request, emit
from swarmdsl.ir import Literal, State, StateKind, StateMachine, System, TimeTrigger, Transition
from swarmdsl.syntax.types import DURATION

SOURCE = Source("m.swarm", "after 1 s, after 2 s")


def after(start: int) -> Transition:
    delay = Literal(1, DURATION)
    trigger = TimeTrigger(delay, Span(SOURCE, start, start + 9))
    return Transition((trigger,), None, (), "End")


TIMED = System(
    "timed",
    machines=(
        StateMachine(
            "M",
            "A",
            (
                State("A", "A", StateKind.SIMPLE, transitions=(after(0), after(11))),
                State("End", "End", StateKind.FINAL),
            ),
        ),
    ),
)
EMPTY = System("empty")


def generator(target: str, *paths: str, supports=ALL_FEATURES) -> Generator:
    def made(system, options, report):
        return [path if isinstance(path, OutputFile) else OutputFile(path, "") for path in paths]

    return Generator(target, "A stub", made, supports=supports)


def run(system: System, *requests: Request):
    report = Diagnostics()
    return emit(system, requests, report), list(report)


def names(found) -> list[str]:
    return [diagnostic.name for diagnostic in found]


def test_the_files_of_each_target_in_the_order_of_the_requests(built_in):
    built_in(generator("a", "x", "y/z"))
    built_in(generator("b", "x"))
    output, found = run(EMPTY, Request("b"), Request("a"))
    assert found == []
    assert {target: [file.path for file in files] for target, files in output.items()} == {
        "b": ["x"],
        "a": ["x", "y/z"],
    }
    assert list(output) == ["b", "a"]


def test_an_unknown_target_comes_with_a_suggestion(built_in):
    built_in(generator("smach", "x"))
    _, (found,) = run(EMPTY, Request("smatch"))
    assert (found.name, found.help) == ("unknown-target", "did you mean `smach`?")
    _, (found,) = run(EMPTY, Request("zzz"))
    assert found.help == "the targets are `smach`"


def test_a_construct_a_target_cannot_express_is_reported_at_each_place(built_in):
    built_in(generator("a", "x", supports=ALL_FEATURES - {Feature.TIMEOUT}))
    output, found = run(TIMED, Request("a"))
    assert output == {}
    assert [(one.name, one.primary.span.text) for one in found] == [
        ("unsupported-construct", "after 1 s"),
        ("unsupported-construct", "after 2 s"),
    ]
    assert found[0].message == "target `a` cannot express a transition after a time"


def test_machines_a_target_does_not_write_may_use_anything(built_in):
    able = generator("a", "x", supports=ALL_FEATURES - {Feature.TIMEOUT})
    built_in(replace(able, machines=lambda system: ()))
    output, found = run(TIMED, Request("a"))
    assert (list(output), found) == (["a"], [])


def test_a_target_nobody_asked_for_by_name_is_left_out(built_in):
    built_in(generator("a", "x", supports=ALL_FEATURES - {Feature.TIMEOUT}))
    built_in(generator("b", "x"))
    output, (found,) = run(TIMED, Request("a", required=False), Request("b", required=False))
    assert list(output) == ["b"]
    assert (found.name, found.severity.value) == ("target-left-out", "warning")
    assert found.primary.span.text == "after 1 s"
    assert found.notes == (
        "target `a` cannot express a transition after a time",
        "and 1 more: `--target a` shows them",
    )


def test_a_target_asked_for_by_name_is_not_left_out(built_in):
    built_in(generator("a", "x", supports=frozenset()))
    built_in(generator("b", "x"))
    _, found = run(TIMED, Request("a"), Request("a", {}, required=False), Request("b"))
    assert "unsupported-construct" in names(found)


def test_when_every_target_would_be_left_out_that_is_an_error(built_in):
    built_in(generator("a", "x", supports=frozenset()))
    _, found = run(TIMED, Request("a", required=False))
    assert set(names(found)) == {"unsupported-construct"}


def test_what_a_generator_finds_it_cannot_express_counts_too(built_in):
    def refuse(system, options, report):
        report.report("unsupported-construct", None, target="a", construct="this")
        return []

    built_in(Generator("a", "", refuse))
    built_in(generator("b", "x"))
    output, (found,) = run(EMPTY, Request("a", required=False), Request("b", required=False))
    assert (list(output), found.name) == (["b"], "target-left-out")


def test_no_file_is_a_warning(built_in):
    built_in(generator("a"))
    output, (found,) = run(EMPTY, Request("a"))
    assert output == {"a": []}
    assert (found.name, found.severity.value) == ("nothing-to-generate", "warning")


@pytest.mark.parametrize("path", ["/etc/x", "../x", "a/../../x", "C:\\x", ""])
def test_a_path_outside_is_an_error(built_in, path):
    built_in(generator("a", path))
    _, found = run(EMPTY, Request("a"))
    assert names(found) == ["outside-output"]


@pytest.mark.parametrize(
    "paths", [("x", "x"), ("Robot.py", "robot.py"), ("a", "a/b"), ("a/b", "A"), ("d/e/f", "d/E")]
)
def test_files_that_would_be_one_are_an_error(built_in, paths):
    built_in(generator("t", *paths))
    _, found = run(EMPTY, Request("t"))
    assert names(found) == ["output-collision"]


def test_many_files_in_one_folder_do_not_clash(built_in):
    built_in(generator("t", "a/b", "a/c", "a/d/e", "b"))
    built_in(generator("u", "a/b"))
    _, found = run(EMPTY, Request("t"), Request("u"))
    assert found == []


def test_a_clash_shows_both_places(built_in):
    first, second = Span(SOURCE, 0, 5), Span(SOURCE, 11, 16)
    built_in(generator("t", OutputFile("X", "", origin=first), OutputFile("x", "", origin=second)))
    _, (found,) = run(EMPTY, Request("t"))
    assert found.primary.span == second
    assert [label.span for label in found.related] == [first]
    assert found.notes == ("the other one is `t/X`",)


def test_a_bug_in_a_built_in_generator_is_a_bug_of_ours(built_in):
    built_in(Generator("a", "", lambda system, options, report: 1 / 0))
    with pytest.raises(ZeroDivisionError):
        run(EMPTY, Request("a"))


CRASHING = """
from swarmdsl.codegen.api import Generator
def emit(system, options, report):
    yield from ()
    {body}
generator = Generator("x", "Crashes", emit)
"""


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("raise ValueError('two\\nlines')", "ValueError: two lines"),
        ("raise SystemExit", "SystemExit"),
        ("yield 7", "returned 7, not an `OutputFile`"),
    ],
)
def test_a_generator_of_others_that_fails_is_named(install, caplog, body, reason):
    install("x", CRASHING.format(body=body))
    with caplog.at_level(logging.DEBUG, "swarmdsl"):
        output, (found,) = run(EMPTY, Request("x"))
    assert (output, found.name) == ({}, "generator-failed")
    assert "target `x`" in found.message
    assert reason in found.message
    assert any(record.exc_info for record in caplog.records) == ("raise" in body)


def test_a_generator_of_others_that_cannot_name_its_machines_is_named(install):
    source = CRASHING.format(body="").replace("emit)", "emit, machines=lambda system: 1 / 0)")
    install("x", source)
    output, (found,) = run(EMPTY, Request("x"))
    assert (output, found.name) == ({}, "generator-failed")
    assert "ZeroDivisionError" in found.message


def test_a_broken_generator_that_nobody_asked_for_is_left_out(install, built_in):
    built_in(generator("a", "x"))
    install("x", CRASHING.format(body="1 / 0"))
    output, (found,) = run(EMPTY, Request("a", required=False), Request("x", required=False))
    assert list(output) == ["a"]
    assert found.name == "target-left-out"
    assert "ZeroDivisionError" in found.notes[0]


MODEL = (Path(__file__).parents[2] / "examples/minimal/blinker.swarm").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({}, "blinker [2..*]\n"),
        ({"style": "markdown"}, "- blinker [2..*]\n"),
        ({"title": "Who"}, "Who\nblinker [2..*]\n"),
        ({"indent": "2"}, "  blinker [2..*]\n"),
        ({"count": "false"}, "blinker\n"),
    ],
)
def test_options_reach_the_generator(roster, compiled, options, text):
    output, found = run(compiled(MODEL), Request("roster", options))
    assert found == []
    assert [(file.path, file.text) for file in output["roster"]] == [("Blinkers.txt", text)]


@pytest.mark.parametrize(
    ("options", "fault", "hint"),
    [
        ({"titel": "x"}, "there is no option `titel`", "did you mean `title`?"),
        (
            {"zzz": "x"},
            "there is no option `zzz`",
            "the options are `style`, `title`, `indent` and `count`",
        ),
        ({"style": "html"}, "option `style` takes `plain` or `markdown`, not `html`", None),
        ({"indent": "two"}, "option `indent` takes a whole number, not `two`", None),
        ({"indent": "9" * 5000}, f"option `indent` takes a whole number, not `{'9' * 5000}`", None),
        ({"indent": "41"}, "41 is no number of spaces: 0 to 40", None),
        ({"count": "yes"}, "option `count` takes `true` or `false`, not `yes`", None),
    ],
)
def test_options_that_a_target_does_not_take(roster, options, fault, hint):
    output, (found,) = run(EMPTY, Request("roster", options))
    assert output == {}
    assert found.name == "bad-option"
    assert found.message == f"target `roster`: {fault}"
    assert found.help == hint


def test_a_check_that_fails_is_a_fault_of_the_generator(install):
    install(
        "odd",
        """from dataclasses import dataclass
from swarmdsl.codegen.api import Generator, option
@dataclass(frozen=True)
class Options:
    n: int = option(1, "A number.", check=lambda n: 1 // n and None)
generator = Generator("odd", "A summary", lambda system, options, report: [], Options)
""",
    )
    _, found = run(EMPTY, Request("odd", {"n": "0"}))
    assert [one.name for one in found] == ["generator-failed"]
    assert "check of option `n` ends with ZeroDivisionError" in found[0].message


def test_requests_for_one_target_add_up(roster, compiled):
    output, found = run(
        compiled(MODEL),
        Request("roster", {"count": "false"}),
        Request("roster", {"title": "T"}),
        Request("roster", {"title": "T"}),
    )
    assert found == []
    assert output["roster"][0].text == "T\nblinker\n"


def test_requests_for_one_target_must_not_differ(roster):
    _, found = run(EMPTY, Request("roster", {"title": "A"}), Request("roster", {"title": "B"}))
    assert "bad-option" in names(found)
    assert any("`A` and as `B`" in one.message for one in found)
