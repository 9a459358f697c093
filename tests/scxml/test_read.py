"""Reading SCXML: what it means, and what is said about documents that are wrong."""

# ruff: noqa: E501 - one mistake a line

from __future__ import annotations

import re

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.explain import page_path
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Event, Instance, Machine
from swarmdsl.execution.scxml import read

from ..engine.world import StillWorld, Trace, after

HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript">'


def machine(body: str) -> Machine:
    report = Diagnostics()
    made = read(Source("m.scxml", f"{HEAD}{body}</scxml>"), report)
    assert made is not None, [found.message for found in report]
    assert not list(report)
    return made


def running(body: str) -> Instance:
    instance = Instance(machine(body), StillWorld(), observer=Trace())
    instance.start()
    return instance


def said(text: str) -> list[tuple[str, str, str]]:
    """Name, message and the text at the place, of everything found."""
    report = Diagnostics()
    read(Source("m.scxml", text), report)
    return [
        (found.name, found.message, found.primary.span.text if found.primary else "")
        for found in report
    ]


def said_of(body: str) -> list[tuple[str, str, str]]:
    return said(f"{HEAD}{body}</scxml>")


def trace(instance: Instance) -> list[str]:
    assert isinstance(instance.observer, Trace)
    return instance.observer.lines


def errors(instance: Instance) -> list[str]:
    assert isinstance(instance.world, StillWorld)
    return instance.world.errors


# ---- states


def test_the_first_state_is_initial_whatever_it_is() -> None:
    instance = running('<parallel id="p"><state id="l"/><state id="r"/></parallel><state id="a"/>')

    assert instance.configuration.innermost == ["l", "r"]


def test_states_without_ids() -> None:
    instance = running('<state><transition event="e" target="b"/></state><state id="b"/>')

    assert after(instance, "e") == ["b"]


@pytest.mark.parametrize("written", ["a.b", "a.b.*", "a.b."])
def test_descriptors_of_events_are_beginnings_of_names(written: str) -> None:
    body = f'<state id="a"><transition event="{written}" target="b"/></state><state id="b"/>'

    assert after(running(body), "a.bc", "a") == ["a"]
    assert after(running(body), "a.b") == ["b"]
    assert after(running(body), "a.b.c") == ["b"]


def test_several_targets_and_initial_elements() -> None:
    instance = running("""
      <state id="s"><transition event="e" target="l2 r2"/></state>
      <parallel id="p">
        <state id="l" initial="l1"><state id="l2"/><state id="l1"/></state>
        <state id="r">
          <initial><transition target="r1"><raise event="x"/></transition></initial>
          <state id="r2"/><state id="r1"><transition event="x" target="r3"/></state>
          <state id="r3"/>
        </state>
        <transition event="f" target="p"/>
      </parallel>""")

    assert after(instance, "e") == ["l2", "r2"]
    assert after(instance, "f") == ["l1", "r3"]


def test_the_default_of_a_history_has_content() -> None:
    instance = running("""
      <state id="s"><transition event="e" target="h"/></state>
      <state id="a">
        <history id="h" type="deep"><transition target="a2"><raise event="x"/></transition></history>
        <state id="a1"/>
        <state id="a2"><transition event="x" target="a3"/></state>
        <state id="a3"/>
      </state>""")

    assert after(instance, "e") == ["a3"]


def test_done_data() -> None:
    instance = running("""
      <state id="a">
        <transition event="done.state.a" cond="_event.data.n === 3" target="b"/>
        <state id="a1"><transition event="e" target="end"/></state>
        <final id="end"><donedata><param name="n" expr="1 + 2"/></donedata></final>
      </state>
      <state id="b"/>""")

    assert after(instance, "e") == ["b"]


def test_done_data_goes_without_what_has_no_value() -> None:
    instance = running("""
      <state id="a">
        <transition event="done.state.a" cond="_event.data.n === 3" target="b"/>
        <state id="a1"><transition event="e" target="end"/></state>
        <final id="end"><donedata>
          <param name="gone" expr="nobody.x"/><param name="n" expr="1 + 2"/>
        </donedata></final>
      </state>
      <state id="b"/>""")

    assert after(instance, "e") == ["b"]


# ---- content


def test_data_and_assignments() -> None:
    instance = running("""
      <datamodel>
        <data id="n" expr="2"/><data id="twice" expr="n * 2"/><data id="word">"a"</data>
        <data id="o" expr="{list: [1, 2], inner: {x: 0}}"/><data id="none"/>
      </datamodel>
      <state id="a"><onentry>
        <assign location="n" expr="n + twice"/>
        <assign location="o.inner.x" expr="word + n"/>
        <assign location="o.list[1]" expr="true"/>
        <assign location="none">[6]</assign>
      </onentry></state>""")

    assert instance.data == {
        "n": 6,
        "twice": 4,
        "word": "a",
        "o": {"list": [1, True], "inner": {"x": "a6"}},
        "none": [6],
    }


def test_conditions_of_content() -> None:
    instance = running("""
      <datamodel><data id="n" expr="0"/></datamodel>
      <state id="a"><transition event="e"><if cond="_event.data &lt; 1">
        <assign location="n" expr="'less'"/><elseif cond="_event.data == 1"/>
        <assign location="n" expr="'one'"/><log label="n" expr="n"/><else/>
        <assign location="n" expr="'more'"/></if></transition></state>""")
    for value, word in ((0, "less"), (1, "one"), (2, "more")):
        instance.receive(Event("e", value))
        assert instance.data["n"] == word
    assert trace(instance).count("log n: one") == 1


def test_delays() -> None:
    instance = running("""
      <datamodel><data id="d" expr="2"/></datamodel>
      <state id="a">
        <onentry><send event="t" delay="1.5s"/><send event="u" delayexpr="d * 1000 + 'ms'" id="x"/>
        </onentry>
        <transition event="t" target="b"/>
      </state>
      <state id="b"><transition event="stop"><cancel sendid="x"/></transition>
        <transition event="u" target="c"/></state>
      <state id="c"/>""")
    assert isinstance(instance.world, StillWorld)
    clock = instance.world.clock
    clock.advance(1_499_999_999)
    assert instance.configuration.ids == ["a"]
    clock.advance(1)
    assert instance.configuration.ids == ["b"]
    clock.advance(499_999_999)
    assert instance.configuration.ids == ["b"]
    clock.advance(1)
    assert instance.configuration.ids == ["c"]


def test_a_delay_is_cancelled_by_its_id() -> None:
    instance = running("""
      <state id="a"><onentry><send event="t" delay="1s" id="one"/></onentry>
        <transition event="e"><cancel sendidexpr="'on' + 'e'"/></transition>
        <transition event="t" target="b"/></state><state id="b"/>""")
    after(instance, "e")
    assert isinstance(instance.world, StillWorld)
    instance.world.clock.advance(10**10)

    assert instance.configuration.ids == ["a"]


def test_elements_and_attributes_with_a_prefix() -> None:
    text = """
      <s:scxml xmlns:s="http://www.w3.org/2005/07/scxml" version="1.0">
        <s:state id="a"><s:onentry><s:send event="t" s:delay="1s"/></s:onentry>
          <s:transition event="t" s:target="b"/></s:state><s:state id="b"/></s:scxml>"""
    report = Diagnostics()
    made = read(Source("m.scxml", text.strip()), report)
    assert made is not None, [found.message for found in report]
    instance = Instance(made, world := StillWorld())
    instance.start()
    world.clock.advance(10**9)

    assert instance.configuration.ids == ["b"]


def test_sends() -> None:
    instance = running("""
      <datamodel><data id="n" expr="3"/></datamodel>
      <state id="a"><transition event="e">
        <send event="inside" target="#_internal"/>
        <send event="own"><param name="x" expr="n"/></send>
        <send eventexpr="'for' + '.others'" type="urn:swarmdsl:swarm" namelist="n"/>
        <send event="value" type="urn:swarmdsl:swarm"><content expr="n + 1"/></send>
      </transition>
      <transition event="own" cond="_event.data.x == 3"/></state>""")
    after(instance, "e")

    assert isinstance(instance.world, StillWorld)
    assert instance.world.asked == ["send for.others {'n': 3}", "send value 4"]
    assert [line for line in trace(instance) if line[0] == "?"] == ["? e", "? inside", "? own"]


DELAYED = "`x` has a target of its own: it cannot be delayed"


@pytest.mark.parametrize(
    ("content", "error"),
    [
        ('<assign location="x" expr="1"/>', "there is no variable `x`"),
        ('<assign location="n" expr="x"/>', "`x` is not defined"),
        ('<assign location="n.x" expr="1"/>', "`n.x` cannot be assigned to"),
        ('<log expr="n.x.y"/>', "undefined has no `y`"),
        ("<send event='x' delayexpr='3'/>", "`3` is no delay"),
        ("<send event='x' delay='1s' target='#_internal'/>", DELAYED),
        ("<send eventexpr='&quot;&quot;'/>", "an event without a name cannot be sent"),
        ("<send eventexpr='_event'/>", "`_event` is not defined"),
        ("<send eventexpr='undefined'/>", "`eventexpr` has no value"),
        ("<send event='x' target='y'/>", "no event can be sent to `y`"),
        ("<send event='x' type='y'/>", "no event can be sent with the type `y`"),
        ("<if cond='true'><send event='x' target='y'/></if>", "no event can be sent to `y`"),
        ("<send event='x' idlocation='y'/>", "there is no variable `y`"),
        ("<assign location='_name' expr='1'/>", "`_name` cannot be assigned to"),
        ("<assign location='_event.data' expr='1'/>", "`_event` cannot be assigned to"),
        ("<script>n.x = 1</script>", "`=` cannot be assigned to"),
        ("<script>x += 1</script>", "`x` is not defined"),
        ("<script>_sessionid = 1</script>", "`_sessionid` cannot be assigned to"),
        ("<foreach array='n' item='x'/>", "`0` is not a list"),
        ("<foreach array='x' item='y'/>", "`x` is not defined"),
        ("<foreach array='[1]' item='if'/>", "`if` is not the name of a variable"),
        (
            "<foreach array='[1]' item='x' index='_event'/>",
            "`_event` is not the name of a variable",
        ),
        (
            "<foreach array='[1]' item='x'><send event='x' target='y'/></foreach>",
            "no event can be sent to `y`",
        ),
    ],
)
def test_content_that_fails(content: str, error: str) -> None:
    instance = running(f"""
      <datamodel><data id="n" expr="0"/></datamodel>
      <state id="a"><onentry>{content}<assign location="n" expr="'done'"/></onentry>
      <transition event="error.execution" target="b"/></state><state id="b"/>""")

    assert instance.configuration.ids == ["b"]
    assert instance.data["n"] == 0
    assert errors(instance) == [error]


def test_a_condition_without_a_value_does_not_hold_and_the_rest_is_done() -> None:
    instance = running("""
      <datamodel><data id="n" expr="0"/></datamodel>
      <state id="a"><onentry><if cond="x"><assign location="n" expr="1"/>
        <else/><assign location="n" expr="2"/></if></onentry></state>""")

    assert instance.data["n"] == 2
    assert errors(instance) == ["`x` is not defined"]


def test_a_first_value_that_fails_leaves_the_others() -> None:
    instance = running("""
      <datamodel><data id="a" expr="x"/><data id="b" expr="1"/></datamodel><state id="s"/>""")

    assert instance.data == {"a": None, "b": 1}
    assert errors(instance) == ["`x` is not defined"]


def test_in_with_and_without_quotes() -> None:
    body = """<parallel id="p">
      <state id="l"><state id="l1"><transition event="e" cond="{cond}" target="l2"/></state>
      <state id="l2"/></state>
      <state id="r"><state id="r1"><transition event="f" target="r2"/></state><state id="r2"/></state>
    </parallel>"""
    for cond in ("In(r2)", "In('r2')", "!In('r1')", "In('nowhere') || In(r2)"):
        assert after(running(body.format(cond=cond)), "e", "f", "e") == ["l2", "r2"]


def test_values_of_a_host_are_kept_where_the_document_gives_none() -> None:
    made = machine(
        '<datamodel><data id="a"/><data id="b" expr="a + 1"/></datamodel><state id="s"/>'
    )
    instance = Instance(made, StillWorld(), data={**made.data(), "a": 4})
    instance.start()

    assert instance.data == {"a": 4, "b": 5}


def test_activities_that_swarmdsl_wrote() -> None:
    instance = running("""
      <sw:function xmlns:sw="urn:swarmdsl:scxml" name="go" server="cmd/go"/>
      <datamodel><data id="n" expr="2"/></datamodel>
      <state id="a"><sw:activity xmlns:sw="urn:swarmdsl:scxml" function="go">
        <sw:goal><sw:argument field="x" expr="n * 2"/></sw:goal><sw:result/></sw:activity>
        <transition event="do.a.succeeded" target="b"/></state><state id="b"/>""")
    assert isinstance(instance.world, StillWorld)
    run = instance.world.runs["go"]
    assert (run.goal, run.activity.server) == ({"x": 4}, "cmd/go")
    run.end("succeeded")
    assert instance.configuration.ids == ["b"]


# ---- what is wrong


STATE = '<state id="a">{}</state>'
WRONG: list[tuple[str, str, str, str]] = [
    (
        '<state id="a"><transition event="e" target="b"/></state>',
        "unknown-state",
        "no state has the id `b`",
        "b",
    ),
    ('<state id="a"/><state id="a"/>', "duplicate-id", "duplicate id `a`", "a"),
    ("", "illegal-structure", "the document has no state", "scxml"),
    (
        STATE.format("<transition/>"),
        "illegal-structure",
        "a transition without event, condition and target is an endless loop",
        "transition",
    ),
    (
        STATE.format('<transition event="e" cond="1 +"/>'),
        "bad-expression",
        "invalid expression: it ends early",
        "1 +",
    ),
    (
        STATE.format('<transition event="e" cond="eval(1)"/>'),
        "bad-expression",
        "invalid expression: only functions of `Math`, `Number` and `In` can be called",
        "eval(1)",
    ),
    (
        STATE.format('<transition event="e" cond="_event.raw"/>'),
        "bad-expression",
        "invalid expression: `_event.raw` is not supported",
        "_event.raw",
    ),
    (
        STATE.format('<transition event="e" cond="x = 3"/>'),
        "bad-expression",
        "invalid expression: `=` cannot stand here",
        "x = 3",
    ),
    (
        STATE.format('<transition event="e" type="inner"/>'),
        "bad-value",
        "`type` must be `external` or `internal`",
        "inner",
    ),
    (
        STATE.format('<transition event="" target="a"/>'),
        "bad-value",
        "`event` must be the name of an event",
        "",
    ),
    (
        STATE.format('<onentry><send event="e" delay="soon"/></onentry>'),
        "bad-value",
        "`delay` must be a number followed by `s` or `ms`",
        "soon",
    ),
    (
        STATE.format('<onentry><send delay="1s"/></onentry>'),
        "missing-attribute",
        "`<send>` needs attribute `event`",
        "send",
    ),
    (
        STATE.format('<onentry><assign expr="1"/></onentry>'),
        "missing-attribute",
        "`<assign>` needs attribute `location`",
        "assign",
    ),
    (
        STATE.format('<onentry><assign location="1" expr="1"/></onentry>'),
        "bad-expression",
        "invalid expression: `1` cannot be assigned to",
        "1",
    ),
    (
        STATE.format('<onentry><send event="e" namelist="x 1+"/></onentry>'),
        "bad-expression",
        "invalid expression: it ends early",
        "1+",
    ),
    (
        STATE.format("<onentry><script>f(1)</script></onentry>"),
        "not-understood",
        "`script` is not supported: only assignments are run; it ends early",
        "script",
    ),
    (
        '<script>x = 1; while (x) { x = 0 }</script><state id="a"/>',
        "not-understood",
        "`script` is not supported: only assignments are run; `{` cannot stand here",
        "script",
    ),
    (
        '<script src="file:///etc/passwd"/><state id="a"/>',
        "not-understood",
        "`src` is not supported: other files are not read",
        "file:///etc/passwd",
    ),
    (
        '<datamodel><data id="d"><books xmlns=""/></data></datamodel><state id="a"/>',
        "not-understood",
        "`books` is not supported: XML cannot be a value",
        "books",
    ),
    (
        STATE.format(
            '<onentry><send event="e" type="http://www.w3.org/TR/scxml/#BasicHTTPEventProcessor"/></onentry>'
        ),
        "not-understood",
        "`type` is not supported: no event is sent over a network",
        "http://www.w3.org/TR/scxml/#BasicHTTPEventProcessor",
    ),
    (
        STATE.format('<onentry><send event="e" eventexpr="1"/></onentry>'),
        "illegal-structure",
        "`<send>` gives the same thing twice",
        "send",
    ),
    (
        STATE.format('<onentry><send event="e" delay="1s" delayexpr="1"/></onentry>'),
        "illegal-structure",
        "`<send>` gives the same thing twice",
        "send",
    ),
    (
        STATE.format('<onentry><send event="e" namelist="x"><content>1</content></send></onentry>'),
        "illegal-structure",
        "`<send>` gives the same thing twice",
        "send",
    ),
    (
        STATE.format('<onentry><assign location="x" expr="1">2</assign></onentry>'),
        "illegal-structure",
        "`<assign>` gives the same thing twice",
        "assign",
    ),
    (
        STATE.format('<onentry><if cond="1"><else/><elseif cond="2"/></if></onentry>'),
        "illegal-structure",
        "`<elseif>` must not come after `<else>`",
        "elseif",
    ),
    (
        STATE.format('<onentry><foreach array="x"/></onentry>'),
        "missing-attribute",
        "`<foreach>` needs attribute `item`",
        "foreach",
    ),
    (
        STATE.format('<transition event="e" cond="Math.PI"/>'),
        "bad-expression",
        "invalid expression: `Math` is not supported",
        "Math.PI",
    ),
    (
        STATE.format('<invoke type="x"/>'),
        "not-understood",
        "`invoke` is not supported: activities outside of the machine are not started from SCXML",
        "invoke",
    ),
    (
        '<datamodel><data id="d" src="file:///etc/passwd"/></datamodel><state id="a"/>',
        "not-understood",
        "`src` is not supported: other files are not read",
        "file:///etc/passwd",
    ),
    (
        '<datamodel><data id="d"/><data id="d"/></datamodel><state id="a"/>',
        "duplicate-id",
        "duplicate id `d`",
        "d",
    ),
    (
        STATE.format('<transition event="e" taget="a"/>'),
        "unknown-attribute",
        "`<transition>` has no attribute `taget`",
        "a",
    ),
    (
        STATE.format("<transitoin/>"),
        "unknown-element",
        "element `<transitoin>` is not allowed in `<state>`",
        "transitoin",
    ),
    (
        '<raise event="e"/><state id="a"/>',
        "unknown-element",
        "element `<raise>` is not allowed in `<scxml>`",
        "raise",
    ),
    (STATE.format("words"), "illegal-structure", "`<state>` must not contain text", "state"),
    (
        '<state id="a" initial="b"><state id="c"/></state><state id="b"/>',
        "illegal-structure",
        "`b` is not in `a`",
        "b",
    ),
    (
        '<state id="a"><history id="h"/><state id="c"/></state>',
        "illegal-structure",
        "`<history>` must have exactly one transition",
        "history",
    ),
    (
        '<state id="a"><history id="h"><transition target="b"/></history><state id="c"/></state><state id="b"/>',
        "illegal-structure",
        "`b` is not in `a`",
        "b",
    ),
    (
        '<state id="a"><initial><transition target="c" event="e"/></initial><state id="c"/></state>',
        "illegal-structure",
        "the transition of `<initial>` must not have an event or condition",
        "e",
    ),
    (
        '<state id="a" initial="c"><initial><transition target="c"/></initial><state id="c"/></state>',
        "illegal-structure",
        "the initial state is given twice",
        "c",
    ),
    (
        '<state id="a"><transition event="e" target="a b"/></state><state id="b"/>',
        "illegal-structure",
        "`a` and `b` cannot be active together",
        "a",
    ),
    (
        '<state id="a"><history id="h" type="big"><transition target="c"/></history><state id="c"/></state>',
        "bad-value",
        "`type` must be `shallow` or `deep`",
        "big",
    ),
    (
        '<x:y xmlns:x="urn:x"/><state id="a"><x:z xmlns:x="urn:x"/></state>',
        "foreign-element",
        "`<y>` is not an SCXML element and is ignored",
        "x:y",
    ),
]


@pytest.mark.parametrize(("body", "name", "message", "place"), WRONG)
def test_what_is_wrong_is_said_once_at_its_place(
    body: str, name: str, message: str, place: str
) -> None:
    assert said_of(body) == [(name, message, place)]


@pytest.mark.parametrize(("name", "value"), [("datamodel", "python"), ("binding", "sometimes")])
def test_attributes_of_the_root(name: str, value: str) -> None:
    text = f'<scxml xmlns="http://www.w3.org/2005/07/scxml" {name}="{value}"><state/></scxml>'

    assert [(found, place) for found, _, place in said(text)] == [("bad-value", value)]


@pytest.mark.parametrize(
    ("text", "name", "message", "place"),
    [
        ("", "not-xml", "invalid XML: no element found", ""),
        ("words", "not-xml", "invalid XML: syntax error", "w"),
        (f"{HEAD}<state></scxml>", "not-xml", None, None),
        ("<scxml><state/></scxml>", "not-scxml", None, "scxml"),
        ('<a xmlns="http://www.w3.org/2005/07/scxml"/>', "not-scxml", None, "a"),
        (f"<!DOCTYPE scxml>{HEAD}<state/></scxml>", "xml-document-type", None, "<!DOCTYPE"),
        (
            f'<?xml version="1.0"?>\n<!-- x -->\n<!DOCTYPE scxml [<!ENTITY a "b">]>{HEAD}</scxml>',
            "xml-document-type",
            None,
            "<!DOCTYPE",
        ),
    ],
)
def test_files_that_are_no_scxml(
    text: str, name: str, message: str | None, place: str | None
) -> None:
    ((found_name, found_message, found_place),) = said(text)

    assert found_name == name
    assert message in (None, found_message)
    assert place in (None, found_place)


def test_a_comment_may_speak_of_document_types() -> None:
    assert said(f"<!-- <!DOCTYPE x> -->{HEAD}<state/></scxml>") == []


def test_several_mistakes_are_all_told() -> None:
    found = said_of(STATE.format('<transition event="e" target="b c"/><onentry><rise/></onentry>'))

    assert [name for name, _, _ in found] == ["unknown-element"]
    found = said_of(STATE.format('<transition event="e" target="b c" cond="("/>'))
    assert sorted(name for name, _, _ in found) == [
        "bad-expression",
        "unknown-state",
        "unknown-state",
    ]


def test_places_are_right_behind_letters_that_take_several_bytes() -> None:
    found = said(f'<!-- ä€𝄞 -->{HEAD}<state id="ä"/>\r\n<state id="b" \n initial=\'x\'/></scxml>')

    assert [place for _, _, place in found] == ["x"]


def test_what_was_meant_is_suggested() -> None:
    report = Diagnostics()
    body = '<state id="ready"><transition event="e" target="redy"/></state>'
    read(Source("m.scxml", f"{HEAD}{body}</scxml>"), report)

    assert [found.help for found in report] == ["did you mean `ready`?"]


def test_deep_documents() -> None:
    opening = "".join(f'<state id="s{n}">' for n in range(240))
    instance = running(opening + "</state>" * 240)
    assert instance.configuration.innermost == ["s239"]
    ((name, message, _),) = said_of("<state>" * 300 + "</state>" * 300)
    assert (name, message) == (
        "not-xml",
        "invalid XML: elements are nested more than 250 levels deep",
    )


# ---- the pages about it


def blocks(code: str, heading: str) -> list[str]:
    text = page_path(code).read_text(encoding="utf-8").partition(f"## {heading}\n")[2]
    return re.findall(r"```xml\n(.*?)```", text.partition("\n## ")[0], re.DOTALL)


@pytest.mark.parametrize(
    "name", [name for name, code in CODES.items() if "SW08" < code.code < "SW09"]
)
def test_pages_show_the_fault_and_the_way_out(name: str) -> None:
    entry = CODES[name]
    (wrong,) = blocks(entry.code, "Example")
    (right,) = blocks(entry.code, "Way out")

    assert [found for found, _, _ in said(wrong)] == [name]
    assert said(right) == []
