"""Fields of the IR that a consumer leaves out, by the reason."""

from __future__ import annotations

_REASONS: dict[str, dict[str, str]] = {
    "dump": {
        "follows from the parts of the expression": (
            "Binary.type Call.type EnvelopeField.header EnvelopeField.type EventData.type "
            "Elapsed.type FieldAccess.type ParamRef.type "
            "ItemRef.type Query.type SelfField.type InState.type Unary.type VariableRef.type"
        ),
    },
    "printer": {
        "follows from the parts of the expression": (
            "Binary.type Call.type Elapsed.type EnvelopeField.header EnvelopeField.type "
            "EventData.type FieldAccess.type ParamRef.type ItemRef.type Query.type SelfField.type "
            "InState.type Unary.type"
        ),
    },
    "diff": {
        "follows from the parts of the expression": (
            "Binary.type Call.type Elapsed.type EnvelopeField.header EnvelopeField.type "
            "EventData.type FieldAccess.type ParamRef.type ItemRef.type Query.type SelfField.type "
            "InState.type Unary.type VariableRef.type"
        ),
        "a name that nothing declares reads as another name of the swarm": ("Optimization.swarm"),
        "the name of the file where there is no package": ("System.name"),
    },
    "diagram": {
        "comments are not drawn": (
            "Action.doc Communication.doc CommunicationSettings.doc "
            "CommunicationSettings.docs Component.doc Component.docs Connector.doc "
            "Constant.doc Constraint.doc Contract.doc CountRange.doc Environment.doc "
            "Environment.docs "
            "Event.doc Field.doc "
            "Fitness.doc Fitness.docs Function.doc FunctionPort.doc Heartbeat.doc "
            "Member.doc Member.docs "
            "Message.doc Optimization.doc Optimization.docs Param.doc ParamRange.doc Part.doc "
            "Part.docs Port.doc RobotValues.doc RobotValues.docs Role.doc Role.docs Service.doc "
            "State.docs StateMachine.doc "
            "StateMachine.docs Swarm.doc Swarm.docs System.doc"
        ),
        "comments in space are not drawn": (
            "Area.doc Obstacle.doc Rain.doc Sight.doc Sight.docs Targets.doc Wall.doc "
            "Wind.doc Zone.doc"
        ),
        "an event looks the same, whoever raises it": "Event.predefined",
        "interfaces are not drawn; types are drawn without package and bounds": (
            "Action.external Action.feedback Action.goal Action.result Action.type "
            "Constant.name Constant.type "
            "Constant.value Field.name Field.type Message.constants Message.external "
            "Message.fields Message.type "
            "Named.package Primitive.bound Service.external Service.request Service.response "
            "Service.type System.interfaces"
        ),
        "follows from the parts of the expression": (
            "Binary.type Call.type Elapsed.type EnvelopeField.header EnvelopeField.type "
            "EventData.type FieldAccess.type ParamRef.type ItemRef.type Query.type SelfField.type "
            "InState.type Unary.type"
        ),
        "calls are drawn by the name of their function": (
            "Communication.name Communication.paradigm Communication.type "
            "Function.communication Function.model Function.params Function.ports "
            "FunctionPort.direction FunctionPort.topic FunctionPort.type ModelUse.arguments "
            "ModelUse.doc ModelUse.name"
        ),
        "properties are not drawn": (
            "Chance.bound Chance.probability Count.comparison Count.number Count.role "
            "Count.state Fact.guard "
            "Property.chance Property.claims Property.doc Property.each "
            "Property.kind Property.name Property.scope Property.subject Property.times "
            "Property.within Robots.index Robots.number "
            "Scope.claims Scope.kind System.properties"
        ),
        "the measures of a fitness are of the swarm in the diagram": "Fitness.subject",
        "inputs are drawn without documentation": "FitnessInput.doc",
        "communication settings are not drawn": (
            "CommunicationSettings.technology CommunicationSettings.values Member.communication"
        ),
        "inheritance and operations are not drawn": (
            "Component.base Component.operations Member.base"
        ),
        "events and ports are drawn by name": (
            "Delivery.deadline Delivery.keep Delivery.latest Delivery.lifespan Delivery.reliable "
            "Event.delivery Event.operator Event.topic Event.type Port.topic"
        ),
        "diagrams have the names of what they show": ("System.name"),
    },
    "portable SCXML": {
        "the type of the event tells it": "Event.predefined",
        "follows from the parts of the expression": (
            "Binary.type Call.type Elapsed.type EnvelopeField.header EnvelopeField.type "
            "EventData.type ParamRef.type ItemRef.type Query.type SelfField.type InState.type "
            "Unary.type"
        ),
        "comments of calls are not written": ("Communication.doc"),
        "a document is about one state machine": (
            "CommunicationSettings.doc CommunicationSettings.docs "
            "CommunicationSettings.technology CommunicationSettings.values Component.base "
            "Component.behavior Component.doc Component.docs Component.kind Component.name "
            "Component.operations Component.params Component.ports Connector.doc "
            "Constraint.doc Constraint.property "
            "Contract.doc Contract.events Contract.function Contract.guard Contract.name "
            "Contract.states Contract.within Member.contracts "
            "Connector.source Connector.target CountRange.doc CountRange.lower "
            "CountRange.role CountRange.upper Environment.doc Environment.docs "
            "Environment.name Environment.size Environment.world Fitness.doc Fitness.docs "
            "Fitness.goal Fitness.inputs Fitness.name Fitness.params Fitness.subject "
            "Fitness.value FitnessInput.doc FitnessInput.measure FitnessInput.name "
            "FitnessInput.type Measure.aggregate Measure.claim Measure.each Measure.kind "
            "Measure.over "
            "Member.base Member.behavior Member.communication Member.connectors Member.doc "
            "Member.docs Member.name Member.params Member.parts Member.ports "
            "Optimization.constraints "
            "Multiplicity.lower Multiplicity.upper Optimization.counts Optimization.doc "
            "Optimization.docs Optimization.params Optimization.settings Optimization.swarm "
            "ParamRange.doc ParamRange.lower ParamRange.param ParamRange.role ParamRange.step "
            "ParamRange.upper Part.component Part.doc Part.docs Part.name Part.operations "
            "Part.values Port.direction Port.doc Port.name Port.topic Port.type PortRef.part "
            "PortRef.port RobotValues.doc RobotValues.docs RobotValues.index RobotValues.values "
            "Role.doc Role.docs Role.member Role.multiplicity Role.name Role.robots Role.values "
            "Heartbeat.doc Heartbeat.period Heartbeat.timeout Swarm.doc Swarm.heartbeat "
            "Swarm.docs Swarm.environment Swarm.fitness Swarm.name Swarm.roles "
            "System.components System.doc System.environments System.fitness System.members "
            "System.optimizations System.swarms"
        ),
        "SCXML has no space": (
            "FitnessInput.space SpaceMeasure.of SpaceMeasure.quantity "
            "Area.box Area.doc Area.name Box.high Box.highest Box.low Box.lowest "
            "Component.sights Disc.centre Disc.height Disc.radius Environment.areas "
            "Environment.obstacles Environment.rains Environment.targets Environment.walls "
            "Environment.winds Environment.zones Function.model Member.battery Member.body "
            "Member.radio ModelUse.arguments ModelUse.doc ModelUse.name Obstacle.doc "
            "Obstacle.name Obstacle.shape Point.x Point.y Rain.doc Rain.end Rain.start "
            "RobotValues.start Role.start Sight.doc Sight.docs Sight.kind Sight.values "
            "Targets.area Targets.count Targets.doc Targets.kind Targets.places Wall.doc "
            "Wall.height Wall.points Wind.angle Wind.doc Wind.end Wind.speed Wind.start "
            "Zone.box Zone.doc Zone.name"
        ),
        "SCXML has no properties": (
            "Chance.bound Chance.probability Count.comparison Count.number Count.role "
            "Count.state Fact.act Fact.guard Fact.name Fact.outcome Fact.robots Junction.claims "
            "Junction.operator Property.chance Property.claims Property.doc Property.each "
            "Property.kind Property.name Property.scope Property.subject Property.times "
            "Property.within Robots.index Robots.number Robots.other Robots.quantifier "
            "Robots.role Scope.claims Scope.kind System.properties"
        ),
        "functions are called by the name of their server": (
            "Function.params Function.ports FunctionPort.direction FunctionPort.doc "
            "FunctionPort.topic FunctionPort.type"
        ),
    },
    "document": {},
}

LEFT_OUT = {
    consumer: {name for names in reasons.values() for name in names.split()}
    for consumer, reasons in _REASONS.items()
}

NOT_LOWERED = {
    "AliasType.doc": "an alias is replaced by its type",
    "AliasType.name": "an alias is replaced by its type",
    "AliasType.type": "types are lowered from the resolved references",
    "Branch.otherwise": "a branch without a guard",
    "Elapsed.function": "there is only one",
    "Elapsed.state": "the resolved state is lowered",
    "EnumType.underlying": "the resolved type is lowered",
    "ImportFile.doc": "imports are resolved by the loader",
    "ImportFile.path": "imports are resolved by the loader",
    "ImportLibrary.doc": "imports are resolved by the loader",
    "ImportLibrary.name": "imports are resolved by the loader",
    "ImportRos.doc": "imports are resolved by the loader",
    "ImportRos.path": "imports are resolved by the loader",
    "Model.imports": "imports are resolved by the loader",
    "Fitness.subject": "the resolved subject is lowered",
    "Measure.about": "it is that of the fitness",
    "Property.subject": "the resolved subject is lowered",
    "TypeRef.array": "the resolved type is lowered",
    "TypeRef.bound": "the resolved type is lowered",
    "TypeRef.name": "the resolved type is lowered",
    "TypeRef.unit": "the resolved type is lowered",
}
"""Fields of the syntax tree that are not read by lowering, with the reason."""

_ALONE_INVALID = (
    "Action.goal Address.id Area.box Area.name Array.element Assignment.path Box.high Box.low "
    "Cancel.event Chance.bound Chance.probability Communication.type Component.base "
    "Component.behavior Component.name Component.operations Connector.source Connector.target "
    "Constant.type Constraint.property Construction.type Contract.events Contract.function "
    "Count.comparison Count.role Count.state CountRange.role Disc.centre EnvelopeField.field "
    "Environment.areas Environment.name Event.type Field.type FieldAccess.base Fitness.goal "
    "Fitness.name Fitness.subject Fitness.value FitnessInput.type Function.communication "
    "Function.name FunctionPort.type ItemRef.name Measure.aggregate Measure.claim "
    "Measure.each Measure.over Member.base Member.ports Obstacle.shape Optimization.swarm "
    "OutcomeTrigger.state Param.type ParamRange.param ParamRange.role Part.operations "
    "Port.type PortRef.part PortRef.port Property.each Property.subject Query.array "
    "Query.item Query.key ResultMapping.field ResultMapping.path ResultMapping.variable "
    "Robots.number Role.multiplicity Role.start Sight.kind SpaceMeasure.of "
    "SpaceMeasure.quantity State.activity State.id State.initial StateMachine.states "
    "StateMachine.variables Swarm.environment Swarm.fitness System.components "
    "System.environments System.events System.fitness System.functions Targets.area "
    "Targets.kind Targets.places Unary.operand Unary.operator Variable.name Variable.type "
    "Zone.box"
)
NEVER_ALONE = set(_ALONE_INVALID.split())
"""Fields whose change makes a model invalid unless something else changes too."""
