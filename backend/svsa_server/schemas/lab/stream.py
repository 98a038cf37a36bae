"""Messages of a stream, and a description of the layout of `svsa.runs.session.frame`."""

import struct
from typing import Annotated, Any, Literal

from pydantic import BaseModel, Field

from svsa.actuators.signals import PLOTTED
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.runs.definition.design import MAX_LANES
from svsa.runs.result.channels import ChannelName
from svsa.runs.session.frame import (
    HEADER,
    HEADER_FIELDS,
    LANE_ID,
    MAGIC,
    TYPES,
    VALUE,
    FieldName,
    FieldType,
)
from svsa_server.problems import ShownText
from svsa_server.schemas.lab.session import SessionProgress, SessionState
from svsa_server.schemas.response import ResponseModel

BATCH_BYTES = 12 * 1024
"""Maximum size of a batch with more than one sample, about 0.6 s at 20 kB/s."""


class StreamRequest(Checked):
    """The contents of a stream."""

    rate_hz: Number = quantity("Hz", "Sample rate", ge=1, le=10_000, default=200.0)
    lanes: tuple[Annotated[Whole, Field(ge=1, le=MAX_LANES)], ...] | None = quantity(
        "", "Numbers of the lanes, from 1; None: all lanes", default=(1,)
    )
    history_s: Number = quantity(
        "s", "Length of the history to send first", ge=0, le=20, default=0.0
    )
    live_first: bool = quantity(
        "", "Send the newest samples first, then the history in parts, newest first", default=False
    )


class StreamChannel(ResponseModel):
    """A column of the batches."""

    name: ChannelName
    unit: str
    label: str


class BatchField(BaseModel):
    """A field of a batch's header."""

    name: FieldName
    type: FieldType
    byte: int = Field(description="Offset of the field in the message")


class BatchLayout(BaseModel):
    """A binary message, little-endian: header, lane ids, values of each sample."""

    magic: str = Field(default=MAGIC.decode(), description="Magic bytes at the start of a batch")
    header_bytes: int = HEADER.size
    header: list[BatchField]
    lane_id: Literal["uint32"] = LANE_ID
    value: Literal["float32"] = VALUE


class Hello(BaseModel):
    """The first message: contents and layout of the batches."""

    type: Literal["hello"] = "hello"
    session: str
    period_s: float
    rate_hz: float = Field(description="Samples per second at speed 1")
    lanes: list[int] = Field(description="Numbers of the lanes, from 1")
    channels: list[StreamChannel]
    batch: BatchLayout
    state: SessionState


class StateMessage(BaseModel):
    """The state after every change; otherwise the fields that change with time, at 1 or 5 Hz."""

    type: Literal["state"] = "state"
    since_tick: int = Field(
        description="The message has only the `events`, `ended_windows` and ended `segments` of the"
        " lanes from this tick on; earlier ones stay valid. 0: the lists are complete"
    )
    state: SessionState | SessionProgress


class StreamError(BaseModel):
    """An error in the address of the stream; the stream is closed after it."""

    type: Literal["error"] = "error"
    message: ShownText


StreamMessage = Hello | StateMessage | StreamError


def lay_out_batch() -> BatchLayout:
    """Return the offsets of the fields of a batch's header, as `pack_batch` writes them."""
    codes = [code for _, code, _ in HEADER_FIELDS]
    return BatchLayout(
        header=[
            BatchField(name=name, type=TYPES[code], byte=struct.calcsize("<" + "".join(codes[:n])))
            for n, (name, code, _) in enumerate(HEADER_FIELDS)
        ]
    )


def describe_stream(batch_period_s: float) -> str:
    """Describe the stream (Markdown) with the layout of a batch."""
    rows = [
        f"| {field.byte} | {field.type} | {field.name} | {meaning} |"
        for field, (_, _, meaning) in zip(lay_out_batch().header, HEADER_FIELDS, strict=True)
    ]
    return "\n".join(
        [
            "Stream the samples over a **WebSocket** at this address (`ws://` or `wss://`); a plain"
            " GET is answered with 426.",
            "",
            "Text messages are JSON, distinguished by `type`. The answer 101 has their schemas:",
            "",
            "* `hello` is the first message.",
            "* `state` follows every change. In addition, a `state` with the fields that change"
            " with time is sent five times a second in the first seconds of a window, and once a"
            " second later. It contains the events, windows and segments that have ended from its"
            " `since_tick` on; earlier ones stay valid and are not sent again.",
            "* `error` is sent before the stream is closed because of a wrong address.",
            "",
            f"Binary messages are batches of samples, about {1 / batch_period_s:.0f} a second,"
            f" little-endian: a header of {HEADER.size} bytes,",
            "",
            "| byte | type | field | meaning |",
            "|---|---|---|---|",
            *rows,
            "",
            f"then `{LANE_ID}[lanes]` from byte {HEADER.size} on: the `id` of every lane in"
            " `state.lanes`. A lane keeps its id during the run. Its position among the lanes may"
            " change; `hello.lanes` has the order in the first batch.",
            "",
            f"Then `{VALUE}[count][lanes][channels]` from byte {HEADER.size} + 4 · lanes on, in the"
            " order of these ids and of `hello.channels`. NaN is an unknown value. A slow client"
            " receives the newest samples, and `missed` counts the samples that it did not receive."
            " If a session runs many times faster than real time, each batch has consecutive"
            " samples, with gaps between the batches: compare `first_tick` with the end of the"
            " previous batch.",
            "",
            f"A batch with more than one sample has at most {BATCH_BYTES // 1024} kB, so a history"
            " comes in several batches. With `live_first=true` the newest samples come first; then"
            " the history, its newest batch first, between the batches of new samples. A batch that"
            " begins before the end of an earlier one belongs to the history. A client on a slow"
            " link gets sparser samples, of a larger `stride`. A restart of the run ends the"
            " history.",
            "",
            "The server sends pings between the batches and waits for the pongs, so that new"
            " samples do not wait behind the history in the buffers of a slow link.",
            "",
            f"The default of `channels` is `{','.join(PLOTTED)}`.",
            "",
            "Any message from the client holds the dead-man's switch of a bench for 0.1 s, if the"
            " client may command.",
        ]
    )


def list_stream_parameters() -> list[dict[str, Any]]:
    """List the query parameters of the stream, as OpenAPI parameters."""
    bounds = StreamRequest.model_json_schema()["properties"]
    words = {
        "lanes": f"`all`, or numbers from 1 to {MAX_LANES} with commas; default: lane 1",
        "channels": "Comma-separated channel names; default: see above",
        "client": "Client id, as in the header SVSA-Client, which browsers cannot send with a "
        "WebSocket",
    }
    schemas = {name: bounds[name] for name in ("rate_hz", "history_s", "live_first")}
    schemas |= {name: {"type": "string", "description": text} for name, text in words.items()}
    return [
        {
            "name": name,
            "in": "query",
            "required": False,
            "description": schema.get("description", ""),
            "schema": schema,
        }
        for name, schema in schemas.items()
    ]
