"""Checks of properties and measures: their subject, their robots, facts that never hold."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from swarmdsl.analysis.checks.conjunctions import satisfiable
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import guard_condition
from swarmdsl.analysis.event_topics import received_topic
from swarmdsl.analysis.resolve.multiplicity import greatest
from swarmdsl.analysis.resolve.sentences import (
    Sentence,
    each_robot_of,
    facts_in,
    machines_of_fact,
    robots_in,
    role_of_fact,
    subjects_of,
)
from swarmdsl.base.diagnostics.advice import Advice, before, edits, last_robot, write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.records import replace
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Activity,
    Communication,
    Event,
    EventTrigger,
    Fact,
    Fitness,
    Function,
    Measure,
    MonitorTrigger,
    Node,
    Property,
    Role,
    Send,
    SpaceMeasure,
    State,
    StateMachine,
    Swarm,
    TopLevel,
    nodes_of,
    whole,
)
from swarmdsl.syntax.types import BOOL, DURATION

_QUANTIFIERS = ("all", "some", "no")


def check_subjects(project: Project, context: Context) -> None:
    """Check that a property that names no swarm or machine is about the only one."""
    for file, owner in project.declarations():
        measures = isinstance(owner, Fitness) and any(
            nodes_of(owner, kind) for kind in (Measure, SpaceMeasure)
        )
        if not isinstance(owner, Property) and not measures:
            continue
        assert isinstance(owner, (Property, Fitness))
        if owner.subject is not None or file.library:
            continue
        found = subjects_of(owner, project)
        if len(found) == 1 or any(each.parsed.skipped_names for each in project.files):
            continue
        names = [f"of {each.name}" for each in found]
        help_: str = "declare a `swarm`"
        if names:
            help_ = Advice(
                f"write {listed(names)} after its name", "append", *(f" {each}" for each in names)
            )
        kind = "fitness" if measures else "property"
        context.report.report(
            "unclear-property", owner.name.span, kind=kind, name=owner.name, help=help_
        )


def check_property(owner: Property, context: Context) -> None:
    """Check a property: its duration, its probability, and its facts."""
    body = owner.body
    if body.within is not None:
        context.check_constant(body.within, DURATION)
        value = context.typing.folding.value(body.within.tree) if body.within.tree else None
        if isinstance(value, (int, float)) and value < 0:
            context.report.report("negative-delay", body.within.span)
    chance = owner.chance
    if chance is not None and float(chance.probability) > 1:
        context.report.report(
            "bad-chance",
            chance.span,
            text=chance.probability,
            help=Advice("write a number from 0 to 1, such as `0.95`", "number", "0.95"),
        )
    check_facts(owner, owner, context)


def check_facts(sentence: Sentence, owner: TopLevel, context: Context) -> None:
    """Check the facts in a sentence of a declaration."""
    facts = facts_in(sentence)
    if isinstance(sentence.about, StateMachine):
        _check_no_robots(sentence, sentence.about, context)
    elif sentence.about is not None:
        for fact in facts:
            if not isinstance(sentence, Measure) or fact is not each_robot_of(sentence):
                _check_robots(fact, sentence, context)
    for fact in facts:
        context.expect(fact.guard, BOOL, context.typing.in_fact(fact))
        if sentence.about is not None and not context.incomplete:
            _check_possible(fact, sentence, context)


def _check_no_robots(owner: Sentence, machine: StateMachine, context: Context) -> None:
    """Report roles in a property of a machine."""
    places = [fact.counted.span for fact in facts_in(owner) if fact.counted is not None]
    places += [who.role.span for who in robots_in(owner)]
    places += [owner.each.role.span] if owner.each is not None else []
    for place in places:
        context.report.report(
            "misplaced-robots",
            place,
            name=place.text,
            fault=f"is not part of state machine `{machine.name}`",
            related=(Label(machine.name.span, "the property is about this state machine"),),
            help="leave it out, or write `of` with the name of a swarm",
        )


def _check_robots(fact: Fact, owner: Sentence, context: Context) -> None:
    """Check that a fact in a property of a swarm says which robots it is about."""
    if fact.who is None:
        if owner.each is None and fact.counted is None and (fact.act or fact.event is None):
            context.report.report(
                "unnamed-robot",
                fact.span,
                which="which robot it is about",
                help=_about_each(owner),
            )
        return
    who, role = fact.who, fact.who.role.target
    if role is None:
        return
    misplaced = partial(context.report.report, "misplaced-robots", who.span, name=who.span.text)
    if who.other and (owner.each is None or owner.each.role.target is not role):
        misplaced(
            fault="has no robot to be another one of",
            help=f"begin the {_kind(owner)} with `each {role.name} :`",
        )
    most = greatest(role)
    if who.index:
        if most is not None and whole(who.index) >= most:
            misplaced(
                fault=f"is no robot of role `{role.name}`",
                related=(Label(role.span, "it has robots from 0 on"),),
                help=last_robot(role.name, most) if most else None,
            )
    elif not who.quantifier and not who.lower and most != 1:
        context.report.report(
            "unnamed-robot",
            who.span,
            which=f"which robot of role `{role.name}` it is about",
            related=(Label(role.span, "it can have several"),),
            help=f"leave `{role.name}` out here: `each {role.name} :` says it"
            if owner.each is not None and owner.each.role.target is role
            else write(*(f"{word} {role.name}" for word in _QUANTIFIERS), f"{role.name}[0]"),
        )


def _about_each(owner: Sentence) -> str:
    """Return the help for a fact that no robot is named in; a single role can be meant."""
    text = (
        f"begin the {_kind(owner)} with `each ROLE :`, or write `all ROLE`, "
        "`some ROLE` or `no ROLE` here"
    )
    swarm = owner.about if isinstance(owner, Property) else None
    roles = [each for each in swarm.items if isinstance(each, Role)] if swarm is not None else []
    if not isinstance(owner, Property) or len(roles) != 1:
        return text
    words = f"each {roles[0].name} :"
    beginning = owner.scope or owner.body
    return edits(text, f"Add `{words}`", before(beginning.span, f"{words} "))


def _kind(sentence: Sentence) -> str:
    return "measure" if isinstance(sentence, Measure) else "property"


def _check_possible(fact: Fact, owner: Sentence, context: Context) -> None:
    """Report a fact that can never hold."""
    reason = _limit(fact) or _never_done(fact, owner) or _never_true(fact, context)
    if reason is not None:
        context.report.report(
            "impossible-fact",
            fact.span,
            reason=reason,
            help="change it, or the model so that it can happen",
        )


def _limit(fact: Fact) -> str | None:
    """Describe why a role never has so many robots; None if it can."""
    role = fact.counted.target if fact.counted is not None else None
    if role is not None:
        needed = whole(fact.number) + (fact.comparison == ">")
        if fact.comparison not in (">", ">=", "=="):
            return "a number is never below 0" if (fact.comparison, needed) == ("<", 0) else None
    elif fact.who is not None and fact.who.lower and fact.who.lower != "*":
        upper = fact.who.upper
        if upper and upper != "*" and whole(upper) < whole(fact.who.lower):
            return f"no number is in `{fact.who.lower}..{upper}`"
        role, needed = fact.who.role.target, whole(fact.who.lower)
    most = greatest(role) if role is not None else None
    if role is None or most is None or needed <= most:
        return None
    return f"role `{role.name}` has at most {most} robot{'s' if most != 1 else ''}"


def _never_done(fact: Fact, owner: Sentence) -> str | None:
    """Describe why machines never do this; None if one can."""
    if fact.event is None and fact.function is None:
        return None
    if fact.act:
        machines = machines_of_fact(fact, owner)
        role = role_of_fact(fact, owner)
        who = f"role `{role.name}`" if role is not None else f"`{getattr(owner.about, 'name', '')}`"
    else:
        machines, who = _machines_of(owner), f"`{getattr(owner.about, 'name', '')}`"
    if not machines:
        return None
    found: set[Node | None] = set()
    topics: set[str] = set()
    for machine in _with_reused(machines):
        if fact.function is not None:
            found |= {each.function.target for each in nodes_of(machine, Activity)}
        elif fact.act == "sends":
            found |= {each.event.target for each in nodes_of(machine, Send)}
        else:
            found |= {each.event.target for each in nodes_of(machine, EventTrigger)}
            topics |= {received_topic(each) for each in nodes_of(machine, MonitorTrigger)}
    ref = fact.event if fact.event is not None else fact.function
    assert ref is not None
    if ref.target is None or None in found:
        return None
    if ref.target in found:
        return _never_ends_so(fact)
    if isinstance(ref.target, Event) and received_topic(ref.target) in topics:
        return None
    verb = "calls" if fact.function is not None else "sends" if fact.act == "sends" else "waits for"
    return f"{who} never {verb} `{ref.name}`"


def _never_ends_so(fact: Fact) -> str | None:
    """Describe why a function that is called never has an outcome; None if it can."""
    target = fact.function.target if fact.function is not None else None
    items = target.items if isinstance(target, Function) else ()
    paradigms = {item.paradigm for item in items if isinstance(item, Communication)}
    if fact.outcome != "preempted" or paradigms != {"service"}:
        return None
    return "a service ends as `succeeded` or `aborted`"


def _never_true(fact: Fact, context: Context) -> str | None:
    """Describe why a condition never holds; None if it can, or has an error."""
    tree = fact.guard.tree if fact.guard is not None else None
    typing = replace(context.typing.in_fact(fact), report=Diagnostics())
    if tree is None or typing.infer(tree) != BOOL:
        return None
    if satisfiable(guard_condition(tree, typing)):
        return None
    return "its condition is always false"


def _machines_of(owner: Sentence) -> list[StateMachine]:
    if isinstance(owner.about, StateMachine):
        return [owner.about]
    from swarmdsl.analysis.resolve.addresses import machines_in

    return [*machines_in(owner.about)] if isinstance(owner.about, Swarm) else []


def _with_reused(machines: Iterable[StateMachine]) -> list[StateMachine]:
    """Return machines and those that their states reuse."""
    found: dict[StateMachine, None] = {}
    work = list(machines)
    while work:
        machine = work.pop()
        if machine not in found:
            found[machine] = None
            states = nodes_of(machine, State)
            uses = (state.machine.target for state in states if state.machine is not None)
            work += [each for each in uses if each is not None]
    return list(found)
