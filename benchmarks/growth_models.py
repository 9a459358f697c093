"""Models of any size: each family repeats one construct, in one place or side by side.

A family returns the files of a model with `count` of the construct. The same count gives the same
text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

Files = Mapping[str, str]
Family = Callable[[int], Files]
"""Text of each file of a model with that many of a construct."""

MODEL = "model.swarm"

_HEAD = """\
package growing

event Go : std_msgs/Empty
event Num : std_msgs/Int32
"""


def model(body: str) -> Files:
    """Return a model of one file, with the events `Go` and `Num`."""
    return {MODEL: f"{_HEAD}\n{body}\n"}


def repeated(pattern: str, count: int) -> str:
    """Repeat lines; `<i>` is the number of each, `<j>` that of the next."""
    return "\n".join(
        pattern.replace("<i>", str(number)).replace("<j>", str(number + 1))
        for number in range(count)
    )


def machine(pattern: str, around: str, values: str = "") -> Family:
    """Return a machine with that many lines in place of `<>`; `<n>` is their number."""

    def files(count: int) -> Files:
        body = f"statemachine M {{\n{values}\n{around}\n  final F\n}}\n"
        return model(body.replace("<>", repeated(pattern, count)).replace("<n>", str(count)))

    return files


def declared(pattern: str, tail: str = "") -> Family:
    """Return that many declarations, before others."""
    return lambda count: model(repeated(pattern, count) + "\n" + tail.replace("<n>", str(count)))


_IN_S = "  initial S0\n  state S0 {\n<>\n    on Go -> F\n  }"
_CHAIN_END = "  state S<n> { on Go -> F }"
_CHAIN = f"  initial S0\n<>\n{_CHAIN_END}"


def _triggers(count: int) -> Files:
    """Events that one transition waits for."""
    return model(
        repeated("event E<i> : std_msgs/Empty", count)
        + "\nstatemachine M {\n  initial S0\n  state S0 {\n    on "
        + ", ".join(f"E{number}" for number in range(count))
        + " -> F\n  }\n  final F\n}\n"
    )


def _guarded_targets(count: int) -> Files:
    """Guarded transitions to states of their own."""
    return model(
        "statemachine M {\n  initial S0\n  state S0 {\n"
        + repeated("    on Num [event.data == <i>] -> S<j>", count)
        + "\n    on Go -> F\n  }\n"
        + repeated("  state S<j> { on Go -> S0 }", count)
        + "\n  final F\n}\n"
    )


def _done(count: int) -> Files:
    """Return the ends of a composite state, with a transition each."""
    return model(
        "statemachine M {\n  initial S0\n  state S0 {\n    initial A0\n"
        + repeated("    state A<i> {\n      on Go -> A<j>\n      on Num -> E<i>\n    }", count)
        + f"\n    state A{count} {{ on Go -> E0 }}\n"
        + repeated("    final E<i>", count)
        + "\n"
        + repeated("    on done.E<i> -> F<i>", count)
        + "\n  }\n"
        + repeated("  final F<i>", count)
        + "\n}\n"
    )


def _region_events(count: int) -> Files:
    """Regions of one parallel state, each with a transition out."""
    return model(
        repeated("event E<i> : std_msgs/Empty", count)
        + "\nstatemachine M {\n  initial P\n  parallel state P {\n"
        + repeated(
            "    region R<i> {\n      initial A\n      state A { on E<i> -> F }\n    }",
            count,
        )
        + "\n  }\n  final F\n}\n"
    )


def _parallels(count: int) -> Files:
    """Parallel states in a row, left from inside their regions."""
    one = (
        "  parallel state S<i> {\n"
        "    region Left {\n      initial A\n      state A { on Go -> B }\n"
        "      state B { on Num -> S<j> }\n    }\n"
        "    region Right {\n      initial A\n      state A { on Num -> S<j> }\n    }\n  }"
    )
    return model(
        "statemachine M {\n  initial S0\n"
        + repeated(one, count)
        + f"\n  state S{count} {{ on Go -> F }}\n  final F\n}}\n"
    )


def _branches(count: int) -> Files:
    """Branches of one choice, to states of their own."""
    return model(
        "statemachine M {\n  var x : int32 = 0\n  initial S0\n"
        "  state S0 { on Num / x = event.data -> C }\n  choice C {\n"
        + repeated("    [x == <i>] -> S<j>", count)
        + "\n    else -> F\n  }\n"
        + repeated("  state S<j> { on Go -> S0 }", count)
        + "\n  final F\n}\n"
    )


def _members(count: int) -> Files:
    """Members with a machine, parts and a role each."""
    return model(
        "sensor Eye { out seen : std_msgs/Int32 }\n"
        "controller Pilot { in seen : std_msgs/Int32; param gain : float64 = 1.0 }\n"
        + repeated(
            "statemachine M<i> {\n  param speed : float64 = 1.0\n  initial S0\n"
            "  state S0 { on Num -> F }\n  final F\n}\n"
            "member R<i> {\n  behavior M<i>\n  param speed : float64 = 2.0\n  eye : Eye\n"
            "  pilot : Pilot { gain = 2.0 }\n  connect eye.seen -> pilot.seen\n}",
            count,
        )
        + "\nswarm All {\n"
        + repeated("  r<i> : R<i>[2]", count)
        + "\n}\n"
    )


def _functions(count: int) -> Files:
    """Functions, each called by a member of its own kind."""
    return model(
        repeated(
            'function f_<i> : abstraction {\n  action "f_<i>" : p_msgs/A<i>\n'
            '  in "in_<i>" : std_msgs/Int32\n  param p : int32 = 1\n}\n'
            "action p_msgs/A<i> { goal { g : uint8 } result { r : uint8 } }\n"
            "statemachine M<i> {\n  initial S0\n  state S0 {\n    do f_<i>(g = 1)\n"
            "    on succeeded, aborted -> F\n  }\n  final F\n}\n"
            "member R<i> { behavior M<i> }",
            count,
        )
        + "\nswarm All {\n"
        + repeated("  r<i> : R<i>", count)
        + "\n}\n"
    )


def _activities(count: int) -> Files:
    """States of one machine that call functions of their own."""
    return model(
        repeated(
            'function f_<i> : abstraction { action "f_<i>" : p_msgs/A<i> }\n'
            "action p_msgs/A<i> { goal { g : uint8 } result { r : uint8 } }",
            count,
        )
        + "\nstatemachine M {\n  var v : uint8\n  initial S0\n"
        + repeated(
            "  state S<i> {\n    do f_<i>(g = 1) gives (r => v)\n    on succeeded [v > 1] -> S<j>\n"
            "    on succeeded, aborted -> F\n  }",
            count,
        )
        + f"\n  state S{count} {{ on Go -> F }}\n  final F\n}}\n"
    )


_DEPTH = 25


def _nested(count: int) -> Files:
    """Towers of states in each other, to a depth of 25."""
    towers = 1 + count // _DEPTH
    inside = "".join(f"state S{at} {{ initial S{at + 1}\non Num -> F\n" for at in range(_DEPTH))
    leaf = f"state S{_DEPTH} {{ on Go -> T<j> }}\n{'}' * _DEPTH}"
    return model(
        "statemachine M {\n  initial T0\n"
        + repeated(f"  state T<i> {{ initial S0\n{inside}{leaf}\n}}", towers)
        + f"\n  state T{towers} {{ on Go -> F }}\n  final F\n}}\n"
    )


def _files(count: int) -> Files:
    """Files, each imported by the one before."""
    files = {}
    for number in range(count):
        name = MODEL if number == 0 else f"part{number}.swarm"
        following = f'import "part{number + 1}.swarm"\n' if number + 1 < count else ""
        first = "event Go : std_msgs/Empty\n" if number == 0 else ""
        used = number + 1 if number + 1 < count else number
        files[name] = (
            f"package part{number}\n{following}{first}const K{number} : int32 = {number}\n"
            f"event E{number} : std_msgs/Int32\n"
            f"statemachine M{number} {{\n  initial S0\n"
            f"  state S0 {{ on E{used} [event.data == K{used}] -> F }}\n  final F\n}}\n"
            f"member R{number} {{ behavior M{number} }}\n"
        )
    return files


def _roles(count: int) -> Files:
    """Roles of one swarm that receive what another one sends."""
    return model(
        "message Told { header : std_msgs/Header, swarmio : swarmros/EventHeader, n : int32 }\n"
        "swarm event Tell : Told\n"
        "statemachine M {\n  initial S0\n  state S0 { on Tell -> F }\n  final F\n}\n"
        "statemachine N {\n  initial S0\n  state S0 { on Go / send Tell(n = 1) -> F }\n"
        "  final F\n}\nmember R { behavior M }\nmember Q { behavior N }\nswarm All {\n  q : Q\n"
        + repeated("  r<i> : R", count)
        + "\n}\n"
    )


def _events(count: int) -> Files:
    """Swarm events that one machine sends and receives."""
    return model(
        "message Told { header : std_msgs/Header, swarmio : swarmros/EventHeader }\n"
        + repeated("swarm event E<i> : Told", count)
        + "\nstatemachine M {\n  initial S0\n"
        + repeated("  state S<i> { on E<i> / send E<i>() -> S<j> }", count)
        + f"\n  state S{count} {{ on Go -> F }}\n  final F\n}}\n"
        + "member R { behavior M }\nswarm All { r : R[2] }\n"
    )


def _parts(count: int) -> Files:
    """Parts of one member and their connectors."""
    return model(
        "sensor C { out a : std_msgs/Int32 }\nactuator D { in a : std_msgs/Int32 }\n"
        "member R {\n"
        + repeated("  c<i> : C\n  d<i> : D\n  connect c<i>.a -> d<i>.a", count)
        + "\n}\nswarm All { r : R }\n"
    )


def _reused(count: int) -> Files:
    """Submachine states of one machine."""
    return model(
        "statemachine Inner {\n  param p : int32 = 1\n  var v : int32 = 0\n  initial A\n"
        "  state A { on Num [event.data > p] / v = v + 1 -> B }\n"
        "  state B { on Go [v > p] -> Z }\n  final Z\n}\n"
        "statemachine M {\n  initial S0\n"
        + repeated("  state S<i> = Inner(p = <i>) { on done.Z -> S<j> }", count)
        + f"\n  state S{count} {{ on Go -> F }}\n  final F\n}}\n"
    )


def _effects(count: int) -> Files:
    """Effects of one transition, on variables of their own."""
    return model(
        "statemachine M {\n"
        + repeated("  var x<i> : int32 = 0", count)
        + "\n  initial S0\n  state S0 {\n    on Num /\n"
        + repeated("      x<i> = event.data,", count)
        + "\n      x0 = x0 + 1 -> S1\n  }\n  state S1 {\n"
        + repeated("    [x<i> > 1] -> F", count)
        + "\n    on Go -> F\n  }\n  final F\n}\n"
    )


def _variables(count: int) -> Files:
    """Variables and params of one machine, with a guard on each."""
    return model(
        "statemachine M {\n"
        + repeated("  param p<i> : int32 = <i>\n  var v<i> : int32 = <i>", count)
        + "\n  initial S0\n  state S0 {\n"
        + repeated("    on Num [v<i> > p<i>] / v<i> = event.data -> F", count)
        + "\n    on Go -> F\n  }\n  final F\n}\nmember R { behavior M }\nswarm All { r : R }\n"
    )


def _long_documentation(count: int) -> Files:
    """Lines of the documentation of one state, with names to resolve and Markdown."""
    return model(
        "statemachine M {\n  initial S0\n"
        + repeated("  /// Line <i> of `S1` and *others*, as in `M`; see `Go`.", count)
        + "\n  state S0 { on Go -> S1 }\n  state S1 { on Num -> F }\n  final F\n}\n"
    )


def _long_text(count: int) -> Files:
    """Characters of one text."""
    return model(
        f'const T : string = "{"some text " * count}"\n'
        "event Said : std_msgs/String\n"
        "statemachine M {\n  initial S0\n  state S0 { on Said [event.data == T] -> F }\n"
        "  final F\n}\n"
    )


def _sends(count: int) -> Files:
    """Events that one transition sends."""
    return model(
        "message Told { header : std_msgs/Header, swarmio : swarmros/EventHeader, n : int32 }\n"
        "swarm event Tell : Told\n"
        "statemachine M {\n  initial S0\n  state S0 {\n    on Go /\n"
        + repeated("      send Tell(n = <i>),", count)
        + "\n      send Tell(n = 0) -> F\n    on Tell -> F\n  }\n  final F\n}\n"
        "member R { behavior M }\nswarm All { r : R[2] }\n"
    )


def _arguments(count: int) -> Files:
    """Arguments of one call."""
    numbers = ", ".join(f"x + {number}" for number in range(count + 1))
    return model(
        "statemachine M {\n  var x : int32 = 0\n  initial S0\n"
        f"  state S0 {{ on Num [max({numbers}) > 5] / x = event.data -> F }}\n  final F\n}}\n"
    )


FAMILIES: Mapping[str, Family] = {
    "states in a row": machine("  state S<i> { on Go -> S<j> }", _CHAIN),
    "states that go back": machine(
        "  state S<i> {\n    on Go -> S<j>\n    on Num -> S0\n  }", _CHAIN
    ),
    "guarded transitions": machine("    on Num [event.data == <i>] -> F", _IN_S),
    "guards of two terms": machine(
        "    on Num [event.data == <i> and x < <i>] / x = x + 1 -> F", _IN_S, "  var x : int32 = 0"
    ),
    "guarded transitions to states": _guarded_targets,
    "triggers of one transition": _triggers,
    "delays": machine("    after <j> s -> F", _IN_S),
    "monitors": machine('    monitor "topic/t<i>" : std_msgs/Int32 [event.data > 1] -> F', _IN_S),
    "effects": _effects,
    "events sent": _sends,
    "variables and params": _variables,
    "final states with done": _done,
    "regions with events out": _region_events,
    "parallel states in a row": _parallels,
    "eventless chain": machine("  state S<i> { on done -> S<j> }", _CHAIN),
    "eventless chain with guards": machine(
        "  state S<i> {\n    [x > <i>] / x = x + 1 -> S<j>\n    on Num / x = event.data\n  }",
        _CHAIN,
        "  var x : int32 = 0",
    ),
    "choices in a row": machine(
        "  choice S<i> {\n    [x > <i>] / x = x + 1 -> F\n    else -> S<j>\n  }",
        f"  initial T\n  state T {{ on Num / x = event.data -> S0 }}\n<>\n{_CHAIN_END}",
        "  var x : int32 = 0",
    ),
    "branches": _branches,
    "histories": machine(
        "  state S<i> {\n    initial A\n    state A { on Go -> B }\n    state B { on Go -> A }\n"
        "    history Back -> A\n    on Num -> W<i>\n  }\n"
        "  state W<i> {\n    on Go -> S<i>.Back\n    on Num -> S<j>\n  }",
        _CHAIN,
    ),
    "nested states": _nested,
    "submachine states": _reused,
    "activities": _activities,
    "arguments of a call": _arguments,
    "machines": declared(
        "statemachine M<i> {\n  initial S0\n  state S0 { on Go -> F }\n  final F\n}"
    ),
    "members": _members,
    "roles": _roles,
    "functions of members": _functions,
    "parts and connectors": _parts,
    "swarm events": _events,
    "addresses": lambda count: model(
        "swarm event Told : std_msgs/Empty\n"
        + repeated(
            "endless statemachine M<i> {\n  initial S\n"
            "  state S { on Told / send Told to r<i> }\n}\n"
            "member R<i> { behavior M<i> }",
            count,
        )
        + "\nswarm Team {\n"
        + repeated("  r<i> : R<i>", count)
        + "\n}\n"
    ),
    "fields of a struct": lambda count: model(
        "struct T {\n" + repeated("  f<i> : float64", count) + "\n}\nevent Told : T\n"
        "statemachine M {\n  initial S0\n  state S0 { on Told -> F }\n  final F\n}\n"
    ),
    "structs": declared(
        "struct T<i> { a : T<j> }",
        "struct T<n> { a : int32 }\nevent Told : T0\n"
        "statemachine M {\n  initial S0\n  state S0 { on Told -> F }\n  final F\n}\n",
    ),
    "values of an enum": lambda count: model(
        "enum E : uint32 {\n" + repeated("  V<i>", count + 1) + "\n}\n"
        "statemachine M {\n  var e : E = E.V0\n  initial S0\n  state S0 {\n"
        + repeated("    on Num [e == E.V<i>] / e = E.V<j> -> S0", count)
        + "\n    on Go -> F\n  }\n  final F\n}\n"
    ),
    "constants": declared(
        "const K<i> : int32 = K<j>",
        "const K<n> : int32 = 1\n"
        "statemachine M {\n  initial S0\n  state S0 { on Num [event.data > K0] -> F }\n"
        "  final F\n}\n",
    ),
    "documentation": machine(
        "  /// Wait for a `Go` of *somebody*, number <i>.\n  state S<i> { on Go -> S<j> }",
        _CHAIN,
    ),
    "lines of documentation": _long_documentation,
    "length of a text": _long_text,
    "files": _files,
}
