"""Emit the functions of a recursive-descent parser.

All tokens are found before parsing: `tokens` are their strings, `ends` the end offset of the token
before each. Each rule of nodes becomes a function nested in `parse`; these share `at`, the index
of the next token, and `token`, its string. Regular expressions that are no tokens match the text
and must end with a token. Alternatives that the next token cannot begin are skipped; others are
tried in order, and a failed attempt is undone, as in any PEG.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.pegen.actions import Target
from swarmdsl.syntax.pegen.grammar import (
    Assign,
    Choice,
    Expression,
    Optional,
    Repetition,
    Rule,
    Sequence,
    Terminal,
    UnsupportedError,
    Use,
    inside,
)
from swarmdsl.syntax.pegen.lookahead import Lookahead

_ADVANCE = "at += 1; token = tokens[at]"
_START = "ends[at + 1] - len(token)"


@dataclass
class Emission:
    """Emitter of the functions of a parser."""

    look: Lookahead
    target: Target
    lines: list[str] = field(default_factory=list)
    _depth: int = 1
    _names: int = 0
    _rule: Rule | None = None

    def rule(self, rule: Rule) -> None:
        """Emit the function of a rule of nodes."""
        self._rule, self._names = rule, 0
        recursive = rule.name in self.look.analysis.recursive
        self._line(f"def r_{rule.name}():")
        with self._block():
            self._line(f"nonlocal at, token{', depth' if recursive else ''}")
            fail = "return None"
            if recursive:
                fail = "depth -= 1; return None"
                self._line("depth += 1")
                self._line("if depth > limit: raise TooDeepError")
            self._line(f"start = {self._start_of(rule.body)}")
            if separator := self.target.items.get(rule.name):
                self._line(f"if find('\\n', ends[at], start) < 0: inline[at] = {separator!r}")
            defaults = {"value": "None", "word": "''", "many": "[]", "flag": "False"}
            for attribute, kind in rule.attributes.items():
                self._line(f"{attribute}_ = {defaults[kind]}")
            self._expression(rule.body, fail, known=self.look.is_asked_before(rule.name))
            if recursive:
                self._line("depth -= 1")
            fields = {"span": self._span("start"), **self.target.nodes[rule.name]}
            self._make("made", rule.name, fields)
            self._line("return made")
        self._line("")

    def ordered_attempts(self) -> None:
        """Emit the functions that try several rules in order."""
        for rules, name in self.look.attempts.items():
            self._line(f"def {name}():")
            with self._block():
                self._line("nonlocal at, token")
                self._line("before = at")
                for rule in rules[:-1]:
                    self._line(f"made = r_{rule}()")
                    self._line("if made is not None: return made")
                    self._line("at = before; token = tokens[at]")
                self._line(f"return r_{rules[-1]}()")
            self._line("")

    # ---- expressions: each method emits code that continues after a match, or else runs `fail`.
    # `known` is True if the next token has been tested.

    def _expression(self, expression: Expression, fail: str, *, known: bool = False) -> None:
        match expression:
            case Terminal():
                self._text(expression, fail, known=known)
            case Sequence(parts):
                for number, part in enumerate(parts):
                    self._expression(part, fail, known=known and number == 0)
            case Choice(parts):
                if known and self.look.is_token(expression):
                    self._line(_ADVANCE)
                else:
                    self._choice(parts, fail)
            case Optional(part):
                self._optional(part)
            case Repetition():
                self._repetition(expression, fail, known=known)
            case Assign():
                self._assign(expression, fail, known=known)
            case Use(rule) if self.look.analysis.grammar.rules[rule].kind == "text":
                self._text(expression, fail, known=known)
            case Use(rule):
                raise self._unsupported(f"what {rule} makes is not used")

    def _choice(self, parts: tuple[Expression, ...], fail: str) -> None:
        firsts = [self.look.analysis.first(part) for part in parts]
        distinct = not any(
            first.overlaps(other)
            for number, first in enumerate(firsts)
            for other in firsts[:number]
        )
        if not distinct:
            self._ordered_choice(parts, fail)
            return
        for number, part in enumerate(parts):
            if self.look.analysis.nullable(part):
                self._line("else:")
                with self._block():
                    self._expression(part, fail)
                return
            self._line(f"{'elif' if number else 'if'} {self.look.test(firsts[number])}:")
            with self._block():
                self._expression(part, fail, known=True)
        self._line(f"else: {fail}")

    def _ordered_choice(self, parts: tuple[Expression, ...], fail: str) -> None:
        chosen = self._new("chosen")
        self._line(f"{chosen} = False")
        for part in parts:
            test = "True" if self.look.analysis.nullable(part) else self._can_begin(part)
            self._line(f"if not {chosen} and {test}:")
            with self._block():
                undo = self._save(part)
                self._line("while True:")
                with self._block():
                    self._expression(part, f"{undo}; break", known=True)
                    self._line(f"{chosen} = True")
                    self._line("break")
        self._line(f"if not {chosen}: {fail}")

    def _optional(self, part: Expression) -> None:
        self._line(f"if {self._can_begin(part)}:")
        with self._block():
            if self.look.is_sure(part):
                self._expression(part, "", known=True)
                return
            undo = self._save(part)
            self._line("while True:")
            with self._block():
                self._expression(part, f"{undo}; break", known=True)
                self._line("break")

    def _repetition(self, repetition: Repetition, fail: str, *, known: bool) -> None:
        part, separator = repetition.part, repetition.separator
        if repetition.least:
            self._expression(part, fail, known=known)
            self._more(part, separator)
        elif separator is None:
            self._more(part, None)
        else:
            self._optional(Repetition(part, 1, separator))

    def _more(self, part: Expression, separator: Terminal | None) -> None:
        """Emit a loop over parts, each with a separator before it."""
        begin = separator or part
        if isinstance(begin, Assign) and self.look.is_choice(begin.part):
            self._line("while True:")  # which of them it may be is seen at one look
        else:
            self._line(f"while {self._can_begin(begin)}:")
        with self._block():
            undo = self._save(part)
            if separator is not None:
                self._text(separator, f"{undo}; break", known=True)
            self._expression(part, f"{undo}; break", known=separator is None)

    def _assign(self, assign: Assign, fail: str, *, known: bool) -> None:
        value = self._value(assign, fail, known=known)
        match assign.kind:
            case "flag":
                self._line(f"{assign.attribute}_ = True")
            case "many":
                self._line(f"{assign.attribute}_.append({value})")
            case "value":
                self._line(f"{assign.attribute}_ = {value}")

    def _value(self, assign: Assign, fail: str, *, known: bool) -> str:
        """Emit code for a value; return the expression for it."""
        part = assign.part
        rule = self.look.analysis.grammar.rules[part.rule] if isinstance(part, Use) else None
        if rule is not None and rule.name in self.target.written:
            self._line(f"found = {self.target.written[rule.name]}(at)")
            self._line(f"if found is None: {fail}")
            self._line("value, at = found; token = tokens[at]")
            return "value"
        if rule is not None and rule.name in self.target.words:
            assert isinstance(rule.body, Assign)
            text, start = self._placed(rule.body.part, fail, known=known)
            self._line(f"value = new_word(Word, {self.target.words[rule.name].format(text)})")
            self._line(f"value.span = {self._span(start)}")
            return "value"
        if rule is None or rule.kind == "text":
            if assign.refers is None:
                return self._text(part, fail, known=known)
            text, start = self._placed(part, fail, known=known)
            end = "ends[at]" if self.look.is_token(part) else f"first + len({text})"
            span = f"new_span(Span, (source, {start}, {end}))"
            fields = {"name": text, "kind": repr(assign.refers), "span": span, "target": "None"}
            self._make("value", "Ref", fields)
            return "value"
        if rule.kind == "choice":
            look_up, always = self.look.table(rule)
            self._line(f"rule = {look_up}")
            if not always:
                self._line(f"if rule is None: {fail}")
            self._line("value = rule()")
        else:
            if not known and self.look.is_asked_before(rule.name):
                self._line(f"if not ({self._can_begin(part)}): {fail}")
            self._line(f"value = r_{rule.name}()")
        self._line(f"if value is None: {fail}")
        return "value"

    def _start_of(self, body: Expression) -> str:
        """Return an expression for the start of a rule's first token."""
        first = self.look.analysis.first(body)
        lengths = set(map(len, first.tokens))
        known = first.but is None and "" not in first.tokens and len(lengths) == 1
        return f"ends[at + 1] - {min(lengths)}" if known else _START

    def _placed(self, part: Expression, fail: str, *, known: bool) -> tuple[str, str]:
        """Emit code that takes a string; return expressions for it and for its start."""
        if self.look.is_token(part):
            text = self._text(part, fail, known=known)
            return text, f"ends[at] - len({text})"
        self._line(f"first = {_START}")
        return self._text(part, fail, known=known), "first"

    def _text(self, part: Expression, fail: str, *, known: bool = False) -> str:
        """Emit code that takes a string; return the expression for it."""
        match part:
            case Use(rule):
                return self._text(self.look.analysis.grammar.rules[rule].body, fail, known=known)
            case Sequence(parts):
                return self._joined(parts, fail, known=known)
            case Choice(parts) if not self.look.is_token(part):
                rules = self.look.analysis.grammar.rules
                named = (rules[each.rule].body if isinstance(each, Use) else each for each in parts)
                regexes = [each.regex for each in named if isinstance(each, Terminal)]
                if len(regexes) < len(parts):
                    raise self._unsupported("a text is too complicated")
                return self._text(Terminal("|".join(regexes)), fail)
            case Terminal(literal=literal) if part.is_symbols:
                self._line(f"if not ({_symbols(literal)}): {fail}")
                self._line(f"at += {len(literal)}; token = tokens[at]")
                return repr(literal)
            case Terminal(regex) if not self.look.is_token(part):
                if self.look.analysis.nullable(part):
                    raise self._unsupported("a text may be nothing at all")
                match = self._match(regex)
                self._line(f"if {match} is None: {fail}")
                self._skip_match(match, fail)
                return f"{match}[0]"
        if not self.look.is_token(part):
            raise self._unsupported("a text is too complicated")
        if not known:
            self._line(f"if not ({self._can_begin(part)}): {fail}")
        if isinstance(part, Terminal) and part.literal:
            self._line(_ADVANCE)
            return repr(part.literal)
        taken = self._new("taken")
        self._line(f"{taken} = token; {_ADVANCE}")
        return taken

    def _joined(self, parts: tuple[Expression, ...], fail: str, *, known: bool) -> str:
        """Emit code for the parts of a string, which may have blanks between them."""
        text = self._new("text")
        self._line(f"{text} = {self._text(parts[0], fail, known=known)}")
        for part in parts[1:]:
            if not self.look.analysis.nullable(part):
                self._line(f"{text} += {self._text(part, fail)}")
                continue
            if isinstance(part, Use):
                part = self.look.analysis.grammar.rules[part.rule].body
            if not isinstance(part, Terminal):
                raise self._unsupported("a text is too complicated")
            if part.regex.startswith("(?!"):  # what may not follow
                self._line(f"if {self.look.regex(part.regex)}(text, {_START}) is None: {fail}")
                continue
            self._line(f"if {self._can_begin(part)}:")
            with self._block():
                match = self._match(part.regex)
                self._line(f"if {match}[0]:")
                with self._block():
                    self._line(f"{text} += {match}[0]")
                    self._skip_match(match, fail)
        return text

    def _match(self, regex: str) -> str:
        """Emit code that matches a regular expression; return the variable of the match."""
        match = self._new("match")
        self._line(f"{match} = {self.look.regex(regex)}(text, {_START})")
        return match

    def _skip_match(self, match: str, fail: str) -> None:
        """Emit code that skips the tokens of a match, which must end with a token."""
        self._line(f"end = {match}.end()")
        self._line("while ends[at] < end: at += 1")
        self._line(f"if ends[at] > end: {fail}")
        self._line("token = tokens[at]")

    def _make(self, variable: str, node: str, fields: Mapping[str, str]) -> None:
        """Emit code that makes a node; calling its class would take a third longer."""
        self._line(f"{variable} = new_node({node})")
        for name, value in fields.items():
            self._line(f"{variable}.{name} = {value}")

    # ---- lines

    def _save(self, part: Expression) -> str:
        """Emit code that saves the state before an attempt; return the code that restores it."""
        before = self._new("before")
        self._line(f"{before} = at")
        undo = f"at = {before}; token = tokens[at]"
        if self._rule is None or isinstance(part, Assign):
            return undo  # it is the last thing that happens
        if isinstance(part, Repetition) and isinstance(part.part, Assign) and part.least:
            return undo  # nothing is kept where not even one is there
        kinds = {p.attribute: p.kind for p in inside(part) if isinstance(p, Assign)}
        for attribute, kind in kinds.items():
            before = self._new("before")
            if kind == "many":
                self._line(f"{before} = len({attribute}_)")
                undo += f"; del {attribute}_[{before}:]"
            else:
                self._line(f"{before} = {attribute}_")
                undo += f"; {attribute}_ = {before}"
        return undo

    def _can_begin(self, part: Expression) -> str:
        return self.look.test(self.look.analysis.first(part))

    def _span(self, start: str) -> str:
        return f"new_span(Span, (source, {start}, ends[at]))"

    def _new(self, name: str) -> str:
        self._names += 1
        return f"{name}{self._names}"

    def _line(self, line: str) -> None:
        self.lines.append("    " * self._depth + line if line else "")

    @contextmanager
    def _block(self) -> Iterator[None]:
        self._depth += 1
        yield
        self._depth -= 1

    def _unsupported(self, what: str) -> UnsupportedError:
        return UnsupportedError(self._rule.name if self._rule else "?", what)


def _symbols(marks: str) -> str:
    """Return a test for adjacent symbols, such as an arrow."""
    return f"token == {marks[0]!r}" + "".join(
        f" and tokens[at + {n}] == {mark!r} and ends[at + {n + 1}] == ends[at + {n}] + 1"
        for n, mark in enumerate(marks[1:], 1)
    )
