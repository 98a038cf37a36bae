"""What became of the requests whose answers may have been lost on the way.

A client gives a changing request a name of its own, drawn at random, in the header
`SVSA-Request`. Where no answer comes it cannot know whether the request was carried out; it
asks for the outcome by that name.
"""

import time
from collections import OrderedDict
from collections.abc import Callable
from typing import Literal

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa_server.leases.lease import CHANGING

REQUEST_HEADER = "SVSA-Request"
LONGEST_NAME = 64
MAX_KEPT = 1000

Outcome = Literal["unknown", "pending", "carried_out", "refused"]


class Outcomes:
    """The status of the last requests that had a name; None while one is being worked on.

    A name belongs to the person who gave it: another person's request of that name is another one.
    """

    def __init__(self) -> None:
        self._begun = time.monotonic()
        self._statuses: OrderedDict[tuple[str, str], int | None] = OrderedDict()

    @property
    def age_s(self) -> float:
        """For how long this server has kept them, s: what was asked before is not known here."""
        return time.monotonic() - self._begun

    def note(self, person_id: str, name: str, status: int | None) -> None:
        """A request of this name has come (None), or was answered with this status."""
        self._statuses[person_id, name] = status
        if len(self._statuses) > MAX_KEPT:
            self._statuses.popitem(last=False)

    def find(self, person_id: str, name: str) -> tuple[Outcome, int | None]:
        """What became of this person's request, and the status that it was answered with."""
        if (person_id, name) not in self._statuses:
            return "unknown", None
        status = self._statuses[person_id, name]
        if status is None:
            return "pending", None
        return ("carried_out" if status < 400 else "refused"), status


class OutcomeKeeper:
    """ASGI middleware that notes what named requests come to, whether or not anybody hears it.

    read_person_id: returns the id of the caller, empty where the lab knows no persons.
    """

    def __init__(
        self, app: ASGIApp, outcomes: Outcomes, read_person_id: Callable[[Scope], str]
    ) -> None:
        self._app = app
        self._outcomes, self._read_person_id = outcomes, read_person_id

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Hand the request on, and note its status."""
        name = Headers(scope=scope).get(REQUEST_HEADER) if scope["type"] == "http" else None
        if name is None or len(name) > LONGEST_NAME or scope["method"] not in CHANGING:
            await self._app(scope, receive, send)
            return

        person_id = self._read_person_id(scope)

        async def send_noted(message: Message) -> None:
            if message["type"] == "http.response.start":
                self._outcomes.note(person_id, name, message["status"])
            await send(message)

        # Noted before the route runs: a client that lost its connection may ask at once.
        self._outcomes.note(person_id, name, None)
        try:
            await self._app(scope, receive, send_noted)
        except BaseException:
            self._outcomes.note(person_id, name, 500)
            raise
