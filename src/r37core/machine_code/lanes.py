"""Eight numbers at once for numba: what is written with them becomes vector instructions, whatever the optimiser thinks.

The operators + - * / < > and np.sqrt, np.where, np.maximum and np.abs act on every lane; a number among them counts for all
lanes. So a formula in NumPy can be applied to arrays as it stands, and to lanes once it is compiled. Eight numbers fill one
register with AVX-512, two with AVX2, four with SSE2 or NEON. Made with numba's extension interface (numba.extending).

What they are for is the sum over modes: of plain loops LLVM makes vectors as it happens, and one of 8 rows of 32 modes takes 19
to 163 ns by how its line is written. A march of plain loops takes 1.4 to 2.6 times as long, and with lanes in the sums over
modes alone 1.5 to 1.7. Constants of a program (program_constants) are not flags, as these make it 1.05 to 1.09 times as long,
and its compilation half as long again at least.

Imported only where something is compiled, never by a simulation job that finds it compiled.
"""

import operator
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic, lower_builtin, models, register_model, type_callable

from .alignment import LANES

OPTIONS: dict[str, Any] = {"error_model": "numpy", "_nrt": False}
"""A division by zero is no error. Nothing is counted that refers to an array: all lie in records, and counting takes a seventh
of the time to compile. Nothing lets the optimiser choose how numbers are rounded (numba's `fastmath`): what it chose
would change with the processor, and with what is compiled around a sum."""

# wrappers for Python and C would be optimised and emitted, too, a quarter of all work, and nothing calls them
inlined = njit(**OPTIONS, forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)
"""Compiles a function into those that call it."""

_INTEGER = ir.IntType(32)
_NUMBERS, _TRUTHS = ir.VectorType(ir.DoubleType(), LANES), ir.VectorType(ir.IntType(1), LANES)


class Lanes(types.Type):
    """Eight doubles."""


class Flags(types.Type):
    """Eight truth values."""


_lanes, _flags = Lanes("lanes"), Flags("flags")
_KINDS = (Lanes, types.Number)


def _represent(kind: type, content: ir.Type) -> None:
    @register_model(kind)
    class _(models.PrimitiveModel):
        def __init__(self, manager: Any, numba_type: types.Type):
            super().__init__(manager, numba_type, content)


_represent(Lanes, _NUMBERS)
_represent(Flags, _TRUTHS)


def _shuffle(builder: Any, a: Any, b: Any, numbers: list[int]) -> Any:
    return builder.shuffle_vector(a, b, ir.Constant(ir.VectorType(_INTEGER, LANES), numbers))


def _broadcast(builder: Any, kind: ir.VectorType, number: Any) -> Any:
    single = builder.insert_element(ir.Constant(kind, ir.Undefined), number, _INTEGER(0))
    return _shuffle(builder, single, single, [0] * LANES)


def _spread(context: Any, builder: Any, kind: types.Type, value: Any) -> Any:
    """Lanes as they are, a number in every lane."""
    if kind == _lanes:
        return value
    return _broadcast(builder, _NUMBERS, context.cast(builder, value, kind, types.float64))


def _overload(symbol: Callable, result: types.Type, count: int, build: Callable) -> None:
    """Let `symbol` act on `count` arguments, lanes or numbers but not numbers alone, by `build(builder, *lanes)`."""

    @type_callable(symbol)
    def _(context: Any) -> Callable:
        def unary(a: types.Type) -> types.Type | None:
            return result if a == _lanes else None

        def binary(a: types.Type, b: types.Type) -> types.Type | None:
            return result if _lanes in (a, b) and isinstance(a, _KINDS) and isinstance(b, _KINDS) else None

        return unary if count == 1 else binary

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return build(builder, *(_spread(context, builder, kind, value) for kind, value in zip(sig.args, args, strict=True)))

    for kinds in [(Lanes,)] if count == 1 else [(Lanes, Lanes), (Lanes, types.Number), (types.Number, Lanes)]:
        lower_builtin(symbol, *kinds)(lower)


def _call_llvm(builder: Any, name: str, *values: Any) -> Any:
    kind = ir.FunctionType(_NUMBERS, [_NUMBERS] * len(values))
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v{LANES}f64"), values)


def _fused(builder: Any, product: Any, negative: bool, addend: Any) -> Any:
    """A product, or its negative, and what is added to it, rounded once; twice on a processor that cannot."""
    first, second = product.operands
    return _call_llvm(builder, "fmuladd", builder.fneg(first) if negative else first, second, addend)


def _is_product(value: Any) -> bool:
    return isinstance(value, ir.Instruction) and value.opname == "fmul"


def _add(builder: Any, a: Any, b: Any) -> Any:
    if _is_product(a):
        return _fused(builder, a, False, b)
    return _fused(builder, b, False, a) if _is_product(b) else builder.fadd(a, b)


def _subtract(builder: Any, a: Any, b: Any) -> Any:
    if _is_product(a):
        return _fused(builder, a, False, builder.fneg(b))
    return _fused(builder, b, True, a) if _is_product(b) else builder.fsub(a, b)


def _larger(builder: Any, a: Any, b: Any) -> Any:
    return builder.select(builder.fcmp_ordered(">", a, b), a, b)


for _symbols, _build in {
    (operator.add, operator.iadd): _add,
    (operator.sub, operator.isub): _subtract,
    (operator.mul, operator.imul): lambda builder, a, b: builder.fmul(a, b),
    (operator.truediv,): lambda builder, a, b: builder.fdiv(a, b),
}.items():
    for _symbol in _symbols:
        _overload(_symbol, _lanes, 2, _build)
_overload(operator.neg, _lanes, 1, lambda builder, a: builder.fneg(a))
_overload(operator.lt, _flags, 2, lambda builder, a, b: builder.fcmp_ordered("<", a, b))
_overload(operator.gt, _flags, 2, lambda builder, a, b: builder.fcmp_ordered(">", a, b))
_overload(np.maximum, _lanes, 2, _larger)
_overload(np.sqrt, _lanes, 1, lambda builder, a: _call_llvm(builder, "sqrt", a))
_overload(np.abs, _lanes, 1, lambda builder, a: _call_llvm(builder, "fabs", a))


@type_callable(np.where)
def _type_where(context: Any) -> Callable:
    def typer(flags: types.Type, yes: types.Type, no: types.Type) -> types.Type | None:
        return _lanes if flags == _flags and isinstance(yes, _KINDS) and isinstance(no, _KINDS) else None

    return typer


def _where(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    values = [_spread(context, builder, kind, value) for kind, value in zip(sig.args[1:], args[1:], strict=True)]
    return builder.select(args[0], *values)


for _yes in _KINDS:
    for _no in _KINDS:
        lower_builtin(np.where, Flags, _yes, _no)(_where)


def _address(context: Any, builder: Any, kinds: Any, array: Any, place: Any) -> Any:
    """Address at which lanes begin: at a place of a pointer, or at an index (last axis: number) of an array of a record."""
    kind, index = kinds
    indices = cgutils.unpack_tuple(builder, place) if isinstance(index, types.BaseTuple) else [place]
    index_kinds = list(index) if isinstance(index, types.BaseTuple) else [index]
    indices = [context.cast(builder, i, k, types.intp) for i, k in zip(indices, index_kinds, strict=True)]
    flat = indices[0]
    if isinstance(kind, types.CPointer):
        data = array
    else:
        data = context.make_array(kind)(context, builder, array).data
        for length, i in zip(kind.shape[1:], indices[1:], strict=True):
            flat = builder.add(builder.mul(flat, context.get_constant(types.intp, length)), i)
    return builder.bitcast(builder.gep(data, [flat]), _NUMBERS.as_pointer())


@intrinsic
def load(typingctx, array, place):
    """The eight numbers from `place` on: a pointer's, or the index of an array in a record, its last a multiple of eight."""

    def build(context, builder, sig, args):
        return builder.load(_address(context, builder, sig.args, *args), align=8 * LANES)

    return _lanes(array, place), build


@intrinsic
def store(typingctx, array, place, value):
    """Put eight numbers there."""

    def build(context, builder, sig, args):
        lanes = _spread(context, builder, sig.args[2], args[2])
        builder.store(lanes, _address(context, builder, sig.args[:2], *args[:2]), align=8 * LANES)
        return context.get_dummy_value()

    return types.void(array, place, value), build


@intrinsic
def spread(typingctx, number):
    """A number in every lane."""
    return _lanes(number), lambda context, builder, sig, args: _spread(context, builder, sig.args[0], args[0])


@intrinsic
def bits_of(typingctx, flags):
    """Flags as the lowest bits of an integer."""

    def build(context, builder, sig, args):
        return builder.zext(builder.bitcast(args[0], ir.IntType(LANES)), ir.IntType(64))

    return types.int64(flags), build


@intrinsic
def flags_of(typingctx, bits):
    """Flags from the lowest bits of an integer."""

    def build(context, builder, sig, args):
        return builder.bitcast(builder.trunc(args[0], ir.IntType(LANES)), _TRUTHS)

    return _flags(bits), build


@intrinsic
def flag_at(typingctx, number):
    """The flag of lane `number` set and no other; none if there is no such lane."""

    def build(context, builder, sig, args):
        kind = ir.VectorType(ir.IntType(64), LANES)
        lane = context.cast(builder, args[0], sig.args[0], types.int64)
        return builder.icmp_signed("==", _broadcast(builder, kind, lane), ir.Constant(kind, list(range(LANES))))

    return _flags(number), build


@intrinsic
def first_bit(typingctx, bits):
    """Number of the lowest bit that is set."""
    return types.int64(bits), lambda context, builder, sig, args: builder.cttz(args[0], ir.Constant(ir.IntType(1), 1))


@intrinsic
def sums_of_lanes(typingctx, vectors):
    """Lane k of the result is the sum of all lanes of the k-th vector of a tuple: every stage halves their number."""

    def build(context, builder, sig, args):
        sums, half = cgutils.unpack_tuple(builder, args[0]), LANES // 2
        while half:
            upper = [LANES * bool(lane & half) for lane in range(LANES)]
            kept = [lane + upper[lane] for lane in range(LANES)]
            added = [(lane ^ half) + upper[lane] for lane in range(LANES)]
            pairs = [(sums[j], sums[j + half]) for j in range(half)]
            sums = [builder.fadd(_shuffle(builder, *pair, kept), _shuffle(builder, *pair, added)) for pair in pairs]
            half //= 2
        return sums[0]

    return _lanes(vectors), build


def _joined(builder: Any, join: Callable, lanes: Any) -> Any:
    """All lanes, joined to one number: every stage halves how many differ."""
    half = LANES // 2
    while half:
        lanes = join(builder, lanes, _shuffle(builder, lanes, lanes, [lane ^ half for lane in range(LANES)]))
        half //= 2
    return builder.extract_element(lanes, _INTEGER(0))


@intrinsic
def sum_of_lanes(typingctx, value):
    """The sum of all lanes."""
    return types.float64(value), lambda context, builder, sig, args: _joined(builder, ir.IRBuilder.fadd, args[0])


@intrinsic
def largest_of_lanes(typingctx, value):
    """The largest of all lanes, none of which is NaN."""
    return types.float64(value), lambda context, builder, sig, args: _joined(builder, _larger, args[0])


@inlined
def lanes_used(array, used):
    """Number of lanes of an array that are `used`; of a single vector the compiler knows it."""
    return LANES if len(array) == LANES else used


def _elements_at(kind: types.Type) -> Callable:
    @intrinsic
    def elements_at(typingctx, address):
        def build(context, builder, sig, args):
            return builder.inttoptr(args[0], context.get_value_type(sig.return_type))

        return types.CPointer(kind)(address), build

    return elements_at


numbers_at, integers_at = _elements_at(types.float64), _elements_at(types.int64)
"""The doubles, or integers, that begin at an address, which is an integer of a record."""


def _same_address(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.bitcast(args[0], context.get_value_type(sig.return_type))


@intrinsic
def numbers_of(typingctx, record):
    """The doubles that a record begins with."""
    return types.CPointer(types.float64)(record), _same_address


@intrinsic
def pointed_at(typingctx, pointer):
    """The record that a pointer points at, not a copy of it."""
    return pointer.dtype(pointer), _same_address
