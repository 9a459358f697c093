"""Rules for breaking changes."""

from __future__ import annotations

RULES = {
    "INTERFACE_REMOVED": "a message, service or action was removed or renamed",
    "FIELD_ADDED": "a field was added to an interface, which ROS treats as another interface",
    "FIELD_REMOVED": "a field of an interface was removed or renamed",
    "FIELD_TYPE": "a field of an interface changed its type",
    "FIELD_ORDER": "the fields of an interface were reordered",
    "CONSTANT_REMOVED": "a constant or enum value was removed or renamed",
    "CONSTANT_VALUE": "a constant or enum value changed its value or type",
    "EVENT_REMOVED": "an event was removed or renamed",
    "EVENT_TYPE": "an event changed its message type",
    "EVENT_TOPIC": "an event changed its topic",
    "EVENT_REACH": "an event changed between the member and the whole swarm",
    "EVENT_DELIVERY": "receivers of an event can rely on less of its delivery than before",
    "EVENT_UNHANDLED": "a state machine no longer handles an event",
    "EVENT_UNSENT": "a state machine no longer sends an event",
    "FUNCTION_REMOVED": "a function was removed or renamed",
    "FUNCTION_TYPE": "a function changed its interface",
    "FUNCTION_SERVER": "the server of a function was renamed",
    "FUNCTION_PORT": "a topic of a function was removed or changed its type",
    "OPERATION_REMOVED": "an operation of a component was removed",
    "PARAM_REMOVED": "a param was removed or renamed",
    "PARAM_TYPE": "a param changed its type",
    "PARAM_REQUIRED": "a required param was added, or a param lost its default",
    "PORT_REMOVED": "a port was removed or renamed",
    "PORT_TYPE": "a port changed its type",
    "PORT_DIRECTION": "a port changed its direction",
    "PORT_TOPIC": "a port changed its topic",
    "ROLE_REMOVED": "a role of a swarm was removed or renamed",
    "ROLE_MEMBER": "a role of a swarm changed its member",
    "ROLE_NUMBER": "the multiplicity of a role was narrowed",
    "OUTCOME_LOST": "a final state of a state machine was removed or renamed",
    "DECLARATION_REMOVED": "a component, member, state machine or swarm was removed or renamed",
}
"""Description of each rule by its name."""
