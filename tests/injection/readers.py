"""Contents of generated files for their readers, without comments."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Callable
from pathlib import PurePosixPath
from typing import Any

import yaml
from lxml import etree


def with_strings(value: Any, change: Callable[[str], str]) -> Any:
    """Return content with its strings changed."""
    if isinstance(value, str):
        return change(value)
    if isinstance(value, dict):
        return {
            with_strings(key, change): with_strings(each, change) for key, each in value.items()
        }
    return [with_strings(each, change) for each in value] if isinstance(value, list) else value


def content(path: str, text: str, ros: int = 1) -> Any:
    """Return the content of a file, as its real reader sees it, without comments."""
    name = PurePosixPath(path)
    first = text.partition("\n")[0]
    if name.suffix == ".py" or (first.startswith("#!") and "python" in first):
        return python(text)
    if name.suffix == ".scxml":
        return with_strings(xml(text), ecmascript)
    if name.suffix in (".xml", ".launch", ".test"):
        return xml(text)
    if name.suffix in (".yaml", ".yml"):
        return yaml.safe_load(text)
    if name.suffix in (".json", ".adf"):
        return json.loads(text)
    if name.suffix in (".msg", ".srv", ".action"):
        return interface(text, ros)
    if name.suffix in (".cpp", ".h", ".hpp"):
        return cpp(text)
    if name.suffix == ".cfg" and "=" in text and "{" in text:
        return libconfig(text)
    if name.name == "CMakeLists.txt":
        return [line for line in text.split("\n") if not line.lstrip().startswith("#")]
    return None


def python(text: str) -> Any:
    """Return the statements of a module, without documentation."""
    tree = ast.parse(text.encode())
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.FunctionDef, ast.ClassDef)) and ast.get_docstring(
            node
        ):
            node.body[0].value.value = "doc"  # type: ignore[attr-defined]
    return plain(tree)


def plain(node: Any) -> Any:
    if isinstance(node, ast.AST):
        return [type(node).__name__, *(plain(value) for _, value in ast.iter_fields(node))]
    if isinstance(node, list):
        return [plain(each) for each in node]
    return node


def xml(text: str) -> Any:
    def tree(node: Any) -> Any:
        if node.tag == "rosparam" and "param" in node.attrib:
            # YAML, which roslaunch reads without substitutions.
            given = {"type": "str", **node.attrib, "value": yaml.safe_load(node.text)}
            given["name"] = given.pop("param")
            return ["param", given, None]
        return [
            node.tag,
            dict(node.attrib),
            node.text if len(node) == 0 else (node.text or "").strip(),
            *(tree(each) for each in node if isinstance(each.tag, str)),
        ]

    return tree(etree.fromstring(text.encode(), etree.XMLParser(resolve_entities=False)))


def ecmascript(text: str) -> str:
    """Return an expression with the values of its literals, which are those of JSON."""
    return re.sub(r'"(?:[^"\\\n]|\\.)*"', lambda found: f'"{json.loads(found[0])}"', text)


def interface(text: str, ros: int) -> Any:
    """Return the lines of an interface file; only ROS 2 has quotes and comments in lines."""
    lines = (line.strip() for line in text.split("\n"))
    lines = (line for line in lines if line and not line.startswith("#"))
    if ros == 1:
        return list(lines)
    quotes = re.compile('(.*?)="(.*)"')
    found = []
    for line in lines:
        assert "#" not in line
        known = quotes.fullmatch(line)
        found.append([known[1], known[2].replace('\\"', '"')] if known else line)
    return found


_CPP = re.compile(
    r'//(?:\\\n|[^\n])*|/\*(?s:.*?)\*/|(?:"(?:\\(?s:.)|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\')|[^\s"\'/]+|/|"|\''
)
_TRIGRAPHS = dict(zip("=/'()!<>-", "#\\^[]|{}~", strict=True))
_ESCAPE = re.compile(r"\\(?:([0-7]{1,3})|x([0-9a-fA-F]{2})|(.))", re.DOTALL)


def cpp(text: str) -> Any:
    """Return the tokens of C++11, whose first phases replace trigraphs and join lines."""
    text = re.sub(r"\?\?([=/'()!<>-])", lambda found: _TRIGRAPHS[found[1]], text)
    text = text.replace("\\\n", "")
    tokens = []
    for found in _CPP.finditer(text):
        token = found[0]
        if token.startswith(("//", "/*")):
            continue
        if token.startswith('"') and len(token) > 1:
            tokens.append(["text", cpp_text(token[1:-1])])
        else:
            tokens.append(token)
    return tokens


def cpp_text(text: str) -> str:
    def byte(found: re.Match[str]) -> bytes:
        if found[1]:
            return bytes([int(found[1], 8)])
        if found[2]:
            return bytes([int(found[2], 16)])
        simple = {"n": b"\n", "t": b"\t", "r": b"\r"}
        assert found[3] in simple or found[3] in "\"'\\?", found[0]
        return simple.get(found[3]) or found[3].encode()

    out, at = b"", 0
    for found in _ESCAPE.finditer(text):
        out += text[at : found.start()].encode() + byte(found)
        at = found.end()
    return (out + text[at:].encode()).decode()


_LIBCONFIG = re.compile(
    r'\#[^\n]*|//[^\n]*|/\*(?s:.*?)\*/|"((?:\\.|[^"\\])*)"|[A-Za-z0-9_.*+-]+|[={}()\[\],;:]',
    re.DOTALL,
)


def libconfig(text: str) -> Any:
    tokens = []
    end = 0
    for found in _LIBCONFIG.finditer(text):
        assert not text[end : found.start()].strip(), text[end : found.start()]
        end = found.end()
        if found[0].startswith(("#", "//", "/*")):
            continue
        tokens.append(["text", cpp_text(found[1])] if found[1] is not None else found[0])
    assert not text[end:].strip()
    return tokens
