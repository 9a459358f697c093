"""Mapping of each construct of a model to a library, for `swarmc targets`.

Text between backticks occurs in the generated module of the library, or in the chart, which is the
table of the machine that the engine runs.
"""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import Mapped, Support

_EXACT, _EMULATED, _REJECTED = Support.EXACT, Support.EMULATED, Support.REJECTED


def mapping(start: str, memory: str, *, own: Iterable[Mapped]) -> tuple[Mapped, ...]:
    """Return the mapping of a library, with its `own` further rows.

    `start` is the call that sets the initial state of a machine, `memory` the store of variables.
    """
    rows = (
        ("state with an action", _EXACT, "an `ActionState`"),
        ("state with a service", _EXACT, "a `ServiceState`"),
        ("state without activity", _EXACT, "a `State`"),
        ("composite state, submachine", _EXACT, "a `StateMachine`"),
        ("parallel state", _EXACT, "a `Concurrence` with a `StateMachine` for each region"),
        ("final state", _EXACT, "outcome of the machine; inside, a `State` that waits"),
        ("transition on an outcome", _EXACT, "outcome of the state, `'succeeded'`"),
        ("transition on an event", _EMULATED, "outcome; the chart receives the event, `Topic(`"),
        ("transition on a completion", _EMULATED, "outcome `'done'`; the chart has `'done.state.`"),
        ("transition on a certain final state", _EMULATED, "outcome; the chart has `'final.`"),
        ("transition after a time", _EMULATED, "outcome `'timeout'`; the chart has `send_after(`"),
        ("transition without a trigger", _EMULATED, "outcome; the chart takes it at once"),
        ("choice", _EMULATED, "a `State` that the chart leaves at once"),
        ("guard", _EMULATED, "function of the chart, `guard=`"),
        ("effect", _EMULATED, "function of the chart, `effect=`"),
        ("transition with several triggers", _EMULATED, "an outcome for each, `'Go'`, `'Stop'`"),
        (
            "transition out of states",
            _EMULATED,
            "outcome of all states inside, passed on: `'Stop': 'Stop'`",
        ),
        ("transition into a state", _EMULATED, "a `Junction` in which the machine begins"),
        ("initial state inside a state", _EXACT, f"`{start}`"),
        ("history", _EMULATED, "kept by the chart; a `Junction` leads to the last state"),
        ("deep history", _EMULATED, "the same in all machines inside: `Kind.DEEP_HISTORY`"),
        ("internal transition", _EMULATED, "outcome of the states inside"),
        ("transition without a target", _EMULATED, "no outcome: `None`"),
        ("entry, exit", _EMULATED, "functions of the chart: `entry=`, `exit=`"),
        ("goal or request", _EXACT, "function of the chart, `goal=`"),
        ("callback", _EXACT, "`callbacks.`, called by the chart"),
        ("stored result or response", _EXACT, "function of the chart, `finalize=`"),
        ("variable", _EXACT, f"key of the {memory}, `self.n`"),
        ("test of a state", _EXACT, "in the chart: `machine.active(`"),
        ("time in a state", _EXACT, "in the chart: `machine.elapsed(`"),
        ("sender and time of an event", _EXACT, "in the chart: header, or `envelope.sender`"),
        ("address of a sent event", _EXACT, "in the chart: `Envelope(to=`"),
        ("identity of the robot", _EXACT, f"key of the {memory}: `self.self = parameters['self']`"),
        ("param", _EXACT, f"ROS parameter, `Parameter(`, and key of the {memory}"),
        ("sent event", _EXACT, "published by the chart: `machine.emit(`"),
        ("deferred event", _EMULATED, "kept by the chart: `deferred=`"),
        (
            "delayed sending, cancel",
            _EMULATED,
            "timer of the chart: `machine.emit_after(`, `machine.cancel(`",
        ),
        ("swarm event", _EXACT, "topic in the namespace of the swarm: `swarm=True`"),
        ("event of a person", _EXACT, "a swarm event like others: `swarm=True`"),
        ("delivery of a swarm event", _EXACT, "quality of service: `delivery=Delivery(`"),
        (
            "monitored topic",
            _EXACT,
            "subscribed by the chart, reliable if its publishers are: `heard=True`",
        ),
        (
            "monitored feedback of an action",
            _EXACT,
            "subscribed on a hidden topic: `.Impl.FeedbackMessage` on `/_action/feedback`",
        ),
        ("events of members", _EXACT, "raised by heartbeats: `follows_members=True`"),
        ("number of present robots", _EXACT, "heard in time: `machine.world.present(`"),
        ("contract on an event", _EXACT, "property of the monitor: `Abort`, with option monitors"),
        ("contract `when dead`", _EXACT, "watchdog, which launch files start: `watchdog=`"),
        ("connector", _EXACT, "launch files rename topics for the nodes of parts: `remappings=`"),
        (
            "initial state of a machine that is final",
            _REJECTED,
            "the node would end at once (SW0903)",
        ),
        (
            "transition from deep inside to a deep history around",
            _REJECTED,
            "the states that it leaves are not known in advance (SW0903)",
        ),
        ("param that is a message", _REJECTED, "not a type of ROS parameters (SW0903)"),
        ("name that Python cannot have", _REJECTED, "not a valid identifier (SW0905)"),
    )
    return (*(Mapped(*row) for row in rows), *own)
