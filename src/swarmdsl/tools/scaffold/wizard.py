"""Interactive questions of `swarmc new`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.prompt import Confirm, Prompt

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.tools.scaffold.new import is_taken
from swarmdsl.tools.scaffold.plan import TARGETS, Plan, Robots, check_plan

_Update = Callable[[str], Plan]


def ask(start: Plan, console: Console, folder: Path | None) -> Plan:
    """Ask for a plan, offering the values of `start`.

    The project goes to `folder`, by default one with the project name; it must be new or empty.
    Raises EOFError at the end of input.
    """
    plan = start
    console.print("New project. Press Enter to accept the value in parentheses.\n")
    plan = _name(console, plan, folder)
    if is_taken(folder or Path(plan.name)):
        return plan  # `create` reports it; another name would not help
    plan = replace(plan, description=_prompt(console, "Description", plan.description))
    if not plan.library:
        plan = _types(console, plan)
    plan = _ask_until_valid(
        console, "Name of the swarm", plan, plan.swarm_name, _with(plan, "swarm")
    )
    return plan if plan.library else _target(console, plan)


def _types(console: Console, plan: Plan) -> Plan:
    plan = _robots(console, plan)
    for kind in ("sensor", "controller", "actuator"):
        question = f"Name of a {kind}" if kind != "actuator" else "Name of an actuator"
        plan = _ask_until_valid(console, question, plan, getattr(plan, kind), _with(plan, kind))
    return plan


def _target(console: Console, plan: Plan) -> Plan:
    question = "Target: ROS 2 (ros2) or ROS 1 (smach)"
    target = Prompt.ask(
        question, console=console, choices=list(TARGETS), show_choices=False, default=plan.target
    )
    return replace(plan, target=target)


def _name(console: Console, plan: Plan, folder: Path | None) -> Plan:
    question = "Name of the project"
    while True:
        plan = _ask_until_valid(console, question, plan, plan.name, _with(plan, "name"))
        if folder is not None or not is_taken(Path(plan.name)):
            return plan
        error = f"`{plan.name}` already exists: choose another name"
        console.print(error, style="red", highlight=False, markup=False)
        plan = replace(plan, name="")


def _robots(console: Console, plan: Plan) -> Plan:
    robots: tuple[Robots, ...] = ()
    offered = plan.robots[0]
    while True:
        question = f"Name of {'another' if robots else 'a'} type of robot"
        update = _with_member(plan, robots)
        plan = _ask_until_valid(
            console, question, plan, offered.member if not robots else None, update
        )
        plan = _ask_until_valid(
            console, "How many (3, 1..5, 2..*)", plan, offered.count, _with_count(plan)
        )
        robots = plan.robots
        if not Confirm.ask("Another type of robot?", console=console, default=False):
            return plan


def _with(plan: Plan, field: str) -> _Update:
    def made(name: str) -> Plan:
        changes: dict[str, Any] = {field: name}
        return replace(plan, **changes)

    return made


def _with_member(plan: Plan, robots: tuple[Robots, ...]) -> _Update:
    return lambda name: replace(plan, robots=(*robots, Robots(name)))


def _with_count(plan: Plan) -> _Update:
    *before, last = plan.robots
    return lambda count: replace(plan, robots=(*before, Robots(last.member, count)))


def _ask_until_valid(
    console: Console, question: str, plan: Plan, offered: str | None, update: _Update
) -> Plan:
    """Ask until the answer adds no error to the plan."""
    before = _errors(plan)
    while True:
        answer = _prompt(console, question, offered or "")
        changed = update(answer)
        errors = [each for each in _errors(changed) if answer in each or each not in before]
        if not errors:
            return changed
        console.print(errors[0], style="red", highlight=False, markup=False)


def _errors(plan: Plan) -> list[str]:
    report = Diagnostics()
    check_plan(plan, report)
    return [f"{each.message}: {each.help}" for each in report]


def _prompt(console: Console, question: str, offered: str) -> str:
    if not offered:
        return Prompt.ask(question, console=console, default="", show_default=False).strip()
    return Prompt.ask(question, console=console, default=offered).strip()
