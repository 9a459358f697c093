"""Any import into a model keeps comments and what only the model has."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.importing.update import Model, read_model, update
from swarmdsl.ir import (
    Component,
    Constant,
    Event,
    Field,
    Function,
    FunctionPort,
    Interface,
    Message,
    Named,
    Param,
    Port,
    Service,
    System,
)
from swarmdsl.syntax.formatter import format_source
from swarmdsl.syntax.formatter.tokens import tokenize
from swarmdsl.syntax.types import FLOAT, INT, STRING

from ..swarm_printer.expressions import literals
from ..swarm_printer.systems import systems

pytestmark = pytest.mark.long


T = TypeVar("T")
PLAIN = [FLOAT, INT, STRING]
TYPES = [*PLAIN, Named("new_msgs", "Thing")]
docs = st.sampled_from(["", "", "Imported.", "Two\nlines"])


def some(draw: st.DrawFn, items: Sequence[T]) -> list[T]:
    """Some of the items, in another order."""
    chosen = draw(st.lists(st.sampled_from(items), unique_by=id)) if items else []
    return list(chosen)


def changed_fields(draw: st.DrawFn, fields: Sequence[Field]) -> tuple[Field, ...]:
    # In their order: an import that has another one is told, and changes nothing.
    kept = [each for each in fields if draw(st.booleans())]
    made = [
        replace(each, type=draw(st.sampled_from([each.type, *TYPES])), doc=draw(docs))
        for each in kept
    ]
    for name in draw(st.sampled_from([(), ("z1",), ("z1", "goal")])):
        at = draw(st.integers(0, len(made)))
        made.insert(at, Field(name, draw(st.sampled_from(TYPES)), draw(docs)))
    return tuple(made)


def changed_interface(draw: st.DrawFn, known: Interface) -> Interface:
    if isinstance(known, Message):
        constants = tuple(
            replace(each, value=draw(literals(each.type))) for each in some(draw, known.constants)
        )
        if draw(st.booleans()):
            constants += (Constant("NEW", INT, draw(literals(INT)), draw(docs)),)
        fields = changed_fields(draw, known.fields)
        return replace(known, external=True, constants=constants, fields=fields, doc=draw(docs))
    words = (
        ("request", "response") if isinstance(known, Service) else ("goal", "result", "feedback")
    )
    parts = {word: changed_fields(draw, getattr(known, word)) for word in words}
    return replace(known, external=True, doc=draw(docs), **parts)  # type: ignore[arg-type]


def changed_params(draw: st.DrawFn, params: Sequence[Param]) -> tuple[Param, ...]:
    made = [
        replace(each, type=type_, default=draw(st.none() | literals(type_)), doc=draw(docs))
        for each in some(draw, params)
        for type_ in [draw(st.sampled_from([each.type, *PLAIN]))]
    ]
    if draw(st.booleans()):
        made.append(Param("z_new", FLOAT, draw(literals(FLOAT)), draw(docs)))
    return tuple(made)


def changed_function(draw: st.DrawFn, known: Function) -> Function:
    paradigm = draw(st.sampled_from(["action", "service"]))
    call = known.communication
    if draw(st.booleans()):
        call = replace(call, paradigm=paradigm, name="new/one", type=Named("new_msgs", "Call"))
    ports = [replace(each, type=Named("new_msgs", "Other")) for each in some(draw, known.ports)]
    ports += [FunctionPort("out", "z/new", Named("new_msgs", "Thing"), draw(docs))]
    params = changed_params(draw, known.params)
    category = draw(st.sampled_from(["abstraction", "swarm"]))
    return Function(known.name, category, call, tuple(ports), params, draw(docs))  # type: ignore[arg-type]


def changed_component(draw: st.DrawFn, known: Component) -> Component:
    ports = [replace(each, type=FLOAT) for each in some(draw, known.ports)]
    ports += [Port("z_port", "in", STRING, draw(st.sampled_from(["z_port", "q"])), draw(docs))]
    params = changed_params(draw, known.params)
    return Component(known.name, "virtual", tuple(ports), params, doc=draw(docs))


@st.composite
def imports(draw: st.DrawFn, system: System) -> System:
    """An import that has some things that the system has, and some that it has not."""
    offered = {name for each in system.components for name in each.operations}
    offered |= {name for m in system.members for part in m.parts for name in part.operations}
    services = {system.function(name).communication.type for name in offered}
    functions = [each for each in system.functions if each.name not in offered]
    interfaces = [each for each in system.interfaces if each.type not in services]
    fresh = Message(Named("new_msgs", "Fresh"), (Field("x", FLOAT),), True, doc=draw(docs))
    call = draw(st.sampled_from(functions)).communication if functions else None
    new = [Function("fresh_one", "swarm", replace(call, doc=""), (), ())] if call else []
    return System(
        "imported",
        (*(changed_interface(draw, each) for each in some(draw, interfaces)), fresh),
        (
            *(
                replace(each, swarm=draw(st.booleans()), topic="new/t")
                for each in system.events[:1]
            ),
            Event("FreshOne", fresh.type, "fresh_one", False, draw(docs)),
        ),
        (*(changed_function(draw, each) for each in some(draw, functions)), *new),
        (
            *(changed_component(draw, each) for each in some(draw, system.components)),
            Component("FreshPart", "sensor", (), (), doc=draw(docs)),
        ),
    )


@st.composite
def commented(draw: st.DrawFn, text: str) -> str:
    """The text with comments in many places, each another one."""
    lines: list[str] = []
    number = 0

    def comment() -> int:
        nonlocal number
        number += 1
        return number

    for line in text.split("\n"):
        is_doc = line.lstrip().startswith("///")
        if not is_doc and draw(st.integers(0, 5)) == 0:
            lines.append(
                draw(st.sampled_from(["// c{}", "/* c{}\n*/", "\n// c{}"])).format(comment())
            )
        if not is_doc and line.rstrip().endswith("{") and draw(st.integers(0, 3)) == 0:
            line = f"{line.rstrip()[:-1]}/* c{comment()} */ {{"
        if not is_doc and draw(st.integers(0, 4)) == 0:
            line += draw(st.sampled_from(["  // c{}", " /* c{} */", "/* c{} */ // x"])).format(
                comment()
            )
        lines.append(line)
    return "\n".join(lines)


def model_of(text: str, path: Path) -> Model:
    return read_model(path, Diagnostics(), texts={str(path): text})


def words(text: str) -> list[str]:
    return [token.text for token in tokenize(text) if not token.is_comment]


def of_all(model: Model) -> dict[object, list[str]]:
    """The words of each declaration, by what an import finds it by, else by its name."""
    keys = {id(declared): key for key, (_, declared) in model.declared.items()}
    return {
        keys.get(id(declared), str(declared.name)): words(declared.span.text)
        for declared in model.file.model.declarations
    }


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
@settings(
    max_examples=60,
    phases=[Phase.generate],
)
@given(st.data())
def test_an_update_keeps_all_else(data: st.DataObject) -> None:
    # An import cannot name the interfaces of a package whose name the language does not have.
    system = data.draw(systems().filter(lambda each: each.name not in ("my-model", "event")))
    before = data.draw(commented(print_system(system)))
    imported = model_of(print_system(data.draw(imports(system))), Path("imported.swarm"))
    model = model_of(before, Path("model.swarm"))
    report = Diagnostics()
    after = update(model, imported, report, force=True)["model.swarm"]

    made = format_source(Source("model.swarm", after), found := Diagnostics())
    assert made is not None, [each.message for each in found]
    comment = re.compile(r"\bc\d+\b")
    assert sorted(comment.findall(made)) == sorted(comment.findall(before))
    again = model_of(made, Path("model.swarm"))
    left, now = of_all(model), of_all(again)
    for name in left.keys() - imported.declared.keys():
        assert now[name] == left[name]
    assert now.keys() == left.keys() | imported.declared.keys()
    # All that was documented still is, in the same words.
    for line in before.split("\n"):
        if line.lstrip().startswith("///"):
            assert line.strip() in {each.strip() for each in made.split("\n")}
    assert update(again, imported, Diagnostics(), force=True) == {}
