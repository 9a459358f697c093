"""The text of what is added, from what the command line says of it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.base.usage_error import UsageError
from swarmdsl.importing.update.merging import commented

_PORT = re.compile(r"(\w+)\s*:\s*([^@]+?)\s*(?:@\s*(\S+))?")
_PARAM = re.compile(r"(\w+)\s*:\s*([^=]+(?:<=[^=]*)?)\s*(?:=(?!=)\s*(.+))?")
_TOPIC = re.compile(r"([^:\s]+)\s*:\s*(\S+)")
_PART = re.compile(r"(\w+)\s*:\s*([\w.]+)")
_CONNECTOR = re.compile(r"([\w.]+)\s*->\s*([\w.]+)")
_ROLE = re.compile(r"(?:(\w+)\s*:\s*)?([\w.]+)(?:=([0-9.*]+))?")

_WAY_IN = re.compile(r"([\w.]+)\s*:\s*(.+)")


@dataclass(frozen=True)
class Ports:
    """The data that goes in and out, as `NAME:TYPE` or `NAME:TYPE@TOPIC` each."""

    incoming: Sequence[str] = ()
    outgoing: Sequence[str] = ()
    both: Sequence[str] = ()

    def lines(self) -> Iterable[str]:
        """A line for each."""
        by_word = {"in": self.incoming, "out": self.outgoing, "inout": self.both}
        for word, each in ((word, each) for word, many in by_word.items() for each in many):
            name, type_, topic = _match(_PORT, each, f"--{word}", "NAME:TYPE or NAME:TYPE@TOPIC")
            yield f"{word} {name} : {type_}" + (f' on "{topic}"' if topic else "")


def block(doc: str, head: str, lines: Iterable[str]) -> str:
    """A declaration with its documentation."""
    body = "".join(f"  {line}\n" for line in lines)
    inside = f"{{\n{body}}}" if body else "{ }"
    return f"{commented(doc)}\n{head} {inside}" if doc else f"{head} {inside}"


def params(given: Iterable[str]) -> Iterable[str]:
    """A line for each `NAME:TYPE` or `NAME:TYPE=VALUE`."""
    for each in given:
        name, type_, value = _match(_PARAM, each, "--param", "NAME:TYPE or NAME:TYPE=VALUE")
        yield f"param {name} : {type_.strip()}" + (f" = {value}" if value else "")


def call(action: str | None, service: str | None) -> str:
    """How a function is called, as `SERVER:TYPE`."""
    if (action is None) == (service is None):
        raise UsageError("say how it is called, with `--action` or `--service`, and not with both")
    word, given = ("action", action) if action is not None else ("service", service or "")
    server, type_ = _match(_TOPIC, given, f"--{word}", "SERVER:TYPE")
    return f'{word} "{server}" : {type_}'


def topics(word: str, given: Iterable[str]) -> Iterable[str]:
    """A line for each topic of a function, as `TOPIC:TYPE`."""
    for each in given:
        topic, type_ = _match(_TOPIC, each, f"--{word}", "TOPIC:TYPE")
        yield f'{word} "{topic}" : {type_}'


def parts(given: Iterable[str]) -> Iterable[str]:
    """A line for each part, as `NAME:COMPONENT`."""
    for each in given:
        name, component = _match(_PART, each, "--part", "NAME:COMPONENT")
        yield f"{name} : {component}"


def connectors(given: Iterable[str]) -> Iterable[str]:
    """A line for each connector, as `PART.PORT->PART.PORT`."""
    for each in given:
        source, target = _match(_CONNECTOR, each, "--connect", "PART.PORT->PART.PORT")
        yield f"connect {source} -> {target}"


def roles(given: Iterable[str]) -> Iterable[str]:
    """A line for each role, as `MEMBER`, `MEMBER=NUMBER` or `ROLE:MEMBER=NUMBER`."""
    for each in given:
        name, member, count = _match(_ROLE, each, "--member", "MEMBER=NUMBER or ROLE:MEMBER=NUMBER")
        role = name or snake_case(member.rpartition(".")[2])
        yield f"{role} : {member}" + (f"[{count}]" if count else "")


def way_in(given: str, name: str) -> tuple[str, str]:
    """The state that a transition to another one begins in, and the transition."""
    source, trigger = _match(_WAY_IN, given, "--from", '"STATE: TRIGGER"')
    word = "" if trigger.startswith(("after ", "monitor ", "[", "on ")) else "on "
    return source, f"{word}{trigger} -> {name}"


def machine(name: str, doc: str) -> str:
    """A state machine to begin with: from its first state to its end."""
    lines = ["initial Ready", "", "state Ready { on done -> Done }", "final Done"]
    return block(doc, f"statemachine {name}", lines)


def _match(form: re.Pattern[str], given: str, option: str, shape: str) -> tuple[str, ...]:
    found = form.fullmatch(given.strip())
    if found is None:
        raise UsageError(f"`{option} {given}` has not the form {shape}")
    return tuple(each or "" for each in found.groups())
