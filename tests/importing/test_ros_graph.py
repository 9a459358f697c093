"""Models of the graph of a running ROS 2: names that the language reserves or does not have."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.importing.ros_graph import Graph, import_graph
from swarmdsl.ir import Named

EMPTY, TEXT = Named("std_srvs", "Empty"), Named("std_msgs", "String")


def test_names_of_servers_and_topics_become_names_of_the_language(tmp_path: Path) -> None:
    servers = ("/do", "/state", "/cmd/land", "/cmd_land")
    topics = ("/on", "/a/b", "/a_b")
    graph = Graph(
        services=tuple((name, EMPTY) for name in servers),
        topics=tuple((name, TEXT) for name in topics),
    )
    report = Diagnostics()
    system, count = import_graph(graph, "/", "robot", report)
    assert count == len(servers) + len(topics)
    model = tmp_path / "model.swarm"
    model.write_text(print_system(system), encoding="utf-8")

    checked = pipeline.check([model])
    assert [each.message for each in checked.report if each.code != "SW0521"] == []
    assert checked.system is not None
    called = {each.communication.name for each in checked.system.functions}
    assert called == {name.removeprefix("/") for name in servers}
    assert {each.topic for each in checked.system.events} == {"on", "a/b", "a_b"}
