"""The lab as an LTI tool: logins, launches and members."""

import asyncio
import hashlib
import hmac
import re
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any
from urllib.parse import urlencode, urlsplit

import httpx
from joserfc.errors import JoseError
from joserfc.jwk import KeySet
from joserfc.jws import extract_compact

from svsa_server.access.authentication import REMOVED, ClassAuthentication
from svsa_server.access.names import is_reserved
from svsa_server.access.roles import Person, Role
from svsa_server.lti.keys import PlatformKeys, open_key
from svsa_server.lti.launch import Launch, read_launch
from svsa_server.lti.launch_error import LaunchError
from svsa_server.lti.links import Link, Links
from svsa_server.lti.platforms import Logins, LtiSettings, Platform, read_lti_file

ANSWER_S = 10.0
_LANDING = re.compile(r"learn(/[a-z0-9][a-z0-9-]{0,39}){0,2}")
_ROLES = {"student": Role.OPERATOR, "instructor": Role.INSTRUCTOR}


class LtiTool:
    """The LTI tool of one lab. client: HTTP client for the platforms; closed with the tool."""

    def __init__(self, settings: LtiSettings, data: Path) -> None:
        self.settings = settings
        self.key = open_key(settings.key_file)
        self.client = httpx.AsyncClient(timeout=ANSWER_S, trust_env=False)
        self.links = Links(data)
        self._keys, self._logins = PlatformKeys(self.client), Logins()

    @classmethod
    def open(cls, path: Path, data: Path) -> "LtiTool":
        """Open the tool of an LTI file; `data` is the lab's folder.

        Raises:
            ParameterError: If the file is invalid.
        """
        return cls(read_lti_file(path), data)

    def list_keys(self) -> dict[str, Any]:
        """Return the public keys of the lab, as a JSON Web Key Set."""
        return dict(KeySet([self.key]).as_dict(private=False))

    def find_platform(self, asked: Mapping[str, str]) -> Platform:
        """Find the platform of a login.

        Raises:
            LaunchError: If it is unknown.
        """
        platform = self.settings.find(asked.get("iss", ""), asked.get("client_id"))
        if platform is None:
            raise LaunchError(f"This lab has no platform {asked.get('iss', '')!r:.200}.")
        if not asked.get("login_hint"):
            raise LaunchError("The platform does not send the user of the login (login_hint).")
        return platform

    def begin(self, asked: Mapping[str, str], redirect: str) -> tuple[str, str]:
        """Start a login: return the address to redirect to, and its state; `redirect` is the
        address for the answer.

        Raises:
            LaunchError: If the platform is unknown.
        """
        platform = self.find_platform(asked)
        state, nonce = self._logins.begin(platform)
        query = {
            "scope": "openid", "response_type": "id_token", "response_mode": "form_post",
            "prompt": "none", "client_id": platform.client_id, "redirect_uri": redirect,
            "login_hint": asked["login_hint"], "state": state, "nonce": nonce,
        }  # fmt: skip
        if hint := asked.get("lti_message_hint"):
            query["lti_message_hint"] = hint
        mark = "&" if urlsplit(platform.login_url).query else "?"
        return f"{platform.login_url}{mark}{urlencode(query)}", state

    async def take(self, form: Mapping[str, str], cookie: str) -> tuple[Platform, Launch]:
        """Verify a launch; `cookie` is the state with which this browser started the login.

        Raises:
            LaunchError: If the launch is invalid.
        """
        state, token = form.get("state", ""), form.get("id_token", "")
        if error := form.get("error"):
            raise LaunchError(f"The platform reports: {error} {form.get('error_description', '')}")
        if not hmac.compare_digest(state.encode(), cookie.encode()):
            raise LaunchError(
                "It was not started in this browser, or the cookies are blocked: launch it"
                " again, in a separate window."
            )
        # The first use ends the login, so that a launch cannot be replayed.
        login = self._logins.end(state)
        if login is None:
            raise LaunchError("It was already used, or is too old: launch it again.")
        try:
            kid = extract_compact(token.encode()).headers().get("kid")
        except (JoseError, ValueError, TypeError) as error:
            raise LaunchError(f"The platform's token is invalid: {error}") from None
        keys = await self._keys.get(login.platform.keyset_url, kid)
        return login.platform, read_launch(login.platform, keys, token, login.nonce)

    async def admit(
        self, authentication: ClassAuthentication, platform: Platform, launch: Launch
    ) -> Person:
        """Return the member for the platform's user, the same at each launch.

        Raises:
            LaunchError: If the user was removed from the class.
        """
        identity = "\n".join((platform.issuer, platform.client_id, launch.user))
        id_ = f"p-{hashlib.sha256(identity.encode()).hexdigest()[:24]}"
        known, role = authentication.members.find(id_), _ROLES[launch.role]
        if known is not None and known.is_ended:
            raise LaunchError(REMOVED)
        members = authentication.members
        if known is None:
            # The platform's name is never rejected; a reserved one, or that of another member, is
            # shown with the end of the person's id.
            marked = f"{launch.name} ({id_[-6:]})"
            name = marked if is_reserved(launch.name) else launch.name
            person = await asyncio.to_thread(
                members.add,
                Person(id_, name, role),
                lambda number: marked if number == 2 else f"{marked} {number}",
            )
        else:
            person = known.person._replace(role=role)
            if person != known.person:
                await asyncio.to_thread(members.keep, known._replace(person=person))
        authentication.people.hear(person)
        return person

    def find_landing(self, launch: Launch, base: str, course: Collection[str]) -> str:
        """Return the requested page address within the lab; by default the course.

        Raises:
            LaunchError: If there is no such exercise.
        """
        place = launch.target.removeprefix(base) if launch.target.startswith(base) else ""
        if launch.exercise:
            place = f"learn/{launch.exercise}"
        if not _LANDING.fullmatch(place):
            return "learn"
        name = find_exercise(place)
        if name and name not in course:
            raise LaunchError(f"There is no exercise {name!r:.80}; there are {', '.join(course)}.")
        return place

    def learn(self, platform: Platform, launch: Launch, person: Person, exercise: str) -> None:
        """Store where this person's points in this exercise are sent, if the platform takes any."""
        if exercise and launch.line_item:
            link = (person.id, exercise, platform.issuer, platform.client_id)
            self.links.learn(Link(*link, launch.user, launch.line_item))


def find_exercise(place: str) -> str:
    """Find the exercise of a page address such as learn/NAME/STEP; "" if there is none."""
    parts = place.split("/")
    return parts[1] if len(parts) > 1 else ""
