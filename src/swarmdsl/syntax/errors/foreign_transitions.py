"""Hints for transitions and effects as other notations write them."""

from __future__ import annotations

from swarmdsl.base.diagnostics.advice import write
from swarmdsl.syntax.errors.foreign_effects import EFFECTS
from swarmdsl.syntax.errors.patterns import DELAY, START

_GUARD = "write a guard in square brackets: `on event [x < 3] -> Target`"
_ACTIVITY = "write `do` on a line of its own: the activity starts on entry"
_COMPARED = r"(?:[=!<>]=|<|(?<!-)>)"
_KEEP = r"write `defer \1` on a line of its own: it is no effect"
_RAISED = "succeeded|aborted|preempted|done|after|monitor"
_BEFORE_EFFECTS = r"(?:\b(?:entry|exit) *|\b(?:on|after) [^/]*)"

# As in foreign_statements.
TRANSITIONS = (
    *EFFECTS,
    (r"(?:^|[{;]) *@-> *([\w.]+)", "`else`", write(r"else -> \1")),
    (r"\[ *@else *\] *-> *([\w.]+)", "", write(r"else -> \1")),
    (r"\[ *@else *\]", "", "write `else` without brackets"),
    (
        rf"{START}@else\b",
        "`on`",
        "`else` belongs to a `choice`: in a state, write the trigger again without a guard",
    ),
    (r"\bon [^/[\]]*@(?:if|when|where)\b", "", _GUARD),
    (
        rf"\bon +([\w., ]*\w) *@(?:\|\||or\b) *([^/\[]*{_COMPARED}[^/\[]*?) *(?=/(?!/)|->|$)",
        "",
        r"write two transitions: `on \1 -> ...` and `[\2] -> ...`",
    ),
    (
        r"\bon [\w., ]*@(?:\|\|?|or\b)",
        "",
        "write `,`: the transition fires on any of the events",
    ),
    (
        r"\bon +([\w., ]*\w) *@(?:&&|and\b) *((?:not\b|!|[a-z_(])[^/\[\n]*?) *(?=/(?!/)|->|$)",
        "",
        r"write a guard in square brackets: `on \1 [\2]`",
    ),
    (
        r"\bon [\w., ]*@(?:&&|and\b)",
        "",
        "events occur one at a time: wait for the second one in another state",
    ),
    (r"\bon +@(entry|exit)\b", "", r"write `\1 / ...` without `on`"),
    (r"(?:^|\{) *@-> *([\w.]+)", "", r"write `on done -> \1` to leave the state when it is done"),
    (
        r"\b(send +[\w.]+(?:\([^)]*\))?) +(after [^/]*?\w) *@to +([\w.]+(?:\[[^]]*\])?)",
        "",
        r"write the address before the delay: `\1 to \3 \2`",
    ),
    (r"\bin @([\w.]+)", "`(`", write(r"in(\1)")),
    (r"\bon +@after\b", "", "write `after` without `on`"),
    (r"\b(entry|exit) *@:", "", write(r"\1 / ...")),
    (r"\b(entry|exit) *@\{ *\}", "", r"delete `\1 { }`: it does nothing"),
    (r"\b(?:entry|exit) *@\{ *do\b", "", _ACTIVITY),
    (r"\b(entry|exit) *@\{ *([^{}\n]*[^{}\n ]) *\}", "", write(r"\1 / \2")),
    (r"\b(entry|exit) *@\{", "", r"write effects without braces: `\1 / x = 1, send Event`"),
    (
        r"\b(entry|exit) +@(send +[^{};\n]*[^{};\n ]|[\w.]+ *=[^{};\n]*[^{};\n ])",
        "",
        write(r"\1 / \2"),
    ),
    (
        r"\b(?:entry|exit) *@(?: *do\b)",
        "",
        _ACTIVITY,
    ),
    (
        rf"(?:{START}|\bon +)@timeout *\(? *({DELAY})\b",
        "",
        r"write `after \1` instead of `timeout`",
    ),
    (rf"\bon timeout *@\(? *({DELAY})\b", "", r"write `after \1` instead of `on timeout`"),
    (
        rf"\bdo [^{{}};]*@timeout *\(? *({DELAY})\b",
        "",
        r"limit the time with a transition on a line of its own: `after \1 -> Target`",
    ),
    (rf"(?:{START}|\bon +)@timeout\b", "", "write a delay as `after 5 s -> Target`"),
    (r"\bon timeout *@[\d(]", "", "write a delay as `after 5 s -> Target`"),
    (rf"{START}defer +@(?:{_RAISED})\b", "", "only events can be deferred"),
    (r"\bon +(\w[\w.]*) */ *defer@", "", _KEEP),
    (rf"{START}@(\w[\w.]*) */ *defer\b", "", _KEEP),
    (
        r"-> *@\[\*\]",
        "",
        "the end is a state: declare `final Done`, and write `-> Done`",
    ),
    (r"\bon +[\w., ]*@: *-+>", "", "delete the `:`"),
    (r"\bon [\w., ]+@enter +(\w+)", "", write(r"-> \1")),
    (
        rf"{_BEFORE_EFFECTS}/ *(?:[^/]*, *)?[\w.]+(?:\([^()]*\))? *@ *(?:$|->|,)",
        "`=`",
        "an effect is `name = value` or `send Event`: what takes time is an activity, `do`",
    ),
    (r"/ *@\{", "", "write effects without braces, separated by `,`"),
    (r"/ *\w[^\[\]>{};]*@; *\w", "", "separate effects with `,`"),
    (
        r"[/,] *(?:raise|emit|publish|fire|trigger) +@(\w+)",
        "",
        r"send an event with `send \1`",
    ),
    (
        r"[/,] *(?:(?:call|run|start) +@\w|@do\b)",
        "",
        "an effect cannot start an activity: go to a state with `do`",
    ),
    (
        r"/ *[^/]*= *[\w.]+ +@(?:(\w+) *=(?!=)|(send|cancel|append|remove|clear)\b)",
        "`,`",
        r"write `,` before `\1\2`",
    ),
    (r"^ *@every\b", "", "for a periodic action, let `after 5 s` target its own state"),
)
