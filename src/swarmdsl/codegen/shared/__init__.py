"""Views of the IR that several generators need."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swarmdsl.codegen.shared.constants import (
        UndefinedValueError,
        UnknownValueError,
        Value,
        constant,
        evaluate,
        params_by_name,
    )
    from swarmdsl.codegen.shared.default_values import (
        default_fields,
        default_result,
        default_value,
        field_type,
        result_fields,
        sent_types,
    )
    from swarmdsl.codegen.shared.envelopes import (
        envelopes_of,
        python_address,
        reads_envelope,
    )
    from swarmdsl.codegen.shared.events import (
        Events,
        delays,
    )
    from swarmdsl.codegen.shared.identity import (
        follows_members,
        member_uses,
        uses_self,
    )
    from swarmdsl.codegen.shared.missing_values import (
        missing_values,
    )
    from swarmdsl.codegen.shared.model_digest import (
        model_digest,
    )
    from swarmdsl.codegen.shared.nodes import (
        BehaviorNode,
        ParamValue,
        behavior_nodes,
        bringup_package,
        has_node,
        member_functions,
    )
    from swarmdsl.codegen.shared.parallel_transitions import (
        entered_region,
        region_transitions,
    )
    from swarmdsl.codegen.shared.part_values import (
        check_part_values,
    )
    from swarmdsl.codegen.shared.property_texts import (
        condition_text,
        facts_of,
        measure_text,
        parts_text,
        sentence_text,
    )
    from swarmdsl.codegen.shared.state_expressions import (
        expressions_of,
        timed_states,
    )
    from swarmdsl.codegen.shared.swarmros import (
        bridge_files,
    )
    from swarmdsl.codegen.shared.units import (
        doc_with_unit,
    )
    from swarmdsl.codegen.shared.watchdogs import (
        check_watchdogs,
    )
    from swarmdsl.codegen.shared.wiring import (
        Remaps,
        Wiring,
        check_wiring,
        member_wiring,
    )
else:
    from swarmdsl.base.lazy_exports import lazy_exports

    __getattr__ = lazy_exports(
        globals(),
        {
            "swarmdsl.codegen.shared.constants": (
                "UndefinedValueError UnknownValueError Value constant evaluate params_by_name"
            ),
            "swarmdsl.codegen.shared.default_values": (
                "default_fields default_result default_value field_type result_fields sent_types"
            ),
            "swarmdsl.codegen.shared.envelopes": "envelopes_of python_address reads_envelope",
            "swarmdsl.codegen.shared.events": "Events delays",
            "swarmdsl.codegen.shared.identity": "follows_members member_uses uses_self",
            "swarmdsl.codegen.shared.missing_values": "missing_values",
            "swarmdsl.codegen.shared.model_digest": "model_digest",
            "swarmdsl.codegen.shared.nodes": (
                "BehaviorNode ParamValue behavior_nodes bringup_package member_functions has_node"
            ),
            "swarmdsl.codegen.shared.parallel_transitions": "entered_region region_transitions",
            "swarmdsl.codegen.shared.part_values": "check_part_values",
            "swarmdsl.codegen.shared.property_texts": (
                "condition_text facts_of measure_text parts_text sentence_text"
            ),
            "swarmdsl.codegen.shared.state_expressions": "expressions_of timed_states",
            "swarmdsl.codegen.shared.swarmros": "bridge_files",
            "swarmdsl.codegen.shared.units": "doc_with_unit",
            "swarmdsl.codegen.shared.watchdogs": "check_watchdogs",
            "swarmdsl.codegen.shared.wiring": "Remaps Wiring check_wiring member_wiring",
        },
    )

__all__ = [
    "BehaviorNode",
    "Events",
    "ParamValue",
    "Remaps",
    "UndefinedValueError",
    "UnknownValueError",
    "Value",
    "Wiring",
    "behavior_nodes",
    "bridge_files",
    "bringup_package",
    "check_part_values",
    "check_watchdogs",
    "check_wiring",
    "condition_text",
    "constant",
    "default_fields",
    "default_result",
    "default_value",
    "delays",
    "doc_with_unit",
    "entered_region",
    "envelopes_of",
    "evaluate",
    "expressions_of",
    "facts_of",
    "field_type",
    "follows_members",
    "has_node",
    "measure_text",
    "member_functions",
    "member_uses",
    "member_wiring",
    "missing_values",
    "model_digest",
    "params_by_name",
    "parts_text",
    "python_address",
    "reads_envelope",
    "region_transitions",
    "result_fields",
    "sent_types",
    "sentence_text",
    "timed_states",
    "uses_self",
]
