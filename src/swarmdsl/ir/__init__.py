"""The intermediate representation: frozen data that every generator starts from.

Nodes are equal when they mean the same; `origin`, the place in the model, does not count.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swarmdsl.ir.architecture import (
        CommunicationSettings,
        Component,
        Connector,
        Contract,
        Direction,
        Environment,
        Heartbeat,
        Member,
        Multiplicity,
        Part,
        Port,
        PortGroup,
        PortRef,
        RobotValues,
        Role,
        Swarm,
    )
    from swarmdsl.ir.docs import (
        Docs,
        doc_of,
    )
    from swarmdsl.ir.expressions import (
        Binary,
        Call,
        Construction,
        Elapsed,
        EnvelopeField,
        EventData,
        Expression,
        FieldAccess,
        InState,
        ItemRef,
        Literal,
        ParamRef,
        Query,
        SelfField,
        Unary,
        VariableRef,
        mapped,
        reads,
        reads_values,
        subexpressions,
    )
    from swarmdsl.ir.integer_ranges import (
        bound_of,
        bound_of_any,
    )
    from swarmdsl.ir.interfaces import (
        Action,
        Communication,
        Constant,
        Delivery,
        Event,
        Field,
        Function,
        FunctionPort,
        Interface,
        Message,
        Param,
        Service,
    )
    from swarmdsl.ir.operations import (
        OPERATIONS,
    )
    from swarmdsl.ir.optimization import (
        Constraint,
        CountRange,
        Fitness,
        FitnessInput,
        Optimization,
        ParamRange,
    )
    from swarmdsl.ir.properties import (
        Chance,
        Claim,
        Count,
        Fact,
        Junction,
        Measure,
        Property,
        Robots,
        Scope,
    )
    from swarmdsl.ir.space import (
        Area,
        Box,
        Disc,
        ModelUse,
        Obstacle,
        Point,
        Rain,
        Shape,
        Sight,
        SpaceMeasure,
        Targets,
        Wall,
        Wind,
        Zone,
    )
    from swarmdsl.ir.statemachine import (
        Activity,
        Address,
        Assignment,
        Cancel,
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
    from swarmdsl.ir.system import (
        System,
    )
    from swarmdsl.syntax.types import (
        BOOL,
        DURATION,
        FLOAT,
        FLOATS,
        INT,
        INTEGERS,
        PRIMITIVES,
        STRING,
        Array,
        Named,
        Primitive,
        Type,
    )
else:
    from swarmdsl.base.lazy_exports import lazy_exports

    __getattr__ = lazy_exports(
        globals(),
        {
            "swarmdsl.ir.architecture": (
                "CommunicationSettings Component Connector Contract Direction Environment "
                "Heartbeat Member Multiplicity Part Port PortGroup PortRef RobotValues Role Swarm"
            ),
            "swarmdsl.ir.docs": "Docs doc_of",
            "swarmdsl.ir.expressions": (
                "Binary Call Construction Elapsed EnvelopeField EventData Expression FieldAccess "
                "InState ItemRef Literal ParamRef Query SelfField Unary VariableRef mapped reads "
                "reads_values subexpressions"
            ),
            "swarmdsl.ir.integer_ranges": "bound_of bound_of_any",
            "swarmdsl.ir.interfaces": (
                "Action Communication Constant Delivery Event Field Function FunctionPort "
                "Interface Message Param Service"
            ),
            "swarmdsl.ir.operations": "OPERATIONS",
            "swarmdsl.ir.optimization": (
                "Constraint CountRange Fitness FitnessInput Optimization ParamRange"
            ),
            "swarmdsl.ir.properties": (
                "Chance Claim Count Fact Junction Measure Property Robots Scope"
            ),
            "swarmdsl.ir.space": (
                "Area Box Disc ModelUse Obstacle Point Rain Shape Sight SpaceMeasure Targets Wall "
                "Wind Zone"
            ),
            "swarmdsl.ir.statemachine": (
                "Activity Address Assignment Cancel DoneTrigger Effect EventTrigger OutcomeTrigger "
                "Policy ResultMapping Send State StateKind StateMachine TimeTrigger Transition "
                "Trigger Variable"
            ),
            "swarmdsl.ir.system": "System",
            "swarmdsl.syntax.types": (
                "BOOL DURATION FLOAT FLOATS INT INTEGERS PRIMITIVES STRING Array Named "
                "Primitive Type"
            ),
        },
    )

__all__ = [
    "BOOL",
    "DURATION",
    "FLOAT",
    "FLOATS",
    "INT",
    "INTEGERS",
    "OPERATIONS",
    "PRIMITIVES",
    "STRING",
    "Action",
    "Activity",
    "Address",
    "Area",
    "Array",
    "Assignment",
    "Binary",
    "Box",
    "Call",
    "Cancel",
    "Chance",
    "Claim",
    "Communication",
    "CommunicationSettings",
    "Component",
    "Connector",
    "Constant",
    "Constraint",
    "Construction",
    "Contract",
    "Count",
    "CountRange",
    "Delivery",
    "Direction",
    "Disc",
    "Docs",
    "DoneTrigger",
    "Effect",
    "Elapsed",
    "EnvelopeField",
    "Environment",
    "Event",
    "EventData",
    "EventTrigger",
    "Expression",
    "Fact",
    "Field",
    "FieldAccess",
    "Fitness",
    "FitnessInput",
    "Function",
    "FunctionPort",
    "Heartbeat",
    "InState",
    "Interface",
    "ItemRef",
    "Junction",
    "Literal",
    "Measure",
    "Member",
    "Message",
    "ModelUse",
    "Multiplicity",
    "Named",
    "Obstacle",
    "Optimization",
    "OutcomeTrigger",
    "Param",
    "ParamRange",
    "ParamRef",
    "Part",
    "Point",
    "Policy",
    "Port",
    "PortGroup",
    "PortRef",
    "Primitive",
    "Property",
    "Query",
    "Rain",
    "ResultMapping",
    "RobotValues",
    "Robots",
    "Role",
    "Scope",
    "SelfField",
    "Send",
    "Service",
    "Shape",
    "Sight",
    "SpaceMeasure",
    "State",
    "StateKind",
    "StateMachine",
    "Swarm",
    "System",
    "Targets",
    "TimeTrigger",
    "Transition",
    "Trigger",
    "Type",
    "Unary",
    "Variable",
    "VariableRef",
    "Wall",
    "Wind",
    "Zone",
    "bound_of",
    "bound_of_any",
    "doc_of",
    "mapped",
    "reads",
    "reads_values",
    "subexpressions",
]
