"""Mapping of each construct of a model, for `swarmc targets ros2`.

Text between backticks occurs in the generated module or in launch files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

_EXACT, _EMULATED, _REJECTED = Support.EXACT, Support.EMULATED, Support.REJECTED

MAPPING = tuple(
    Mapped(*each)
    for each in (
        ("state with an action", _EXACT, "`State(` with an `Activity(`; client `Action(`"),
        ("state with a service", _EXACT, "`State(` with an `Activity(`; client `Service(`"),
        ("state without activity", _EXACT, "row of the table, a `State(`"),
        ("composite state, submachine", _EXACT, "row with `initial=`, before the states inside"),
        ("parallel state", _EXACT, "row of `Kind.PARALLEL`, before its regions"),
        ("final state", _EXACT, "row of `Kind.FINAL`"),
        ("transition on an outcome", _EXACT, "`Transition(` on `'do."),
        ("transition on an event", _EXACT, "`Transition(` on the event; subscription `Topic(`"),
        ("transition on a completion", _EXACT, "`Transition(` on `'done.state."),
        (
            "transition on a certain final state",
            _EXACT,
            "raised by the final state: `machine.raise_event(`",
        ),
        ("transition after a time", _EXACT, "timer on the node's clock: `machine.send_after(`"),
        ("transition without a trigger", _EXACT, "`Transition((),`"),
        ("choice", _EXACT, "row whose transitions have no trigger: `Transition((),`"),
        ("guard", _EXACT, "function of the module: `guard=`"),
        ("effect", _EXACT, "function of the module: `effect=`"),
        ("transition with several triggers", _EXACT, "a `Transition(` on `('Go', 'Stop')`"),
        ("transition out of states", _EXACT, "a `Transition(` with its target"),
        ("transition into a state", _EXACT, "a `Transition(` with its target"),
        ("initial state inside a state", _EXACT, "path of the state, in `Machine(`"),
        ("history", _EXACT, "row of `Kind.HISTORY`"),
        ("deep history", _EXACT, "row of `Kind.DEEP_HISTORY`"),
        ("internal transition", _EXACT, "`internal=True`"),
        ("transition without a target", _EXACT, "`Transition(` to `()`"),
        ("entry, exit", _EXACT, "functions of the module: `entry=`, `exit=`"),
        ("constant goal or request", _EXACT, "function of the module: `goal=`"),
        ("goal or request of values", _EXACT, "function of the module: `goal=`"),
        ("callback for a goal or request", _EXACT, "`by_user(callbacks.`, in `goal=`"),
        ("callback for a result or response", _EXACT, "`by_user(callbacks.`, in `finalize=`"),
        ("stored result or response", _EXACT, "function of the module: `finalize=`"),
        ("variable", _EXACT, "attribute of `class Data`"),
        ("test of a state", _EXACT, "`machine.active(`"),
        ("time in a state", _EXACT, "`machine.elapsed(`"),
        ("sender and time of an event", _EXACT, "header of the message, or `envelope.sender`"),
        ("address of a sent event", _EXACT, "in its envelope: `Envelope(to=`"),
        ("identity of the robot", _EXACT, "parameters: `self.self = parameters['self']`"),
        (
            "param",
            _EXACT,
            "parameter of the node, a `Parameter(`, and an attribute of `class Data`",
        ),
        ("param that is a message", _REJECTED, "not a type of ROS parameters (SW0903)"),
        ("sent event", _EXACT, "published reliably: `machine.emit(`, with `sent=True`"),
        ("deferred event", _EXACT, "kept by the engine: `deferred=`"),
        (
            "delayed sending, cancel",
            _EXACT,
            "timer of the engine in the time of the node: `machine.emit_after(`, `machine.cancel(`",
        ),
        ("events of members", _EXACT, "raised by heartbeats: `follows_members=True`"),
        ("number of present robots", _EXACT, "heard in time: `machine.world.present(`"),
        ("contract on an event", _EXACT, "property of the monitor: `Abort`, with option monitors"),
        ("contract `when dead`", _EXACT, "watchdog, which launch files start: `watchdog=`"),
        ("connector", _EXACT, "launch files rename topics for the nodes of parts: `remappings=`"),
        ("initial state of a machine that is final", _EXACT, "the node ends at once: `Kind.FINAL`"),
        ("name that Python cannot have", _REJECTED, "not a valid identifier (SW0905)"),
        ("swarm event", _EXACT, "topic in the namespace of the swarm: `swarm=True`"),
        ("event of a person", _EXACT, "a swarm event like others: `swarm=True`"),
        ("delivery of a swarm event", _EXACT, "quality of service: `delivery=Delivery(`"),
        ("monitored topic", _EXACT, "subscription, reliable if its publishers are: `heard=True`"),
        (
            "monitored feedback of an action",
            _EXACT,
            "subscription to a hidden topic: `.Impl.FeedbackMessage` on `/_action/feedback`",
        ),
    )
)
