"""YAML as users expect it: 1e-1 is a number, 010 is ten, a key given twice is an error, and every key knows its line.

A whole number as a key is the text that stands there: `{ 1: 0.4 }` and `{ "1": 0.4 }` are the same.
"""

import re
from collections.abc import Hashable
from pathlib import Path
from typing import Any

import yaml

from .io import TextFileError, read_text

KeyPath = tuple[str | int, ...]
"""Path of a value: keys of mappings and numbers of list entries."""

_LARGEST = 100_000
"""Values in one file; more than that is an alias that multiplies itself."""

_LARGEST_FILE, _DEEPEST = 2 * 2**20, 200
"""Bytes of a file, and sections and lists inside each other, above which it takes long to be told what is wrong."""

_DIGITS = list("-+0123456789.")
_INTEGER = re.compile(r"[-+]?[0-9]{1,400}\Z")
_FLOAT = re.compile(r"([-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN))\Z")


class _Loader(yaml.SafeLoader):
    """Numbers as in YAML 1.2 and JSON (none octal, sexagesimal or with underscores), no dates; mappings merged by <<."""

    def fetch_flow_collection_start(self, TokenClass: Any) -> None:
        if self.flow_level > _DEEPEST:
            raise yaml.MarkedYAMLError(problem="nested too deeply", problem_mark=self.get_mark())
        super().fetch_flow_collection_start(TokenClass)


_Loader.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag.endswith((":bool", ":null"))]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
_Loader.add_implicit_resolver("tag:yaml.org,2002:int", _INTEGER, _DIGITS)
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", _FLOAT, _DIGITS)
_Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))


def _mapping(loader: _Loader, node: yaml.MappingNode) -> dict[Hashable, Any]:
    content: dict[Hashable, Any] = {}
    for key_node, value in node.value:
        key = loader.construct_object(key_node, deep=True)
        if type(key) is int:
            # of a table by numbers; what has names refuses it as it refuses this text
            key = key_node.value
        if not isinstance(key, str):
            shown = key_node.value if isinstance(key_node, yaml.ScalarNode) else "?"
            raise _refusal(key_node, f"found the key '{shown}', which is {_kind(key)} in YAML; allowed: a name")
        content[key] = loader.construct_object(value, deep=True)
    return content


_Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


def _kind(value: object) -> str:
    names = {bool: "true or false", int: "a number", float: "a number", type(None): "nothing"}
    return names.get(type(value), "no text")


def _refusal(node: yaml.Node, reason: str) -> yaml.MarkedYAMLError:
    return yaml.MarkedYAMLError(problem=reason, problem_mark=node.start_mark)


def load_yaml(file: Path) -> Any:
    """Content of a YAML file; TextFileError where it is malformed or gives a key twice, OSError as `open` does."""
    return load_yaml_with_lines(file)[0]


def load_yaml_with_lines(file: Path) -> tuple[Any, dict[KeyPath, int]]:
    """Content of a YAML file as `load_yaml` gives it, and the number of the line each value stands on."""
    lines: dict[KeyPath, int] = {}
    if (size := file.stat().st_size) > _LARGEST_FILE:
        raise TextFileError(1, f"found {size} bytes; allowed: at most {_LARGEST_FILE}")
    text = read_text(file)
    try:
        loader = _Loader(text)
        node = loader.get_single_node()
        if node is None:
            raise TextFileError(1, "the file is empty")
        _note_lines(loader, node, (), lines)
        return loader.construct_document(node), lines
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        raise TextFileError(line, f"not readable as YAML: found the control character {error.character:#x}") from None
    except yaml.MarkedYAMLError as error:
        raise TextFileError(*_explained(error)) from None
    except RecursionError:
        raise TextFileError(1, "not readable as YAML: nested too deeply") from None


def yaml_text(content: Any) -> str:
    """Plain values as the text of a YAML file, which `load_yaml` reads as the same values."""
    return yaml.dump(content, Dumper=_Dumper, sort_keys=False, width=120, default_flow_style=None, allow_unicode=True)


class _Dumper(yaml.SafeDumper):
    """Texts that are none without quotes have them, and nothing is an alias."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _quoted(dumper: _Dumper, text: str) -> yaml.ScalarNode:
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=None if isinstance(scalar(text), str) else '"')


_Dumper.add_representer(str, _quoted)


def scalar(text: str) -> Any:
    """Value of a plain text in YAML: a number, true or false, nothing, or the text itself."""
    loader = _Loader("")
    return loader.construct_object(yaml.ScalarNode(loader.resolve(yaml.ScalarNode, text, (True, False)), text))


def _explained(error: yaml.MarkedYAMLError) -> tuple[int, str]:
    mark = error.problem_mark or error.context_mark
    problem = error.problem or error.context or "malformed"
    if "\\t" in problem:
        problem = "found a tab; indent with blanks"
    elif isinstance(error, yaml.parser.ParserError | yaml.scanner.ScannerError) and error.context:
        problem = f"{problem} ({error.context})"
    elif isinstance(error, yaml.composer.ComposerError):
        problem = f"{error.context or ''} {problem}".strip()
    return (mark.line + 1 if mark else 1), f"not readable as YAML: {problem}"


def _note_lines(loader: _Loader, node: yaml.Node, path: KeyPath, lines: dict[KeyPath, int]) -> None:
    """Put the lines of the values in a node into `lines`, and the keys of merged mappings into its mappings."""
    if len(lines) > _LARGEST:
        raise _refusal(node, f"more than {_LARGEST} values")
    lines.setdefault(path, node.start_mark.line + 1)
    if isinstance(node, yaml.MappingNode):
        _merge(loader, node)
        for key, value in node.value:
            inner = (*path, str(key.value))
            lines[inner] = key.start_mark.line + 1
            _note_lines(loader, value, inner, lines)
    elif isinstance(node, yaml.SequenceNode):
        for number, value in enumerate(node.value):
            _note_lines(loader, value, (*path, number), lines)


def _merge(loader: _Loader, node: yaml.MappingNode) -> None:
    """Put the keys of mappings that << names before those of the mapping `node`, which win."""
    names: set[str] = set()
    for key, value in node.value:
        if key.value == "<<" and key.style is None:
            key.tag = "tag:yaml.org,2002:merge"
            # has each key once before it is merged: no alias multiplies itself
            _note_lines(loader, value, (), {})
        elif str(key.value) in names:
            raise _refusal(key, f"the key '{key.value}' is given twice")
        else:
            names.add(str(key.value))
    loader.flatten_mapping(node)
    node.value = list({str(key.value): (key, value) for key, value in node.value}.values())
