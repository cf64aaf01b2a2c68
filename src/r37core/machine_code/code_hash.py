"""Hash of what code does: the same for other comments, docstrings, layout and versions of Python."""

import ast
import hashlib
from collections.abc import Iterator


def code_hash(tree: ast.AST) -> bytes:
    """Hash of a syntax tree, in which docstrings and texts that stand alone do not count."""
    return hashlib.sha256("".join(f"{part}\0" for part in _parts(tree)).encode()).digest()


def _parts(node: ast.AST) -> Iterator[str]:
    yield type(node).__name__
    for name, value in ast.iter_fields(node):
        if name in ("ctx", "kind", "type_comment") or value is None or value == []:
            continue
        yield name
        values = value if isinstance(value, list) else [value]
        if name == "body" and isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            values = [part for part in values if not _is_text(part)]
        for part in values:
            if isinstance(part, ast.AST):
                yield from _parts(part)
            else:
                yield repr(part)
        yield "."


def _is_text(node: ast.AST) -> bool:
    """True if a statement is a text alone: a docstring, or one after an assignment."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
