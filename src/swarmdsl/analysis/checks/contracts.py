"""Checks of contracts: every state takes the event, and a path leads on to a safe state in time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
from functools import partial
from itertools import pairwise

from swarmdsl.analysis.called_interface import called_interface
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.contract_answers import Answer, Answers
from swarmdsl.analysis.checks.safe_paths import SafePaths, also_safe, is_left_at_once
from swarmdsl.analysis.checks.state_places import Place, inside, places_of
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.sentences import machines_of_member
from swarmdsl.analysis.resolve.states import all_resolved
from swarmdsl.base.diagnostics.advice import insert
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    ActionType,
    BehaviorUse,
    Choice,
    Contract,
    Event,
    EventTrigger,
    History,
    Member,
    Node,
    Parallel,
    Part,
    Region,
    Send,
    ServiceType,
    StateMachine,
    Transition,
    Vertex,
    nodes_of,
)
from swarmdsl.syntax.types import BOOL, DURATION

_MOST_LABELS = 3


def check_contracts(member: Member, context: Context) -> None:
    """Check the contracts of a member against the machines that it runs."""
    contracts = [item for item in member.items if isinstance(item, Contract)]
    context.check_repeated((each.name for each in contracts), "contract")
    if any(each.function is not None for each in contracts):
        _check_single_call(member, context)
    machines = machines_of_member(member) if contracts else []
    for contract in contracts:
        if contract.function is not None:
            _check_call(contract, context)
            continue
        context.expect(contract.guard, BOOL, context.with_event([*contract.triggers]))
        _check_time(contract, context)
        if not machines and not _misses_machine(member):
            reason = f"member `{member.name}` runs no state machine"
            help_ = "add `behavior` with the name of its state machine"
            _report_idle(contract, contract.name.span, reason, help_, context)
        targets = {each.state.target for each in contract.states}
        if None not in targets:
            _check_machines(contract, member, partial(_is_among, targets), context)
    if any(isinstance(item, BehaviorUse) for item in member.items):
        for contract in all_items(member, Contract):
            if contract.function is None and contract not in contracts:
                _check_inherited(contract, member, context)


def _misses_machine(member: Member) -> bool:
    """Return True if a name is wrong that may stand for a state machine of a member."""
    extends = member.base is not None and member.base.target is None
    return (
        extends
        or any(use.machine.target is None for use in all_items(member, BehaviorUse))
        or any(part.component.target is None for part in all_items(member, Part))
    )


def _is_among(targets: Set[Vertex | None], place: Place) -> bool:
    return place.node in targets


def _check_inherited(contract: Contract, member: Member, context: Context) -> None:
    """Check an inherited contract in another state machine, where its states have these names."""
    names = [str(each.state.name) for each in contract.states]
    machines = machines_of_member(member)
    missing = [name for name in names if not any(_has(each, name) for each in machines)]
    if not missing:

        def is_safe(place: Place) -> bool:
            return any(place.is_called(name) for name in names)

        _check_machines(contract, member, is_safe, context)
    elif not context.incomplete and machines:
        reason = f"no state of `{machines[0].name}` is called `{missing[0]}`"
        help_ = f"declare it in `{member.name}` again, with the states of its state machine"
        _report_idle(contract, member.name.span, reason, help_, context)


def _has(machine: StateMachine, name: str) -> bool:
    with places_of(machine) as places:
        return any(place.is_called(name) for place in inside(places))


def _report_idle(
    contract: Contract, place: Span, reason: str, help_: str, context: Context
) -> None:
    context.report.report("idle-contract", place, name=contract.name, reason=reason, help=help_)


def _check_machines(
    contract: Contract, member: Member, is_safe: Callable[[Place], bool], context: Context
) -> None:
    """Check a contract in the machines of a member, if all names are resolved."""
    machines = machines_of_member(member)
    complete = all(all_resolved(each) for each in machines) and not context.incomplete
    if not complete or any(each.event.target is None for each in contract.triggers):
        return
    within = _time(contract, context)
    if within is not None and within < 0:
        within = None  # reported as such
    own = {use.machine.target for use in all_items(member, BehaviorUse)}
    for machine in machines:
        params = [*machine.items] if machine in own else []
        with places_of(machine) as places:
            _MachineCheck(contract, machine, places, is_safe, within, context, params).run()


def _check_single_call(member: Member, context: Context) -> None:
    """Check that one function at most is called when the node of a robot has died."""
    calls = [each for each in all_items(member, Contract) if each.function is not None]
    context.check_single([each.name.span for each in calls], "the call of a watchdog")


def _check_time(contract: Contract, context: Context) -> None:
    """Check the time of a contract."""
    assert contract.within is not None
    context.check_constant(contract.within, DURATION)
    value = _time(contract, context)
    if value is not None and value < 0:
        context.report.report("negative-delay", contract.within.span)


def _time(contract: Contract, context: Context) -> int | None:
    """Return the time of a contract in nanoseconds if it is known."""
    tree = contract.within.tree if contract.within is not None else None
    value = context.typing.folding.value(tree) if tree is not None else None
    return round(value) if isinstance(value, (int, float)) else None


def _check_call(contract: Contract, context: Context) -> None:
    """Check that a function that is called by a watchdog needs no values."""
    assert contract.function is not None
    function = contract.function.target
    match called_interface(function, context.interfaces):
        case ActionType(goal=fields) | ServiceType(request=fields) if fields and function:
            context.report.report(
                "missing-field",
                contract.function.span,
                fields=listed([f"`{each.name}`" for each in fields]),
                owner=f"function `{function.name}`",
                help="call a function without values: who calls it knows none when a node has died",
            )


class _MachineCheck:
    """Check of one contract in one machine; `given` are its items with values of the member."""

    def __init__(
        self,
        contract: Contract,
        machine: StateMachine,
        places: list[Place],
        is_safe: Callable[[Place], bool],
        within: int | None,
        context: Context,
        given: Sequence[Node],
    ) -> None:
        self._contract = contract
        self._answers = Answers(contract.guard, context.with_event([*contract.triggers]), given)
        self._within = within
        self._context = context
        self._places = places
        safe = [each for each in inside(self._places) if is_safe(each)]
        sends = nodes_of(machine, Send)
        sent = {s.event.target for s in sends if s.event.target and not s.event.target.swarm}
        self._safe = safe
        self._paths = SafePaths(safe, sent, context.typing.folding)

    def run(self) -> None:
        """Report states that ignore the event, and paths that miss the safe states."""
        if not self._safe:
            return
        for trigger in self._contract.triggers:
            event = trigger.event.target
            assert event is not None
            self._check_event(trigger, event)
        self._check_kept()

    def _check_event(self, trigger: EventTrigger, event: Event) -> None:
        ignoring: list[tuple[Place, Answer]] = []
        missing: dict[Transition, tuple[Place, str]] = {}
        answers = [(leaf, self._answers.answer(leaf, event)) for leaf in self._unsafe_leaves()]
        taken = [each for _, answer in answers for each in answer.taken]
        targets = (owner.target(transition.target) for owner, transition in taken)
        reached = self._paths.reached(each for each in targets if each is not None)
        for leaf, answer in answers:
            on_its_way = leaf in reached and self._on_its_way(leaf)
            if not (answer.covers or on_its_way or self._other_region(leaf, event)):
                ignoring.append((leaf, answer))
            for owner, transition in answer.taken:
                fault = self._fault(leaf, owner, transition)
                if fault is not None:
                    missing.setdefault(transition, (leaf, fault))
        if ignoring:
            self._report_ignored(trigger, event, ignoring)
        for transition, (leaf, fault) in missing.items():
            self._context.report.report(
                "unsafe-path",
                trigger.span,
                contract=self._contract.name,
                event=event.name,
                state=leaf.name,
                fault=fault,
                related=(Label(transition.span, "this is taken"),),
                help=f"let it lead to {self._targets()}, or to a state from where a robot gets "
                "there by itself",
            )

    def _unsafe_leaves(self) -> Iterator[Place]:
        """Yield the states without others inside in which a robot may wait, and is not safe."""
        for leaf in (each for place in self._places for each in place.leaves()):
            if self._paths.is_safe(leaf) or isinstance(leaf.node, (Choice, History)):
                continue
            if leaf.is_final and (leaf.around is None or self._paths.settles(leaf)):
                continue
            if not is_left_at_once(leaf):
                yield leaf

    def _on_its_way(self, leaf: Place) -> bool:
        """Return True if a robot in a state is going to a safe one already, perhaps in time."""
        if not self._paths.leads(leaf):
            return False
        time = self._paths.time(leaf, set())
        return time is not None and (self._within is None or time <= self._within)

    def _other_region(self, leaf: Place, event: Event) -> bool:
        """Return True if another region of a parallel state takes the event in all its states."""
        chain = list(leaf.chain())
        for inner, outer in pairwise(chain):
            if isinstance(outer.node, Parallel):
                for region in outer.inside:
                    if region is not inner and self._region_takes(region, event):
                        return True
        return False

    def _region_takes(self, region: Place, event: Event) -> bool:
        leaves = [each for each in region.leaves() if not isinstance(each.node, (Choice, History))]
        # A region that stays in a final state takes nothing.
        answers = [
            (each, self._answers.answer(each, event, region))
            for each in leaves
            if not (self._paths.is_safe(each) or is_left_at_once(each))
        ]
        return bool(leaves) and all(
            answer.covers
            and not any(self._fault(leaf, owner, taken) for owner, taken in answer.taken)
            for leaf, answer in answers
        )

    def _fault(self, leaf: Place, owner: Place, transition: Transition) -> str | None:
        """Describe why a transition does not lead to a safe state in time; None if it does."""
        target = owner.target(transition.target)
        if target is None:
            return "leaves the robot where it is"
        stays = set(leaf.chain()).intersection(target.chain())
        time = self._paths.time(target, {each for each in stays if each is not target})
        if time is None:
            return f"leads to `{target.name}`, from where no path leads to a safe state"
        if self._within is not None and time > self._within:
            return f"leads to a safe state after {time / 1e9:g} s at the earliest"
        return None

    def _report_ignored(
        self, trigger: EventTrigger, event: Event, found: Sequence[tuple[Place, Answer]]
    ) -> None:
        names = [f"`{leaf.name}`" for leaf, _ in found]
        shown = names
        # One more is no longer than "1 other state".
        if len(names) > _MOST_LABELS + 1:
            shown = [*names[:_MOST_LABELS], f"{len(names) - _MOST_LABELS} other states"]
        labels = [_label(leaf, answer) for leaf, answer in found[:_MOST_LABELS]]
        around = _common(found)
        where = (
            f"state `{around.name}`"
            if around is not None
            else "each of them, or put them into a state that has it"
        )
        places = [around] if around is not None else [leaf for leaf, _ in found]
        first = self._contract.states[0].state.name
        guard = self._contract.guard
        condition = f" [{guard.span.text}]" if guard is not None else ""
        line = f"on {event.name}{condition} -> {first}"
        self._context.report.report(
            "ignored-contract",
            trigger.span,
            contract=self._contract.name,
            states=" and ".join([", ".join(shown[:-1]), shown[-1]] if len(shown) > 1 else shown),
            verb="ignores" if len(found) == 1 else "ignore",
            event=event.name,
            related=tuple(labels),
            help=insert(line, *(each.node.name.span for each in places), to=where),
        )

    def _check_kept(self) -> None:
        """Report transitions that leave the safe states though nothing has come."""
        for place, transition in self._paths.leaving():
            self._context.report.report(
                "left-safe-state",
                self._contract.name.span,
                contract=self._contract.name,
                state=place.name,
                related=(Label(transition.span, "by this transition"),),
                help=also_safe(self._contract, transition),
            )

    def _targets(self) -> str:
        return " or ".join(f"`{each.state.name}`" for each in self._contract.states)


def _label(leaf: Place, answer: Answer) -> Label:
    if answer.deferring is not None:
        return Label(answer.deferring.node.name.span, "this state puts it off")
    if answer.taken:
        return Label(answer.taken[0][1].span, "no guard holds for sure")
    return Label(leaf.node.name.span, "no transition takes it here")


def _common(found: Sequence[tuple[Place, Answer]]) -> Place | None:
    """Return the innermost state around all states, or the only one."""
    chains = [list(leaf.chain()) for leaf, _ in found]
    for place in chains[0]:
        if not isinstance(place.node, Region) and all(place in chain for chain in chains):
            return place
    return None
