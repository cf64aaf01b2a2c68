"""Object code for this machine's processor: made once, kept, checked, and loaded without its compiler.

Light: the simulation jobs import it. An object is kept (`kept`) under a name made of everything it depends on.
"""

import ctypes
import hashlib
import logging
import os
import subprocess
import sys
from collections.abc import Callable
from functools import cache, cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import llvmlite
import llvmlite.binding as llvm

from .kept import kept_bytes

_PACKAGE = Path(__file__).parents[1]


class ObjectCodeError(RuntimeError):
    """Object code that cannot be made: it needs what is not there, or the environment excludes it."""


def processor() -> tuple[str, str]:
    """Name and features that code is made for: this machine's, or numba's NUMBA_CPU_NAME and NUMBA_CPU_FEATURES."""
    named = os.environ.get("NUMBA_CPU_NAME")
    own_name, own_features = this_processor() if named is None else (named, "")
    features = os.environ.get("NUMBA_CPU_FEATURES")
    return own_name, own_features if features is None else features


@cache
def this_processor() -> tuple[str, str]:
    """Name and features of this machine's processor; LLVM takes a while to find them out."""
    return llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()


class Sources:
    """Files of the package that object code is made from, as they were when they were imported."""

    def __init__(self, *files: str):
        self.files = files
        self._contents = self._contents_now()

    @cached_property
    def digest(self) -> bytes:
        """Hash of what the files did, of which comments and docstrings are no part; kept, as jobs have no time to parse."""

        def parsed() -> bytes:
            # slow, and no job with a known text asks
            import ast

            from .code_hash import code_hash

            return b"".join(code_hash(ast.parse(content)) for content in self._contents)

        texts = [hashlib.sha256(content).digest() for content in self._contents]
        return kept_bytes("sources.digest", texts, parsed, lambda: True)

    @property
    def unchanged(self) -> bool:
        """True as long as nobody has edited the files."""
        return self._contents == self._contents_now()

    def _contents_now(self) -> list[bytes]:
        return [(_PACKAGE / file).read_bytes() for file in self.files]


def cached_object(name: str, sources: Sources, about: object, build: Callable[[], bytes]) -> bytes:
    """The object code called `name`; `build` is called when it is not there, or damaged.

    `about`: what it depends on beside its sources, told apart by its repr. The compiler's versions and the processor are
    taken along. What is built is not kept if the sources were edited after this process imported them.
    """
    made_of = (about, sources.digest, _numba_version(), llvmlite.__version__, processor())

    def told() -> bytes:
        # the name of the package that people call; whoever calls it shows such lines (r37.stages)
        logging.getLogger("r37").info("compiling the %s for this processor, up to half a minute", name.replace("_", " "))
        _check_environment()
        return build()

    return kept_bytes(f"{name}.o", made_of, told, lambda: sources.unchanged)


def object_code(assembly: str, symbol: str, name: str) -> bytes:
    """Object code for the processor from LLVM's assembly language, its function `symbol` renamed to `name`.

    Raises ObjectCodeError if it needs functions that a process without the compiler lacks.
    """
    _start_llvm()
    module = llvm.parse_assembly(assembly)
    module.verify()
    module.get_function(symbol).name = name
    machine = _target_machine(opt=3, reloc="pic", codemodel="small")
    _drop_unreached(module, machine)
    process, outside = ctypes.CDLL(None), [f.name for f in module.functions if f.is_declaration]
    missing = [name for name in outside if not name.startswith("llvm.") and not hasattr(process, name)]
    if missing:
        raise ObjectCodeError(f"{name} needs {', '.join(missing)}, which only its compiler has")
    return machine.emit_object(module)


def load_function(code: bytes, name: str, result: Any, *arguments: Any) -> Callable:
    """A function of some object code, called through ctypes."""
    _start_llvm()
    # in one piece of memory: constants far from the code are out of reach, and LLVM then ends the process
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target_machine(), use_lmm=True)
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    function = ctypes.CFUNCTYPE(result, *arguments)(engine.get_function_address(name))
    function.engine = engine  # type: ignore[attr-defined]  # the code lives as long as its engine
    return function


def _check_environment() -> None:
    """ObjectCodeError for variables of numba with which its compiler does nothing, or LLVM ends the process."""
    if (disabled := os.environ.get("NUMBA_DISABLE_JIT", "0")) not in ("", "0"):
        raise ObjectCodeError(f"NUMBA_DISABLE_JIT: found {disabled}; allowed: 0, as the time integration is compiled")
    if named := os.environ.get("NUMBA_CPU_NAME"):
        # in a process that LLVM may end; it only prints that it does not know a name
        trial = f"from {__name__} import object_code; object_code('define void @f() {{ ret void }}', 'f', 'f')"
        done = subprocess.run([sys.executable, "-c", trial], capture_output=True, text=True, check=False)
        if done.returncode or "not a recognized processor" in done.stderr:
            allowed = f"allowed: a name of LLVM's, as {this_processor()[0]}, or unset for this processor"
            raise ObjectCodeError(f"NUMBA_CPU_NAME: found {named}, which LLVM cannot compile for; {allowed}")


def _numba_version() -> str:
    """Content of numba's file about its version, without importing it, nor importlib.metadata, which takes long."""
    spec = find_spec("numba")
    return "" if spec is None or spec.origin is None else Path(spec.origin).with_name("_version.py").read_text(encoding="utf-8")


def _start_llvm() -> None:
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()


def _target_machine(**options: Any) -> llvm.TargetMachine:
    cpu, features = processor()
    return llvm.Target.from_default_triple().create_target_machine(cpu=cpu, features=features, **options)


def _drop_unreached(module: llvm.ModuleRef, machine: llvm.TargetMachine) -> None:
    """Drop what a caller does about errors that its function, as it was optimised, never has."""
    passes = llvm.create_new_module_pass_manager()
    passes.add_ipsccp_pass()
    passes.add_simplify_cfg_pass()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options()))
