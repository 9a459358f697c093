"""Update events, functions and components."""

from __future__ import annotations

from swarmdsl.analysis.event_topics import topic_of
from swarmdsl.base.naming import snake_case
from swarmdsl.base.source import Span
from swarmdsl.importing.update.merging import Merge, doc_comment, node_text, of_class
from swarmdsl.importing.update.values import default_change
from swarmdsl.syntax.ast import (
    Communication,
    Component,
    Event,
    Function,
    FunctionPort,
    Param,
    Port,
)


def merge_event(merge: Merge, old: Event, new: Event) -> None:
    """Update an event, except for a guessed topic."""
    merge.documentation(old, new)
    if (str(new.name), "topic") in merge.guesses:
        return
    merge.type(old.type, new.type)
    topic = topic_of(new)
    if topic_of(old) != topic:
        if old.topic is not None:
            merge.edits.replace(old.topic.span, f'"{topic}"')
        else:
            merge.edits.insert(old.span.end, f' on "{topic}"')
    _merge_kind(merge, old, new)
    _merge_delivery(merge, old, new)


def _merge_kind(merge: Merge, old: Event, new: Event) -> None:
    """Update the words before `event`."""
    words = merge.tokens.code(old.span.start, 1 + old.swarm + old.operator)
    added = "swarm " if new.swarm and not old.swarm else ""
    if old.swarm and not new.swarm:
        merge.word_at(words[0].start, "")
    if old.operator and not new.operator:
        merge.word_at(words[-2].start, "")
    elif new.operator and not old.operator:
        added += "operator "
    if added:
        merge.edits.insert(words[-1].start, added)


def _merge_delivery(merge: Merge, old: Event, new: Event) -> None:
    """Update the settings of a delivery whose value or kind differs."""
    if _settings(merge, old) == _settings(merge, new):
        return
    block = ", ".join(each.span.text for each in new.delivery)
    if not old.delivery:
        if old.span.text.endswith("}"):  # an empty block
            merge.edits.insert(old.span.end - 1, f"{block} ")
        else:
            merge.edits.insert(old.span.end, f" {{ {block} }}")
        return
    first, last = old.delivery[0].span, old.delivery[-1].span
    merge.edits.replace(Span(first.source, first.start, last.end), block)


def _settings(merge: Merge, event: Event) -> dict[str, object]:
    return {
        each.kind: merge.folding.value(each.value.tree)
        if each.value is not None and each.value.tree is not None
        else None
        for each in event.delivery
    }


def merge_function(merge: Merge, old: Function, new: Function) -> None:
    """Update the communication, topics and params of a function."""
    merge.documentation(old, new)
    name = str(new.name)
    if (name, "category") not in merge.guesses and old.category != new.category:
        colon, _ = merge.tokens.code(old.name.span.end, 2)
        merge.word_at(colon.start + 1, new.category)
    calls = of_class(old.items, Communication)
    if (name, "communication") not in merge.guesses:
        merge.items(
            calls,
            of_class(new.items, Communication),
            lambda _: 0,
            lambda one, other: _merge_call(merge, one, other),
            merge.inside(old.name.span.end),
        )
    merge.items(
        of_class(old.items, FunctionPort),
        of_class(new.items, FunctionPort),
        lambda port: (port.direction, str(port.topic)),
        lambda one, other: merge.type(one.type, other.type),
        merge.last(calls, old.name.span.end),
    )
    _merge_params(merge, old, new, {})


def _merge_call(merge: Merge, old: Communication, new: Communication) -> None:
    if old.paradigm != new.paradigm:
        merge.word_at(old.span.start, new.paradigm)
    merge.word(old.name.span, new.name.span)
    merge.type(old.type, new.type)


def merge_component(merge: Merge, old: Component, new: Component) -> None:
    """Update the kind, ports and params of a component."""
    merge.documentation(old, new)
    if (str(new.name), "kind") not in merge.guesses and old.kind != new.kind:
        merge.word_at(old.span.start, new.kind)
    inherited = _bases(old)
    own = of_class(old.items, Port)
    known = [*(port for base in inherited for port in of_class(base.items, Port)), *own]
    flows: dict[tuple[str, str], Port | None] = {
        flow: port for port in known for flow in _flows(port)
    }
    taken = {str(port.name) for port in known}
    add = merge.below(own[-1]) if own else merge.last(old.items, old.name.span.end)
    for port in of_class(new.items, Port):
        flow, *_ = _flows(port)
        if flow not in flows:
            add(_with_free_name(port, taken))
        found = flows.get(flow)
        if found in own:
            merge.documentation(found, port)
            merge.type(found.type, port.type)
        flows[flow] = None  # further ports with this topic are the same
    params = {str(p.name): p for base in inherited for p in of_class(base.items, Param)}
    _merge_params(merge, old, new, params)


def _merge_params(
    merge: Merge,
    old: Function | Component,
    new: Function | Component,
    inherited: dict[str, Param],
) -> None:
    params = of_class(old.items, Param)
    own = {str(param.name) for param in params}

    def is_new(param: Param) -> bool:
        base = inherited.get(str(param.name))
        if base is None or str(param.name) in own:
            return True
        return default_change(base, param, merge.folding) is not None

    merge.items(
        params,
        [param for param in of_class(new.items, Param) if is_new(param)],
        lambda param: str(param.name),
        merge.default,
        merge.last(old.items, old.name.span.end),
    )


def _bases(component: Component) -> list[Component]:
    """Return the base components, the root first."""
    chain: list[Component] = []
    base = component.base.target if component.base is not None else None
    while base is not None and base not in chain:
        chain.insert(0, base)
        base = base.base.target if base.base is not None else None
    return chain


def _flows(port: Port) -> list[tuple[str, str]]:
    """Directions of a port, each with its topic."""
    topic = str(port.topic) if port.topic is not None else snake_case(port.name)
    directions = ("in", "out") if port.direction == "inout" else (port.direction,)
    return [(direction, topic) for direction in directions]


def _with_free_name(port: Port, taken: set[str]) -> str:
    """Text of a port with a free name and its original topic."""
    name, number = str(port.name), 1
    while name in taken:
        number += 1
        name = f"{port.name}{number}"
    taken.add(name)
    if name == port.name:
        return node_text(port)
    ((_, topic), *_) = _flows(port)
    text = f'{port.direction} {name} : {port.type.span.text} on "{topic}"'
    return f"{doc_comment(port.doc)}\n{text}" if port.doc else text
