"""Layout, by example."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest

import swarmdsl.syntax.formatter as swarm_format
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.formatter import MeaningChangedError, format_source
from swarmdsl.syntax.formatter.tokens import Kind, tokenize

HERE = Path(__file__).parent


def layout(text: str) -> str | None:
    return format_source(Source("model", text), Diagnostics())


def machine(*lines: str) -> str:
    """A state with these lines in it."""
    inside = "".join(f"    {line}\n" for line in lines)
    return f"statemachine M {{\n  state S {{\n{inside}  }}\n}}\n"


def test_everything(bless):
    """One file with every construct, written as badly as possible."""
    result = layout((HERE / "everything.swarm").read_text(encoding="utf-8"))
    assert result is not None
    expected = HERE / "everything.formatted.swarm"
    if bless:
        expected.write_text(result, encoding="utf-8")
    assert result == expected.read_text(encoding="utf-8")


def test_the_examples_are_formatted(examples):
    for path in sorted(examples.rglob("*.swarm")):
        text = path.read_text(encoding="utf-8")
        assert layout(text) == text, path


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("", ""),
        (" \n\n", ""),
        ("\n\n// only this", "// only this\n"),
        ("event A:B", "event A : B\n"),
        ("const A : int8=1-  -2*-(3+x)", "const A : int8 = 1 - -2 * -(3 + x)\n"),
        ('const A : string = "a  //b"', 'const A : string = "a  //b"\n'),
        ("message M { a : x_y /Z [ <= 3 ] }", "message M { a : x_y/Z[<=3] }\n"),
        ("enum E { A = - 1 }", None),
        ("event A : ", None),
    ],
)
def test_short_files(written, expected):
    assert layout(written) == expected


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("struct A {\n\n}", "struct A { }\n"),
        ("struct A {a : B}", "struct A { a : B }\n"),
        ("struct A {\na : B}", "struct A {\n  a : B\n}\n"),
        ("struct A {a : B, c : D}", "struct A {\n  a : B\n  c : D\n}\n"),
        ("enum A {B, C}", "enum A { B, C }\n"),
        ("struct A { /* none */ }", "struct A { /* none */ }\n"),
        ("struct A { // none\n}", "struct A {  // none\n}\n"),
        (
            f"struct A {{ {'a' * 80} : {'B' * 20} }}",
            f"struct A {{\n  {'a' * 80} : {'B' * 20}\n}}\n",
        ),
    ],
)
def test_blocks_on_one_line(written, expected):
    assert layout(written) == expected


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("event A : B\nevent C : D", "event A : B\nevent C : D\n"),
        ("event A : B\n\n\n\nevent C : D", "event A : B\n\nevent C : D\n"),
        ("event A : B\ntype C = D", "event A : B\n\ntype C = D\n"),
        ("struct A { }\n// of b\nevent B : C", "struct A { }\n\n// of b\nevent B : C\n"),
        ("struct A { }\n// of a\n\nevent B : C", "struct A { }\n// of a\n\nevent B : C\n"),
        ("struct A {\n\n  a : B\n\n\n  c : D\n\n}", "struct A {\n  a : B\n\n  c : D\n}\n"),
    ],
)
def test_blank_lines(written, expected):
    assert layout(written) == expected


def test_columns_end_at_blank_lines_and_longer_items_but_not_at_comments():
    text = dedent("""\
        struct A {
          a    : B
          // of the next one
          long : C

          x  : D
          yy : E
        }
        """)
    assert layout(text.replace("    : B", " : B").replace("x  :", "x :")) == text


def test_arrows_behind_guards_and_effects_stay_where_they_are():
    text = machine("on done -> A", "on E [x > 1] / y = 2 -> B", "on E    -> C")
    assert layout(text.replace("E    ->", "E ->")) == text


def test_a_long_name_does_not_push_its_neighbours_away():
    text = f"struct A {{\n  {'a' * 41} : B\n  c  : D\n  ee : F\n}}\n"
    assert layout(text) == text


@pytest.mark.parametrize(
    ("written", "lines"),
    [
        (
            f"do f({'a' * 30} = {'b' * 30}) gives (x => {'c' * 30})",
            (f"do f({'a' * 30} = {'b' * 30})", f"  gives (x => {'c' * 30})"),
        ),
        (
            f"do f({'a' * 30} = {'b' * 30}, {'c' * 30} = 1)",
            ("do f(", f"    {'a' * 30} = {'b' * 30},", f"    {'c' * 30} = 1)"),
        ),
        (
            f"on E [{'a' * 40}] / x = {'b' * 30}, y = {'c' * 30} -> D",
            (f"on E [{'a' * 40}]", f"  / x = {'b' * 30}, y = {'c' * 30} -> D"),
        ),
        (
            f"on E [{'a' * 40} and {'b' * 30} or {'c' * 30}] -> D",
            (f"on E [{'a' * 40}", f"    and {'b' * 30}", f"    or {'c' * 30}] -> D"),
        ),
        (f"on {'A' * 100} -> B", (f"on {'A' * 100} -> B",)),
    ],
)
def test_long_lines_are_broken(written, lines):
    assert layout(machine(written)) == machine(*lines)


def test_comments_keep_a_list_broken():
    lines = ("do f(", "    a = 1,  // first", "    // of b", "    b = 2)", "  gives by g")
    written = ("do f(a = 1, // first", "// of b", "b = 2) gives by g")
    assert layout(machine(*written)) == machine(*lines)


def test_comments_behind_lines_stand_below_each_other():
    text = machine("on A -> BB  // one", "on C -> D   // two", "on EE -> F")
    aligned = text.replace("A ->", "A  ->").replace("C ->", "C  ->")
    assert layout(text) == aligned


def test_lines_of_a_comment_that_begin_with_stars_move_with_it():
    assert layout("struct A {\n/* a\n      * b */\nc : D }") == (
        "struct A {\n  /* a\n   * b */\n  c : D\n}\n"
    )


def test_tokens_are_the_whole_text():
    text = 'a1 /* x\n */ "b // \\" c" 1.5e-3 <=.. -> // end \n\u00e9'
    tokens = tokenize(text)
    assert "".join(token.text for token in tokens) == (
        'a1/* x\n */"b // \\" c"1.5e-3<=..->// end\u00e9'
    )
    assert [token.kind for token in tokens][:4] == [
        Kind.WORD,
        Kind.BLOCK_COMMENT,
        Kind.STRING,
        Kind.NUMBER,
    ]


def test_a_layout_that_changes_the_content_is_refused(monkeypatch):
    monkeypatch.setattr(swarm_format, "render_lines", lambda _lines: "event A : C\n")
    with pytest.raises(MeaningChangedError):
        layout("event A : B")


def test_separators_end_no_line_and_divide_values():
    text = """\
        enum Level { LOW; HIGH = 3, }
        enum Wide { ONE,
          TWO; THREE }
        event Start : std_msgs/Empty; event Stop : std_msgs/Empty;
        member Rover { behavior M; eye : Camera { rate = 1.0; zoom = 2 }; }
        member Tug { communication zyre { /* c */ port = 1; name = "a", } }
        statemachine M {
          initial S;
          state S { on Start / x = 1, y = 2; after 1 s -> S };
        }
    """

    assert layout(dedent(text)) == dedent(
        """\
        enum Level { LOW, HIGH = 3 }

        enum Wide {
          ONE
          TWO
          THREE
        }

        event Start : std_msgs/Empty
        event Stop  : std_msgs/Empty

        member Rover {
          behavior M
          eye : Camera { rate = 1.0, zoom = 2 }
        }

        member Tug { communication zyre { /* c */ port = 1, name = "a" } }

        statemachine M {
          initial S
          state S {
            on Start / x = 1, y = 2
            after 1 s -> S
          }
        }
        """
    )


def test_what_shares_a_line_is_divided_only_by_a_migration():
    text = (
        "event A : T event B : T\n"
        "enum E { ONE TWO } statemachine M { state S { on A / send B after 1 s -> S } }"
    )
    report = Diagnostics()

    assert format_source(Source("model", text), report) is None
    assert [found.name for found in report] == ["missing-separator"] * 2
    assert format_source(Source("model", text), Diagnostics(), migrate=True) == dedent(
        """\
        event A : T
        event B : T

        enum E { ONE, TWO }

        statemachine M {
          state S {
            on A / send B
            after 1 s -> S
          }
        }
        """
    )


def test_comments_stay_with_their_items_at_separators():
    text = """\
        const C : int32 = 3
        ; /// of C
        const D : int32 = 4; // of D
        statemachine M {
          initial W /* a */; state W { entry / x = 1 /* c */; exit / x = 2; /* e */ on A -> W }
        }
        enum E { A /* z */, /* y */ B }
    """

    assert layout(dedent(text)) == dedent(
        """\
        const C : int32 = 3  /// of C
        const D : int32 = 4  // of D

        statemachine M {
          initial W  /* a */
          state W {
            entry / x = 1  /* c */
            exit / x = 2
            /* e */ on A -> W
          }
        }

        enum E { A /* z */, /* y */ B }
        """
    )
