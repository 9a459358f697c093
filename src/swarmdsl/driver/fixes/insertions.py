"""Fixes that declare or add what is missing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes.bodies import insert, insertion, opening_brace
from swarmdsl.driver.fixes.problem import CODE, Act, Problem, Rule, inserting, proposed, replacing
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
    Node,
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
    """Add a line to the states with these names."""
    edits = []
    for name in names:
        span = name.absolute
        states: list[State | Parallel] = [*problem.every(State), *problem.every(Parallel)]
        found = (each for each in states if each.name.span.absolute == span)
        edit = insertion(state, line) if (state := next(found, None)) is not None else None
        if edit is None:
            return
        edits.append(edit)
    yield Fix(f"Add `{line}`", tuple(edits))


def _declaration(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    edit = _edit(problem, below_head(problem.file, match[1]))
    yield Fix(f"Declare `{match[1]}`", (edit,))


def _edit(problem: Problem, change: Change) -> tuple[Span, str]:
    start, end, text = change
    return problem.part(start, end), text


def _variable(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Declare a variable or input below the last value of its owner."""
    declared = problem.file.model.declarations
    owner = next((each for each in declared if each.name == match[1]), None)
    if not isinstance(owner, (StateMachine, Fitness)):
        return
    text, line = problem.text, match[2]
    values = [each for each in owner.items if isinstance(each, (Param, Variable, FitnessInput))]
    at = values[-1].span.absolute.end if values else opening_brace(owner)
    if at is None:
        return
    rest = _REST.match(text, at)
    at = rest.end() if rest is not None else at
    ending = "" if text.startswith("\n", at) else "\n "
    edit = (problem.part(at, at), f"\n  {line}{ending}")
    yield Fix(f"Declare `{line}`", (edit,))


def _constant(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Declare a constant above the declaration that uses it."""
    declared = problem.file.model.declarations
    owner = next((each for each in declared if each.name == match[1]), None)
    type_ = match[2].partition(" : ")[2].partition(" = ")[0]
    zero = {"bool": "false", "string": '""', "duration": "0 s"}.get(
        type_, "0.0" if type_.startswith("float") else "0" if "int" in type_ else None
    )
    if owner is not None and zero is not None:
        line = match[2].replace("...", zero)
        start = problem.text.rfind("\n", 0, owner.span.absolute.start) + 1
        while problem.text[:start].endswith("\n") and problem.text[: start - 1].rpartition("\n")[
            2
        ].startswith("///"):
            start = problem.text.rfind("\n", 0, start - 1) + 1
        yield Fix(f"Declare `{line}`", ((problem.part(start, start), f"{line}\n\n"),))


def _into(*kinds: type[Node], first: bool = False) -> Rule:
    """Return the rule that adds the code of the help to the node of some kinds around the place."""

    def rule(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
        node = problem.around(*kinds)
        fix = insert(node, match[1], first=first) if node is not None else None
        if fix is not None:
            yield fix

    return rule


def _into_named(kind: type[Node]) -> Rule:
    """Return the rule that adds the code of the help to the node that the help names."""

    def rule(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
        node = problem.named(match[2], kind)
        fix = insert(node, match[1]) if node is not None else None
        if fix is not None:
            yield fix

    return rule


def _into_environment(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    named = CODE.search(problem.found.message)
    node = problem.named(named[1], Environment) if named is not None else None
    fix = insert(node, match[1]) if node is not None else None
    if fix is not None:
        yield fix


def _environment(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Use the first environment of the model, or declare one."""
    swarm = problem.named(match[1], Swarm)
    if swarm is None:
        return
    there = next(problem.every(Environment), None)
    name = there.name if there is not None else "Field"
    edit = insertion(swarm, f"environment {name}", first=True)
    edits = [edit] if edit is not None else []
    if there is None:
        line = "environment Field { size 50 m x 50 m }"
        edits.append(_edit(problem, below_head(problem.file, line)))
    yield Fix(f"Add `environment {name}`", tuple(edits))


def _member(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    swarm = problem.around(Swarm)
    member = next(problem.every(Member), None)
    name = str(member.name) if member is not None else "Robot"
    role = f"{name[0].lower()}{name[1:]} : {name}[3]"
    edit = insertion(swarm, role) if swarm is not None else None
    if edit is not None:
        declared = _edit(problem, below_head(problem.file, "member Robot { }"))
        yield Fix(f"Add `{role}`", (edit,) if member is not None else (edit, declared))


def _fitness(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    swarm = problem.named(match[1], Swarm)
    for fitness in problem.every(Fitness):
        about = fitness.subject.name if fitness.subject is not None else match[1]
        fix = insert(swarm, f"fitness {fitness.name}") if swarm and about == match[1] else None
        if fix is not None:
            yield fix
            return


def _first_state(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    node = problem.around(State, Region, StateMachine)
    fix = insert(node, "initial First\nstate First", shown="state First") if node else None
    if fix is not None:
        yield fix


def _final(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Declare a machine endless, or add a final state."""
    machine = problem.around(StateMachine)
    if machine is not None:
        start = machine.span.absolute.start
        at = problem.part(start, start)
        yield Fix("Write `endless statemachine`", ((at, "endless "),))
        fix = insert(machine, match[1])
        if fix is not None:
            yield fix


def _final_inside(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    region = problem.span.text.rpartition(".")[0]
    named = CODE.search(problem.found.message)
    node: Node | None = problem.named(region, Region) if region else None
    if node is None and named is not None:
        node = problem.named(named[1], State)
    fix = insert(node, "final Done") if node is not None else None
    if fix is not None:
        yield fix


def _outcomes(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Transitions on outcomes lead to the final state beside, or back to their source."""
    state = problem.around(State)
    target = _target(problem, state)
    if state is not None:
        # The last word of the help is the state.
        lines = [each for each in CODE.findall(match[0]) if each.endswith("-> ...")]
        fix = insert(state, "\n".join(each.replace("...", target) for each in lines))
        if fix is not None:
            yield fix


def _target(problem: Problem, state: State | None) -> str:
    machine = problem.around(StateMachine)
    finals = (
        [each.name for each in machine.items if isinstance(each, FinalState)] if machine else []
    )
    return str(finals[0] if finals else state.name if state is not None else "")


def _otherwise(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    choice = problem.around(Choice)
    if choice is not None and choice.branches:
        fix = insert(choice, f"else -> {choice.branches[-1].target.name}")
        if fix is not None:
            yield fix


def _enum_values(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    enum = problem.around(EnumType)
    values = match[1].strip("{ }").split()
    fix = insert(enum, "\n".join(values), shown=match[1]) if enum is not None else None
    if fix is not None:
        span, text = fix.edits[0]
        yield Fix(fix.title, ((span, text.replace(";", ",")),))


def _no_regions(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    node = problem.around(Parallel)
    if node is not None:
        start = node.span.absolute.start
        word = problem.part(start, start + len("parallel "))
        yield replacing(word, "", title="Write `state`")
        region = insert(node, "region First { initial Begin; state Begin }")
        if region is not None:
            yield region


def _swarm_event(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Declare an event as one that other robots hear."""
    named = match[1] if match.lastindex else ""
    if not named:
        transition = problem.around(Transition)
        triggers = transition.triggers if transition is not None else ()
        events = [each.event.target for each in triggers if isinstance(each, EventTrigger)]
    else:
        events = [problem.named(named, Event)]
    event = next((each for each in events if each is not None and not each.swarm), None)
    if event is not None:
        start = event.span.absolute
        at = (start._replace(end=start.start), "swarm ")
        yield Fix(f"Declare `swarm event {event.name}`", (at,))


def _reliable(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    named = CODE.search(problem.found.message)
    event = problem.named(named[1], Event) if named is not None else None
    for setting in event.delivery if event is not None else ():
        if setting.kind == "best":
            yield replacing(setting.span.absolute, "reliable")


def _heartbeat(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    names = CODE.findall(problem.found.message)
    swarm = problem.named(names[-1], Swarm) if names else None
    fix = insert(swarm, match[1]) if swarm is not None else None
    if fix is not None:
        yield fix


def _delayed(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    """Delay the sending that is to be cancelled."""
    for send in problem.every(Send):
        if send.event.name == problem.span.text and send.delay is None:
            yield inserting(send.span.absolute, " after 5 s")
            return


def _bound(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    for variable in problem.every(Variable):
        if variable.name == problem.span.text:
            yield replacing(variable.type.span.absolute, match[1])
            return


def _subject(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    for text in CODE.findall(match[0]):
        yield inserting(problem.span, f" {text}")


def _instead(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Turn a part that names a machine into a behavior: `behavior Patrol`."""
    part = problem.around(Part)
    if part is not None:
        yield replacing(part.span.absolute, match[1], safe=True)


def _something(problem: Problem, _match: re.Match[str]) -> Iterator[Fix]:
    end = len(problem.text)
    gap = "\n" if problem.text.strip() else ""
    edit = (problem.part(end, end), f"{gap}event Start : std_msgs/Empty\n")
    yield Fix("Declare `event Start`", (edit,))


ACTS: dict[str, Act] = {"import": _import, "insert": _into_all}
RULES: tuple[tuple[str, Rule], ...] = (
    (r"declare something, .*", _something),
    (r"declare it in `(\w+)`: `([^`]+)`", _variable),
    (r"declare it above `(\w+)`: `([^`]+)`", _constant),
    (r"declare it: `([^`]+)`.*", _declaration),
    (r"write `(behavior \w+)`", _instead),
    (r"add `(area [^`]+)` to it", _into_environment),
    (r"swarm `(\w+)` has no environment: add one, `[^`]+`", _environment),
    (r"add a member: `([^`]+)`", _member),
    (r"add `fitness Name` to swarm `(\w+)`.*", _fitness),
    (r"add `((?:range|capacity) = [^`]+)`", _into(Sight, Equipment)),
    (r"add `(speed = [^`]+)` to the body", _into(Equipment)),
    (r"add `(initial \w+)`, for instance", _into(State, Region, StateMachine, first=True)),
    (r"add a state, and `initial` with its name", _first_state),
    (r"add `(final \w+)`, or write `endless statemachine` .*", _final),
    (r"add a final state to it", _final_inside),
    (r"add (?:`on \w+ -> \.\.\.`(?:, | and )?)+ to state `(\w+)`", _outcomes),
    (r"add `else -> \.\.\.`", _otherwise),
    (r"add `do function` to the state, or wait for `(done)`", proposed),
    (r"add `(param [^`]+)` to `(\w+)`", _into_named(Member)),
    (r"name what a value of it can be: `([^`]+)` for instance", _enum_values),
    (r"add `region Name \{ \.\.\. \}`; .*", _no_regions),
    (r"as `swarm event (\w+)` it reaches .*", _swarm_event),
    (r"declare `swarm event (\w+)` to send .*", _swarm_event),
    (r"declare the event with `swarm event` if .*", _swarm_event),
    (r"declare the event as `reliable`", _reliable),
    (r"add `(heartbeat [^`]+)` to the swarm", _heartbeat),
    (r"send it with a delay: `[^`]+`", _delayed),
    (r"give it a bound, such as `([^`]+)`", _bound),
    (r"write `of \w+`(?:(?:, | or )`of \w+`)* after its name", _subject),
)
"""The first pattern that matches the whole help of a diagnostic makes its fixes."""
