"""Arrays that compiled code uses without owning them.

numba counts every reference to an array with an atomic operation, also each time a tuple of arrays
is passed on; in a loop of a few hundred operations that takes most of the time. A borrowed array
has no owner and is not counted.
"""

from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numba.core import cgutils, types
from numba.extending import intrinsic


@intrinsic
def _borrow(typing: Any, array: Any) -> Any:
    if not isinstance(array, types.Array):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        found = cgutils.create_struct_proxy(array)(context, builder, value=arguments[0])
        # numba counts references through `meminfo`; it does not count an array without one.
        found.meminfo = cgutils.get_null_value(found.meminfo.type)
        found.parent = cgutils.get_null_value(found.parent.type)
        return found._getvalue()

    return array(array), generate


borrow = cast("Callable[[np.ndarray], np.ndarray]", _borrow)
"""The same array without an owner, in compiled functions only.

The caller must keep the array itself alive, and must not return the borrowed one.
"""


@intrinsic
def _keep(typing: Any, values: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return context.get_dummy_value()

    return types.none(values), generate


keep = cast("Callable[[Any], None]", _keep)
"""Keep arrays until this call. numba frees an array after the last line that names it, although
borrowed ones still use its memory.
"""
