"""The rules that find what breaks, by their names."""

from __future__ import annotations

RULES = {
    "INTERFACE_REMOVED": "a message, service or action is gone, or is called otherwise",
    "FIELD_ADDED": "an interface has a new field: ROS takes it for another interface",
    "FIELD_REMOVED": "a field of an interface is gone, or is called otherwise",
    "FIELD_TYPE": "a field of an interface has another type",
    "FIELD_ORDER": "the fields of an interface are in another order",
    "CONSTANT_REMOVED": "a constant or value of an enum is gone, or is called otherwise",
    "CONSTANT_VALUE": "a constant or value of an enum has another value or type",
    "EVENT_REMOVED": "an event is gone, or is called otherwise",
    "EVENT_TYPE": "an event has another message",
    "EVENT_TOPIC": "an event is on another topic",
    "EVENT_REACH": "an event is for the whole swarm now, or not any more",
    "EVENT_UNHANDLED": "a state machine handles an event no more",
    "EVENT_UNSENT": "a state machine sends an event no more",
    "FUNCTION_REMOVED": "a function is gone, or is called otherwise",
    "FUNCTION_TYPE": "a function is called through another interface",
    "FUNCTION_SERVER": "the server of a function has another name",
    "FUNCTION_PORT": "a topic of a function is gone, or has another type",
    "OPERATION_REMOVED": "an operation of a component is gone",
    "PARAM_REMOVED": "a param is gone, or is called otherwise",
    "PARAM_TYPE": "a param has another type",
    "PARAM_REQUIRED": "a param must be given: it is new, or had a default",
    "PORT_REMOVED": "a port is gone, or is called otherwise",
    "PORT_TYPE": "a port has another type",
    "PORT_DIRECTION": "a port has another direction",
    "PORT_TOPIC": "a port is on another topic",
    "ROLE_REMOVED": "a role of a swarm is gone, or is called otherwise",
    "ROLE_MEMBER": "a role of a swarm is played by another member",
    "ROLE_NUMBER": "a role of a swarm allows fewer numbers of members",
    "OUTCOME_LOST": "a state machine no longer ends in a final state",
    "DECLARATION_REMOVED": "a component, member, state machine or swarm is gone, or is called "
    "otherwise",
}
"""The rules by their names, each with what it finds."""
