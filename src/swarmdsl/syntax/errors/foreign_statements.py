"""Lines as people write them who are used to other notations, and how that is said in this one."""

from __future__ import annotations

import re
from functools import cache

# How much of a line is looked at on either side of where a parser stops.
_WIDTH = 200
_GUARD = "a guard stands in square brackets: `on event [x < 3] -> Target`"
_SERVER = 'the name of the server comes first: `"cmd/name" : package/Type`'
_FIELD = r"each value stands behind the name of what it is for: `name = \1`"
_POWER = "there is no power: multiply, `x * x`"
_MULTIPLICITY = "write `[3]`, `[1..5]`, `[2..*]` or `[*]`"
_BEFORE_EFFECTS = r"(?:\b(?:entry|exit) *|\b(?:on|after) [^/]*)"

# A line with a mark (@) where the parser stops, what the parser must expect there (anything, if
# nothing is said), and what to do. The first that fits counts.
_HABITS = (
    # transitions
    (r"\bon [^/[\]]*@(?:if|when|where)\b", "", _GUARD),
    (
        r"\bon [\w., ]*@(?:\|\||or\b)",
        "",
        "write `,`: the transition is taken on any of the events",
    ),
    (
        r"\bon [\w., ]*@(?:&&|and\b)",
        "",
        "events come one after the other: wait for the second one in a state of its own",
    ),
    (r"\bon +@(entry|exit)\b", "", r"write `\1 / ...` without `on`"),
    (r"(?:^|\{) *@-> *([\w.]+)", "", r"write `on done -> \1`: the state is left when it is done"),
    (r"\bon +@after\b", "", "write `after` without `on`"),
    (r"\b(entry|exit) *@:", "", r"write `\1 / ...`"),
    (
        r"\b(?:entry|exit) *@(?: *do\b)",
        "",
        "write `do` on a line of its own: it starts when the state is entered",
    ),
    (r"(?:^ *|\bon +)@timeout\b", "", "a delay is written `after 5 s -> Target`"),
    (r"\bon timeout *@[\d(]", "", "a delay is written `after 5 s -> Target`"),
    (r"\bon +[\w., ]*@: *-+>", "", "delete the `:`"),
    (r"\bon [\w., ]+@enter +(\w+)", "", r"write `-> \1`"),
    (
        rf"{_BEFORE_EFFECTS}/ *(?:[^/]*, *)?[\w.]+(?:\([^()]*\))? *@ *(?:$|->|,)",
        "`=`",
        "an effect is `name = value` or `send Event`: what takes time is what a state does",
    ),
    (r"/ *@\{", "", "effects stand without braces, with `,` between them"),
    (r"/ *\w[^\[\]>]*@; *\w", "", "effects stand with `,` between them"),
    (
        r"[/,] *(?:raise|emit|publish|fire|trigger) +@(\w+)",
        "",
        r"an event is sent with `send \1`",
    ),
    (
        r"[/,] *(?:(?:call|run|start) +@\w|@do\b)",
        "",
        "an effect starts no activity: lead to a state that has `do`",
    ),
    (r"/ *[^/]*= *[\w.]+ +@(\w+) *=(?!=)", "`,`", r"write `,` before `\1`"),
    (r"^ *@every\b", "", "a time that comes again: `after 5 s` leads back to the state it is in"),
    # activities
    (r"\bdo *@/ *([\w.]+)", "", r"write `do \1`"),
    (
        r"\bdo ([\w.]+) +@(\w+) *=",
        "",
        r"the values stand in parentheses: `do \1(\2 = ...)`",
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
    (r"\[[^]]*\b([\w.]+) @in\b", "", r"write both ends: `\1 >= 1 and \1 <= 3`"),
    (r"\*@\*|@\^", "", _POWER),
    (
        r"\w@\[",
        "`+`",
        "elements of arrays cannot be used: of an array, expressions have only `len`",
    ),
    # states
    (r"^ *@\[\*\] *-+> *(\w+)", "", r"write `initial \1`"),
    (
        r"^ *@(\w+) *-+> *\[\*\]",
        "",
        r"the end is a state, too: write `final Done`, and in `\1` a transition to it",
    ),
    (
        r"^ *@states? *[:{]|^ *states *@: *(?:$|\{)",
        "",
        "states stand one by one: `state Name { ... }`",
    ),
    (r"^ *@state +machine\b", "", "write `statemachine`"),
    (r"\binitial +enter +@(\w+)", "", r"write `initial \1`"),
    (r"\binitial *@[:=] *[\"']?(\w+)", "", r"write `initial \1`"),
    (
        r"^ *@(?!(?:on|do|entry|exit|after)\b)([A-Za-z]\w*) *: *(?:$|\{)",
        "`state`",
        r"write `state \1 { ... }`",
    ),
    (r"\bfinal @state +(\w+)", "", r"write `final \1`"),
    (r"\binitial @state +(\w+)", "", r"write `initial \1`, and the state beside it"),
    (r"\bparallel @(?!state\b)(\w+)", "`state`", r"write `parallel state \1`"),
    (
        r"^ *@(?:deep +)?(?:state|initial|final|choice|history|parallel)\b",
        "`region`",
        "the states of a parallel state stand in regions: `region Name { ... }`",
    ),
    (r"^ *@region\b", "", "a region stands in a `parallel state`"),
    (r"^ *@submachine +(\w+)", "", r"a machine is reused by `state \1 = Machine`"),
    (r"= *new +@([A-Z]\w*)", "", r"write `= \1`"),
    (r"^ *@(?:on|do|entry|exit|after)\b", "`{`", "what a state has stands in braces behind it"),
    # what stands where
    (
        r"^ *@const\b",
        "",
        "a constant is a declaration of its own, outside of all others",
    ),
    (
        r"^ *const +@\w+ *:",
        "`:`",
        "a constant is a declaration of its own, outside of all others",
    ),
    (
        r"^ *@#define +(\w+)",
        "",
        r"a constant is declared with its type: `const \1 : type = value`",
    ),
    (
        r"^ *@(?:void|int|float|double|bool|auto|char|string|def|fn|func)\b[^()]*\(",
        "",
        "this is no program: what a robot can do is a `function`, its behaviour a `statemachine`",
    ),
    (r"\} *@default +\w+", "", "a variable says what it begins with: `var x : Mode = Mode.IDLE`"),
    (r"^ *@(?:swarm|member) *:|^ *(?:swarm|member) *@:", "", "a block stands in `{` and `}`"),
    # types
    (
        r"^ *(\w+) *@\[(\w*)\] *: *([\w./]+)",
        "`:`",
        r"the size stands behind the type: `\1 : \3[\2]`",
    ),
    (
        r": *(?:std::)?(?:list|vector|Vec|sequence|array|Array|List)@<([\w./]+)>",
        "",
        r"write `\1[]`",
    ),
    (
        r": *(?:std::)?(?:map|dict|Map|Dict|HashMap|unordered_map|Record)@[<\[]",
        "",
        "there are no maps: declare a struct for an entry, and use an array of it",
    ),
    (
        r": *[\w./]+@\?|^ *\w+@\? *:",
        "",
        "no field is optional: add one that says whether it is there",
    ),
    (
        r"^ *[a-z]\w* *: *(?:[a-z][\w.]*|\w+/[\w/]+)(?:\[[^]]*\])* *@= *[^=]",
        "`[`",
        "a field has no value of its own: who sends it says what is in it",
    ),
    (
        r"\bparam +(\w+) *: *@(-?[\d.]+|\"[^\"]*\"|true|false)",
        "a type",
        r"a type stands before the value: `param \1 : type = \2`",
    ),
    (
        r"^ *@var\b",
        "",
        "a variable stands directly in a state machine; a value for all of them is a `const`",
    ),
    (
        r"^ *@param +\w+ *:",
        "",
        "a param belongs to a function, component, member, state machine or fitness",
    ),
    (r"^ *@abstract\b", "", "leave it out: what is extended is declared like all others"),
    # interfaces
    (r"^ *import +ros +@([\w./-]+)", "", r'write `import ros "\1"`'),
    (r"\bfunction +\w+ *@\{", "", "say which kind it is: `: abstraction` or `: swarm`"),
    (r"\b(?:action|service) +@:", "a text in double quotes", _SERVER),
    (
        r"\bevent +\w+@ *$",
        "",
        "say what it carries: `: std_msgs/Empty` if it is nothing",
    ),
    (
        r"\bfunction +(\w+) *@\(",
        "",
        r"a function says how it is asked for: `function \1 : abstraction { ... }`",
    ),
    (
        r"^ *(in|out) +@(\w+) *:",
        "a text in double quotes",
        r'a function names the topic: `\1 "\2" : package/Type`',
    ),
    (r"\bevent +(\w+) *@[{(]", "", r"an event carries a message: `event \1 : package/Name`"),
    (r"\bevent +@swarm\b", "", "write `swarm event`"),
    (
        r"\b(?:event|in|out|inout) +\w+ *: *[\w./]+ +@(?:\w+ *|= *)?(\"[^\"]*\")",
        "`on`",
        r"the topic stands behind `on`: `on \1`",
    ),
    # members
    (r"\bextends +[\w.]+ *@,", "", "one is extended, not several"),
    (r"\b(behavior|environment|fitness) *@[:=] *(\w+)", "", r"write `\1 \2`"),
    (r"^ *([a-z]\w*) *@= *([A-Z]\w*) *$", "`:`", r"write `\1 : \2`"),
    (
        r"^ *([A-Z]\w*) +@([a-z_]\w*) *(?:$|[{[])",
        "`:`",
        r"the name comes first: `\2 : \1`",
    ),
    (r": *[A-Z][\w.]*@\[", "`{`", "a part is one component: declare a part for each"),
    (r": *[A-Z][\w.]*@\(", "`{`", "values of params stand in braces: `{ name = value }`"),
    (r"\bconnect +[\w.]+ +@(?:to|with|and)\b", "", "write `->`"),
    (
        r"\bconnect +([\w.]+) *@<-+ *([\w.]+)",
        "",
        r"the arrow leads from what is sent: `connect \2 -> \1`",
    ),
    (r"^ *instance +@(\w+) *:", "`:`", r"write `\1 : ...` without `instance`"),
    (
        r"^ *connections? *(?:\w+ *)?@(?:\w+ *)?\{",
        "",
        "connectors stand in the member, one by one: `connect a.b -> c.d`",
    ),
    (
        r"^ *@(?:publish\w*|pub|advertise\w*|(?:a?sync +)?output(?: +port)?) +(\w+)",
        "`out`",
        r"write `out \1`",
    ),
    (
        r"^ *@(?:subscri\w*|sub|(?:(?:a?sync|guarded) +)?input(?: +port)?) +(\w+)",
        "`in`",
        r"write `in \1`",
    ),
    (r"^ *\w+@\.\w+ *->", "", "a connector begins with `connect`"),
    # swarms
    (
        r"^ *([A-Z]\w*) *@\[ *([^\]\n]*)\]",
        "`:`",
        r"what they are called comes first: `name : \1[\2]`",
    ),
    (
        r"(?:^ *|: *)@(\d+) *[x*]? *([A-Z]\w*)",
        "",
        r"how many there are stands behind: `\2[\1]`",
    ),
    (r": *([A-Z][\w.]*) *@\* *(\d+)", "`[`", r"how many there are stands behind: `\1[\2]`"),
    (r": *([A-Z][\w.]*) +x +@(\d+)", "", r"how many there are stands behind: `\1[\2]`"),
    (r"\w\[[^]]*@", "a number or `*`", _MULTIPLICITY),
    (r"\w\[ *\d+@ *[,.:;]", "`..`", _MULTIPLICITY),
    (r"\bsize +[\d.]+ *([a-z]+) *@ *(?:$|\})", "", r"write width and depth: `10 \1 x 10 \1`"),
    # optimization
    (r"^ *@param +(\w+\.\w+)", "", r"write `\1` without `param`"),
    (r"\bin @\[([^],]*), *([^],]*)\]", "", r"write `\1 .. \2`"),
    (r"\bin +\S.*@to\b", "`..`", "write `..`"),
    (r"@from\b", "`in`", "write `in`"),
    (r"\b(steps|evaluations|seed) @= *(\w+)", "", r"write `\1 \2`"),
)


@cache
def _compiled() -> list[tuple[re.Pattern[str], str, str]]:
    return [(re.compile(line.replace("@", "\0")), needed, said) for line, needed, said in _HABITS]


def habit(expected: set[str], text: str, at: int) -> str | None:
    """How to say here what the line around an offset says elsewhere; None if unknown."""
    start = max(text.rfind("\n", 0, at) + 1, at - _WIDTH)
    end = text.find("\n", at, at + _WIDTH)
    line = f"{text[start:at]}\0{text[at : end if end >= 0 else at + _WIDTH]}".replace("\t", " ")
    for pattern, needed, advice in _compiled():
        if (not needed or needed in expected) and (found := pattern.search(line)):
            return found.expand(advice)
    return None
