"""Mapping of each construct of a model, for `swarmc targets smach`.

Text between backticks occurs in the generated module or in launch files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

_EXACT, _EMULATED, _REJECTED = Support.EXACT, Support.EMULATED, Support.REJECTED

MAPPING = tuple(
    Mapped(*each)
    for each in (
        ("state with an action", _EXACT, "state of SMACH, an `ActionState`"),
        ("state with a service", _EXACT, "state of SMACH, a `ServiceState`"),
        ("state without activity", _EXACT, "state of SMACH, a `State`"),
        ("composite state, submachine", _EXACT, "container `StateMachine`"),
        (
            "parallel state",
            _EXACT,
            "container `Concurrence`, with a `StateMachine` for each region",
        ),
        ("final state", _EXACT, "state `Final`; of the machine itself, an outcome of `Machine`"),
        ("transition on an outcome", _EXACT, "outcome, in `transitions=`"),
        (
            "transition on an event",
            _EMULATED,
            "outcome; the chart receives the event, `On(events.`",
        ),
        ("transition on a completion", _EMULATED, "outcome; the chart raises `'done.state.`"),
        ("transition on a certain final state", _EMULATED, "outcome; the chart raises `'final.`"),
        (
            "transition after a time",
            _EMULATED,
            "outcome; the chart has a timer for each in `after=`",
        ),
        ("transition without a trigger", _EMULATED, "outcome; the chart tests it `AT_ONCE`"),
        ("choice", _EMULATED, "a `State` that the chart leaves `AT_ONCE`"),
        ("guard", _EMULATED, "function of userdata, evaluated by the chart: `guard=`"),
        ("effect", _EMULATED, "function of userdata, run by the chart: `effect=`"),
        ("transition with several triggers", _EMULATED, "an `On(` and an outcome for each"),
        ("transition out of states", _EMULATED, "chain of outcomes of the containers: `'to_`"),
        ("transition into a state", _EMULATED, "initial states set by the chart: `into=`"),
        ("initial state inside a state", _EMULATED, "set by the chart: `initial=`"),
        ("history", _EMULATED, "kept by the chart; a state `History` leads to the last state"),
        ("deep history", _EMULATED, "the same, and initial states inside: `deep=True`"),
        ("internal transition", _EMULATED, "outcome of the states inside: `internal=True`"),
        ("transition without a target", _EMULATED, "no outcome: `None`"),
        ("entry, exit", _EMULATED, "functions of userdata: `on_entry=`, `on_exit=`"),
        ("constant goal or request", _EXACT, "`goal=`"),
        ("goal or request of values", _EXACT, "callback `goal_cb=`"),
        ("callback for a goal or request", _EXACT, "`goal_cb=callbacks.`"),
        ("callback for a result or response", _EXACT, "`result_cb=callbacks.`"),
        ("stored result or response", _EXACT, "function of userdata: `store=`"),
        ("variable", _EXACT, "`userdata.`, one for the whole machine"),
        ("test of a state", _EXACT, "`is_active(`"),
        ("time in a state", _EXACT, "`elapsed(`"),
        ("sender and time of an event", _EXACT, "header of the message, or `envelope.sender`"),
        ("address of a sent event", _EXACT, "in its envelope: second argument of `.send(`"),
        ("identity of the robot", _EXACT, "parameters: `userdata.self = identity()`"),
        ("param", _EXACT, "ROS parameter, checked at the start: `param(`, and userdata"),
        ("param that is a message", _EMULATED, "dictionary, converted by `message(`"),
        ("sent event", _EXACT, "published: `.send(`"),
        ("latest, keep of an event", _EXACT, "`latch=True`, `queue_size=` of its publisher"),
        ("lifespan, deadline of an event", _REJECTED, "ROS 1 has neither (SW0903)"),
        ("deferred event", _EMULATED, "kept by the chart: `defer=`"),
        (
            "delayed sending, cancel",
            _EMULATED,
            "timer of the chart: `.send_after(`, `.cancel()`",
        ),
        ("events of members", _REJECTED, "nodes of ROS 1 send no heartbeats (SW0903)"),
        ("number of present robots", _REJECTED, "nodes of ROS 1 send no heartbeats (SW0903)"),
        ("contract on an event", _REJECTED, "checked, but no node of ROS 1 watches it"),
        ("contract `when dead`", _REJECTED, "nodes of ROS 1 have no watchdogs (SW0916)"),
        ("connector", _EXACT, "launch files rename topics for the nodes of parts: `<remap from=`"),
        (
            "initial state of a machine that is final",
            _REJECTED,
            "the node would end at once (SW0903)",
        ),
        ("name that Python cannot have", _REJECTED, "not a valid identifier (SW0905)"),
    )
)
