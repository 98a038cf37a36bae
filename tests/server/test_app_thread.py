"""Answers between the event loop of the application and that of the connections."""

import asyncio

import pytest
from starlette.types import Message

from svsa_server.app_thread import CallBridge

START: Message = {"type": "http.response.start", "status": 200, "headers": []}
BODY: Message = {"type": "http.response.body", "body": b"{}"}


async def send_both(is_replaced: bool) -> tuple[list[Message], list[bool]]:
    """What the client gets of an answer, and whether it has begun after each of its parts.

    is_replaced: another answer is sent after the first part, because the sessions are silent.
    """
    sent: list[Message] = []
    has_answered: list[bool] = []

    async def receive() -> Message:
        raise AssertionError

    async def send(message: Message) -> None:
        sent.append(message)

    bridge = CallBridge(receive, send)
    for message in (START, BODY):
        await bridge.send(message)
        await bridge.finish()
        has_answered.append(bridge.has_answered)
        if is_replaced:
            bridge.end()
    return sent, has_answered


@pytest.mark.parametrize(
    ("is_replaced", "got", "begun"), [(False, [START, BODY], True), (True, [], False)]
)
def test_answer_starts_with_its_body_and_is_replaceable_until_then(
    is_replaced: bool, got: list[Message], begun: bool
) -> None:
    sent, has_answered = asyncio.run(send_both(is_replaced))
    assert sent == got
    assert has_answered == [False, begun]
