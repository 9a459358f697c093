"""Features of SCXML 1.0 that models do not have: each document ends in `pass` if they work."""

# ruff: noqa: E501 - one document a line

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.codegen.exchange.scxml.portable import SEND_TYPE
from swarmdsl.execution.scxml.session import PROCESSOR
from swarmdsl.execution.scxml.vocabulary import SWARM_EVENT

from . import suite

HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript"{}>'
ENDS = '<final id="pass"/><final id="fail"/></scxml>'
OTHERWISE = '<transition event="*" target="fail"/>'


def document(body: str, attributes: str = "") -> str:
    return HEAD.format(attributes) + body + ENDS


def entered(content: str, check: str, data: str = "") -> str:
    """A state that executes content on entry; then a condition must hold."""
    return f'<datamodel>{data}</datamodel><state id="a"><onentry>{content}</onentry><transition cond="{check}" target="pass"/><transition target="fail"/></state>'


def heard(content: str, event: str, check: str = "true", data: str = "") -> str:
    """A state that executes content on entry; then this event, and no other, comes next."""
    return f'<datamodel>{data}</datamodel><state id="a"><onentry>{content}</onentry><transition event="{event}" cond="{check}" target="pass"/>{OTHERWISE}</state>'


N = '<data id="n" expr="0"/>'
L = '<data id="l" expr="[3, 4]"/>'
PLUS = '<assign location="n" expr="n + 1"/>'
OWN = "'#_scxml_' + _sessionid"
TIMEOUT = '<send event="timeout"/>'

DOCUMENTS = {
    "4.3 a branch of <if> that fails ends the block": heard('<if cond="true"><send event="x" target="nowhere"/></if><raise event="late"/>', "error.execution"),
    "4.6 foreach sets item and index": entered('<foreach array="l" item="i" index="k"><assign location="n" expr="n + i * 10 + k"/></foreach>', "n == 71 &amp;&amp; i == 4 &amp;&amp; k == 1", N + L),
    "4.6 foreach without content declares": entered('<foreach array="l" item="i"/>', "i == 4", L),
    "4.6 foreach of an empty list": entered('<foreach array="[]" item="i"><raise event="x"/></foreach>', "typeof i == 'undefined'"),
    "4.6 foreach goes through a copy": entered(f'<foreach array="l" item="i"><assign location="l" expr="l.concat(l)"/>{PLUS}</foreach>', "n == 2 &amp;&amp; l.length == 8", N + L),
    "4.6 an error ends the loop and the block": entered(f'<foreach array="l" item="i">{PLUS}<assign location="no" expr="1"/></foreach>{PLUS}', "n == 1", N + L),
    "4.6 foreach of a number is an error": heard('<foreach array="3" item="i"><raise event="x"/></foreach>', "error.execution"),
    "4.6 loops in loops": entered(f'<foreach array="l" item="i"><foreach array="l" item="k">{PLUS}</foreach></foreach>', "n == 4", N + L),
    "4.6 loops end": heard('<foreach array="l" item="a"><foreach array="l" item="b"><foreach array="l" item="c"/></foreach></foreach>', "error.execution", data=f'<data id="l" expr="[{"0, " * 99}0]"/>'),
    "4.9 an error of <send> skips the rest of the block only": entered(f'<send event="x" target="nowhere"/>{PLUS}</onentry><onentry><assign location="n" expr="n + 5"/>', "n == 5", N),
    "5.3 early binding": '<state id="a"><transition cond="v == 7" target="pass"/><transition target="fail"/></state><state id="b"><datamodel><data id="v" expr="7"/></datamodel></state>',
    "5.7 donedata without a value has no data": '<state id="a"><final id="end"><donedata><param name="p" expr="no.x"/></donedata></final><transition event="error.execution" target="b"/><transition event="*" target="fail"/></state><state id="b"><transition event="done.state.a" cond="typeof _event.data == \'undefined\'" target="pass"/><transition event="*" target="fail"/></state>',
    "5.7 donedata with text": '<state id="a"><final id="end"><donedata><content>text</content></donedata></final><transition event="done.state.a" cond="_event.data == \'text\'" target="pass"/><transition event="*" target="fail"/></state>',
    "5.8 a script of the document": '<script>var v = 3, w; u = v * 2 // both\n v += 1\n w = [v]; w[0]++</script><state id="a"><transition cond="v == 4 &amp;&amp; u == 6 &amp;&amp; w[0] == 5" target="pass"/><transition target="fail"/></state>',
    "5.8 a script comes after first values": f'<script>n = n + 5</script><datamodel>{N.replace("0", "1")}</datamodel><state id="a"><transition cond="n == 6" target="pass"/><transition target="fail"/></state>',
    "5.9.2 a script on entry": entered("<script>var n; --n; o.x = n; o['y'] = 2; o.y -= 5</script>", "n == -1 &amp;&amp; o.x == -1 &amp;&amp; o.y == -3", N + '<data id="o" expr="{}"/>'),
    "5.10 no event before the first": entered("", "typeof _event == 'undefined'"),
    "5.10 system variables": entered("", "typeof _sessionid == 'string' &amp;&amp; _name == 'm' &amp;&amp; _ioprocessors.scxml.location == '#_scxml_' + _sessionid"),
    "5.10.1 an internal event": heard('<raise event="e"/>', "e", "_event.type == 'internal' &amp;&amp; _event.name == 'e' &amp;&amp; typeof _event.origin == 'undefined' &amp;&amp; typeof _event.origintype == 'undefined' &amp;&amp; typeof _event.sendid == 'undefined'"),
    "5.10.1 an external event": heard('<send event="e"/>', "e", f"_event.type == 'external' &amp;&amp; _event.origin == {OWN} &amp;&amp; _event.origintype == '{PROCESSOR}' &amp;&amp; typeof _event.sendid == 'undefined'"),
    "5.10.1 an external event with a delay": heard('<send event="e" delay="1s" id="i"/>', "e", f"_event.type == 'external' &amp;&amp; _event.origin == {OWN} &amp;&amp; _event.sendid == 'i'"),
    "5.10.1 an error": heard('<assign location="no" expr="1"/>', "error.execution", "_event.type == 'platform' &amp;&amp; typeof _event.sendid == 'undefined'"),
    "5.10.1 done events": '<state id="a"><final id="end"/><transition event="done.state.a" cond="_event.type == \'platform\'" target="pass"/><transition event="*" target="fail"/></state>',
    "5.10.1 all fields are there": heard('<raise event="e"/>', "e", " &amp;&amp; ".join(f"'{name}' in _event" for name in ("name", "type", "sendid", "origin", "origintype", "invokeid", "data"))),
    "5.10.1 the same event, kept": '<datamodel><data id="kept"/></datamodel><state id="a"><onentry><send event="e"><param name="x" expr="1"/></send></onentry><transition event="e" target="b"><assign location="kept" expr="_event"/></transition></state><state id="b"><transition cond="kept == _event" target="c"/><transition target="fail"/></state><state id="c"><onentry><raise event="f"/></onentry><transition event="f" cond="kept != _event &amp;&amp; kept.name == \'e\' &amp;&amp; kept.data.x == 1" target="pass"/><transition event="*" target="fail"/></state>',
    "6.2 idlocation": entered('<send event="e" idlocation="n"/>', "typeof n == 'string' &amp;&amp; n != ''", N),
    "6.2 an error has the id of its send": '<datamodel><data id="i"/></datamodel><state id="a"><onentry><send event="e" target="nowhere" idlocation="i"/></onentry><transition event="error.execution" cond="_event.sendid == i &amp;&amp; typeof i == \'string\'" target="pass"/><transition event="*" target="fail"/></state>',
    "6.2 an unknown type": heard(f'<send event="e" type="carrier pigeon"/>{TIMEOUT}', "error.execution"),
    "6.2 an unknown target": heard(f'<send event="e" target="http://example.org/"/>{TIMEOUT}', "error.execution", "_event.data == 'no event can be sent to `http://example.org/`'"),
    "6.2 data are those of the time of sending": heard('<send event="e"><content expr="l"/></send><script>l[0] = 9</script>', "e", "_event.data[0] == 3", L),
    "6.3 an event without an id is not cancelled": heard('<send event="e" delay="1s"/><cancel sendidexpr="\'\'"/><send event="late" delay="2s"/>', "e"),
    "6.3 a generated id cancels": heard('<send event="e" delay="1s" idlocation="n"/><cancel sendidexpr="n"/><send event="late" delay="2s"/>', "late", data=N),
    "C.1 the internal queue comes first": heard(f'{TIMEOUT}<send event="e" target="#_internal" id="i"/>', "e", "_event.type == 'internal' &amp;&amp; _event.sendid == 'i' &amp;&amp; typeof _event.origin == 'undefined'"),
    "C.1 the own session": heard(f'<send event="e" targetexpr="{OWN}"/>{TIMEOUT}', "e"),
    "C.1 the own location": heard(f"<send event=\"e\" targetexpr=\"_ioprocessors['{PROCESSOR}'].location\"/>{TIMEOUT}", "e"),
    "C.1 an answer to the origin": f'<state id="a"><onentry><send event="e"/></onentry><transition event="e" target="b"><send event="f" targetexpr="_event.origin" typeexpr="_event.origintype"/></transition></state><state id="b"><transition event="f" target="pass"/>{OTHERWISE}</state>',
    "C.1 another session cannot be reached": heard(f'<send event="e" target="#_scxml_other" id="i"/>{TIMEOUT}', "error.communication", "_event.sendid == 'i' &amp;&amp; _event.type == 'platform'"),
    "C.1 what cannot be reached does not end the block": entered(f'<send event="e" target="#_parent"/>{PLUS}', "n == 1", N),
    "B.2 data of JSON": entered("", "n.a[1] == 2", '<data id="n">\n {"a": [1, 2]} </data>'),
    "B.2 data of text": entered("", "n == 'a + b'", '<data id="n"> a  +\n b </data>'),
    "B.2 an assigned text": entered('<assign location="n">n + 1</assign>', "n == 'n + 1'", N),
    "B.2 what Python alone reads as JSON": entered('<assign location="n">NaN</assign>', "n == 'NaN'", N),
    "B.2 text around a comment": entered('<assign location="n">a<!-- b --> <!-- c -->d</assign>', "n == 'a d'", N),
    "B.2 a sent text": heard('<send event="e"><content>n + 1</content></send>', "e", "_event.data == 'n + 1'", N),
    "B.2 a condition that assigns": entered("", "++n == 1 &amp;&amp; n++ == 1 &amp;&amp; n == 2", N),
}  # fmt: skip

LATE = {
    "5.3.3 a value on entry": '<state id="a"><transition cond="typeof v == \'undefined\'" target="b"/><transition target="fail"/></state><state id="b"><datamodel><data id="v" expr="1"/></datamodel><onentry><assign location="v" expr="v + 1"/></onentry><transition cond="v == 2" target="pass"/><transition target="fail"/></state>',
    "5.3.3 on the first entry only": '<datamodel><data id="n" expr="0"/></datamodel><state id="a"><datamodel><data id="v" expr="n"/></datamodel><transition cond="n == 0" target="a"><assign location="n" expr="5"/></transition><transition cond="v == 0" target="pass"/><transition target="fail"/></state>',
    "5.3.3 the document's own data at the start": '<datamodel><data id="n" expr="3"/></datamodel><state id="a"><transition cond="n == 3" target="pass"/><transition target="fail"/></state>',
}  # fmt: skip


@pytest.mark.parametrize("body", DOCUMENTS.values(), ids=DOCUMENTS)
def test_feature(body: str) -> None:
    assert suite.judge("m.scxml", document(body, ' name="m"')) == ("pass", "")


@pytest.mark.parametrize("body", LATE.values(), ids=LATE)
def test_late_binding(body: str) -> None:
    assert suite.judge("m.scxml", document(body, ' binding="late"')) == ("pass", "")


def test_sessions_have_ids_of_their_own() -> None:
    from swarmdsl.execution.scxml.session import Session

    assert Session({}).id != Session({}).id


def test_events_of_the_swarm_have_the_type_that_portable_documents_write() -> None:
    assert SWARM_EVENT == SEND_TYPE


# ---- the tool


def state(content: str) -> str:
    return document(f'<state id="a">{content}</state>')


JUDGED = {
    "right": ("pass", state('<transition target="pass"/>')),
    "wrong": ("wrong", state('<transition target="fail"/>')),
    "stuck": ("wrong", state("")),
    "endless": ("wrong", state('<transition cond="true" target="a"/>')),
    "refused": ("refuse", state("<invoke/>")),
    "manual": ("unjudged", HEAD.format("") + '<final id="end"/></scxml>'),
}


def test_verdicts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, (_, text) in JUDGED.items():
        (tmp_path / f"{name}.scxml").write_text(text, encoding="utf-8")

    assert suite.main(tmp_path) == 1
    *lines, total = capsys.readouterr().out.splitlines()
    assert {line.split()[0].partition(".")[0]: line.split()[1] for line in lines} == {
        name: word for name, (word, _) in JUDGED.items()
    }
    assert total == "6 documents: 1 pass, 1 refuse, 1 unjudged, 3 wrong"
    for name, (word, _) in JUDGED.items():
        if word == "wrong":
            (tmp_path / f"{name}.scxml").unlink()
    assert suite.main(tmp_path) == 0
    assert "SW0808" in capsys.readouterr().out


def test_an_empty_folder_proves_nothing(tmp_path: Path) -> None:
    assert suite.main(tmp_path) == 1
