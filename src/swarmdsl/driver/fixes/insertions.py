"""Fixes that declare or add what is missing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes.bodies import insert, insertion, opening_brace
from swarmdsl.driver.fixes.problem import Problem, Rules, inserting, replacing
from swarmdsl.driver.line_insertion import below_head, import_statement
from swarmdsl.syntax.ast import (
    Choice,
    EnumType,
    Environment,
    Equipment,
    Event,
    EventTrigger,
    FinalState,
    Fitness,
    FitnessInput,
    Member,
    Parallel,
    Param,
    Part,
    Region,
    Send,
    Sight,
    State,
    StateMachine,
    Swarm,
    Transition,
    Variable,
)

# Rest of a line that has no further code.
_REST = re.compile(r"[ \t]*(?://[^\n]*)?(?=\n|\Z)")


def _import(problem: Problem, *statements: str) -> Iterator[Fix]:
    for statement in statements:
        edit = _edit(problem, import_statement(problem.file, statement))
        yield Fix(f"Add `{statement}`", (edit,), safe=len(statements) == 1)


def _into_all(problem: Problem, line: str, *names: Span) -> Iterator[Fix]:
    """Add a line to the declarations or states with these names."""
    nodes = [problem.declared(name) for name in names]
    edits = [insertion(node, line) for node in nodes if node is not None]
    found = tuple(edit for edit in edits if edit is not None)
    if len(found) == len(names):
        yield Fix(f"Add `{line}`", found)


def _setting(problem: Problem, line: str) -> Iterator[Fix]:
    node = problem.around(Sight, Equipment)
    fix = insert(node, line) if node is not None else None
    if fix is not None:
        yield fix


def _initial(problem: Problem, *lines: str) -> Iterator[Fix]:
    """Add an initial state; a container without states gets the state itself, too."""
    node = problem.around(State, Region, StateMachine)
    fix = None
    if node is not None:
        fix = insert(node, "\n".join(lines), first=len(lines) == 1, shown=lines[-1])
    if fix is not None:
        yield fix


def _declaration(problem: Problem, line: str) -> Iterator[Fix]:
    edit = _edit(problem, below_head(problem.file, line))
    yield Fix(f"Declare `{line}`", (edit,))


def _edit(problem: Problem, change: Change) -> tuple[Span, str]:
    start, end, text = change
    return problem.part(start, end), text


def _variable(problem: Problem, name: str, line: str) -> Iterator[Fix]:
    """Declare a variable or input below the last value of its owner."""
    declared = problem.file.model.declarations
    owner = next((each for each in declared if each.name == name), None)
    if not isinstance(owner, (StateMachine, Fitness)):
        return
    text = problem.text
    values = [each for each in owner.items if isinstance(each, (Param, Variable, FitnessInput))]
    at = values[-1].span.absolute.end if values else opening_brace(owner)
    if at is None:
        return
    rest = _REST.match(text, at)
    at = rest.end() if rest is not None else at
    ending = "" if text.startswith("\n", at) else "\n "
    edit = (problem.part(at, at), f"\n  {line}{ending}")
    yield Fix(f"Declare `{line}`", (edit,))


def _constant(problem: Problem, name: str, line: str) -> Iterator[Fix]:
    """Declare a constant above the declaration that uses it."""
    declared = problem.file.model.declarations
    owner = next((each for each in declared if each.name == name), None)
    type_ = line.partition(" : ")[2].partition(" = ")[0]
    zero = {"bool": "false", "string": '""', "duration": "0 s"}.get(
        type_, "0.0" if type_.startswith("float") else "0" if "int" in type_ else None
    )
    if owner is not None and zero is not None:
        line = line.replace("...", zero)
        start = problem.text.rfind("\n", 0, owner.span.absolute.start) + 1
        while problem.text[:start].endswith("\n") and problem.text[: start - 1].rpartition("\n")[
            2
        ].startswith("///"):
            start = problem.text.rfind("\n", 0, start - 1) + 1
        yield Fix(f"Declare `{line}`", ((problem.part(start, start), f"{line}\n\n"),))


def _environment(problem: Problem, name: str) -> Iterator[Fix]:
    """Use the first environment of the model, or declare one."""
    swarm = problem.named(name, Swarm)
    if swarm is None:
        return
    there = next(problem.every(Environment), None)
    used = there.name if there is not None else "Field"
    edit = insertion(swarm, f"environment {used}", first=True)
    edits = [edit] if edit is not None else []
    if there is None:
        line = "environment Field { size 50 m x 50 m }"
        edits.append(_edit(problem, below_head(problem.file, line)))
    yield Fix(f"Add `environment {used}`", tuple(edits))


def _member(problem: Problem) -> Iterator[Fix]:
    swarm = problem.around(Swarm)
    member = next(problem.every(Member), None)
    name = str(member.name) if member is not None else "Robot"
    role = f"{name[0].lower()}{name[1:]} : {name}[3]"
    edit = insertion(swarm, role) if swarm is not None else None
    if edit is not None:
        declared = _edit(problem, below_head(problem.file, "member Robot { }"))
        yield Fix(f"Add `{role}`", (edit,) if member is not None else (edit, declared))


def _fitness(problem: Problem, name: str) -> Iterator[Fix]:
    swarm = problem.named(name, Swarm)
    for fitness in problem.every(Fitness):
        about = fitness.subject.name if fitness.subject is not None else name
        fix = insert(swarm, f"fitness {fitness.name}") if swarm and about == name else None
        if fix is not None:
            yield fix
            return


def _final(problem: Problem, line: str) -> Iterator[Fix]:
    """Declare a machine endless, or add a final state."""
    machine = problem.around(StateMachine)
    if machine is not None:
        start = machine.span.absolute.start
        at = problem.part(start, start)
        yield Fix("Write `endless statemachine`", ((at, "endless "),))
        fix = insert(machine, line)
        if fix is not None:
            yield fix


def _outcomes(problem: Problem, *outcomes: str) -> Iterator[Fix]:
    """Transitions on outcomes lead to the final state beside, or back to their source."""
    state = problem.around(State)
    target = _target(problem, state)
    if state is not None:
        lines = [f"on {outcome} -> {target}" for outcome in outcomes]
        fix = insert(state, "\n".join(lines))
        if fix is not None:
            yield fix


def _target(problem: Problem, state: State | None) -> str:
    machine = problem.around(StateMachine)
    finals = (
        [each.name for each in machine.items if isinstance(each, FinalState)] if machine else []
    )
    return str(finals[0] if finals else state.name if state is not None else "")


def _otherwise(problem: Problem) -> Iterator[Fix]:
    choice = problem.around(Choice)
    if choice is not None and choice.branches:
        fix = insert(choice, f"else -> {choice.branches[-1].target.name}")
        if fix is not None:
            yield fix


def _enum_values(problem: Problem, *values: str) -> Iterator[Fix]:
    enum = problem.around(EnumType)
    fix = (
        insert(enum, "\n".join(values), shown=f"{{ {' '.join(values)} }}")
        if enum is not None
        else None
    )
    if fix is not None:
        span, text = fix.edits[0]
        yield Fix(fix.title, ((span, text.replace(";", ",")),))


def _no_regions(problem: Problem) -> Iterator[Fix]:
    node = problem.around(Parallel)
    if node is not None:
        start = node.span.absolute.start
        word = problem.part(start, start + len("parallel "))
        yield replacing(word, "", title="Write `state`")
        region = insert(node, "region First { initial Begin; state Begin }")
        if region is not None:
            yield region


def _swarm_event(problem: Problem, name: str) -> Iterator[Fix]:
    """Declare an event as one that other robots hear."""
    yield from _of_swarm(problem.named(name, Event))


def _heard_events(problem: Problem) -> Iterator[Fix]:
    """Declare an event of the transition as one that other robots send."""
    transition = problem.around(Transition)
    triggers = transition.triggers if transition is not None else ()
    for each in triggers:
        if isinstance(each, EventTrigger) and each.event.target is not None:
            yield from _of_swarm(each.event.target)


def _of_swarm(event: Event | None) -> Iterator[Fix]:
    if event is not None and not event.swarm:
        start = event.span.absolute
        at = (start._replace(end=start.start), "swarm ")
        yield Fix(f"Declare `swarm event {event.name}`", (at,))


def _operator(problem: Problem, name: str) -> Iterator[Fix]:
    """Declare an event as one that a person sends."""
    event = problem.named(name, Event)
    if event is not None and not event.operator:
        source, start, _ = event.span.absolute
        at = source.text.rfind("event", start, event.name.span.absolute.start)
        edit = (Span(source, at, at), "operator ")
        yield Fix(f"Declare `swarm operator event {name}`", (edit,))


def _reliable(problem: Problem, name: Span) -> Iterator[Fix]:
    event = problem.declared(name)
    for setting in event.delivery if isinstance(event, Event) else ():
        if setting.kind == "best":
            yield replacing(setting.span.absolute, "reliable")


def _delayed(problem: Problem) -> Iterator[Fix]:
    """Delay the sending that is to be cancelled."""
    for send in problem.every(Send):
        if send.event.name == problem.span.text and send.delay is None:
            yield inserting(send.span.absolute, " after 5 s")
            return


def _bound(problem: Problem, type_: str, name: str = "") -> Iterator[Fix]:
    for variable in problem.every(Variable):
        if variable.name == (name or problem.span.text):
            yield replacing(variable.type.span.absolute, type_)
            return


def _instead(problem: Problem, text: str) -> Iterator[Fix]:
    """Turn a part that names a machine into a behavior: `behavior Patrol`."""
    part = problem.around(Part)
    if part is not None:
        yield replacing(part.span.absolute, text, safe=True)


def _something(problem: Problem) -> Iterator[Fix]:
    end = len(problem.text)
    gap = "\n" if problem.text.strip() else ""
    edit = (problem.part(end, end), f"{gap}event Start : std_msgs/Empty\n")
    yield Fix("Declare `event Start`", (edit,))


RULES: Rules = {
    "add else": _otherwise,
    "add environment": _environment,
    "add fitness": _fitness,
    "add initial": _initial,
    "add member": _member,
    "add outcomes": _outcomes,
    "add setting": _setting,
    "add values": _enum_values,
    "bound": _bound,
    "declare": _declaration,
    "declare constant": _constant,
    "declare something": _something,
    "declare swarm event": _swarm_event,
    "declare swarm events": _heard_events,
    "declare value": _variable,
    "delay send": _delayed,
    "end machine": _final,
    "import": _import,
    "insert": _into_all,
    "make plain": _no_regions,
    "operator event": _operator,
    "reliable": _reliable,
    "replace part": _instead,
}
