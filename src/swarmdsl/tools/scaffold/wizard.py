"""The questions that `swarmc new` asks on a terminal."""

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

_Check = Callable[[str], Plan]


def ask(start: Plan, console: Console, folder: Path | None) -> Plan:
    """A plan made of answers, those of `start` offered; raises EOFError at the end of input.

    The project goes to `folder`, or to one of its name, which has to be new or empty.
    """
    plan = start
    console.print("A new project. Enter takes what stands in parentheses.\n")
    plan = _name(console, plan, folder)
    if is_taken(folder or Path(plan.name)):
        return plan  # told by who makes the project: another name would not help
    plan = replace(plan, description=_text(console, "What it is for", plan.description))
    plan = _robots(console, plan)
    for kind in ("sensor", "controller", "actuator"):
        question = f"Name of a {kind}" if kind != "actuator" else "Name of an actuator"
        plan = _asked(console, question, plan, getattr(plan, kind), _with(plan, kind))
    plan = _asked(console, "Name of the swarm", plan, plan.swarm_name, _with(plan, "swarm"))
    question = "Packages for ROS 2 (ros2) or ROS 1 (smach)"
    target = Prompt.ask(
        question, console=console, choices=list(TARGETS), show_choices=False, default=plan.target
    )
    return replace(plan, target=target)


def _name(console: Console, plan: Plan, folder: Path | None) -> Plan:
    question = "Name of the project"
    while True:
        plan = _asked(console, question, plan, plan.name, _with(plan, "name"))
        if folder is not None or not is_taken(Path(plan.name)):
            return plan
        wrong = f"`{plan.name}` is there already: choose another name"
        console.print(wrong, style="red", highlight=False, markup=False)
        plan = replace(plan, name="")


def _robots(console: Console, plan: Plan) -> Plan:
    robots: tuple[Robots, ...] = ()
    offered = plan.robots[0]
    while True:
        kind = f"Name of {'another' if robots else 'a'} type of robot"
        made = _with_member(plan, robots)
        plan = _asked(console, kind, plan, offered.member if not robots else None, made)
        plan = _asked(console, "How many (3, 1..5, 2..*)", plan, offered.count, _with_count(plan))
        robots = plan.robots
        if not Confirm.ask("Another type of robot?", console=console, default=False):
            return plan


def _with(plan: Plan, field: str) -> _Check:
    def made(name: str) -> Plan:
        changes: dict[str, Any] = {field: name}
        return replace(plan, **changes)

    return made


def _with_member(plan: Plan, robots: tuple[Robots, ...]) -> _Check:
    return lambda name: replace(plan, robots=(*robots, Robots(name)))


def _with_count(plan: Plan) -> _Check:
    *before, last = plan.robots
    return lambda count: replace(plan, robots=(*before, Robots(last.member, count)))


def _asked(console: Console, question: str, plan: Plan, offered: str | None, with_: _Check) -> Plan:
    """Ask until the answer makes a plan without another mistake."""
    known = _mistakes(plan)
    while True:
        answer = _text(console, question, offered or "")
        made = with_(answer)
        wrong = [each for each in _mistakes(made) if answer in each or each not in known]
        if not wrong:
            return made
        console.print(wrong[0], style="red", highlight=False, markup=False)


def _mistakes(plan: Plan) -> list[str]:
    report = Diagnostics()
    check_plan(plan, report)
    return [f"{each.message}: {each.help}" for each in report]


def _text(console: Console, question: str, offered: str) -> str:
    if not offered:
        return Prompt.ask(question, console=console, default="", show_default=False).strip()
    return Prompt.ask(question, console=console, default=offered).strip()
