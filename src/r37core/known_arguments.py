"""Arguments known when a program is compiled: a branch that they rule out is dropped before anything in it is looked at.

Without this numba compiles what no scene of a kind has, some forty functions, and LLVM throws it away afterwards. Made with
numba's own ways to extend its pipeline (Numba developer manual, "Customizing the compiler") and its types (numba.extending).
"""

from __future__ import annotations

from functools import cache
from typing import Any

from numba.core import ir, types
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.dispatcher import Dispatcher
from numba.core.imputils import lower_constant
from numba.core.ir_utils import build_definitions, get_definition, guard
from numba.core.untyped_passes import IRProcessing
from numba.extending import models, register_model, typeof_impl


class _Choices(types.Type):
    """A tuple of truth values, each known by its name."""

    def __init__(self, values: Any):
        self.values = values
        super().__init__(name=repr(values))


register_model(_Choices)(models.OpaqueModel)


@lower_constant(_Choices)
def _(context: Any, builder: Any, kind: types.Type, value: Any) -> Any:
    return context.get_dummy_value()


def known(kind: type) -> None:
    """Let what is compiled know the fields of a constant of `kind`, a NamedTuple of truth values."""

    @typeof_impl.register(kind)
    def _(value: Any, context: Any) -> types.Type:
        return _Choices(value)


@register_pass(mutates_CFG=False, analysis_only=False)
class _KnownArguments(FunctionPass):
    """Put what is known of an argument in its place; numba's next passes drop the branches that this rules out.

    A function that is called gets the choices that it uses, and forgets the others, so that kinds that agree in these share it.
    """

    _name = "r37_known_arguments"

    def __init__(self) -> None:
        FunctionPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        program = state.func_ir
        for block in program.blocks.values():
            body = []
            for statement in block.body:
                if isinstance(statement, ir.Assign):
                    value = statement.value
                    if (truth := _truth(state, value)) is not None:
                        statement.value = ir.Const(truth, statement.loc)
                    elif isinstance(value, ir.Expr) and value.op == "call":
                        body += _narrow(state, value, block.scope)
                body.append(statement)
            block.body = body
        program._definitions = build_definitions(program.blocks)
        return True


def _truth(state: Any, value: Any) -> bool | None:
    """What an argument, or a field of one, is known to be."""
    if isinstance(value, ir.Arg):
        kind = state.args[value.index]
        return kind.literal_value if isinstance(kind, types.BooleanLiteral) else None
    if isinstance(value, ir.Expr) and value.op == "getattr":
        choices = _choices(state, value.value)
        return None if choices is None else getattr(choices, value.attr)
    return None


def _choices(state: Any, variable: Any) -> Any | None:
    """The choices that a variable is, if it is an argument that is known to be some."""
    meant = guard(get_definition, state.func_ir, variable)
    kind = state.args[meant.index] if isinstance(meant, ir.Arg) else None
    return kind.values if isinstance(kind, _Choices) else None


def _narrow(state: Any, call: Any, scope: Any) -> list[Any]:
    """Give a call the choices that its function uses, and say what has to stand before it."""
    before = []
    function = guard(get_definition, state.func_ir, call.func)
    for place, argument in enumerate(call.args):
        choices = _choices(state, argument)
        if choices is not None and isinstance(function, ir.Global):
            used = _names_in(function.value)
            known = choices._replace(**{name: None for name in choices._fields if name not in used})
            variable = scope.redefine("$narrowed", call.loc)
            before.append(ir.Assign(ir.Const(known, call.loc), variable, call.loc))
            call.args[place] = variable
    return before


@cache
def _names_in(function: Any) -> set[str]:
    """Every name in a compiled function and in those that it calls."""
    found, names, waiting = {function}, set[str](), [function]
    while waiting:
        python = waiting.pop().py_func
        names |= set(python.__code__.co_names)
        called = [python.__globals__.get(name) for name in python.__code__.co_names]
        new = {one for one in called if isinstance(one, Dispatcher)} - found
        found |= new
        waiting += new
    return names


class KnowingCompiler(CompilerBase):
    """Numba's compiler, for njit(pipeline_class=...), with that pass in it."""

    def define_pipelines(self) -> list[Any]:
        """Numba's passes and ours."""
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_KnownArguments, IRProcessing)
        passes.finalize()
        return [passes]
