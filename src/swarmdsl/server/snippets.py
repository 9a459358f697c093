"""Whole statements with places to fill in, offered where their first word can stand."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl.dataclass import dataclass
from swarmdsl.load import File
from swarmdsl.server.candidates import containers
from swarmdsl.server.outcomes import outcomes_left
from swarmdsl.server.trial import owner_around
from swarmdsl.syntax import Activity, State, StateMachine
from swarmdsl.workspace import Workspace


@dataclass(frozen=True)
class Snippet:
    """A text as editors fill it in (`${1:so}`), what it is called, what it is for."""

    label: str
    text: str
    about: str


# By the words that must be possible at a place, of which the first begins the statement.
_ALL: dict[tuple[str, ...], Snippet] = {
    ("statemachine",): Snippet(
        "statemachine ...",
        "statemachine ${1:Name} {\n  initial ${2:First}\n\n  state ${2:First} {\n    $0\n  }\n}",
        "a state machine with its first state",
    ),
    ("member",): Snippet(
        "member ...",
        "member ${1:Name} {\n  behavior ${2:Machine}\n  $0\n}",
        "a kind of robot, and how it behaves",
    ),
    ("swarm", "statemachine"): Snippet(
        "swarm ...",
        "swarm ${1:Name} {\n  ${2:role} : ${3:Member}[${4:1..*}]\n}",
        "which members there are, and how many",
    ),
    ("event", "statemachine"): Snippet(
        "event ...",
        'event ${1:Name} : ${2:std_msgs/Empty} on "${3:topic}"',
        "what is heard on a topic",
    ),
    ("function", "statemachine"): Snippet(
        "function ...",
        'function ${1:name} : ${2|abstraction,swarm|} {\n  action "${3:name}" : ${4:pkg/Type}\n}',
        "what a robot can do",
    ),
    ("state", "choice"): Snippet(
        "state ...", "state ${1:Name} {\n  on ${2:Event} -> ${3:Target}\n}", "a state"
    ),
    ("parallel", "choice"): Snippet(
        "parallel state ...",
        "parallel state ${1:Name} {\n  region ${2:Left} {\n    initial ${3:First}\n"
        "    state ${3:First} {\n      $0\n    }\n  }\n  region ${4:Right} {\n"
        "    initial ${5:Other}\n    state ${5:Other} {\n    }\n  }\n}",
        "states that are active at the same time",
    ),
    ("choice", "final"): Snippet(
        "choice ...",
        "choice ${1:Name} {\n  [${2:condition}] -> ${3:Target}\n  else -> ${4:Other}\n}",
        "one of several ways, by conditions",
    ),
    ("after", "do"): Snippet("after ...", "after ${1:10 s} -> ${2:Target}", "on when time is over"),
}


def snippets(
    keywords: Collection[str], workspace: Workspace, file: File, offset: int
) -> Iterator[Snippet]:
    """The statements that can stand at an offset of a file, where these keywords can."""
    for words, snippet in _ALL.items():
        if all(word in keywords for word in words):
            yield snippet
    if "on" not in keywords:
        return
    yield Snippet("on ... -> ...", "on ${1:Event} -> ${2:Target}", "a transition on an event")
    owner = owner_around(file, offset)
    inner = containers(owner, offset)[-1] if isinstance(owner, StateMachine) else None
    if isinstance(inner, State) and any(isinstance(item, Activity) for item in inner.items):
        left = [each for each in outcomes_left(owner, offset) if each != "preempted"]
        lines = [f"on {each} -> ${{{index}:Target}}" for index, each in enumerate(left, 1)]
        if lines:
            yield Snippet(
                "on the outcomes", "\n".join(lines), "transitions on all ends that are left"
            )
