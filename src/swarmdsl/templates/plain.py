"""The run time of Jinja, as far as plain templates need it.

Code that Jinja has compiled a template to runs with the names that stand here in place of those
of `jinja2.runtime`. What is not here, or is used in a way that is not known here, raises some
exception: then Jinja must fill in the template.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from operator import getitem
from types import CodeType
from typing import Any

from swarmdsl.source_map import Placed, at, marked

Code = CodeType
_Root = Callable[["Context"], Iterator[str]]

PRINTED = "places that were printed"
"""The name in the context of a list: of the places that were printed."""


def _joined(texts: Iterable[object], between: str = "") -> str:
    return between.join(map(str, texts))


def _indented(text: str) -> str:
    """All lines but the first, and but blank ones, four spaces to the right."""
    first, *others = f"{text}\n".splitlines()
    return "\n".join([first, *(line and f"    {line}" for line in others)])


def _attributes(items: Iterable[object], attribute: str) -> list[Any]:
    return [getattr(item, attribute) for item in items]


def _selected(items: Iterable[object], attribute: str) -> list[object]:
    return [item for item in items if getattr(item, attribute)]


def _rejected(items: Iterable[object], attribute: str) -> list[object]:
    return [item for item in items if not getattr(item, attribute)]


# Those of the same names in Jinja know more, and ask for more of its run time.
FILTERS: Mapping[str, Callable[..., Any]] = {
    "indent": _indented,
    "join": _joined,
    "list": list,
    "map": _attributes,
    "rejectattr": _rejected,
    "repr": repr,
    "selectattr": _selected,
    "sort": sorted,
}


def _attribute(of: Any, name: str) -> Any:
    """What `of.name` means in a template."""
    try:
        return getattr(of, name)
    except AttributeError:
        return of[name]


class _NoEscapes:
    autoescape = False


class Context:
    """The values in a template, by name."""

    eval_ctx = _NoEscapes

    def __init__(self, values: Mapping[str, object]) -> None:
        self._values = {"at": at, **values}
        self.printed: list[Placed] = self._values[PRINTED]  # type: ignore[assignment]
        # What is set in the template, which nobody asks for.
        self.vars: dict[str, object] = {}
        self.exported_vars: set[str] = set()

    def resolve_or_missing(self, name: str) -> object:
        """A value."""
        return self._values.get(name, _MISSING)

    def get_all(self) -> dict[str, object]:
        """All values."""
        return {**self._values, **self.vars}

    @staticmethod
    def call(
        function: Callable[..., object],
        *arguments: object,
        _loop_vars: object = None,
        _block_vars: object = None,
        **named: object,
    ) -> object:
        """Call a function of a value or of the context."""
        return function(*arguments, **named)


class _Template:
    """A template as another one includes it."""

    def __init__(self, root: _Root) -> None:
        self.root_render_func = root

    @staticmethod
    def new_context(
        values: Mapping[str, object], _shared: bool, around: Mapping[str, object]
    ) -> Context:
        known = {name: value for name, value in around.items() if value is not _MISSING}
        return Context({**values, **known})


class Plain:
    """The `environment` of compiled templates; `code` is that of a template by its name."""

    getattr = staticmethod(_attribute)
    getitem = staticmethod(getitem)
    concat = "".join

    def __init__(
        self, code: Callable[[str], Code], filters: Mapping[str, Callable[..., Any]]
    ) -> None:
        self._code = code
        self._roots: dict[str, _Root] = {}
        self.filters = filters

    def render(self, name: str, values: Mapping[str, object]) -> str:
        """What a template prints.

        Raises some exception where Jinja is needed to tell.
        """
        return "".join(self._root(name)(Context(values)))

    def get_template(self, name: str, _includer: str) -> _Template:
        """A template that is included."""
        return _Template(self._root(name))

    @staticmethod
    def finalize(context: Context, value: object) -> object:
        """What is printed for a value."""
        return marked(value, context.printed) if isinstance(value, Placed) else value

    @staticmethod
    def undefined(name: str) -> object:
        """What there is not. Raises LookupError."""
        raise LookupError(name)

    def _root(self, name: str) -> _Root:
        if name not in self._roots:
            known = {**_RUNTIME, "environment": self}
            exec(self._code(name), known)
            self._roots[name] = known["root"]
        return self._roots[name]


class _Loop:
    """The items of a loop, each with what is known of its round."""

    def __init__(self, items: Iterable[object], _undefined: object) -> None:
        self._items = tuple(items)

    def __iter__(self) -> Iterator[tuple[object, _Round]]:
        last = len(self._items) - 1
        for index, item in enumerate(self._items):
            yield item, _Round(index == 0, index == last)


class _Round:
    __slots__ = ("first", "last")

    def __init__(self, first: bool, last: bool) -> None:
        self.first = first
        self.last = last


def _macro(
    _environment: object,
    function: Callable[[], str],
    _name: str,
    parameters: tuple[str, ...],
    *_special: object,
) -> Callable[[], str]:
    if parameters:
        raise NotImplementedError("a macro with parameters")
    return function


_MISSING = object()
_RUNTIME: Mapping[str, Any] = {
    "LoopContext": _Loop,
    "Macro": _macro,
    # What `{{ a if b }}` prints where `b` is not true.
    "Undefined": lambda _reason: "",
    "identity": lambda value: value,
    "missing": _MISSING,
    "str_join": _joined,
}
