"""The link between server and loop: complete messages, in order, without waiting."""

import pytest

from svsa.hardware.realtime.link import MAX_UNSENT_BYTES, LinkClosedError, build_links


def test_messages_arrive_complete_and_in_order():
    one, other = build_links()
    for number in range(300):
        one.send({"number": number, "text": "σ" * number})
    arrived = []
    while len(arrived) < 300:
        one.flush()
        arrived += other.receive(1.0)
    assert [message["number"] for message in arrived] == list(range(300))
    assert arrived[-1]["text"] == "σ" * 299


def test_receiving_does_not_wait():
    one, other = build_links()
    assert other.receive() == []
    one.close()
    with pytest.raises(LinkClosedError):
        other.receive()


def test_peer_that_does_not_read_is_dropped():
    one, _other = build_links()
    with pytest.raises(LinkClosedError, match="does not read"):
        for _ in range(1000):
            one.send({"text": "x" * (MAX_UNSENT_BYTES // 100)})
