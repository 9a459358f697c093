"""Reasons why a search has ended before it has found all states."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.failures import failures
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.verdict import unfinished
from swarmdsl.execution.verify.search.explore import explore
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm import model as models
from swarmdsl.execution.verify.swarm.model import Model

COUNTING = """package test
message Job { number : uint32 }
swarm event Announced : Job
swarm event Done : Job
function carry : abstraction { service "carry" : std_srvs/Empty }
endless statemachine Announcing {
  var number : uint32 = 0
  initial Rest
  state Rest { after 1 s / number = number + 1, send Announced(number = number) -> Wait }
  state Wait {
    on Done [event.number == number] -> Rest
    after 5 s -> Rest
  }
}
endless statemachine Carrying {
  var job : Job
  initial Free
  state Free { on Announced / job = event -> Work }
  state Work {
    do carry
    on succeeded, aborted / send Done(number = job.number) -> Free
  }
}
member Carrier { behavior Carrying }
member Boss { behavior Announcing }
swarm Yard { carrier : Carrier[2]; boss : Boss }
property Few of Yard : never count(carrier in Work) > 2
"""


def test_the_variable_to_bound_is_the_one_that_grows(
    modelled: Callable[..., Model], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(models, "MOST_STATES", 20)
    model = modelled(COUNTING)

    (verdict,) = (
        prove(each, model, Budget(Limits(states=2_000))) for each in watchable(model.subject)
    )

    assert verdict.outcome == "up to"
    assert verdict.reason == "a `carrier` has too many states: bound `Announcing.number`"
    assert "Announced" in verdict.full


@pytest.mark.parametrize(
    ("limits", "reached"),
    [(Limits(states=5), "states"), (Limits(seconds=0), "time"), (Limits(memory=1), "memory")],
)
def test_the_limit_that_ended_a_search_is_told(
    limits: Limits, reached: str, modelled: Callable[..., Model]
) -> None:
    bounded = COUNTING.replace("number = number + 1", "number = (number + 1) % 2")
    model = modelled(bounded)
    assert model.complete
    (property_,) = watchable(model.subject)

    verdict = prove(property_, model, Budget(limits))

    assert verdict.outcome == "up to"
    assert verdict.reason.startswith(f"the search came to its limit of {reached}: ")


def test_states_of_lost_robots_are_not_named(
    modelled: Callable[..., Model], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(models, "MOST_STATES", 3)
    text = """
event Go : std_msgs/Empty
endless statemachine Move {
  initial A
  state A { on Go -> B }
  state B { on Go -> C }
  state C { on Go -> D }
  state D { on Go -> A }
}
member Rover { behavior Move }
swarm S { rover : Rover[2] }
property P of S : never some rover in D
"""
    model = modelled(text, faults=1)

    reason = unfinished(model, Budget(Limits()))

    assert reason == "a `rover` has too many states: 3 combinations of active states"


GATHERING = """package test
swarm event Call : std_msgs/Empty
swarm event Here : std_msgs/Empty
function come : abstraction { service "come" : std_srvs/Empty }
endless statemachine Coming {
  initial Away
  state Away { on Call -> Way }
  state Way {
    do come
    on succeeded / send Here -> There
    on aborted -> Away
  }
  state There { on Call -> Away }
}
statemachine Gathering {
  var here : uint32 = 0
  initial Wait
  state Wait {
    entry / send Call
    on Here [here < 5] / here = here + 1
    on Here -> Full
    after 10 s -> Wait
  }
  final Full
}
member Guest { behavior Coming }
member Host { behavior Gathering }
swarm Party { guest : Guest[6]; host : Host }
property Early of Party : each host : never in Full
property Never of Party : each host : in Full only after has [here == 5]
"""


def test_a_robot_near_to_a_violation_is_followed_where_the_search_came_to_its_limit(
    modelled: Callable[..., Model],
) -> None:
    model = modelled(GATHERING)

    early, never = (
        prove(each, model, Budget(Limits(states=5_000))) for each in watchable(model.subject)
    )

    assert early.outcome == "fails"
    assert early.run is not None
    assert not early.run.shortest
    assert early.run.lines[-1].configuration == ["Full"]
    assert never.outcome == "holds"


def test_after_the_limits_one_run_to_each_fault_is_tried(modelled: Callable[..., Model]) -> None:
    model = modelled(
        """package test
event Go : std_msgs/Empty
event Tick : std_msgs/Empty
endless statemachine M {
  var n : uint8 = 0
  initial S0
  state S0 {
    on Go / n = n - 1 -> S1
    on Tick / n = n - 1 -> S0
  }
  state S1 { on Go / n = n - 1 -> S0 }
}
member A { behavior M }
swarm S { a : A }
"""
    )
    graph = explore(model.network(model.groups()), Budget(Limits()))
    tried: list[int] = []

    def played(number: int, _move: Move) -> Run:
        tried.append(number)
        return Run((), flaw="impossible")

    for seconds, tries in ((None, 3), (0.0, 1)):
        tried.clear()
        budget = Budget(Limits(seconds=seconds))
        found = failures(graph, budget, lambda: Run(()), played)
        assert len(tried) == tries
        assert [flaw for _, flaw in found.flaws.values()] == ["impossible"]


def test_a_plan_finds_runs_in_which_roles_need_each_other(modelled: Callable[..., Model]) -> None:
    """Each of ten robots waits for the one before it, and sleeps now and then."""
    machines = "".join(
        f"""
statemachine M{n} {{
  initial Awake
  state Awake {{
    on E{n} / send E{n + 1} -> Done
    after 1 s -> Asleep
  }}
  state Asleep {{
    defer E{n}
    after 1 s -> Awake
  }}
  final Done
}}
member R{n} {{ behavior M{n} }}
"""
        for n in range(10)
    )
    events = "".join(f"swarm event E{n} : std_msgs/Empty\n" for n in range(11))
    roles = "".join(f"  r{n} : R{n}\n" for n in range(10))
    model = modelled(
        f"""package test
{events}{machines}
statemachine Start {{ initial A; state A {{ after 1 s / send E0 -> B }}; final B }}
member First {{ behavior Start }}
statemachine End {{ initial A; state A {{ on E10 -> B }}; final B }}
member Last {{ behavior End }}
swarm S {{
  first : First
{roles}  last : Last
}}
property P of S : each last : never in B
"""
    )
    (property_,) = watchable(model.subject)

    verdict = prove(property_, model, Budget(Limits(states=300)))

    assert verdict.outcome == "fails"
    assert verdict.run is not None
    assert not verdict.run.shortest
    assert verdict.run.lines[-1].actor.name == "last[0]"


SHOW = """package test
event Begin : std_msgs/Empty
event Stop : std_msgs/Empty
swarm event Rise : std_msgs/Empty
swarm event Ready : std_msgs/Empty
swarm event Beat : std_msgs/Empty
function climb : abstraction { service "climb" : std_srvs/Empty }
endless statemachine Dance {
  initial Ground
  state Ground { on Rise -> Climb }
  state Climb {
    do climb
    on succeeded / send Ready -> Air
    on aborted -> Refused
    on Stop -> Ground
  }
  state Refused { after 1 s -> Climb }
  state Air {
    on Beat -> Air
    on Stop -> Ground
  }
}
endless statemachine Conduct {
  var ready : uint8 = 0
  var beats : uint8 = 0
  initial Idle
  state Idle { on Begin -> Rising }
  state Rising {
    entry / ready = 0, beats = 0, send Rise
    on Ready [ready < 4] / ready = ready + 1
    on Ready -> Wave
    after 30 s -> Idle
  }
  state Wave {
    entry / beats = beats + 1, send Beat
    after 5 s [beats < 3] -> Wave
    %s
  }
}
member Dancer { behavior Dance }
member Desk { behavior Conduct }
swarm Show { dancer : Dancer[5]; desk : Desk }
property Ends of Show : each desk : in Rising leads to in Idle
property Soon of Show : each desk : in Rising leads to in Idle within 2 min
"""


@pytest.mark.parametrize(
    ("last", "outcomes"),
    [("on Stop -> Idle", ["fails", "fails"]), ("after 5 s -> Idle", ["up to", "unknown"])],
)
def test_a_large_swarm_is_followed_to_where_it_rests(
    modelled: Callable[..., Model], last: str, outcomes: list[str]
) -> None:
    """At the last beat, the desk waits for somebody to stop the show."""
    model = modelled(SHOW % last)

    found = [prove(each, model, Budget(Limits(states=2_000))) for each in watchable(model.subject)]

    assert [each.outcome for each in found] == outcomes
    for each in found:
        if each.run is not None:
            assert not each.run.shortest
            desk = [line for line in each.run.lines if line.actor.name == "desk[0]"]
            assert desk[-1].configuration == ["Wave"]
