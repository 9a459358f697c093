"""From text to the syntax tree: names with their places, and what is left after a mistake."""

from __future__ import annotations

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import (
    Event,
    Expression,
    Function,
    NameUse,
    Node,
    OperatorUse,
    Param,
    Ref,
    State,
    StateMachine,
    Transition,
    Word,
    walk,
)
from swarmdsl.syntax.parse import Parsed, parse


def parsed(text: str) -> tuple[Parsed, list[str]]:
    report = Diagnostics()
    result = parse(Source("model.swarm", text), report)
    return result, [found.name for found in report]


def valid(text: str) -> list[Node]:
    result, names = parsed(text)
    assert names == []
    return list(walk(result.model))


MACHINE = """
event Start : std_msgs/Empty

/// Searches.
statemachine Search {
  var tries : int32 = 1 + 2 * 3
  initial Idle
  /// Waits.
  state Idle {
    on Start [tries < 3] / tries = tries + 1 -> Done
  }
  final Done
}
"""


def test_names_have_their_places() -> None:
    for node in valid(MACHINE):
        for attribute in node.__dataclass_fields__:
            value = getattr(node, attribute)
            if isinstance(value, Word) and not isinstance(node, Function):
                assert value.span.text == value
            if isinstance(value, Ref):
                assert value.span.text == value.name


def test_places_cover_the_whole_node() -> None:
    nodes = valid(MACHINE)
    transition = next(node for node in nodes if isinstance(node, Transition))
    machine = next(node for node in nodes if isinstance(node, StateMachine))

    assert transition.span.text == "on Start [tries < 3] / tries = tries + 1 -> Done"
    assert machine.span.text == MACHINE[MACHINE.index("statemachine") :].strip()


def test_references_are_recorded_and_not_resolved() -> None:
    transition = next(node for node in valid(MACHINE) if isinstance(node, Transition))

    assert (transition.target.name, transition.target.kind) == ("Done", "Vertex")
    assert transition.target.target is None


def test_documentation_goes_to_what_follows() -> None:
    docs = {
        str(node.name): node.doc
        for node in valid(MACHINE)
        if isinstance(node, (Event, StateMachine, State))
    }

    assert docs == {"Start": "", "Search": "Searches.", "Idle": "Waits."}


def test_expressions_are_trees_with_places_in_the_file() -> None:
    tree = next(node for node in valid(MACHINE) if isinstance(node, Expression)).tree

    assert isinstance(tree, OperatorUse)
    assert (tree.operator, tree.span.text) == ("+", "1 + 2 * 3")
    assert [operand.span.text for operand in tree.operands] == ["1", "2 * 3"]


def test_a_tree_is_walked_without_following_names() -> None:
    result, _ = parsed("member A { param x : int8 = y; param y : int8 = x }")
    before = list(walk(result.model))
    for node in before:
        if isinstance(node, NameUse):
            node.target = next(n for n in before if isinstance(n, Param) and n.name == node.name)

    assert list(walk(result.model)) == before


def test_a_text_has_its_escapes_replaced() -> None:
    event = next(n for n in valid(r'event A : b/C on "x\"y\\z\n"') if isinstance(n, Event))

    assert event.topic == 'x"y\\z\n'


def test_what_follows_a_wrong_declaration_is_kept() -> None:
    result, names = parsed("event A : b/C\nevent B b/C\nevent D : b/C\n")

    assert names == ["syntax-error"]
    assert [str(node.name) for node in result.model.declarations] == ["A", "B", "D"]
    assert "B" in result.skipped_names
    assert not result.incomplete  # nothing but a colon is missing


def test_what_surrounds_a_wrong_statement_is_kept() -> None:
    text = "statemachine M {\n initial A\n state A { on }\n state B {\n on -> A\n }\n final C\n}"
    result, names = parsed(text)
    (machine,) = result.model.declarations

    assert names == ["syntax-error", "syntax-error"]
    assert isinstance(machine, StateMachine)
    assert [getattr(item, "name", "-") for item in machine.items] == ["-", "A", "B", "C"]
    assert result.incomplete == {machine}
    assert "A" in result.skipped_names


def test_a_block_with_a_wrong_header_is_kept() -> None:
    text = "member M extends {\n  camera Camera {\n    x = 1\n  }\n  lamp : Lamp\n}\n"
    result, names = parsed(text)
    (member,) = result.model.declarations

    assert names == ["syntax-error", "syntax-error"]
    assert [str(item.name) for item in member.items] == ["camera", "lamp"]  # type: ignore[union-attr]
    assert result.incomplete == {member}


def test_what_is_missing_has_a_name_and_no_width() -> None:
    result, _ = parsed("statemachine {\n  state {\n    initial B\n    state B\n  }\n}\n")
    states = [node for node in walk(result.model) if isinstance(node, (StateMachine, State))]

    assert [state.name.span.text for state in states] == ["", "", "B"]
    assert len({str(state.name) for state in states}) == 3


def test_places_are_those_of_the_file_behind_a_repair() -> None:
    result, _ = parsed("event A b/C event D : b/E\nevent F : b/G\n")

    assert [node.name.span.text for node in result.model.declarations] == ["A", "D", "F"]
    assert result.model.declarations[0].span.text == "event A b/C"


def test_a_mistake_in_each_of_many_statements() -> None:
    _, names = parsed("member M {\n" + "  x y\n" * 5 + "}\n")

    assert names == ["syntax-error"] * 5


def test_the_package_and_imports_are_kept_too() -> None:
    result, names = parsed('package a.b\nimport "c.swarm"\nevent\nimport "d.swarm"\n')

    assert names == ["syntax-error", "syntax-error"]
    assert result.model.package is not None
    assert result.model.package.name == "a.b"
    assert [str(statement.path) for statement in result.model.imports] == ["c.swarm", "d.swarm"]


def test_whoever_changes_the_grammar_is_told_what_to_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("swarmdsl.syntax.parser.generated.GRAMMAR", 0)

    assert parsed("event A : B\n")[1] == []
    with pytest.warns(UserWarning, match="make parser"):
        parsed("event A B\n")


def test_missing_separators_are_told_beside_warnings() -> None:
    _, names = parsed("const A : int32 = 1 const B : int32 = 2  /// x\n")
    assert sorted(names) == ["missing-separator", "unattached-doc-comment"]


def test_missing_separators_are_told_in_each_file() -> None:
    report = Diagnostics()
    parse(Source("a.swarm", "const A : int32 =\n"), report)
    parse(Source("b.swarm", "const B : int32 = 1 const C : int32 = 2\n"), report)
    assert [found.name for found in report] == ["syntax-error", "missing-separator"]
