"""The surroundings of a generated node: its servers, the events it hears and sends; its process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.ir import Event, Named, System

WAIT = 60.0
# Seconds that a node waits for servers, unless a test says otherwise: longer than a test waits.
PATIENT = dict.fromkeys(("missing_server", "dead_server", "cancel"), 2 * WAIT)


class Peers:
    """The process of the others, driven by lines of JSON."""

    def __init__(self, graph: Any, modules: Sequence[str | Path], namespace: str) -> None:
        self.graph = graph
        self.namespace = namespace
        self.told: list[tuple[str, str, Any]] = []
        self._times: list[tuple[str, str, float]] = []
        self._changed = threading.Condition()
        self.process = graph.start(
            [graph.python, str(graph.folder / "peers.py")],
            env=graph.environment(modules, ROS_NAMESPACE=namespace),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        threading.Thread(target=self._listen, daemon=True).start()
        self.wait_for("ready", "")

    def order(self, do: str, name: str, **more: Any) -> None:
        """Have something done."""
        assert self.process.stdin is not None
        self.process.stdin.write(json.dumps({"do": do, "name": name, **more}) + "\n")
        self.process.stdin.flush()

    def all(self, what: str) -> list[tuple[str, Any]]:
        """Return the reports of this kind, with their names."""
        with self._changed:
            return [(name, content) for told, name, content in self.told if told == what]

    def times(self, what: str, name: str) -> list[float]:
        """Return the times of the reports, in seconds of the peers' clock."""
        with self._changed:
            return [time for told, of, time in self._times if (told, of) == (what, name)]

    def count(self, what: str, name: str) -> int:
        """Return the number of such reports."""
        return sum(1 for each, _ in self.all(what) if each == name)

    def wait_for(self, what: str, name: str, number: int = 1) -> Any:
        """The content of this, told for the nth time."""

        def found() -> bool:
            return sum((w, n) == (what, name) for w, n, _ in self.told) >= number

        with self._changed:
            assert self._changed.wait_for(found, WAIT), f"no {what} {name}; told: {self.told}"
            return [c for w, n, c in self.told if (w, n) == (what, name)][number - 1]

    def _listen(self) -> None:
        for line in self.process.stdout or ():
            event = json.loads(line)
            with self._changed:
                self.told.append((event["what"], event["name"], event["content"]))
                self._times.append((event["what"], event["name"], event["time"]))
                self._changed.notify_all()


class World:
    """A node and all that its model names."""

    def __init__(
        self,
        graph: Any,
        system: System,
        package: Path,
        modules: Sequence[str | Path],
        name: str,
        made: list[World],
    ) -> None:
        self.graph = graph
        self.system = system
        self.package = package
        self.modules = modules
        self.namespace = f"/{name}"
        self._made = made
        self.peers = Peers(graph, modules, self.namespace)
        self._ended: dict[str, int] = {}
        self._listening: set[str] = set()
        self._nodes: list[Any] = []

    def beside(self) -> World:
        """Other servers for the same node, in a process of their own."""
        arguments = (self.graph, self.system, self.package, self.modules)
        other = World(*arguments, self.namespace[1:], self._made)
        self._made.append(other)
        return other

    def serve(self, *but: str, deaf: Sequence[str] = (), **answers: Sequence[str]) -> None:
        """Start the servers of all functions of the model, by their names there, `but` some."""
        for function in self.system.functions:
            if function.name in but:
                continue
            call = function.communication
            settings = {
                "type": str(call.type),
                "answers": list(answers.get(function.name, ())),
                "deaf": function.name in deaf,
            }
            self.peers.order(call.paradigm, call.name, **settings)
            self.peers.wait_for("serves", call.name)

    def node(self, module: str, **params: Any) -> Node:
        """Start the node of a machine."""
        for event in self.system.events:
            if isinstance(event.type, Named) and event.topic not in self._listening:
                self._listening.add(event.topic)
                self.peers.order("listen", event.topic, type=self._type(event))
        for name, seconds in PATIENT.items():
            params.setdefault(f"timeouts__{name}", seconds)
        for name, value in params.items():
            self.graph.set_param(f"{self.namespace}/{module}/{name.replace('__', '/')}", value)
        node = Node(self, module)
        self._nodes.append(node.process)
        return node

    def wait_for(self, function: str) -> Any:
        """The goal or request of the call that is to be ended next, when it has come."""
        name = self._server(function)
        return self.peers.wait_for("call", name, self._ended.get(name, 0) + 1)

    def end(self, function: str, outcome: str = "succeeded", **fields: Any) -> None:
        """End the call of a function, when it has come."""
        self.wait_for(function)
        name = self._server(function)
        self._ended[name] = self._ended.get(name, 0) + 1
        self.peers.order("end", name, outcome=outcome, fields=fields)
        self.peers.wait_for(outcome, name)

    def cancelled(self, function: str) -> None:
        """Wait until the call that is to be ended next is cancelled."""
        name = self._server(function)
        self.wait_for(function)
        self._ended[name] = self._ended.get(name, 0) + 1
        self.peers.wait_for("cancel", name)

    def publish(self, event: str, **fields: Any) -> None:
        """Let an event of the model happen."""
        declared = self.system.event(event)
        topic = declared.incoming_topic
        before = self.peers.count("published", topic)
        self.peers.order("publish", topic, type=self._type(declared), fields=fields)
        self.peers.wait_for("published", topic, before + 1)

    def sent(self, event: str, number: int = 1) -> Any:
        """The data of an event that the node has sent, the nth time."""
        return self.peers.wait_for("sent", self.system.event(event).topic, number)

    def hears(self, event: str) -> None:
        """Wait until what the node sends of an event arrives."""
        topic = self.system.event(event).topic
        self.peers.order("hear", topic)
        self.peers.wait_for("hears", topic)
        # The node knows of it a moment later.
        self.graph.wait_for_link(f"{self.namespace}/{topic}")

    def called(self) -> list[str]:
        """The servers of all calls so far."""
        return [name for name, _ in self.peers.all("call")]

    def stop(self) -> None:
        """End all processes at once: how a node ends when it is told to is another matter."""
        for process in (self.peers.process, *self._nodes):
            process.kill()
            self.graph.end(process)

    def _type(self, event: Event) -> str:
        """The type of the messages of an event, which may be its envelope."""
        return str(envelopes_of(self.system).get(event.name, event).type)

    def _server(self, function: str) -> str:
        return self.system.function(function).communication.name


class Node:
    """A running node."""

    def __init__(self, world: World, module: str) -> None:
        self.world = world
        self.output = f"{world.namespace[1:]}-{module}"
        self.active: list[str] = []
        self.seen: list[list[str]] = []
        self._settled = False
        self._changed = threading.Condition()
        reading, writing = os.pipe()
        graph = world.graph
        traced = str(graph.folder / "traced.py")
        script = str(world.package / "scripts" / module)
        self.process = graph.start(
            [graph.python, traced, str(writing), world.package.name, script],
            output=self.output,
            env=graph.environment(world.modules, ROS_NAMESPACE=world.namespace),
            pass_fds=[writing],
        )
        os.close(writing)
        threading.Thread(target=self._listen, args=(reading,), daemon=True).start()

    def printed(self) -> str:
        """Return the output of the node."""
        return str(self.world.graph.printed(self.output))

    def wait_in(self, *paths: str) -> None:
        """Wait until exactly these states are active, and those that wait do so."""
        with self._changed:
            assert self._changed.wait_for(
                lambda: self.active == sorted(paths) and self._settled, WAIT
            ), f"{list(paths)} expected, {self.active} active\n{self.printed()}"

    def wait_inside(self, path: str) -> None:
        """Wait until a state below this path is active."""
        with self._changed:
            assert self._changed.wait_for(
                lambda: any(each.startswith(path) for each in self.active), WAIT
            ), f"{path} expected, {self.active} active\n{self.printed()}"

    def signal(self, number: signal.Signals) -> int:
        """Send a signal; the exit code, when the node has ended."""
        self.process.send_signal(number)
        return self.ended()

    def ended(self, within: float = WAIT) -> int:
        """The exit code, when the node has ended."""
        try:
            return int(self.process.wait(within))
        except subprocess.TimeoutExpired:
            raise AssertionError(f"the node still runs, {self.active}\n{self.printed()}") from None

    def _listen(self, reading: int) -> None:
        with os.fdopen(reading) as told:
            for line in told:
                with self._changed:
                    self.active, self._settled = json.loads(line)
                    self.seen.append(self.active)
                    self._changed.notify_all()
