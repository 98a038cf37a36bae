"""Arrays in a page: each once, as float32, compressed together into one base64 text.

Bytes of a kind stand together (all highest bytes, then the next …), which lets smooth curves
compress to about half.
"""

import base64
import zlib

import numpy as np
import numpy.typing as npt

_LEVEL = 9


class ArrayPack:
    """Collects arrays and says where the page finds each."""

    def __init__(self) -> None:
        self._planes: list[bytes] = []
        self._places: list[tuple[int, int]] = []
        self._known: dict[bytes, int] = {}
        self._end = 0

    def add(self, values: npt.ArrayLike) -> int:
        """Number of the array in the pack; equal arrays share one. Infinities become NaN."""
        exact = np.asarray(values, dtype=np.float64).ravel()
        with np.errstate(over="ignore"):
            single = exact.astype("<f4")
        single[~np.isfinite(single)] = np.nan
        planes = np.ascontiguousarray(single.view(np.uint8).reshape(-1, 4).T).tobytes()
        if planes not in self._known:
            self._known[planes] = len(self._places)
            self._places.append((self._end, single.size))
            self._planes.append(planes)
            self._end += len(planes)
        return self._known[planes]

    def export(self) -> dict[str, object]:
        """`places`: first byte and number of values of each array; `data`: deflated, base64."""
        packed = zlib.compress(b"".join(self._planes), _LEVEL)
        return {"places": self._places, "data": base64.b64encode(packed).decode("ascii")}
