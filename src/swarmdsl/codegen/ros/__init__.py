"""ROS packages: manifest, interface files, names and parameters."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swarmdsl.codegen.ros.interface_files import (
        Generation,
        depends,
        interface_parts,
        interface_path,
        invalid_names,
        named_types,
    )
    from swarmdsl.codegen.ros.interface_packages import (
        InterfacePackage,
        check_described,
        check_order,
        definition_files,
        group_by_package,
        interfaces_to_write,
        is_fully_described,
        third_party_packages,
    )
    from swarmdsl.codegen.ros.package import (
        PackageOptions,
        copyright_fault,
        manifest,
        packages_fault,
    )
    from swarmdsl.codegen.ros.package_names import (
        PackageNames,
    )
    from swarmdsl.codegen.ros.parameters import (
        parameter_value,
        with_parameters,
    )
    from swarmdsl.codegen.ros.yaml_values import yaml_key, yaml_value
else:
    from swarmdsl.base.lazy_exports import lazy_exports

    __getattr__ = lazy_exports(
        globals(),
        {
            "swarmdsl.codegen.ros.interface_files": (
                "Generation depends interface_parts interface_path invalid_names named_types"
            ),
            "swarmdsl.codegen.ros.interface_packages": (
                "InterfacePackage check_described check_order definition_files "
                "group_by_package interfaces_to_write is_fully_described "
                "third_party_packages"
            ),
            "swarmdsl.codegen.ros.package": (
                "PackageOptions copyright_fault manifest packages_fault"
            ),
            "swarmdsl.codegen.ros.package_names": "PackageNames",
            "swarmdsl.codegen.ros.parameters": "parameter_value with_parameters",
            "swarmdsl.codegen.ros.yaml_values": "yaml_key yaml_value",
        },
    )

__all__ = [
    "Generation",
    "InterfacePackage",
    "PackageNames",
    "PackageOptions",
    "check_described",
    "check_order",
    "copyright_fault",
    "definition_files",
    "depends",
    "group_by_package",
    "interface_parts",
    "interface_path",
    "interfaces_to_write",
    "invalid_names",
    "is_fully_described",
    "manifest",
    "named_types",
    "packages_fault",
    "parameter_value",
    "third_party_packages",
    "with_parameters",
    "yaml_key",
    "yaml_value",
]
