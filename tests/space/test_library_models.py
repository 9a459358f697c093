"""Functions of the shipped library in the flat world: a swarm that uses nothing else flies."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.many_runs.one_run import Runner
from swarmdsl.execution.simulate.run.prepare import Request, prepare

MODEL = """package flight
import cpswarm.behaviours.*
{sensor}
member Flyer {{
  behavior SearchOnce
  {body}
}}
swarm Flight {{
  uav : Flyer[2]
  environment Place
  fitness Found
}}
environment Place {{
  size 40 m x 40 m
  {target}
}}
fitness Found {{
  in found : float64 = mean each uav : count(in Found)
  maximize found
}}
"""
PLACES = {
    "sensor": "sensor Eye {\n  out seen : geometry_msgs/Point\n  senses box { range = 9 m }\n}",
    "body": "body { radius = 0.3 m, speed = 4 m/s, climb = 2 m/s }\n  eye : Eye",
    "target": "target box [3] at random",
}


def _runs(tmp_path, seeds=(1, 2), **parts):
    path = tmp_path / "flight.swarm"
    path.write_text(MODEL.format(**parts), encoding="utf-8")
    request, report = Request((path,), until=300_000_000_000), Diagnostics()
    prepared = prepare(request, report)
    assert prepared is not None, [each.message for each in report]
    return prepared, Runner(request, prepared).run_all(seeds)


def test_robots_that_search_with_functions_of_the_library_find_something(tmp_path):
    prepared, outcomes = _runs(tmp_path, **PLACES)
    assert prepared.spaces.is_flat
    assert [each.fitness for each in outcomes] == [1.0, 1.0]


def test_models_of_a_library_alone_make_no_simulation_flat(tmp_path):
    prepared, outcomes = _runs(tmp_path, sensor="", body="", target="")
    assert not prepared.spaces.is_flat
    assert [each.fitness for each in outcomes] == [0.0, 0.0]
