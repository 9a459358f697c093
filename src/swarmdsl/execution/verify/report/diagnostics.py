"""Verdicts and findings as diagnostics, and as text with the conditions of the proofs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.verify.findings.finding import Fault, Finding, Survey
from swarmdsl.execution.verify.proofs.verdict import Verdict, not_run
from swarmdsl.execution.verify.report.hints import hint
from swarmdsl.execution.verify.report.run_text import Fields, last_taken, run_text
from swarmdsl.execution.verify.robot.timing import Bounds
from swarmdsl.execution.verify.swarm.model import Model

_CODES: Mapping[Fault, str] = {
    "loops": "endless-reaction",
    "fails": "failed-computation",
    "stuck": "stuck-swarm",
    "waits": "waiting-for-ever",
    "unreachable": "absent-state",
    "untaken": "untaken-transition",
    "lost": "unhandled-message",
    "answers": "endless-answers",
}
_HELP: Mapping[Fault, str] = {
    "loops": "add an event or a delay to one of the transitions",
    "stuck": "let something go on by itself: a delay, or an activity that ends",
    "waits": "let a robot send what it waits for, or add a transition `after` a time",
    "answers": "let a delay or an activity pass before an answer, or answer only once",
    "lost": "handle it in the states in which it arrives, or `defer` it there",
}


def code_of(finding: Finding) -> str:
    """Return the code of its diagnostic."""
    return CODES[_CODES[finding.fault]].code


def report_verdict(verdict: Verdict, size: str, fields: Fields, report: Diagnostics) -> None:
    """Report a property that a run violates."""
    if verdict.outcome != "fails" or verdict.run is None:
        return
    report.report(
        "refuted-property",
        verdict.property.origin,
        name=verdict.property.name,
        who=f" for `{verdict.robot}`" if verdict.robot is not None else "",
        related=tuple(last_taken(verdict.run, robot=verdict.robot)),
        notes=tuple(run_text(verdict.run, size, fields)),
        help=hint(verdict.run),
    )


def open_findings(surveys: Iterable[Survey], faults: int) -> Iterator[str]:
    """Yield what may be wrong with swarms in which so many robots may be lost."""
    for found in surveys:
        yield from (_open_finding(*each) for each in found.open)
        if found.news:
            who = "comes back" if faults else "is lost: try `--faults 1`"
            yield f"which robots wait, and what never happens, as some follow who {who}"


def _open_finding(finding: Finding, flaw: str) -> str:
    """Return what may be wrong, and where, with the flaw of the run to it."""
    message = CODES[_CODES[finding.fault]].message.format(
        name=finding.name,
        who=f"`{finding.role}`" if finding.role else "robot",
        reason=finding.detail,
    )
    place = finding.place
    where = f" ({place.source.name}:{place.line})" if place is not None else ""
    return f"{message}{where}? {not_run(flaw)}"


def report_finding(finding: Finding, size: str, fields: Fields, report: Diagnostics) -> None:
    """Report what is wrong with a swarm."""
    run = finding.run
    astray = finding.fault == "lost" and finding.detail
    notes = tuple(run_text(run, size, fields)) if run is not None else (f"in {size}",)
    report.report(
        _CODES[finding.fault],
        finding.place,
        name=finding.name,
        who=f"`{finding.role}`" if finding.role else "robot",
        reason=finding.detail,
        related=tuple(last_taken(run, finding.place)) if run is not None else (),
        notes=notes,
        help=(f"look at its address: {finding.detail} does not handle it" if astray else None)
        or (hint(run) if run is not None and finding.fault == "stuck" else None)
        or _HELP.get(finding.fault),
    )


def rows(
    verdicts: Sequence[Verdict], faults: int, worst_at: Mapping[str, Mapping[str, int]]
) -> Iterator[tuple[str, str, str]]:
    """Yield the names of the properties with their verdicts and reasons.

    `faults` robots may be lost; `worst_at` has the sizes of the verdicts if there are several.
    """
    for each in verdicts:
        reason = each.reason
        open_ = each.outcome == "up to"
        states = counted_in_thousands(each.states, "state")
        outcome = f"holds up to {states}" if open_ else each.outcome
        if each.place is not None:
            reason += f" ({each.place.source.name}:{each.place.line})"
        if each.outcome in ("holds", "up to"):
            reason = "; ".join(filter(None, (reason, _whatever(each))))
        if each.outcome == "fails" and each.robot is not None:
            reason = f"for {each.robot}" + (f", {reason}" if reason else "")
        if faults and each.outcome in ("holds", "up to"):
            reason = ", ".join(filter(None, (reason, with_losses(faults))))
        counts = worst_at.get(each.property.name)
        if counts is not None and each.outcome != "holds":
            size = f"of {', '.join(f'{number} {role}' for role, number in counts.items())}"
            fails = each.outcome == "fails"
            told = filter(None, (reason, size) if fails else (size, reason))
            reason = (", " if fails else ": ").join(told)
        yield each.property.name, outcome, reason


def _whatever(verdict: Verdict) -> str:
    """Describe what a proof does not look at."""
    found = ["whatever the other robots do"] if verdict.alone else []
    if verdict.open:
        found.append(f"whatever the values of {' and '.join(verdict.open)} are")
    return ", and ".join(found)


def conditions(model: Model, full: Sequence[str], *, fair: bool) -> Iterator[str]:
    """Yield what the verdicts were found under; `fair` says if some are about what must happen."""
    options = model.options
    environment = model.environment
    messages = [each for each in model.alphabet.messages if not each.is_heartbeat]
    if messages:
        loss = "any of them may be lost" if environment.lossy else "none is lost"
        reliable = sorted({each.event.name for each in messages if each.reliable})
        if environment.lossy and reliable:
            loss += f" but {listed(reliable, 'and')}"
            loss += " of robots that are there" if environment.faults else ""
        yield f"messages between robots arrive in any order, {loss}"
        if full:
            names = ("each of " if len(full) > 1 else "") + listed(list(full), "and")
            yield f"of more than {options.capacity} {names} on the way to a robot, the rest is lost"
    yield from _times(model)
    if options.scenario is None:
        yield "functions succeed or are aborted, actions are also preempted"
    else:
        moving = f", {listed(list(environment.moving), 'and')} in any" if environment.moving else ""
        yield f"functions end in the ways that the scenario gives a probability{moving}"
    silent = model.silent
    if fair:
        but = f", but {listed(silent, 'and')} may never end" if silent else ""
        yield f"functions and delays end some time{but}, and events that are not lost arrive"
        yield "a function may end in the same way each time, and nothing need come from outside"
        if environment.faults and not model.returns:
            yield "what each robot must do is asked of one that is not lost"
    elif silent:
        yield f"{listed(silent, 'and')} may never end"
    if any(automaton.asks_who_is_near for automaton in model.kinds):
        yield "any number of other robots may be near a robot that counts them"
    yield from _losses_of_robots(model, is_answered=not silent)
    if model.guesses:
        yield "robots may take any others for lost, and hear them again, at any time"
    yield from _from_outside(model)
    if environment.said:
        yield f"values from outside: {', '.join(environment.said)}"
    for doubt in model.every_doubt:
        place = doubt.place
        where = f" ({place.source.name}:{place.line})" if place is not None else ""
        yield f"not all is shown: {doubt.reason}{where}"


def _times(model: Model) -> Iterator[str]:
    """Yield how long functions, delays and events take."""
    has_messages = any(not each.is_heartbeat for each in model.alphabet.messages)
    if not model.options.exact:
        what = "functions, delays and messages" if has_messages else "functions and delays"
        yield f"{what} take any time"
        return
    timing = model.options.timing
    calls: dict[Bounds, dict[str, None]] = {}
    for automaton in model.kinds:
        robot = automaton.kind.cast[0].robot
        for name in automaton.kind.ends:
            calls.setdefault(timing.function(name, robot), {})[name] = None
    for bounds, names in calls.items():
        who = "functions take" if len(calls) == 1 else f"{listed(list(names), 'and')} takes"
        yield f"{who} {_span(bounds)}"
    yield "delays take as long as the model says"
    if has_messages:
        least, most = timing.message(repeats=False)
        yield f"messages take {_span((least, most))}" if most else "messages arrive at once"


def _span(bounds: Bounds) -> str:
    least, most = bounds
    if most is None:
        return f"{format_duration(least)} or more"
    if least == most:
        return format_duration(least)
    return f"{format_duration(least)} to {format_duration(most)}"


def _losses_of_robots(model: Model, *, is_answered: bool) -> Iterator[str]:
    faults = model.environment.faults
    answers = " and no answer of a function is lost" if is_answered else " is lost"
    if not faults:
        yield f"no robot{answers}"
        return
    may = [r for kind in model.kinds if kind.kind.can_be_lost for r in kind.kind.robots]
    of = (
        ""
        if len(may) == len({a.robot.name for a in model.cast})
        else " of " + listed([name or "it" for name in may], "and")
    )
    ends = "until it starts anew" if model.returns else "for ever"
    yield f"{with_losses(faults)}{of}, at any time, {ends}"
    if is_answered:
        yield "no answer of a function is lost"
    if model.subject.heartbeat is not None and not model.guesses:
        yield "each other robot gets `member_lost` some time after a loss"


def with_losses(faults: int) -> str:
    """Return the condition that robots are lost: `with at most 1 robot lost`."""
    return f"with at most {counted(faults, 'robot')} lost"


def _from_outside(model: Model) -> Iterator[str]:
    if not model.outside:
        if model.options.scenario is not None:
            yield "nothing comes from outside"
        return
    names = listed(model.outside, "and")
    if model.options.scenario is None:
        yield f"from outside, at any time: {names}"
        return
    once = {
        event
        for event in model.outside
        if all(
            len(kind.kind.outside.once.get(event, ())) == len(messages)
            for kind in model.kinds
            if (messages := kind.kind.outside.messages.get(event)) is not None
        )
    }
    rest = [event for event in model.outside if event not in once]
    if once:
        told = listed(sorted(once), "and")
        yield f"from outside, as often as in the scenario, at any time: {told}"
    if rest:
        yield f"from outside, at any time and any number of times: {listed(rest, 'and')}"


def counted_in_thousands(number: int, noun: str) -> str:
    """Return a number of things, with commas: `24,122 states`."""
    return counted(number, noun).replace(str(number), f"{number:,}", 1)
