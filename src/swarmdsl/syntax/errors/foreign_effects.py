"""Hints for effects as other notations write them: sends, calls, methods of arrays."""

from __future__ import annotations

from swarmdsl.base.diagnostics.advice import write
from swarmdsl.syntax.errors.patterns import DELAY

_ADDRESS = r"[A-Za-z_][\w.]*(?:\[[^]\n]*\])?"
_SENT = r"[A-Za-z_][\w.]*(?:\([^()\n]*\))?"
_EFFECT = r"(?:send|cancel|append|remove|clear)\b|[A-Za-z_][\w.]* *=(?!=)"
_DATA = r"[\w.]+|\"[^\"]*\""

# As in foreign_statements.
EFFECTS = (
    # sends
    (r"\bsend *@\( *(\w+) *, *([^()]*?) *\)", "", write(r"send \1(\2)")),
    (r"\bsend *@\( *(\w+) *\)", "", write(r"send \1")),
    (r"[/,] *(\w+)\.send\(@\)", "", write(r"send \1")),
    (r"[/,] *(\w+)\.send(\([^()]*\)) *@", "", write(r"send \1\2")),
    (rf"\bsend +to +@({_ADDRESS}) +({_SENT})", "", write(r"send \2 to \1")),
    (rf"\b(send +{_SENT}(?: +to +{_ADDRESS})?) +@in +({DELAY})\b", "", write(r"\1 after \2")),
    (r"\bto +(\w+)\.@(\d+)", "", write(r"\1[\2]")),
    (r"\bto +(\w+) +\[(\w+)\] *@", "", r"write `\1[\2]` without a space"),
    (
        rf"\bsend +({_SENT}) +to +({_ADDRESS}) *, *({_ADDRESS}) *@ *(?:$|->|,)",
        "`=`",
        r"an event has one address: write `send \1 to \2, send \1 to \3`",
    ),
    # arrays
    (
        r"\bappend +(event\b[\w.]*|\d[\d.]*|\"[^\"]*\") *@(?:,|into\b|in\b)? *([\w.]+)",
        "`to`",
        write(r"append \1 to \2"),
    ),
    (
        r"\bappend +([\w.]+) *@,? *(event\b[\w.]*|\d[\d.]*|\"[^\"]*\")",
        "`to`",
        write(r"append \2 to \1"),
    ),
    (r"\bappend +[\w.]+ *@,? *\w", "`to`", write("append value to array")),
    (
        r"([\w.]+)\.(?:append|push|push_back|add)\(([^()@]*)@([^()]*)\)",
        "",
        write(r"append \2\3 to \1"),
    ),
    (r"\bappend\([^()]*\) *@", "", write("append value to array")),
    (r"([\w.]+)\.clear\(@\)", "", write(r"clear \1")),
    (r"([\w.]+)\.(?:remove|erase|pop)\(@(\w+)\)", "", write(r"remove \1[\2]")),
    (r"\bvar\b[^:]*: *(.*?) *= *@\[ *\]", "", r"an array is empty at first: write `\1`"),
    (r"([\w.]+) *= *@\[ *\]", "", write(r"clear \1")),
    # what is no effect
    (
        rf"[/,] *(?:wait|delay|sleep|pause)(?: +@({DELAY})\b|\(({DELAY})\) *@)",
        "",
        r"effects take no time: go to a state with the transition `after \1\2 -> Target`",
    ),
    (
        r"[/,] *(?:log|print|echo|say) +@[\"\w]",
        "",
        "an effect is `name = value` or `send Event`: what else a robot does is an activity, `do`",
    ),
    (
        r"[/,] *if\b[^,;]*@",
        "",
        "write a guard before `/`, as in `on event [x < 3] / x = 1`, or go to a `choice`",
    ),
    (
        rf"\bafter +(?!{DELAY} */)([^/\[\]{{}};]*?) */ *([\w.]+) *@->",
        "",
        r"`/` begins effects: write `after (\1 / \2)`",
    ),
    (
        rf"\bon +(?:[\w.]+(?: *, *[\w.]+)*|[^/]*\]) +@(?:{_EFFECT})",
        "`->`",
        "write `/` before the effects",
    ),
    # data of events
    (
        r"\bon +(member_\w+)@\( *(\w+) *\)",
        "`[`",
        r'write `on \1 [event.role == "\2"]`',
    ),
    (r"\bon +(?!timeout)([\w.]+)@\( *(\w+) *\)", "`[`", r"write `on \1`: its data is `event.\2`"),
    (
        rf"\bon +([\w.]+)@\( *(\w+) *=+ *({_DATA}) *\)",
        "`[`",
        write(r"on \1 [event.\2 == \3]"),
    ),
)
