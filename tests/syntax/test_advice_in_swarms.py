"""Advice for mistakes of new users in models of swarms: a model that follows it is correct."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostic, Severity
from swarmdsl.driver import pipeline

MODEL = """package p

event Start : std_msgs/Empty
event Late : std_msgs/Empty
message Offer { number : int32, cost : float64 }
struct Plan { speed : float64 in m/s }
swarm event Bid : Offer
swarm event Ping : std_msgs/Empty

function carry : abstraction { service "carry" : std_srvs/Trigger }

statemachine M {
  param speed : float64 in m/s = 2 m/s
  param patience : duration = 9 s
  var n : int32
  var ys : Offer[<=9]
  var xs : int32[<=9]
  VARIABLE
  initial A
  state A {
    STATEMENT
    on Start -> B
  }
  state B {
    var tries : int32
    entry / tries = 1, append n to xs, send Bid(number = 1, cost = 2.0), send Ping
    on Start [tries > 1 and n > 0 and count(o in ys where o.number > 0) > 0] -> C
  }
  MACHINE
  final C
}
member Carrier { behavior M }
swarm S {
  HEARTBEAT
  carrier : Carrier[3]
  box : Carrier[2]
  SWARM
}
TOP
"""
BID = "send Bid(number = 1, cost = 2.0)"
HEARTBEAT = "heartbeat 1 s lost after 5 s"
# Where the mistake is, its line, the part of it that is wrong, and what the help has for it:
# `{0}` is what it has in the first backquotes.
MISTAKES = (
    ("STATEMENT", "on Start [present(carrier[1]) > 0] -> B", "present(carrier[1])", "{0}"),
    ("STATEMENT", 'on Start [present("carrier") > 0] -> B', 'present("carrier")', "{0}"),
    ("STATEMENT", "on Start [present(all) > 0] -> B", "present(all)", "{0}"),
    ("STATEMENT", "on Start [any(ys.number == 1)] -> B", "any(ys.number == 1)", "{0}"),
    ("STATEMENT", "on Start [all(ys.number == 1)] -> B", "all(ys.number == 1)", "{0}"),
    ("STATEMENT", "on Start [count(ys.number == n) > 0] -> B", "count(ys.number == n)", "{0}"),
    ("STATEMENT", "on Start / append min(ys.number) to ys", "min(ys.number)", "{0}"),
    ("STATEMENT", "on Start / n = max(xs)", "max(xs)", "{0}"),
    ("STATEMENT", "on Bid [count(o in ys where number == 1) > 0] -> B", "number", "{0}"),
    ("STATEMENT", "on Bid [event.sender == carrier[1]] -> B", "carrier[1]", "{0}"),
    ("STATEMENT", "on Bid [event.sender != carrier] -> B", "carrier", "{0}"),
    ("STATEMENT", "on member_lost [event.role == carrier] -> B", "carrier", "{0}"),
    ("STATEMENT", "on member_lost [event.id == carrier[0]] -> B", "carrier[0]", "{0}"),
    ("STATEMENT", "on Start [carrier == self.role] -> B", "carrier", "{0}"),
    ("STATEMENT", 'on member_lost [event.sender == "box[0]"] -> B', "event.sender", "{0}"),
    ("STATEMENT", "on Start / clear ys[0]", "clear ys[0]", "{0}"),
    ("STATEMENT", "on Start [self.idx == 0] -> B", "idx", "{0}"),
    ("STATEMENT", "on Start [self.id == 0] -> B", "self.id", "{0}"),
    ("STATEMENT", 'on Bid [event.from == "box[0]"] -> B', "from", "{2}"),
    ("STATEMENT", "on Start [ys.len > 0] -> B", "ys.len", "{0}"),
    ("STATEMENT", "on Start [xs.size > 0] -> B", "xs.size", "{0}"),
    ("STATEMENT", "on Start / n = ys.number", "ys.number", "{0}"),
    (
        "STATEMENT",
        "on Start / send Ping to box(number = 1)",
        "send Ping to box(number = 1)",
        "send Ping to box",
    ),
    ("STATEMENT", "on Start / send Ping to all", "to all", ""),
    ("TOP", "property P : each carrier : carrier in A leads to in B", "carrier in A", "in A"),
    # transitions
    ("STATEMENT", "on member_lost(carrier) -> B", "on member_lost(carrier)", "{0}"),
    ("STATEMENT", "on Bid(number) -> B", "on Bid(number)", "{0}"),
    ("STATEMENT", "on Bid(number = 1) -> B", "on Bid(number = 1)", "{0}"),
    ("STATEMENT", "on Start [n > 1] n = n + 1", "n = n + 1", "{0} n = n + 1"),
    ("STATEMENT", "on Start n = n + 1 -> B", "n = n + 1", "{0} n = n + 1"),
    ("STATEMENT", "after patience / n -> B", "after patience / n", "{1}"),
    ("STATEMENT", "on Start / wait 5 s", "on Start / wait 5 s", "{0}"),
    ("STATEMENT", "on Start [n in xs] -> B", "n in xs", "{0}"),
    ("STATEMENT", "on Start [xs [0] > 1] -> B", "xs [0]", "{0}"),
    ("STATEMENT", "on Bid / if n < 3 { n = 1 } -> B", "/ if n < 3 { n = 1 }", "[n < 3] / n = 1"),
    ("MACHINE", "choice K { [n > 1] -> A; -> B }", "-> B", "{0}"),
    ("MACHINE", "choice K {\n[n > 1] -> A\n-> B\n}", "-> B", "{0}"),
    ("MACHINE", "choice K { [n > 1] -> A; [else] -> B }", "[else] -> B", "{0}"),
    ("MACHINE", "on Start -> B", "on Start -> B", "state Z {{ on Start -> B }}"),
    ("MACHINE", "state Z {\nStart / n = 1 -> B\n}", "Start", "{0} Start"),
    ("MACHINE", "state Z { shallow history H; initial Y; state Y }", "shallow history H", "{0}"),
    ("STATEMENT", "on Start | Late -> B", " |", "{0}"),
    ("STATEMENT", "do carry -> B; on aborted -> B", "do carry ->", "do carry; on succeeded ->"),
    # expressions
    ("STATEMENT", "on Bid [number > 3] -> B", "number", "{0}"),
    ("STATEMENT", "on Bid / n = number", "number", "{0}"),
    ("STATEMENT", 'on Bid [sender == "box[0]"] -> B', "sender", "{0}"),
    ("STATEMENT", 'on member_lost [role == "box"] -> B', "role", "{0}"),
    ("STATEMENT", "on Bid [Bid.number > 3] -> B", "Bid.number", "{0}"),
    ("STATEMENT", "on Bid [event.number in xs] -> B", "event.number in xs", "{0}"),
    ("STATEMENT", "on Start [xs.contains(n)] -> B", "xs.contains(n)", "{0}"),
    ("STATEMENT", "on Start [xs.size() > 1] -> B", "xs.size()", "{0}"),
    ("STATEMENT", "on Start [xs.isEmpty()] -> B", "xs.isEmpty()", "{0}"),
    ("STATEMENT", "on Start [any(o in xs, o > 1)] -> B", ",", " {0}"),
    # effects
    ("STATEMENT", "on Start / n = 1 send Ping", " send", "{0} send"),
    ("STATEMENT", "on Start / if (n > 3) then n = 1", "/ if (n > 3) then", "[n > 3] /"),
    ("STATEMENT", "on Start / sleep(5 s)", "on Start / sleep(5 s)", "{0}"),
    ("STATEMENT", "on Bid / xs.clear()", "xs.clear()", "{0}"),
    ("STATEMENT", "on Bid / xs.remove(0)", "xs.remove(0)", "{0}"),
    (
        "STATEMENT",
        "on Start / send Bid number = 1",
        "Bid number = 1",
        "Bid(number = 1, cost = 2.0)",
    ),
    ("STATEMENT", f"on Start / {BID} to carrier [1]", "carrier [1]", "{0}"),
    ("STATEMENT", f"on Start / {BID} to carrier.0", "carrier.0", "{0}"),
    ("STATEMENT", f"on Start / {BID} to role carrier -> B", "to role carrier", "{0}"),
    ("STATEMENT", "on Start [self.id in carrier] -> B", "self.id in carrier", "{0}"),
    ("STATEMENT", f"on Start / {BID} to carrier, box", f"{BID} to carrier, box", "{0}"),
    (
        "STATEMENT",
        "on Start / Bid.send(number = 1, cost = 2.0)",
        "Bid.send(number = 1, cost = 2.0)",
        "{0}",
    ),
    ("STATEMENT", "on Start / Ping.send()", "Ping.send()", "{0}"),
    (
        "STATEMENT",
        "on Start / send(Bid, number = 1, cost = 2.0)",
        "send(Bid, number = 1, cost = 2.0)",
        "{0}",
    ),
    ("STATEMENT", "on Start / send(Ping)", "send(Ping)", "{0}"),
    ("STATEMENT", "on Start / send to box Ping", "send to box Ping", "{0}"),
    ("STATEMENT", "on Start / send Late in 5 s", "send Late in 5 s", "{0}"),
    ("STATEMENT", "on Bid / append xs, event.number", "append xs, event.number", "{0}"),
    ("STATEMENT", "on Bid / append xs event.number", "append xs event.number", "{0}"),
    ("STATEMENT", "on Bid / append event.number, xs", "append event.number, xs", "{0}"),
    ("STATEMENT", "on Bid / xs.append(event.number)", "xs.append(event.number)", "{0}"),
    ("STATEMENT", "on Bid / ys.append(event)", "ys.append(event)", "{0}"),
    ("STATEMENT", "on Bid / ys = []", "ys = []", "{0}"),
    ("VARIABLE", "var zs : int32[<=4] = []", "int32[<=4] = []", "{0}"),
    ("VARIABLE", "var far : float64 [m]", "float64 [m]", "{0}"),
    ("VARIABLE", "var far : float64 (m/s)", "float64 (m/s)", "{0}"),
    ("VARIABLE", "var far : float64 km", "float64 km", "{0}"),
    # swarms
    ("SWARM", "3 rover : Carrier", "3 rover : Carrier", "{0}"),
    ("HEARTBEAT", "heartbeat 1 s", "heartbeat 1 s", "{0}"),
    (
        "HEARTBEAT",
        "heartbeat every 1 s, lost after 5 s",
        "heartbeat every 1 s, lost after 5 s",
        "{0}",
    ),
    ("HEARTBEAT", "heartbeat 1 s, lost after 5 s", "heartbeat 1 s, lost after 5 s", "{0}"),
    ("HEARTBEAT", "heartbeat 1 s lost 5 s", "lost 5 s", "{0}"),
    ("TOP", "swarm event L : std_msgs/Empty { reliable latest }", " latest", ", latest"),
    ("TOP", "swarm event L : std_msgs/Empty [reliable]", "[reliable]", "{0}"),
    ("TOP", "swarm event L : std_msgs/Empty reliable", "reliable", "{0}"),
    ("TOP", "swarm event L : std_msgs/Empty best effort", "best effort", "{0}"),
    ("TOP", "swarm event L : std_msgs/Empty { reliable, keep = 5 }", "keep = 5", "{0}"),
    # properties
    ("TOP", "property P : count(carrier in B) <= 1", "<= 1", "<= 1 {0}"),
    ("TOP", "property P : some carrier in B", "some", "{2} some"),
    ("TOP", "property P : some carrier has n > 3 leads to box[0] in B", "has n > 3", "{0}"),
    ("TOP", "property P : box[0] receives Bid leads to box[0] in B", "receives", "{0}"),
    (
        "TOP",
        "property P : after Start some box in B leads to some box in A",
        "after Start",
        "after Start,",
    ),
    ("TOP", "property P : each box, in A leads to in B", "each box,", "{0}"),
    ("TOP", "property P : each box : if in A then in B", "if in A then in B", "in A leads to in B"),
    ("TOP", "property P : box[0] in A then eventually box[1] in B", "then eventually", "leads to"),
)
# The beginning of what cannot be followed literally.
ADVICE = (
    ("STATEMENT", "on Start [tries > 3] -> B", "it is a variable of `B`: declare it in `M` "),
    ("STATEMENT", "on Start / tries = 3", "it is a variable of `B`: declare it in `M` "),
    ("STATEMENT", "on Bid / number = 3", "declare it in `M` "),
    ("STATEMENT", 'on Start / log "hi"', "an effect is `name = value` or `send Event`"),
    ("STATEMENT", "else -> B", "`else` belongs to a `choice`"),
    ("STATEMENT", "defer *", "name the events"),
    ("STATEMENT", "on Start / n = min(o in ys by o.cost).number", "assign the item to a variable"),
    ("STATEMENT", "on Start / append(xs, n)", "write `append value to array`"),
    ("STATEMENT", "on Start [sum(o in ys by o.cost) > 1] -> B", "the queries are `count`, `any`"),
    ("TOP", "property P : eventually always box[0] in B", "name what it follows: `after P, Q at"),
    (
        "TOP",
        "fitness F { in t : float64 = time(box in A) / 2; maximize t }",
        "a measure is no part of a calculation",
    ),
)


def _errors(place: str, text: str, folder: Path) -> list[Diagnostic]:
    model = MODEL if place == "HEARTBEAT" else MODEL.replace("HEARTBEAT", HEARTBEAT)
    model = model.replace(place, text)
    for each in ("VARIABLE", "STATEMENT", "MACHINE", "SWARM", "TOP"):
        model = model.replace(each, "")
    file = folder / "model.swarm"
    file.write_text(model, encoding="utf-8")
    found = list(pipeline.check([file]).report)
    strange = ("unknown-identity", "unknown-interface")
    return [each for each in found if each.severity is Severity.ERROR or each.name in strange]


@pytest.mark.parametrize(("place", "mistake", "wrong", "right"), MISTAKES)
def test_advice_in_a_swarm(
    place: str, mistake: str, wrong: str, right: str, tmp_path: Path
) -> None:
    (error,) = _errors(place, mistake, tmp_path)
    quoted = re.findall(r"`([^`]+)`", error.help or "")
    followed = mistake.replace(wrong, right.format(*quoted)).replace("Target", "B")

    assert _errors(place, followed, tmp_path) == [], followed


@pytest.mark.parametrize(("place", "mistake", "advice"), ADVICE)
def test_advice_without_a_text_to_write(
    place: str, mistake: str, advice: str, tmp_path: Path
) -> None:
    (error,) = _errors(place, mistake, tmp_path)

    assert (error.help or "").startswith(advice)


@pytest.mark.parametrize(
    ("variable", "followed"),
    [
        ("var p : Plan = Plan(speed = 1 m/s)", "var p : Plan"),
        ("var k : int32 = n", "var k : int32"),
    ],
)
def test_advice_on_an_initial_value(variable: str, followed: str, tmp_path: Path) -> None:
    (error,) = _errors("VARIABLE", variable, tmp_path)
    (entry,) = re.findall(r"`([^`]+)`", error.help or "")
    text = MODEL.replace("VARIABLE", followed).replace("HEARTBEAT", HEARTBEAT)
    file = tmp_path / "model.swarm"
    file.write_text(
        re.sub("MACHINE|SWARM|TOP", "", text.replace("STATEMENT", entry)), encoding="utf-8"
    )

    assert not pipeline.check([file]).report.has_errors


def test_advice_on_a_misspelt_role(tmp_path: Path) -> None:
    (warning,) = _errors("STATEMENT", 'on member_lost [event.id == "carier[1]"] -> B', tmp_path)

    assert warning.name == "unknown-identity"
    assert warning.help == "did you mean `carrier[1]`?"


def test_a_comparison_in_a_statement_with_a_syntax_error_is_left_out(tmp_path: Path) -> None:
    (error,) = _errors("STATEMENT", 'on Bid [event.sender == "carier[1]"] n = 1', tmp_path)

    assert error.name == "syntax-error"
