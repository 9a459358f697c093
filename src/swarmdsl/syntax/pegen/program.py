"""Compile a grammar to instructions for `parser.failure_finder`."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.syntax.parser import failure_finder
from swarmdsl.syntax.pegen.grammar import (
    Assign,
    Choice,
    Expression,
    Grammar,
    Optional,
    Repetition,
    Sequence,
    Terminal,
    Use,
    inside,
)

_END_OF_FILE = Terminal(r"\Z", name="EOF")


class Program:
    """Instructions for whole files of a grammar, and the terminals they match."""

    def __init__(self, grammar: Grammar) -> None:
        self.instructions: list[failure_finder.Instruction] = []
        self.terminals: dict[failure_finder.MachineTerminal, int] = {}
        self._addresses: dict[str, int] = {}
        self._calls: list[tuple[int, str]] = []
        self._write(Use(grammar.start))
        self._write(_END_OF_FILE)
        self._append(failure_finder.END)
        self.rules = _used(grammar)
        for name in self.rules:
            self._addresses[name] = self._here
            self._write(grammar.rules[name].body)
            self._append(failure_finder.RETURN)
        for address, name in self._calls:
            self.instructions[address] = (failure_finder.CALL, self._addresses[name])

    @property
    def _here(self) -> int:
        return len(self.instructions)

    def _append(self, operation: int, number: int = 0) -> int:
        """Add an instruction; return its address."""
        self.instructions.append((operation, number))
        return self._here - 1

    def _write(self, expression: Expression) -> None:
        match expression:
            case Terminal(regex, literal, name):
                terminal = (regex, name, literal)
                number = self.terminals.setdefault(terminal, len(self.terminals))
                self._append(failure_finder.MATCH, number)
            case Use(rule):
                self._calls.append((self._append(failure_finder.CALL), rule))
            case Assign(_, _, part):
                self._write(part)
            case Sequence(parts):
                for part in parts:
                    self._write(part)
            case Choice(parts):
                self._write_choice(parts)
            case Optional(part):
                self._write_optional((part,))
            case Repetition(part, least, separator):
                if least == 0 and separator is not None:
                    self._write_optional((Repetition(part, 1, separator),))
                    return
                if least == 1:
                    self._write(part)
                again = self._here
                self._write_optional((separator, part) if separator else (part,), again)

    def _write_choice(self, parts: tuple[Expression, ...]) -> None:
        commits = []
        for part in parts[:-1]:
            choice = self._append(failure_finder.CHOICE)
            self._write(part)
            commits.append(self._append(failure_finder.COMMIT))
            self.instructions[choice] = (failure_finder.CHOICE, self._here)
        self._write(parts[-1])
        for commit in commits:
            self.instructions[commit] = (failure_finder.COMMIT, self._here)

    def _write_optional(self, parts: Iterable[Expression], again: int | None = None) -> None:
        """Emit an optional part; after it, continue at `again`, or else after it."""
        choice = self._append(failure_finder.CHOICE)
        for part in parts:
            self._write(part)
        commit = self._append(failure_finder.COMMIT)
        self.instructions[choice] = (failure_finder.CHOICE, self._here)
        self.instructions[commit] = (failure_finder.COMMIT, self._here if again is None else again)


def _used(grammar: Grammar) -> list[str]:
    """Return the reachable rules, in order of their first use."""
    found = [grammar.start]
    for name in found:  # which grows meanwhile
        for part in inside(grammar.rules[name].body):
            if isinstance(part, Use) and part.rule not in found:
                found.append(part.rule)
    return found
