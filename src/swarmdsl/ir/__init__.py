"""The intermediate representation: frozen data that every generator starts from.

Nodes are equal when they mean the same; `origin`, the place in the model, does not count.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swarmdsl.ir.architecture import (
        CommunicationSettings,
        Component,
        Connector,
        Direction,
        Environment,
        Member,
        Multiplicity,
        Part,
        Port,
        PortRef,
        Role,
        Swarm,
    )
    from swarmdsl.ir.docs import Docs, doc_of
    from swarmdsl.ir.expressions import (
        Binary,
        Call,
        EventData,
        Expression,
        FieldAccess,
        Literal,
        ParamRef,
        Unary,
        VariableRef,
        reads,
    )
    from swarmdsl.ir.interfaces import (
        Action,
        Communication,
        Constant,
        Event,
        Field,
        Function,
        FunctionPort,
        Interface,
        Message,
        Param,
        Service,
    )
    from swarmdsl.ir.optimization import CountRange, Fitness, Optimization, ParamRange
    from swarmdsl.ir.statemachine import (
        Activity,
        Assignment,
        DoneTrigger,
        Effect,
        EventTrigger,
        OutcomeTrigger,
        Policy,
        ResultMapping,
        Send,
        State,
        StateKind,
        StateMachine,
        TimeTrigger,
        Transition,
        Trigger,
        Variable,
    )
    from swarmdsl.ir.system import System
    from swarmdsl.syntax.types import Array, Named, Primitive, Type
else:
    # Others have a `Literal` too, that of typing; the one of `expressions`, the last, is meant.
    _PARTS = (
        "swarmdsl.syntax.types",
        *(
            f"{__name__}.{part}"
            for part in (
                *("docs", "interfaces", "architecture", "statemachine", "optimization"),
                *("system", "expressions"),
            )
        ),
    )

    def __getattr__(name):
        """Import the parts with the first name that is asked for: a check needs only types."""
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        for part in _PARTS:
            names = vars(import_module(part))
            globals().update((known, names[known]) for known in names.keys() & set(__all__))
        return globals()[name]


__all__ = [
    "Action",
    "Activity",
    "Array",
    "Assignment",
    "Binary",
    "Call",
    "Communication",
    "CommunicationSettings",
    "Component",
    "Connector",
    "Constant",
    "CountRange",
    "Direction",
    "Docs",
    "DoneTrigger",
    "Effect",
    "Environment",
    "Event",
    "EventData",
    "EventTrigger",
    "Expression",
    "Field",
    "FieldAccess",
    "Fitness",
    "Function",
    "FunctionPort",
    "Interface",
    "Literal",
    "Member",
    "Message",
    "Multiplicity",
    "Named",
    "Optimization",
    "OutcomeTrigger",
    "Param",
    "ParamRange",
    "ParamRef",
    "Part",
    "Policy",
    "Port",
    "PortRef",
    "Primitive",
    "ResultMapping",
    "Role",
    "Send",
    "Service",
    "State",
    "StateKind",
    "StateMachine",
    "Swarm",
    "System",
    "TimeTrigger",
    "Transition",
    "Trigger",
    "Type",
    "Unary",
    "Variable",
    "VariableRef",
    "doc_of",
    "reads",
]
