"""What can be written at a place: the keywords of the grammar, and the names that fit.

The parser says which tokens could follow the text before the place; a name that stands there on
trial says, by the node that holds it, what it would mean. Both work in text that is not finished.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from swarmdsl import swarm_parser
from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.inheritance import all_items
from swarmdsl.ir.types import PRIMITIVES
from swarmdsl.link_machines import content, regions, vertices
from swarmdsl.load import File
from swarmdsl.parse import parse_piece
from swarmdsl.peg.machine import mismatch
from swarmdsl.scopes import FileScope, Scopes, bare, kind_of
from swarmdsl.source import Source
from swarmdsl.statements import statement_at
from swarmdsl.syntax import (
    NODES,
    AliasType,
    Constant,
    Container,
    DoneTrigger,
    EnumType,
    FieldUse,
    FinalState,
    FitnessInput,
    Member,
    MessageType,
    Model,
    NameUse,
    Node,
    Optimization,
    Parallel,
    Param,
    Part,
    Port,
    PortRef,
    Ref,
    Region,
    Role,
    State,
    StateMachine,
    StructType,
    Swarm,
    TopLevel,
    TypeRef,
    Variable,
    nodes_of,
    references,
    walk,
)
from swarmdsl.workspace import Workspace
from swarmdsl.workspace.occurrences import owners

_TRIAL = "completed_here_"
_WORD = re.compile(r"\w*")
_COMMENT_OR_TEXT = re.compile(
    r'//[^\n]*|/\*(?:[^*]|\*(?!/))*(?:\*/|\Z)|"(?:[^"\\\n]|\\[^\n])*(?:"|(?=\n)|\Z)'
)
# No text of a model has it: there the parser must stop.
_STOP = "\0"
_TYPES = (StructType, EnumType, AliasType, MessageType)


@dataclass(frozen=True)
class Completion:
    """A word that can stand at a place; `node` is what it means, None for a keyword."""

    word: str
    detail: str
    node: Node | None = None


def completions(workspace: Workspace, file: File, offset: int) -> list[Completion]:
    """What can stand at an offset, in place of the word that begins before it."""
    text = file.source.text
    start, end = word_at(text, offset)
    _, first, last = workspace.piece(file, start)
    last = max(last, end)
    head, tail = text[first:start], text[end:last]
    if _in_comment_or_text(head):
        return []
    expected = _expected(head)
    found = [Completion(word, "keyword") for word in _keywords(expected) if word.isalpha()]
    before = [owner for owner in owners(file) if owner.span.absolute.end <= first]
    if before:
        found = [each for each in found if each.word not in ("package", "import")]
    if any(name for _, name, literal in expected if not literal) or not expected:
        scope = Scopes(workspace.project)[file]
        around = next((one for one in owners(file) if _covers(one, start)), None)
        found += _names(head, tail, scope, around, start)
    return list({each.word: each for each in found}.values())


def word_at(text: str, offset: int) -> tuple[int, int]:
    """Where the word around an offset begins and ends."""
    start = offset
    while start and (text[start - 1].isalnum() or text[start - 1] == "_"):
        start -= 1
    found = _WORD.match(text, offset)
    return start, found.end() if found is not None else offset


def _covers(owner: TopLevel, offset: int) -> bool:
    span = owner.span.absolute
    return span.start <= offset <= span.end


def _in_comment_or_text(head: str) -> bool:
    """Whether a comment or a text that begins in `head` goes on behind it."""
    found = list(_COMMENT_OR_TEXT.finditer(head))
    if not found or found[-1].end() < len(head):
        return False
    last = found[-1]
    closed = last[0].endswith("*/") if last[0].startswith("/*") else last[0][1:].endswith('"')
    return last[0].startswith("//") or not closed


def _expected(head: str) -> frozenset[tuple[str, str, str]]:
    """What the grammar has behind a text; where that is wrong, behind its last statement."""
    statement = statement_at(head, len(head))
    blocks = "".join(head[start:end] for start, end in statement.around)
    for text in (head, blocks + head[statement.start :], blocks):
        found = mismatch(
            swarm_parser.PROGRAM, swarm_parser.TERMINALS, swarm_parser.BLANK, text + _STOP
        )
        if found is not None and found.at == len(text):
            return found.expected
    return frozenset()


def _keywords(expected: Iterable[tuple[str, str, str]]) -> list[str]:
    return sorted(literal for _, _, literal in expected if literal)


def _names(
    head: str, tail: str, scope: FileScope, around: TopLevel | None, offset: int
) -> Iterator[Completion]:
    """The names that can stand between two texts, in the declaration that is around them."""
    for rest in ("\n" + _closers(head), tail):
        source = Source("", head + _TRIAL + rest)
        model = parse_piece(source, Diagnostics()).model
        for owner in _owners(model):
            for nodes in _fitting(owner, scope, around or owner, offset):
                for node in nodes:
                    name = str(node.name)  # type: ignore[attr-defined]
                    yield Completion(name, bare(kind_of(node)), node)
                return
            for type_ in nodes_of(owner, TypeRef):
                if _TRIAL in type_.name:
                    if type_.name == _TRIAL:
                        yield from (Completion(word, "type") for word in PRIMITIVES)
                    yield from _declared(scope, _TYPES)
                    return


def _owners(model: Model) -> Iterator[TopLevel]:
    yield from model.declarations
    yield from model.optimizations


def _closers(head: str) -> str:
    """The brackets that end what is open behind a text."""
    opened = []
    for bracket in re.findall(r"[][(){}]", _COMMENT_OR_TEXT.sub("", head)):
        if bracket in "([{":
            opened.append({"(": ")", "[": "]", "{": "}"}[bracket])
        elif opened and opened[-1] == bracket:
            opened.pop()
    return "\n".join(reversed(opened))


def _fitting(
    owner: TopLevel, scope: FileScope, around: TopLevel, offset: int
) -> Iterator[Iterable[Node]]:
    """What the name on trial can mean; nothing where no name of something that exists stands."""
    for holder, ref in references(owner):
        if _TRIAL in ref.name:
            yield _meant(holder, ref, owner, scope, around, offset)
    for field in nodes_of(owner, FieldUse):
        if field.name == _TRIAL:
            base = field.base
            enum = scope.one(base.name, EnumType) if isinstance(base, NameUse) else None
            yield enum.values if enum is not None else ()
    for use in nodes_of(owner, NameUse):
        if _TRIAL in use.name:
            kinds = (Variable, Param, FitnessInput)
            own = [node for kind in kinds for node in nodes_of(around, kind)]
            yield [*own, *_visible(scope, (Constant, EnumType))]


def _meant(
    holder: Node,
    ref: Ref[Node],
    owner: TopLevel,
    scope: FileScope,
    around: TopLevel,
    offset: int,
) -> Iterable[Node]:
    """What a reference can lead to."""
    path = ref.name.partition(_TRIAL)[0].rstrip(".").split(".")
    match holder, around:
        case PortRef(part=part), Member():
            parts = {str(each.name): each for each in all_items(around, Part)}
            if part is not None and _TRIAL not in part.name:
                component = parts[part.name].component.target if part.name in parts else None
                return all_items(component, Port) if component is not None else ()
            return [*parts.values(), *all_items(around, Port)]
        case DoneTrigger(region=region), StateMachine():
            inner = _containers(around, offset)[-1]
            if region is ref:
                return regions(inner)
            inside = content(inner)
            return [v for v in vertices(inside) if isinstance(v, FinalState)] if inside else ()
    kind = NODES.get(ref.kind)
    if ref.kind == "Vertex" and isinstance(around, StateMachine):
        if path != [""]:
            found = [each for each in nodes_of(around, State) if each.name == path[-1]]
            found_parallel = [each for each in nodes_of(around, Parallel) if each.name == path[-1]]
            return [inner for each in (*found, *found_parallel) for inner in _inside(each)]
        levels = [_inside(each) for each in reversed(_containers(around, offset))]
        return [vertex for level in levels for vertex in level]
    if isinstance(around, Optimization) and kind is Role:
        swarm = scope.one(around.swarm.name, Swarm)
        return [each for each in swarm.items if isinstance(each, Role)] if swarm else ()
    if kind is None or not issubclass(kind, TopLevel):
        return _visible(scope, (NODES["Function"],)) if "Function" in ref.kind else ()
    return _visible(scope, (kind,))


def _inside(state: Node) -> list[Node]:
    """The states directly inside another, those in its regions among them."""
    if isinstance(state, Parallel):
        return [each for region in regions(state) for each in vertices(region)]
    return list(vertices(state)) if isinstance(state, (State, Region, StateMachine)) else []


def _containers(machine: StateMachine, offset: int) -> list[Container]:
    """The machine and the states around an offset, the innermost last."""
    found: list[Container] = []
    for node in walk(machine):
        if isinstance(node, (StateMachine, State, Parallel, Region)):
            span = node.span.absolute
            if span.start <= offset <= span.end:
                found.append(node)
    return found or [machine]


def _visible(scope: FileScope, kinds: tuple[type[Node], ...]) -> list[Node]:
    """The declarations of some kinds that a file sees."""
    found: list[Node] = []
    for kind in kinds:
        for name in scope.names(kind):  # type: ignore[arg-type]
            found += [node for _, node in scope.find(name) if isinstance(node, kind)]
    return found


def _declared(scope: FileScope, kinds: tuple[type[Node], ...]) -> Iterator[Completion]:
    for node in _visible(scope, kinds):
        yield Completion(str(node.name), bare(kind_of(node)), node)  # type: ignore[attr-defined]
