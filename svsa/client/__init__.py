"""Scripts for a running lab over its public API, with the library's vocabulary.

    import svsa
    with svsa.connect("http://127.0.0.1:8000") as lab:
        session = lab.session
        session.position = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.2)
        with session.record("3 kg") as run:
            session.loads.add(svsa.PaperLoad())
            for block in session.stream("position_rad", duration_s=5.0):
                print(block.time_s[-1], block["position_rad"][-1])
        run.result.metrics.rms_position_error_rad

It needs the extra `client`. A rejection by the lab raises the same exception as `svsa.simulate`.
"""

# ruff: noqa: E402
from svsa.inputs.extras import require_extra

require_extra("client")

from svsa.client.asynchronous import AsyncLab, AsyncRecording, AsyncSession, connect_async
from svsa.client.bench import RemoteBench
from svsa.client.connection import (
    AccessError,
    AppliedAt,
    Connection,
    ControlError,
    LabError,
    LostAnswerError,
)
from svsa.client.lab import Lab, connect
from svsa.client.loads import AppliedLoad, Loads
from svsa.client.runs import Recording, RemoteRuns
from svsa.client.session import RemoteSession
from svsa.client.stream import Block, BlockStream

__all__ = [
    "AccessError",
    "AppliedAt",
    "AppliedLoad",
    "AsyncLab",
    "AsyncRecording",
    "AsyncSession",
    "Block",
    "BlockStream",
    "Connection",
    "ControlError",
    "Lab",
    "LabError",
    "Loads",
    "LostAnswerError",
    "Recording",
    "RemoteBench",
    "RemoteRuns",
    "RemoteSession",
    "connect",
    "connect_async",
]
