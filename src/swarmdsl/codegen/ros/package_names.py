"""Names in a package of Python modules for ROS, and of its interfaces."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.naming import is_python_name, is_ros_package_name, snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.codegen.ros.interface_files import Generation, invalid_names
from swarmdsl.codegen.ros.interface_packages import InterfacePackage, check_order
from swarmdsl.ir import Interface, StateMachine, System

_PACKAGE_NAMES = "use lower-case letters, digits and `_`, and no name of a Python module"


@dataclass(frozen=True)
class PackageNames:
    """Names that a target allows, with the diagnostics for others.

    `modules` are the modules of each of its packages; a package named like one of `imported` would
    hide what the nodes import. `made_of` are the suffixes of the names that ROS generates from an
    interface, by the class of the interface.
    """

    target: str
    ros: Generation
    modules: Sequence[str]
    imported: Sequence[str]
    made_of: Mapping[type, Sequence[str]]

    def package(self, system: System, option: str, report: Diagnostics) -> str:
        """Return the package name: the option's, else made from the system's name."""
        name = option or f"{snake_case(system.name)}_behavior"
        if not option and self.package_fault(name) is not None:
            hint = "give the package a name with the option `package`"
            self.bad(report, name, "a ROS package name", system.origin, help=hint)
        return name

    def package_fault(self, name: str) -> str | None:
        """Return the reason why a package cannot have this name, or None."""
        if is_ros_package_name(name) and name not in self.imported:
            return None
        return f"`{name}` cannot be the name of the package: {_PACKAGE_NAMES}"

    def option_fault(self, name: str) -> str | None:
        """Return the same for an option, which may be empty."""
        return self.package_fault(name) if name else None

    def of_modules(self, machines: Iterable[StateMachine], report: Diagnostics) -> dict[str, str]:
        """Return the module of each machine, by the machine's name."""
        names: dict[str, str] = {}
        owners: dict[str, StateMachine] = {}
        for machine in machines:
            module = snake_case(machine.name)
            if not is_python_name(module) or module in self.modules:
                self.bad(report, module or machine.name, "a module name", machine.origin)
            elif module in owners:
                first = owners[module]
                use = f"the module of two machines, `{first.name}` and `{machine.name}`"
                related = _first(first.origin)
                self.bad(report, module, use, machine.origin, related=related)
            owners.setdefault(module, machine)
            names[machine.name] = module
        return names

    def check_callbacks(self, machine: StateMachine, report: Diagnostics) -> None:
        """Check the names of the functions that the user writes."""
        for state in machine.walk():
            activity = state.activity
            if activity is None:
                continue
            for callback in (activity.goal_callback, activity.result_callback):
                if callback is not None and not is_python_name(callback):
                    self.bad(report, callback, "the name of a function", activity.origin)

    def check_callback(
        self, name: str, signature: str, known: dict[str, str], at: Span | None, report: Diagnostics
    ) -> None:
        """Check that a callback has one signature."""
        if known.setdefault(name, signature) != signature:
            use = f"a callback with the arguments ({known[name]}) and with ({signature})"
            self.bad(report, name, use, at)

    def check_interfaces(
        self,
        system: System,
        packages: Sequence[InterfacePackage],
        behavior: str,
        report: Diagnostics,
    ) -> None:
        """Check the packages of interfaces beside package `behavior`."""
        for package in packages:
            self._check_package(package, behavior, report)
        # A generated package cannot contain interfaces that another package defines.
        own = [each for package in packages for each in package.interfaces if not each.external]
        generated = {behavior, *(interface.type.package for interface in own)}
        for interface in system.interfaces:
            if interface.external and interface.type.package in generated:
                use = "a third-party package: a generated package has that name"
                self.bad(report, interface.type.package, use, interface.origin)
        check_order(packages, self.target, report)

    def bad(
        self,
        report: Diagnostics,
        name: str,
        use: str,
        at: Span | None,
        *,
        related: tuple[Label, ...] = (),
        help: str | None = None,  # noqa: A002 - as `Diagnostics.report` calls it
    ) -> None:
        """Report a name that the target cannot take."""
        report.report(
            "bad-identifier", at, target=self.target, name=name, use=use, related=related, help=help
        )

    def _check_package(self, package: InterfacePackage, behavior: str, report: Diagnostics) -> None:
        name, at = package.name, package.interfaces[0].origin
        if not is_ros_package_name(name) or name in self.imported:
            self.bad(report, name, "the name of a ROS package", at, help=_PACKAGE_NAMES)
        elif name == behavior:
            use = "the package of its interfaces: the package with the behaviour has that name"
            hint = "rename that one with the option `package`"
            self.bad(report, name, use, at, help=hint)
        owners: dict[str, Interface] = {}
        for interface in package.interfaces:
            for wrong, use, hint, place in invalid_names(interface, self.ros):
                self.bad(report, wrong, use, place, help=hint)
            endings = self.made_of.get(type(interface), ())
            for made in (interface.type.name + ending for ending in ("", *endings)):
                owner = owners.setdefault(made, interface)
                if owner is not interface:
                    related = _first(owner.origin)
                    self.bad(
                        report, made, "two types of a package", interface.origin, related=related
                    )


def _first(origin: Span | None) -> tuple[Label, ...]:
    return (Label(origin, "the first is here"),) if origin is not None else ()
