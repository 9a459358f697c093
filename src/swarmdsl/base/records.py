"""Data classes that are cheap to define.

Python compiles the methods of a data class at its definition, which takes half a millisecond: for
all classes together longer than to check a model. Here methods are closures, except for `__init__`,
which is compiled after some instances. Type checkers see `dataclasses.dataclass`, of which this is
a subset; functions of `dataclasses`, such as `replace` and `fields`, accept these classes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import cache
from operator import attrgetter
from reprlib import recursive_repr
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dataclasses import Field as PythonField
    from dataclasses import dataclass, field, replace
else:

    def dataclass(cls=None, /, *, eq=True, frozen=False, slots=False):
        """Make a data class, as `dataclasses.dataclass` does."""
        if cls is None:
            return lambda cls: _define(cls, eq, frozen, slots)
        return _define(cls, eq, frozen, slots)

    def field(**about):
        """Return a field with options, like `dataclasses.field`."""
        return _Field(about)

    def replace(of, /, **changes):
        """Return a copy with other values, like `dataclasses.replace`."""
        kept = {
            name: getattr(of, name)
            for name, about in of.__parts__.items()
            if about.get("init", True) and name not in changes
        }
        return type(of)(**kept, **changes)


class _Field(dict[str, Any]):
    """Arguments of `dataclasses.field`."""


_NOTHING = _Field()
_set = object.__setattr__


def is_dataclass(cls: type) -> bool:
    """Return True for a data class, from here or from Python."""
    return "__parts__" in vars(cls) or hasattr(cls, "__dataclass_fields__")


def fields_of(cls: type[Any]) -> Mapping[str, Mapping[str, Any]]:
    """Return the fields of a data class by name, with the arguments of `dataclasses.field`."""
    if "__parts__" in vars(cls):
        own: dict[str, _Field] = cls.__parts__
        return own
    return {name: _about(field) for name, field in cls.__dataclass_fields__.items()}


def annotations_of(cls: type) -> Mapping[str, str]:
    """Return the annotations of the fields of a data class by name, as written."""
    annotations: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        annotations |= vars(base).get("__annotations__", {})
    return annotations


def _define(cls: type, eq: bool, frozen: bool, slots: bool) -> type:
    body = {name: of for name, of in vars(cls).items() if name not in _MADE_WITH_A_CLASS}
    inherited: dict[str, _Field] = getattr(cls, "__parts__", {})
    own = {name: _about(body.pop(name, _NOTHING)) for name in body.get("__annotations__", ())}
    parts = inherited | own
    methods: dict[str, Any] = {
        "__parts__": parts,
        "__dataclass_fields__": _FIELDS_OF_PYTHON,
        "__dataclass_params__": _params(eq, frozen),
        "__match_args__": _MATCHED,
        "__init__": _first_init(frozen),
        "__repr__": _repr,
    }
    if eq:
        methods["__eq__"], methods["__hash__"] = _comparison(parts)
        if not frozen:
            methods["__hash__"] = None
    if frozen:
        methods |= {"__setattr__": _refuse, "__delattr__": _refuse, "__setstate__": _set_state}
    if slots:
        # They cannot be added to a class.
        methods["__slots__"] = tuple(name for name in own if name not in inherited)
        return type(cls)(cls.__name__, cls.__bases__, methods | body)
    for name, about in own.items():
        if "default" in about:
            methods[name] = about["default"]
        elif name in vars(cls):
            delattr(cls, name)
    for name, value in methods.items():
        if name not in body:
            setattr(cls, name, value)
    return cls


_MADE_WITH_A_CLASS = ("__dict__", "__weakref__")
# To compile what sets the fields takes as long as to do without it so often.
_FEW = 50


@cache
def _params(eq: bool, frozen: bool) -> SimpleNamespace:
    """Return parameters that pretty-printers read."""
    return SimpleNamespace(
        init=True, repr=True, eq=eq, order=False, unsafe_hash=False, frozen=frozen
    )


def _about(given: Any) -> _Field:
    if isinstance(given, _Field):
        return given
    # A field of Python can only be there where its module is, which is slow to import.
    python = sys.modules.get("dataclasses")
    if python is None or not isinstance(given, python.Field):
        return _Field(default=given)
    names = ("default", "default_factory", "init", "repr", "compare", "kw_only", "metadata")
    about = {name: getattr(given, name) for name in names}
    return _Field({name: of for name, of in about.items() if of is not python.MISSING})


def _named(about: _Field) -> bool:
    return bool(about.get("kw_only", False))


def _first_init(frozen: bool) -> Callable[..., None]:
    """Return the `__init__` of the first few instances; later, and for wrong calls, `_init`."""
    left = _FEW
    shape: _Shape | None = None

    def first(self: object, *arguments: object, **named: object) -> None:
        nonlocal left, shape
        if shape is None:  # many classes have no instance at all
            owner = next(cls for cls in type(self).__mro__ if vars(cls).get("__init__") is first)
            shape = _Shape(owner)
        left -= 1
        right = len(arguments) <= len(shape.positional)
        values = shape.constants.copy()
        for name, make in shape.factories:
            values[name] = make()
        values.update(zip(shape.positional, arguments))  # noqa: B905 - of fewer or more
        if named:
            values.update(named)
            twice = not named.keys().isdisjoint(shape.positional[: len(arguments)])
            right = right and named.keys() <= shape.accepted and not twice
        if right and len(values) == shape.complete and left >= 0:
            if shape.in_dict:
                vars(self).update(values)
            else:
                for name, value in values.items():
                    _set(self, name, value)
        else:
            init = shape.owner.__init__ = _init(shape.owner, frozen)
            # It refers to itself: dropped, it would be garbage that has to be searched for.
            vars(init)["first"] = first
            init(self, *arguments, **named)

    return first


class _Shape:
    """Parameters of a class, and defaults of its other fields."""

    def __init__(self, owner: type[Any]) -> None:
        self.owner = owner
        parts: dict[str, _Field] = owner.__parts__
        self.accepted = {name for name, about in parts.items() if about.get("init", True)}
        self.positional = [
            name for name, about in parts.items() if name in self.accepted and not _named(about)
        ]
        self.constants = {name: of["default"] for name, of in parts.items() if "default" in of}
        self.factories = [
            (name, of["default_factory"]) for name, of in parts.items() if "default_factory" in of
        ]
        slots = [name for name in parts if hasattr(getattr(owner, name, None), "__set__")]
        self.in_dict = owner.__dictoffset__ != 0 and not slots
        self.complete = len({*self.accepted, *self.constants, *dict(self.factories)})


def _init(cls: type[Any], frozen: bool) -> Callable[..., None]:
    """Return a compiled `__init__`, as Python makes it."""
    parts: dict[str, _Field] = cls.__parts__
    anew = object()
    known: dict[str, Any] = {"anew": anew, "setattr": object.__setattr__}
    parameters: dict[bool, list[str]] = {False: ["self"], True: []}
    lines = ["pass"]
    for name, about in parts.items():
        parameter, value = name, name
        if "default" in about:
            known[f"default_{name}"] = about["default"]
            parameter = f"{name}=default_{name}"
        elif "default_factory" in about:
            known[f"make_{name}"] = about["default_factory"]
            parameter = f"{name}=anew"
            value = f"make_{name}() if {name} is anew else {name}"
        if about.get("init", True):
            parameters[_named(about)].append(parameter)
        elif "default" in about:
            value = f"default_{name}"
        elif "default_factory" in about:
            value = f"make_{name}()"
        else:
            continue
        lines.append(f"setattr(self, {name!r}, {value})" if frozen else f"self.{name} = {value}")
    if parameters[True]:
        parameters[True].insert(0, "*")
    head = ", ".join(parameters[False] + parameters[True])
    exec("\n ".join([f"def __init__({head}):", *lines]), known)
    init: Callable[..., None] = known["__init__"]
    init.__qualname__ = f"{cls.__qualname__}.__init__"
    return init


def _comparison(parts: dict[str, _Field]) -> tuple[Callable[..., Any], Callable[..., Any]]:
    compared = [name for name, about in parts.items() if about.get("compare", True)]
    values = attrgetter(*compared) if compared else type

    def equal(self: object, other: object) -> bool:
        return values(self) == values(other) if type(other) is type(self) else NotImplemented

    def hashed(self: object) -> int:
        return hash(values(self))

    return equal, hashed


@recursive_repr()
def _repr(self: Any) -> str:
    shown = ", ".join(
        f"{name}={getattr(self, name)!r}"
        for name, about in self.__parts__.items()
        if about.get("repr", True)
    )
    return f"{type(self).__qualname__}({shown})"


def _refuse(_self: object, name: str, *_value: object) -> None:
    from dataclasses import FrozenInstanceError

    raise FrozenInstanceError(f"`{name}` is of a frozen data class")


def _set_state(self: object, state: Any) -> None:
    """Restore a copy, whose attributes cannot be set otherwise."""
    for values in state if isinstance(state, tuple) else (state,):
        for name, value in (values or {}).items():
            object.__setattr__(self, name, value)


class _FieldsOfPython:
    """The attribute by which `dataclasses` knows its classes, made when it asks."""

    def __get__(self, _instance: object, owner: type[Any]) -> dict[str, PythonField[Any]]:
        import dataclasses

        annotations = annotations_of(owner)
        fields = [
            (name, annotations[name], dataclasses.field(**about))
            for name, about in fields_of(owner).items()
        ]
        of_python = dataclasses.make_dataclass(
            owner.__name__,
            fields,
            namespace={"__doc__": owner.__doc__ or owner.__name__},  # else it is worked out
            init=False,
            repr=False,
            eq=False,
        )
        found = {part.name: part for part in dataclasses.fields(of_python)}
        owner.__dataclass_fields__ = found
        return found


class _Matched:
    """The attribute by which `match` knows positional patterns, made when it asks."""

    def __get__(self, _instance: object, owner: type[Any]) -> tuple[str, ...]:
        found = tuple(_Shape(owner).positional)
        # Type checkers let only the body of a class give them.
        owner.__match_args__ = found  # type: ignore[misc]
        return found


_FIELDS_OF_PYTHON = _FieldsOfPython()
_MATCHED = _Matched()


__all__ = ["annotations_of", "dataclass", "field", "fields_of", "is_dataclass", "replace"]
