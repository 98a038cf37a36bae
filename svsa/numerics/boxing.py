"""Return of tuples and arrays from compiled functions, safe if a signal handler raises.

numba builds a named tuple by calling its class, and looks up that class and the type of an array
with functions written in Python. Python runs signal handlers in Python code, and the handler of
Ctrl-C raises `KeyboardInterrupt`. numba then continues with the missing object, and the interpreter
ends with a segmentation fault. The functions here replace those of numba. They check every object:
if one is missing, the compiled call raises the exception.
"""

from contextlib import ExitStack
from functools import cache
from importlib import import_module
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.pythonapi import _boxers
from numba.np.numpy_support import as_dtype


def _box_tuple(kind: Any, value: Any, context: Any) -> Any:
    """A plain tuple of the native `value`; NULL if one of its parts is missing."""
    api, builder = context.pyapi, context.builder
    missing, found = cgutils.get_null_value(api.pyobj), api.tuple_new(kind.count)
    built = cgutils.alloca_once_value(builder, missing)
    with ExitStack() as nested:
        nested.enter_context(_if_found(builder, found))
        # The blocks nest: after the first missing part nothing more is boxed, and `built` stays
        # NULL.
        for i, part in enumerate(kind):
            boxed = context.box(part, builder.extract_value(value, i))
            api.tuple_setitem(found, i, boxed)
            nested.enter_context(_if_found(builder, boxed))
        builder.store(found, built)
    # `Py_DecRef` accepts NULL, so this also covers a tuple that could not be created.
    with builder.if_then(cgutils.is_null(builder, builder.load(built)), likely=False):
        api.decref(found)
    return builder.load(built)


def _box_named_tuple(kind: Any, value: Any, context: Any) -> Any:
    """A named tuple of the native `value`; NULL if its class or one of its parts is missing."""
    api, builder = context.pyapi, context.builder
    built = cgutils.alloca_once_value(builder, cgutils.get_null_value(api.pyobj))
    plain = _box_tuple(kind, value, context)
    with _if_found(builder, plain):
        named = api.unserialize(api.serialize_object(kind.instance_class))
        with _if_found(builder, named):
            builder.store(api.call(named, plain), built)
            api.decref(named)
        api.decref(plain)
    return builder.load(built)


def _box_array(kind: Any, value: Any, context: Any) -> Any:
    """An array of the native `value`; NULL if its Python type is missing."""
    api, builder = context.pyapi, context.builder
    built = cgutils.alloca_once_value(builder, cgutils.get_null_value(api.pyobj))
    dtype = context.env_manager.read_const(context.env_manager.add_const(as_dtype(kind.dtype)))
    python_type = api.unserialize(api.serialize_object(kind.box_type))
    with _if_found(builder, python_type):
        word = ir.IntType(32)
        given = [api.voidptr, api.pyobj, word, word, api.pyobj]
        # numba's own `nrt_adapt_ndarray_to_python` does not check the type for NULL. Therefore its
        # runtime function is called here directly.
        name = "NRT_adapt_ndarray_to_python_acqref"
        adapt = api._get_function(ir.FunctionType(api.pyobj, given), name=name)
        array = builder.bitcast(cgutils.alloca_once_value(builder, value), api.voidptr)
        dimensions, is_writable = word(kind.ndim), word(int(kind.mutable))
        boxed = builder.call(adapt, [array, python_type, dimensions, is_writable, dtype])
        builder.store(boxed, built)
        api.decref(python_type)
    # The adapter takes its own reference (`acqref`), so the native one is released here.
    context.context.nrt.decref(builder, kind, value)
    return builder.load(built)


def _if_found(builder: ir.IRBuilder, found: Any) -> Any:
    """Generate code for the case that this object exists."""
    return builder.if_then(cgutils.is_not_null(builder, found), likely=True)


@cache
def replace_boxing() -> None:
    """Make numba use this module in all later compilations."""
    import_module("numba.core.boxing")  # registers the boxers that are replaced below; takes 18 ms
    # The table is internal to numba; for this reason numba's minor version is pinned.
    _boxers.functions |= {
        types.Tuple: _box_tuple,
        types.UniTuple: _box_tuple,
        types.NamedTuple: _box_named_tuple,
        types.NamedUniTuple: _box_named_tuple,
        types.Array: _box_array,
    }
