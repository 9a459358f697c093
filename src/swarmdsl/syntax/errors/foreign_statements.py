"""Hints for statements in the syntax of other languages."""

from __future__ import annotations

import re
from functools import cache

from swarmdsl.base.diagnostics.advice import Advice, sizes, write
from swarmdsl.syntax.errors.foreign_transitions import TRANSITIONS
from swarmdsl.syntax.errors.patterns import DELIVERY, START, UNIT

# Characters of the line on either side of the error.
_WIDTH = 200
_SERVER = 'write the name of the server first: `"cmd/name" : package/Type`'
_FIELD = r"name the field of each value: `name = \1`"
_POWER = "there is no power operator: write `x * x`"
_MULTIPLICITY = write("[3]", "[1..5]", "[2..*]", "[*]")

# A line with a mark (@) where the parser stops, a terminal that must be expected there (any, if
# empty), and the hint. The first that fits counts.
_HINTS = (
    *TRANSITIONS,
    # activities
    (r"\bdo *@/ *([\w.]+)", "", write(r"do \1")),
    (
        r"\b(do|send) ([\w.]+) +@(?:with +)?(\w+) *=",
        "",
        r"write the arguments in parentheses: `\1 \2(\3 = ...)`",
    ),
    (
        r"\bdo +[\w.]+(?:\([^()]*\))? *;? *@-> *([\w.]+)",
        "",
        r"write the outcome on a line of its own: `on succeeded -> \1`",
    ),
    (
        r"(?:\b(?:do|send) |\bstate \w+ *= *)[\w.]+\((?:[^()]*, *)?@(-?[\w.]+|\"[^\"]*\")",
        "a name",
        _FIELD,
    ),
    (
        r"(?:\b(?:do|send) |\bstate \w+ *= *)[\w.]+\((?:[^()]*, *)?(?!by\b)(\w+) *@[,)]",
        "`=`",
        _FIELD,
    ),
    # expressions
    (r"\b(?:any|all|count)\(\w+ in [^()]*?@,", "`where`", "write `where` before the condition"),
    (r"\b(any|all|count|min|max)\((\w+) *@: *(\w+)", "`in`", write(r"\1(\2 in \3 ...)")),
    (r"([\w.]+)\.contains\(([^()@]*)@([^()]*)\)", "", write(r"contains(\1, \2\3)")),
    (r"([\w.]+)\.(?:len|length|size|count)\(@\)", "", write(r"len(\1)")),
    (r"([\w.]+)\.(?:is_?empty|isEmpty|empty)\(@\)", "", write(r"len(\1) == 0")),
    (
        r"\[(?:[^]]*[^\w.])?(self|event)\.id @in +([A-Za-z_]\w*) *(?:\]|and\b|or\b)",
        "",
        r'for a role, write `\1.role == "\2"`; for an array, `contains(\2, \1.id)`',
    ),
    (r"\bto +role +@(\w+)", "", write(r"to \1")),
    (
        r"\[(?:[^]]*[^\w.])?([\w.]+) @in +([A-Za-z_][\w.]*) *(?:\]|and\b|or\b)",
        "",
        write(r"contains(\2, \1)"),
    ),
    (r"\[[^]]*\b([\w.]+) +@\[ *([^]]*?) *\]", "`]`", r"write `\1[\2]` without a space"),
    (r"\[[^]]*\b([\w.]+) @in\b", "", r"compare with both bounds: `\1 >= 1 and \1 <= 3`"),
    (r"\*@\*|@\^", "", _POWER),
    (
        r"\b(?:min|max)\(.*\) *@\.(\w+)",
        "",
        r"assign the item to a variable first, such as `item`, and write `item.\1`",
    ),
    # states
    (r"\bhistory@ *$", "", write("history Name")),
    (r"@shallow +history +(\w+)", "", write(r"history \1")),
    (r"\bdefer +@\*", "", "name the events: `defer Start, Stop`"),
    (r"^ *@\[\*\] *-+> *(\w+)", "", write(r"initial \1")),
    (
        r"^ *@(\w+) *-+> *\[\*\]",
        "",
        r"the end is a state: declare `final Done`, and a transition to it in `\1`",
    ),
    (
        r"^ *@states? *[:{]|^ *states *@: *(?:$|\{)",
        "",
        "declare each state: `state Name { ... }`",
    ),
    (r"^ *@state +machine\b", "", write("statemachine")),
    (r"\binitial +enter +@(\w+)", "", write(r"initial \1")),
    (r"\binitial *@[:=] *[\"']?(\w+)", "", write(r"initial \1")),
    (
        r"^ *@(?!(?:on|do|entry|exit|after)\b)([A-Za-z]\w*) *: *(?:$|\{)",
        "`state`",
        write(r"state \1 { ... }"),
    ),
    (r"\bfinal @state +(\w+)", "", write(r"final \1")),
    (r"\binitial @state +(\w+)", "", r"write `initial \1`, and declare the state next to it"),
    (r"\bparallel @(?!state\b)(\w+)", "`state`", write(r"parallel state \1")),
    (
        r"^ *@(?:deep +)?history +(\w+)",
        "`region`",
        (
            r"write `history \1` in a region to restore that one; to restore all regions, put the "
            r"parallel state into a state, and `deep history \1` beside it"
        ),
    ),
    (
        rf"{START}@(?:state|initial|final|choice|parallel)\b",
        "`region`",
        "put the states of a parallel state in regions: `region Name { ... }`",
    ),
    (r"^ *@region\b", "", "a region belongs to a `parallel state`"),
    (r"^ *@submachine +(\w+)", "", r"reuse a state machine with `state \1 = Machine`"),
    (r"= *new +@([A-Z]\w*)", "", write(r"= \1")),
    (
        r"^ *@(?:on|do|entry|exit|after)\b",
        "`{`",
        "write the items of a state in braces after its name",
    ),
    (
        r"^ *@(?:on|do|entry|exit|after|defer)\b",
        "`param`",
        "write it in a state: `state Name { ... }`",
    ),
    # declarations
    (
        r"^ *@const\b",
        "",
        "declare a constant at the top level of the file",
    ),
    (
        r"^ *const +@\w+ *:",
        "`:`",
        "declare a constant at the top level of the file",
    ),
    (
        r"^ *@#define +(\w+)",
        "",
        r"declare a constant with its type: `const \1 : type = value`",
    ),
    (
        r"^ *@(?:void|int|float|double|bool|auto|char|string|def|fn|func)\b[^()]*\(",
        "",
        "declare what a robot can do as `function`, and its behaviour as `statemachine`",
    ),
    (r"\} *@default +\w+", "", "give the variable an initial value: `var x : Mode = Mode.IDLE`"),
    (r"^ *@(?:swarm|member) *:|^ *(?:swarm|member) *@:", "", "enclose a block in `{` and `}`"),
    (r"\b(keep|lifespan|deadline) *@[=:] *(\w[\w. ]*\w|\w)", "", write(r"\1 \2")),
    # types
    (rf": *(\w+(?:\[[^]]*\])?) *@[\[(] *({UNIT}) *[\])]", "`in`", write(r"\1 in \2")),
    (
        r"^ *(\w+) *@\[(\w*)\] *: *([\w./]+)",
        "`:`",
        r"write the size after the type: `\1 : \3[\2]`",
    ),
    (
        r": *(?:std::)?(?:list|vector|Vec|sequence|array|Array|List)@<([\w./]+)>",
        "",
        write(r"\1[]"),
    ),
    (
        r": *(?:std::)?(?:map|dict|Map|Dict|HashMap|unordered_map|Record)@[<\[]",
        "",
        "there are no maps: declare a struct for the entries, and use an array of it",
    ),
    (
        r": *[\w./]+@\?|^ *\w+@\? *:",
        "",
        "fields cannot be optional: add a `bool` field for its presence",
    ),
    (
        r"^ *[a-z]\w* *: *(?:[a-z][\w.]*|\w+/[\w/]+)(?:\[[^]]*\])* *@= *[^=]",
        "`[`",
        "a field has no default value: the sender sets it",
    ),
    (
        r"\bparam +(\w+) *: *@(-?[\d.]+|\"[^\"]*\"|true|false)",
        "a type",
        r"write the type before the value: `param \1 : type = \2`",
    ),
    (
        rf"{START}@param +\w+",
        "`do`",
        "declare it in the state machine, outside its states",
    ),
    (
        r"^ *@var\b",
        "",
        "declare a variable in a state machine, or a `const` at the top level",
    ),
    (
        r"^ *@param +\w+ *:",
        "",
        "declare a param in a function, component, member, state machine or fitness",
    ),
    (r"^ *@abstract\b", "", "delete it: any component or member can be extended"),
    # interfaces
    (
        r"^ *import +(\w+)@/(?:(?:msg|srv|action)/)?(\w+)",
        "",
        r"delete the import: an interface of ROS needs none, write `\1/\2` where it is used",
    ),
    (r"^ *import +ros +@([\w./-]+)", "", r'write `import ros "\1"`'),
    (r"\bfunction +\w+ *@\{", "", "add the category: `: abstraction` or `: swarm`"),
    (r"\b(?:action|service) +@:", "a string in double quotes", _SERVER),
    (
        r"\bevent +\w+@ *$",
        "",
        "add the type of its message: `: std_msgs/Empty` if it carries no data",
    ),
    (
        r"\bfunction +(\w+) *@\(",
        "",
        r"write `function \1 : abstraction { ... }`, with its action or service inside",
    ),
    (
        r"^ *(in|out) +@(\w+) *:",
        "a string in double quotes",
        r'write the topic: `\1 "\2" : package/Type`',
    ),
    (r"\bevent +(\w+) *@[{(]", "", r"add the type of its message: `event \1 : package/Name`"),
    (r"\bevent +@swarm\b", "", write("swarm event")),
    (
        rf"\bevent +\w+ *: *[\w./]+ *@(?:\[ *)?({DELIVERY})",
        "`{`",
        r"write `{ \1 }` after the type",
    ),
    (
        r"\b(?:event|in|out|inout) +\w+ *: *[\w./]+ +@(?:\w+ *|= *)?(\"[^\"]*\")",
        "`on`",
        r"write `on` before the topic: `on \1`",
    ),
    # members
    (r"\bextends +[\w.]+ *@,", "", "extend one only"),
    (r"\b(behavior|environment|fitness) *@[:=] *(\w+)", "", write(r"\1 \2")),
    (r"^ *([a-z]\w*) *@= *([A-Z]\w*) *$", "`:`", write(r"\1 : \2")),
    (
        r"^ *([A-Z]\w*) +@([a-z_]\w*) *(?:$|[{[])",
        "`:`",
        Advice(r"write the name first: `\2 : \1`", "name first", r"\2 : \1"),
    ),
    (r": *[A-Z][\w.]*@\[", "`{`", "a part is one component: declare several parts"),
    (r": *[A-Z][\w.]*@\( *(\d[\d.*]*) *\)", "`[`", sizes(r"[\1]")),
    (r": *[A-Z][\w.]*@\(", "`{`", "write values of params in braces: `{ name = value }`"),
    (r"\bconnect +[\w.]+ +@(?:to|with|and)\b", "", write("->")),
    (
        r"\bconnect +([\w.]+) *@<-+ *([\w.]+)",
        "",
        r"connect from the sender to the receiver: `connect \2 -> \1`",
    ),
    (r"^ *instance +@(\w+) *:", "`:`", r"write `\1 : ...` without `instance`"),
    (
        r"^ *connections? *(?:\w+ *)?@(?:\w+ *)?\{",
        "",
        "write each connector in the member: `connect a.b -> c.d`",
    ),
    (
        r"^ *@(?:publish\w*|pub|advertise\w*|(?:a?sync +)?output(?: +port)?) +(\w+)",
        "`out`",
        write(r"out \1"),
    ),
    (
        r"^ *@(?:subscri\w*|sub|(?:(?:a?sync|guarded) +)?input(?: +port)?) +(\w+)",
        "`in`",
        write(r"in \1"),
    ),
    (r"^ *\w+@\.\w+ *->", "", "begin a connector with `connect`"),
    # swarms
    (
        r"^ *contract +@\w+ *(?:\[|:? *on\b)",
        "`:`",
        (
            "a contract belongs to the robots of a `member`: write it there, as in "
            "`contract Stops : on Stop within 2 s reach Home`"
        ),
    ),
    (
        r"(?:^|[{;]) *@(\d+) *[x*]? *([a-z_]\w*) *: *([\w.]+)",
        "`heartbeat`",
        r"write the number after the member: `\2 : \3[\1]`",
    ),
    (
        r"\bheartbeat +every +@(\d[\d.]* *\w+) *,? *(lost +after +\d[\d.]* *\w+)",
        "",
        write(r"heartbeat \1 \2"),
    ),
    (
        r"\bheartbeat +(\d[\d.]* *\w+) *@, *(lost +after +\d[\d.]* *\w+)",
        "",
        write(r"heartbeat \1 \2"),
    ),
    (
        r"\bheartbeat +(?:every +@)?(?:\d[\d.]*) *\w+ *@? *(?:$|\})",
        "",
        "add how long a robot is silent when it is lost: `heartbeat 1 s lost after 5 s`",
    ),
    (r"\blost +@(\d[\d.]* *\w+)", "`after`", write(r"lost after \1")),
    # fitness
    (
        r"\bin +\w+ *: *[\w./]+ *= *[^=]*\) *@[-+*/%]",
        "`in`",
        "a measure is no part of a calculation: calculate in `maximize` or `minimize`",
    ),
    (
        r"^ *([A-Z]\w*) *@\[ *([^\]\n]*)\]",
        "`:`",
        r"write the name of the role first: `name : \1[\2]`",
    ),
    (
        r"(?:^ *|: *)@(\d+) *[x*]? *([A-Z]\w*)",
        "",
        r"write the number after the member: `\2[\1]`",
    ),
    (r": *([A-Z][\w.]*) *@\* *(\d+)", "`[`", r"write the number after the member: `\1[\2]`"),
    (r": *([A-Z][\w.]*) +x +@(\d+)", "", r"write the number after the member: `\1[\2]`"),
    (r"\w\[[^]]*@", "a number or `*`", _MULTIPLICITY),
    (r"\w\[ *\d+@ *[,.:;]", "`..`", _MULTIPLICITY),
    (r"\bsize +[\d.]+ *([a-z]+) *@ *(?:$|\})", "", r"write width and depth: `10 \1 x 10 \1`"),
    # optimization
    (r"^ *@param +(\w+\.\w+)", "", r"write `\1` without `param`"),
    (r"\bin @\[([^],]*), *([^],]*)\]", "", write(r"\1 .. \2")),
    (r"\bin +\S.*@to\b", "`..`", write("..")),
    (r"@from\b", "`in`", write("in")),
    (r"\b(steps|evaluations|seed) @= *(\w+)", "", write(r"\1 \2")),
)


@cache
def _compiled() -> list[tuple[re.Pattern[str], str, str]]:
    return [(re.compile(line.replace("@", "\0")), needed, hint) for line, needed, hint in _HINTS]


def foreign_statement_hint(expected: set[str], text: str, at: int) -> str | None:
    """Return a hint for the line around an offset; None if nothing fits."""
    start = max(text.rfind("\n", 0, at) + 1, at - _WIDTH)
    end = text.find("\n", at, at + _WIDTH)
    line = f"{text[start:at]}\0{text[at : end if end >= 0 else at + _WIDTH]}".replace("\t", " ")
    for pattern, needed, hint in _compiled():
        if (not needed or needed in expected) and (found := pattern.search(line)):
            return hint.expanded(found) if isinstance(hint, Advice) else found.expand(hint)
    return None
