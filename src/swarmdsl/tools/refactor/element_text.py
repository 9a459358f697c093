"""Text of new elements from command-line arguments."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from swarmdsl.base.errors import UsageError
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.importing.update.merging import doc_comment

_PORT = re.compile(r"(\w+)\s*:\s*([^@]+?)\s*(?:@\s*(\S+))?")
_PARAM = re.compile(r"(\w+)\s*:\s*([^=]+(?:<=[^=]*)?)\s*(?:=(?!=)\s*(.+))?")
_TOPIC = re.compile(r"([^:\s]+)\s*:\s*(\S+)")
_PART = re.compile(r"(\w+)\s*:\s*([\w.]+)")
_CONNECTOR = re.compile(r"([\w.]+)\s*->\s*([\w.]+)")
_ROLE = re.compile(r"(?:(\w+)\s*:\s*)?([\w.]+)(?:=([0-9.*]+))?")

_INCOMING = re.compile(r"([\w.]+)\s*:\s*(.+)")


@dataclass(frozen=True)
class Ports:
    """Ports by direction, each `NAME:TYPE` or `NAME:TYPE@TOPIC`."""

    incoming: Sequence[str] = ()
    outgoing: Sequence[str] = ()
    both: Sequence[str] = ()

    def lines(self) -> Iterable[str]:
        """Yield one line for each port."""
        by_word = {"in": self.incoming, "out": self.outgoing, "inout": self.both}
        for word, each in ((word, each) for word, many in by_word.items() for each in many):
            name, type_, topic = _match(_PORT, each, f"--{word}", "NAME:TYPE or NAME:TYPE@TOPIC")
            yield f"{word} {name} : {type_}" + (f' on "{topic}"' if topic else "")


def block(doc: str, head: str, lines: Iterable[str]) -> str:
    """Return the declaration with its doc comment."""
    body = "".join(f"  {line}\n" for line in lines)
    inside = f"{{\n{body}}}" if body else "{ }"
    return f"{doc_comment(doc)}\n{head} {inside}" if doc else f"{head} {inside}"


def params(arguments: Iterable[str]) -> Iterable[str]:
    """Yield a line for each `NAME:TYPE` or `NAME:TYPE=VALUE`."""
    for each in arguments:
        name, type_, value = _match(_PARAM, each, "--param", "NAME:TYPE or NAME:TYPE=VALUE")
        yield f"param {name} : {type_.strip()}" + (f" = {value}" if value else "")


def call(action: str | None, service: str | None) -> str:
    """Return the action or service of a function, given as `SERVER:TYPE`."""
    if (action is None) == (service is None):
        raise UsageError("give either `--action` or `--service`")
    word, argument = ("action", action) if action is not None else ("service", service or "")
    server, type_ = _match(_TOPIC, argument, f"--{word}", "SERVER:TYPE")
    return f'{word} "{server}" : {type_}'


def topics(word: str, arguments: Iterable[str]) -> Iterable[str]:
    """Yield a line for each topic of a function, given as `TOPIC:TYPE`."""
    for each in arguments:
        topic, type_ = _match(_TOPIC, each, f"--{word}", "TOPIC:TYPE")
        yield f'{word} "{topic}" : {type_}'


def parts(arguments: Iterable[str]) -> Iterable[str]:
    """Yield a line for each part, given as `NAME:COMPONENT`."""
    for each in arguments:
        name, component = _match(_PART, each, "--part", "NAME:COMPONENT")
        yield f"{name} : {component}"


def connectors(arguments: Iterable[str]) -> Iterable[str]:
    """Yield a line for each connector, given as `PART.PORT->PART.PORT`."""
    for each in arguments:
        source, target = _match(_CONNECTOR, each, "--connect", "PART.PORT->PART.PORT")
        yield f"connect {source} -> {target}"


def roles(arguments: Iterable[str]) -> Iterable[str]:
    """Yield a line for each `MEMBER`, `MEMBER=NUMBER` or `ROLE:MEMBER=NUMBER`."""
    for each in arguments:
        name, member, count = _match(_ROLE, each, "--member", "MEMBER=NUMBER or ROLE:MEMBER=NUMBER")
        role = name or snake_case(member.rpartition(".")[2])
        yield f"{role} : {member}" + (f"[{count}]" if count else "")


def incoming_transition(argument: str, name: str) -> tuple[str, str]:
    """Source state and text of a transition to `name`, given as `STATE: TRIGGER`."""
    source, trigger = _match(_INCOMING, argument, "--from", '"STATE: TRIGGER"')
    word = "" if trigger.startswith(("after ", "monitor ", "[", "on ")) else "on "
    return source, f"{word}{trigger} -> {name}"


def machine(name: str, doc: str) -> str:
    """Minimal state machine: an initial state and a final state."""
    lines = ["initial Ready", "", "state Ready { on done -> Done }", "final Done"]
    return block(doc, f"statemachine {name}", lines)


def _match(pattern: re.Pattern[str], argument: str, option: str, shape: str) -> tuple[str, ...]:
    found = pattern.fullmatch(argument.strip())
    if found is None:
        raise UsageError(f"`{option} {argument}` does not have the form {shape}")
    return tuple(each or "" for each in found.groups())
