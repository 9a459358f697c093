"""Verdicts and findings as diagnostics, and as text with the conditions of the proofs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.source import Span
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.world.line import Line, as_text
from swarmdsl.execution.verify.findings.finding import Fault, Finding
from swarmdsl.execution.verify.findings.findings import Survey
from swarmdsl.execution.verify.findings.reached import transitions_of
from swarmdsl.execution.verify.proofs.verdict import Verdict, not_run
from swarmdsl.execution.verify.report.hints import hint
from swarmdsl.execution.verify.robot.timing import Bounds
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm.model import Model

_MOST_LINES = 40
"""Maximum number of lines of a run in a diagnostic."""
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


def report_verdict(verdict: Verdict, size: str, report: Diagnostics) -> None:
    """Report a property that a run violates."""
    if verdict.outcome != "fails" or verdict.run is None:
        return
    report.report(
        "refuted-property",
        verdict.property.origin,
        name=verdict.property.name,
        who=f" for `{verdict.robot}`" if verdict.robot is not None else "",
        related=tuple(_last_taken(verdict.run, robot=verdict.robot)),
        notes=(_head(verdict.run, size), *_lines(verdict.run)),
        help=hint(verdict.run),
    )


def open_findings(found: Survey, faults: int) -> Iterator[str]:
    """Yield what may be wrong with a swarm in which so many robots may be lost."""
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


def report_finding(finding: Finding, size: str, report: Diagnostics) -> None:
    """Report what is wrong with a swarm."""
    run = finding.run
    astray = finding.fault == "lost" and finding.detail
    notes = (_head(run, size), *_lines(run)) if run is not None else (f"in {size}",)
    report.report(
        _CODES[finding.fault],
        finding.place,
        name=finding.name,
        who=f"`{finding.role}`" if finding.role else "robot",
        reason=finding.detail,
        related=tuple(_last_taken(run, finding.place)) if run is not None else (),
        notes=notes,
        help=(f"look at its address: {finding.detail} does not handle it" if astray else None)
        or (hint(run) if run is not None and finding.fault == "stuck" else None)
        or _HELP.get(finding.fault),
    )


def _head(run: Run, size: str) -> str:
    if run.loop:
        return f"a run that goes on for ever, of {size}:"
    return f"a shortest run, of {size}:" if run.shortest else f"a run, of {size}:"


def _lines(run: Run) -> Iterator[str]:
    """Format a run: a line a step, with the place of its transition."""
    width = max((len(line.actor.name or "") for line in run.lines), default=0)
    again = len(run.lines) - run.loop if run.loop else None
    told = list(enumerate(run.lines))
    if len(told) > _MOST_LINES:
        busy = {line.actor.robot for line in run.lines if line.event is not None or line.sent}
        told = [each for each in told if each[1].actor.robot in busy]
        rest = len({line.actor.robot for line in run.lines} - busy)
        if rest:
            yield f"{counted(rest, 'robot')} only start, and are left out here"
    for number, line in told[:_MOST_LINES]:
        if number == again:
            yield "from here on, again and again:"
        yield from _losses(run, number)
        yield from _quiet_losses(run, number)
        place = place_of(line)
        about = [f"from {line.envelope.sender}"] if line.envelope.sender else []
        if place is not None:
            about.append(f"{printable(place.source.name)}:{place.line}")
        where = f"  ({', '.join(about)})" if about else ""
        yield f"{as_text(line, width)}{where}"
    if len(told) > _MOST_LINES:
        yield f"... and {len(told) - _MOST_LINES} more"
    else:
        yield from _losses(run, len(run.lines))
        yield from _quiet_losses(run, len(run.lines))
        if run.loop == 0:
            yield f"nothing happens{_to_whom(run)} any more"


def _to_whom(run: Run) -> str:
    """Name the robots of a run: others, of which these hear nothing, may go on."""
    names = [name for name in dict.fromkeys(line.actor.robot.name for line in run.lines) if name]
    if not names:
        return ""
    return f" to {listed(names, 'and') if len(names) <= 3 else 'these robots'}"


def _quiet_losses(run: Run, number: int) -> Iterator[str]:
    """Format the losses of robots that have no line: of those whose machines have ended."""
    for loss in run.gone:
        lines = run.lines[loss.at : loss.at + 1]
        is_told = any(each.event == LOST and each.actor.robot.name == loss.robot for each in lines)
        if loss.at == number and not is_told:
            yield f"{loss.robot or 'the robot'} is lost"


def _losses(run: Run, number: int) -> Iterator[str]:
    """Format the messages that are lost after some lines of a run."""
    return (f"{event} to {robot} is lost" for at, event, robot in run.lost if at == number)


def place_of(line: Line) -> Span | None:
    """Return the place of the first transition of a line."""
    known = transitions_of(line.actor.machine)
    called = line.actor.machine.called
    found = (known[called(each)].origin for each in line.taken if called(each) in known)
    return next(found, None)


def _last_taken(run: Run, told: Span | None = None, robot: str | None = None) -> Iterator[Label]:
    """Yield the place of the last transition of a run, of the given robot if it has taken one."""
    taken = [(line, place) for line in reversed(run.lines) if (place := place_of(line)) is not None]
    own = [each for each in taken if each[0].actor.robot.name == robot]
    for _, place in (own or taken)[:1]:
        if place != told:
            whose = f"of `{robot}` in" if robot is not None and own else "of"
            yield Label(place, f"the last transition {whose} the run")


def rows(verdicts: Sequence[Verdict], faults: int = 0) -> Iterator[tuple[str, str, str]]:
    """Yield the names of the properties with their verdicts and reasons, if robots may be lost."""
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
            names = listed(list(full), "and")
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
    for doubt in dict.fromkeys(model.doubts(model.groups())):
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
