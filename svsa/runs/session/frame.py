"""The binary format of a batch of samples: header, lane ids, float32 values."""

import struct
from collections.abc import Iterable
from typing import Final, Literal, NamedTuple

import numpy as np

from svsa.errors import SvsaError

FieldName = Literal["magic", "run", "first_tick", "stride", "count", "missed", "lanes"]
FieldType = Literal["4 bytes", "uint32", "uint64"]

MAGIC = b"SVSA"
HEADER_FIELDS: Final[tuple[tuple[FieldName, str, str], ...]] = (
    ("magic", "4s", f"the text {MAGIC.decode()}"),
    ("run", "I", "number of the run; a new run begins at tick 0 again"),
    ("first_tick", "Q", "tick of the first sample"),
    ("stride", "I", "ticks from one sample to the next"),
    ("count", "I", "samples in this batch"),
    ("missed", "I", "samples before this batch that a slow client did not receive"),
    ("lanes", "I", "lanes in each sample"),
)
HEADER = struct.Struct("<" + "".join(code for _, code, _ in HEADER_FIELDS))
TYPES: Final[dict[str, FieldType]] = {"4s": "4 bytes", "I": "uint32", "Q": "uint64"}
LANE_ID: Final = "uint32"
VALUE: Final = "float32"
_LANE_ID, _VALUE = np.dtype(LANE_ID).newbyteorder("<"), np.dtype(VALUE).newbyteorder("<")


class Batch(NamedTuple):
    """Samples of one message.

    Attributes:
        run: Number of the run.
        ticks: Ticks of the samples, shape (count,).
        missed: Number of samples that were dropped before.
        lane_ids: Ids of the lanes, shape (lanes,).
        values: Shape (count, lanes, channels).
    """

    run: int
    ticks: np.ndarray
    missed: int
    lane_ids: tuple[int, ...]
    values: np.ndarray


def pack_batch(
    run: int, first_tick: int, stride: int, missed: int, lane_ids: Iterable[int], rows: np.ndarray
) -> bytes:
    """Pack samples, rows (count, lanes, channels), `stride` ticks apart."""
    ids = np.fromiter(lane_ids, _LANE_ID)
    header = HEADER.pack(MAGIC, run, first_tick, stride, len(rows), missed, len(ids))
    return header + ids.tobytes() + rows.astype(_VALUE).tobytes()


def unpack_batch(message: bytes, channels: int) -> Batch:
    """Unpack a batch of `pack_batch` with this number of channels.

    Raises:
        SvsaError: If it is not such a batch.
    """
    try:
        magic, run, first, stride, count, missed, lanes = HEADER.unpack_from(message)
        ids = np.frombuffer(message, _LANE_ID, lanes, HEADER.size)
        values = np.frombuffer(message, _VALUE, -1, HEADER.size + ids.nbytes)
        values = values.reshape(count, lanes, channels)
    except (struct.error, ValueError) as error:
        raise SvsaError(f"This is no batch of samples: {error}.") from None
    if magic != MAGIC:
        raise SvsaError(f"This is no batch of samples: it begins with {magic!r}, not {MAGIC!r}.")
    return Batch(run, first + stride * np.arange(count), missed, tuple(ids.tolist()), values)
