"""Records behave like data classes of Python."""

import copy
import dataclasses
import pickle
import pprint

import pytest

from swarmdsl.base import records as ours

SOURCE = """
from __future__ import annotations

@dataclass(slots=True, eq=False)
class Node:
    span: int

@dataclass(slots=True, eq=False)
class Documented(Node):
    doc: str = field(default="", init=False)

@dataclass(slots=True, eq=False)
class Variable(Documented):
    name: str
    words: list[str] = field(default_factory=list)
    seen: set[str] = field(default_factory=set, init=False, repr=False)

@dataclass(frozen=True, slots=True)
class Event:
    name: str
    topic: str | None = None
    origin: object = field(default=None, compare=False, repr=False)

@dataclass(frozen=True, slots=True)
class Nothing:
    pass

@dataclass(frozen=True)
class Request:
    target: str
    options: tuple[str, ...] = ()

    @property
    def long(self):
        return len(self.options) > 1

    def __repr__(self):
        return "a request"

@dataclass
class Tagged(Node):
    tag: str = ""

@dataclass
class Counts:
    files: int
    names: dict[str, int] = field(default_factory=dict)
    more: int = field(default=0, kw_only=True)
"""

CALLS = [
    "Node(1)",
    "Variable(1, 'x')",
    "Variable(span=1, name='x', words=['y'])",
    "Event('Go')",
    "Event('Go', topic='go', origin=3)",
    "Event('Go', None, 4)",
    "Nothing()",
    "Request('smach', ('a', 'b'))",
    "Request('smach')",
    "Counts(1)",
    "Counts(1, {'a': 2}, more=3)",
    "Tagged(1, 'x')",
]
WRONG_CALLS = [
    "Node()",
    "Variable(1)",
    "Variable(1, 'x', doc='')",
    "Counts(1, {}, 3)",
    "Event(no=1)",
]


@pytest.fixture(scope="module")
def made():
    """The classes, made by us and by Python."""
    both = []
    for maker in (ours, dataclasses):
        names = {"dataclass": maker.dataclass, "field": maker.field, "__name__": __name__}
        exec(SOURCE, names)
        both.append(names)
    return both


def known(value):
    """Return all observable properties of an instance."""
    return (
        repr(value),
        pprint.pformat(value),
        [
            (part.name, part.type, part.default, part.compare, part.init, part.kw_only)
            for part in dataclasses.fields(value)
        ],
        dataclasses.asdict(value),
        type(value).__match_args__,
        getattr(type(value), "__slots__", None),
        hasattr(value, "__dict__"),
    )


@pytest.mark.parametrize("call", CALLS)
def test_instances_are_alike(made, call):
    ours, theirs = (eval(call, names) for names in made)
    assert known(ours) == known(theirs)
    assert known(dataclasses.replace(ours)) == known(dataclasses.replace(theirs))
    for copied in (copy.copy(ours), copy.deepcopy(ours)):
        assert known(copied) == known(theirs)


def test_the_first_of_many_are_like_the_last(made):
    for call in CALLS:
        one, *_, last = [eval(call, made[0]) for _ in range(60)]
        assert known(one) == known(last)
    for call in WRONG_CALLS:  # now that each has code of its own
        with pytest.raises(TypeError):
            eval(call, made[0])


def test_values_can_be_replaced(made):
    event = made[0]["Event"]("Go", "go", 3)
    assert ours.replace(event) == event
    other = ours.replace(event, topic=None)
    assert (other.name, other.topic, other.origin) == ("Go", None, 3)
    with pytest.raises(TypeError):
        ours.replace(event, size=1)
    counts = made[0]["Counts"](1, {}, more=2)
    assert ours.replace(counts, files=3).more == 2


@pytest.mark.parametrize("call", WRONG_CALLS)
def test_calls_are_refused_alike(made, call):
    messages = []
    for names in made:
        with pytest.raises(TypeError) as raised:
            eval(call, names)
        messages.append(str(raised.value))
    assert messages[0] == messages[1]


def test_instances_compare_alike(made):
    tables = []
    for names in made:
        values = [eval(call, names) for call in CALLS * 2]
        tables.append([(a == b, _hash(a) == _hash(b)) for a in values for b in values])
    assert tables[0] == tables[1]


def _hash(value):
    try:
        return hash(value)
    except TypeError:
        return None


def test_a_frozen_one_does_not_change(made):
    event = made[0]["Event"]("Go")
    with pytest.raises(dataclasses.FrozenInstanceError):
        event.name = "Stop"
    with pytest.raises(dataclasses.FrozenInstanceError):
        del event.name
    assert event.name == "Go"


def test_defaults_are_not_shared(made):
    first, second = made[0]["Counts"](1), made[0]["Counts"](2)
    first.names["a"] = 1
    assert second.names == {}


def test_one_that_holds_itself_can_be_shown(made):
    counts = made[0]["Counts"](1)
    counts.names["self"] = counts
    assert repr(counts) == "Counts(files=1, names={'self': ...}, more=0)"


@ours.dataclass(frozen=True, slots=True)
class Kept:
    """Something that can be found by its name."""

    name: str


def test_a_frozen_one_can_be_pickled():
    assert pickle.loads(pickle.dumps(Kept("x"))) == Kept("x")
