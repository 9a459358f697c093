"""SDK for authors of generators, and the way from the IR to files.

A generator imports this package, its modules below, and `swarmdsl.ir`; nothing else is public.

    swarmdsl.codegen          Generator, OutputFile, option, Feature, Diagnostics, Templates, ...
    swarmdsl.codegen.python   Python source: calls, docstrings, comments with their origin
    swarmdsl.codegen.cpp      C++ source: expressions and literals
    swarmdsl.codegen.ros      ROS packages: manifest, interface files, names, parameters
    swarmdsl.codegen.shared   views of the IR: nodes, wiring, events, constants, default values
    swarmdsl.codegen.xml      small XML files; `swarmdsl.codegen.xml_tree`: lxml trees

Names are imported on first use, so that registering a generator stays cheap.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import (
        Diagnostics,
        Label,
        listed,
    )
    from swarmdsl.base.markdown import (
        cell,
        code_cell,
    )
    from swarmdsl.base.naming import (
        FreshNames,
        camel_case,
        fresh,
        incoming_topic,
        is_python_name,
        is_ros_package_name,
        snake_case,
    )
    from swarmdsl.base.records import (
        dataclass,
        field,
        fields_of,
        replace,
    )
    from swarmdsl.base.relative_paths import (
        stays_inside,
    )
    from swarmdsl.base.source import (
        Span,
    )
    from swarmdsl.base.suggest import (
        suggest,
    )
    from swarmdsl.codegen.api import (
        ALL_FEATURES,
        API_VERSION,
        Emit,
        Feature,
        Generator,
        Mapped,
        NoOptions,
        OutputFile,
        Support,
        all_machines,
        chosen_machines,
        emit_of,
        option,
    )
    from swarmdsl.codegen.diagram.readme import (
        Picture,
        member_pictures,
        pictures,
    )
    from swarmdsl.codegen.engine import (
        engine_folder,
        monitors_folder,
    )
    from swarmdsl.codegen.source_map import (
        MappedText,
        TracedStr,
        at,
    )
    from swarmdsl.codegen.templates import (
        Templates,
    )
    from swarmdsl.codegen.user_code_marks import (
        fits,
    )
    from swarmdsl.ir.expression_printer import (
        PYTHON_ARRAY_FUNCTIONS,
        PYTHON_DIVISION,
        PYTHON_FUNCTIONS,
        Dialect,
        ecmascript_literal,
        python_item,
        python_literal,
        python_query,
        translate,
        uses_math,
    )
else:
    from swarmdsl.base.lazy_exports import lazy_exports

    __getattr__ = lazy_exports(
        globals(),
        {
            "swarmdsl.base.diagnostics.collector": "Diagnostics Label listed",
            "swarmdsl.base.markdown": "cell code_cell",
            "swarmdsl.base.naming": (
                "FreshNames camel_case fresh incoming_topic is_python_name is_ros_package_name "
                "snake_case"
            ),
            "swarmdsl.base.records": "dataclass field fields_of replace",
            "swarmdsl.base.relative_paths": "stays_inside",
            "swarmdsl.base.source": "Span",
            "swarmdsl.base.suggest": "suggest",
            "swarmdsl.codegen.api": (
                "ALL_FEATURES API_VERSION Emit Feature Generator Mapped NoOptions "
                "OutputFile Support all_machines chosen_machines emit_of option"
            ),
            "swarmdsl.codegen.diagram.readme": "Picture member_pictures pictures",
            "swarmdsl.codegen.engine": "engine_folder monitors_folder",
            "swarmdsl.codegen.source_map": "MappedText TracedStr at",
            "swarmdsl.codegen.templates": "Templates",
            "swarmdsl.codegen.user_code_marks": "fits",
            "swarmdsl.ir.expression_printer": (
                "PYTHON_ARRAY_FUNCTIONS PYTHON_DIVISION PYTHON_FUNCTIONS Dialect "
                "ecmascript_literal python_item python_literal python_query translate uses_math"
            ),
        },
    )

__all__ = [
    "ALL_FEATURES",
    "API_VERSION",
    "PYTHON_ARRAY_FUNCTIONS",
    "PYTHON_DIVISION",
    "PYTHON_FUNCTIONS",
    "Diagnostics",
    "Dialect",
    "Emit",
    "Feature",
    "FreshNames",
    "Generator",
    "Label",
    "Mapped",
    "MappedText",
    "NoOptions",
    "OutputFile",
    "Picture",
    "Span",
    "Support",
    "Templates",
    "TracedStr",
    "all_machines",
    "at",
    "camel_case",
    "cell",
    "chosen_machines",
    "code_cell",
    "dataclass",
    "ecmascript_literal",
    "emit_of",
    "engine_folder",
    "field",
    "fields_of",
    "fits",
    "fresh",
    "incoming_topic",
    "is_python_name",
    "is_ros_package_name",
    "listed",
    "member_pictures",
    "monitors_folder",
    "option",
    "pictures",
    "python_item",
    "python_literal",
    "python_query",
    "replace",
    "snake_case",
    "stays_inside",
    "suggest",
    "translate",
    "uses_math",
]
