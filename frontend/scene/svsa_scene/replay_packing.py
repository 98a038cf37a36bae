"""Arrays in a page: each once, compressed together into one base64 text.

An array is float32, or a curve: integer multiples of a step, each as the difference from the
previous one, 0, −1, 1, −2 … stored as 0, 1, 2, 3 …. Bytes of equal significance are stored together
(all lowest bytes, then the next …), so that smooth curves are compressed to a few hundredths of
their size.
"""

import base64
import zlib

import numpy as np
import numpy.typing as npt

_LEVEL = 6
_MAX_STEPS = 2**30
_NO_NUMBER = np.int32(-(2**31))


class ArrayPack:
    """Collects arrays and returns the position of each in the page."""

    def __init__(self) -> None:
        self._planes: list[bytes] = []
        self._places: list[tuple[int, int] | tuple[int, int, float]] = []
        self._known: dict[tuple[bytes, float], int] = {}
        self._end = 0

    def add(self, values: npt.ArrayLike) -> int:
        """Number of the array in the pack; equal arrays share one. Infinities become NaN."""
        exact = np.asarray(values, dtype=np.float64).ravel()
        with np.errstate(over="ignore"):
            single = exact.astype("<f4")
        single[~np.isfinite(single)] = np.nan
        return self._keep(single, 0.0)

    def add_curve(self, values: npt.ArrayLike, step: float) -> int:
        """Number of the array, its values rounded to multiples of `step`, in their unit, or of a
        billionth of the largest where that is coarser. Infinities become NaN.
        """
        exact = np.asarray(values, dtype=np.float64).ravel()
        finite = np.isfinite(exact)
        peak = float(np.max(np.abs(exact), initial=0.0, where=finite))
        step = max(step, peak / _MAX_STEPS)
        whole = np.full(exact.size, _NO_NUMBER, dtype="<i4")
        whole[finite] = np.rint(exact[finite] / step)
        change = np.diff(whole, prepend=np.int32(0))
        return self._keep((change << 1) ^ (change >> 31), step)

    def export(self) -> dict[str, object]:
        """`places`: first byte and number of values of each array, of a curve its step too;
        `data`: deflated, base64.
        """
        packed = zlib.compress(b"".join(self._planes), _LEVEL)
        return {"places": self._places, "data": base64.b64encode(packed).decode("ascii")}

    def _keep(self, words: npt.NDArray[np.generic], step: float) -> int:
        planes = np.ascontiguousarray(words.view(np.uint8).reshape(-1, 4).T).tobytes()
        if (planes, step) not in self._known:
            self._known[planes, step] = len(self._places)
            place = (self._end, words.size)
            self._places.append((*place, step) if step else place)
            self._planes.append(planes)
            self._end += len(planes)
        return self._known[planes, step]
