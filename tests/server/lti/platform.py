"""A learning platform that speaks LTI 1.3 over HTTP on loopback: keys, tokens, scores."""

import contextlib
import json
import threading
import time
from collections.abc import Callable, Iterator
from html import escape
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qs, parse_qsl, urlencode, urlsplit

from joserfc import jwt
from joserfc.jwk import KeySet, RSAKey

ISSUER = "https://moodle.example.org"
CLIENT = "lab-7"
DEPLOYMENT = "1"
CLAIM = "https://purl.imsglobal.org/spec/lti/claim/"
AGS = "https://purl.imsglobal.org/spec/lti-ags/"
INSTRUCTOR = "http://purl.imsglobal.org/vocab/lis/v2/membership#Instructor"
LEARNER = "http://purl.imsglobal.org/vocab/lis/v2/membership#Learner"
SCORE = f"{AGS}scope/score"


def make_key(kid: str) -> RSAKey:
    parameters = {"kid": kid, "use": "sig", "alg": "RS256"}
    return RSAKey.generate_key(2048, parameters, private=True)


class LearningPlatform:
    """Its own state: `scores` that arrived, `failures` that are answered 503 first.

    read_keys: reads the tool's JWKS when the platform needs it. tool_url: the URL of the tool for
    browsers.
    """

    def __init__(self, url: str) -> None:
        self.url, self.key = url, make_key("platform-1")
        self.scores: list[tuple[str, dict]] = []
        self.failures = self.key_requests = 0
        self.tokens: set[str] = set()
        self.problems: list[str] = []
        self.tool_url = ""
        self.read_keys: Callable[[], dict] = dict
        self.clock: Callable[[], float] = time.time

    @property
    def line_item(self) -> str:
        return f"{self.url}/items/3/lineitem?type_id=1"

    def write_settings(self, folder: Path, takes_instructors: bool = False) -> Path:
        path = folder / "lti.toml"
        path.write_text(
            f'key_file = "lti.pem"\n[[platforms]]\nissuer = "{ISSUER}"\n'
            f'client_id = "{CLIENT}"\ndeployments = ["{DEPLOYMENT}"]\n'
            f'login_url = "{self.url}/auth"\ntoken_url = "{self.url}/token"\n'
            f'keyset_url = "{self.url}/keys"\n'
            f"takes_instructors = {str(takes_instructors).lower()}\n"
        )
        return path

    def build_claims(self, nonce: str, /, **changes: object) -> dict:
        now = int(time.time())
        claims = {
            "iss": ISSUER, "aud": CLIENT, "sub": "user-42", "name": "Ada", "nonce": nonce,
            "iat": now, "exp": now + 300,
            f"{CLAIM}message_type": "LtiResourceLinkRequest", f"{CLAIM}version": "1.3.0",
            f"{CLAIM}deployment_id": DEPLOYMENT, f"{CLAIM}roles": [LEARNER],
            f"{CLAIM}resource_link": {"id": "r-1"},
            f"{CLAIM}target_link_uri": "http://127.0.0.1/learn/own-law",
            f"{AGS}claim/endpoint": {"scope": [SCORE], "lineitem": self.line_item},
        }  # fmt: skip
        return {key: one for key, one in (claims | changes).items() if one is not None}

    def sign(self, claims: dict, key: RSAKey | None = None) -> str:
        key = key or self.key
        return jwt.encode({"alg": "RS256", "kid": key.kid}, claims, key)

    def build_course(self) -> str:
        """A page of the course: an activity as a link, and one in a frame."""
        hints = {"iss": ISSUER, "client_id": CLIENT, "login_hint": "7", "lti_message_hint": "r&1"}
        link = escape(f"{self.tool_url}/lti/login?{urlencode(hints)}")
        return (
            f'<!doctype html><title>Course</title><a href="{link}">Exercise</a>'
            f'<iframe title="Activity" src="{link}"></iframe>'
        )

    def build_answer(self, asked: dict[str, str]) -> str:
        """The user's browser posts the launch to the lab (OpenID Connect form_post)."""
        assert asked["redirect_uri"] == f"{self.tool_url}/lti/launch"
        assert asked["lti_message_hint"] == "r&1"
        target = {f"{CLAIM}target_link_uri": f"{self.tool_url}/learn/mechanism"}
        given = {
            "id_token": self.sign(self.build_claims(asked["nonce"], **target)),
            "state": asked["state"],
        }
        fields = "".join(f'<input name="{n}" value="{escape(v)}">' for n, v in given.items())
        return (
            f'<!doctype html><form method="post" action="{escape(asked["redirect_uri"])}">{fields}'
            "</form><script>document.forms[0].submit()</script>"
        )

    def give_token(self, form: dict[str, str]) -> tuple[int, dict]:
        """RFC 7523: an access token for the signer of its client id."""
        assertion = jwt.decode(
            form["client_assertion"], KeySet.import_key_set(self.read_keys()), algorithms=["RS256"]
        )
        needed = {"iss": CLIENT, "sub": CLIENT, "aud": f"{self.url}/token"}
        registry = jwt.JWTClaimsRegistry(
            now=lambda: int(self.clock()),
            **{name: {"essential": True, "value": value} for name, value in needed.items()},
            exp={"essential": True}, jti={"essential": True},
        )  # fmt: skip
        registry.validate(assertion.claims)
        assert form["grant_type"] == "client_credentials"
        assert form["scope"] == SCORE
        token = f"token-{len(self.tokens)}"
        self.tokens.add(token)
        return 200, {"access_token": token, "token_type": "Bearer", "expires_in": 3600}

    def take_score(self, path: str, headers: dict[str, str], body: bytes) -> tuple[int, dict]:
        if headers.get("Authorization", "").removeprefix("Bearer ") not in self.tokens:
            return 401, {}
        if self.failures:
            self.failures -= 1
            return 503, {}
        assert headers["Content-Type"] == "application/vnd.ims.lis.v1.score+json"
        self.scores.append((path, json.loads(body)))
        return 200, {}


def _build_handler(find: Callable[[], LearningPlatform]) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            platform, place = find(), urlsplit(self.path).path
            if place == "/course":
                self.show(platform.build_course())
            elif place == "/auth":
                self.show(platform.build_answer(read_query(self.path)))
            else:
                platform.key_requests += 1
                self.answer(200, dict(KeySet([platform.key]).as_dict(private=False)))

        def do_POST(self) -> None:
            platform = find()
            body = self.rfile.read(int(self.headers["Content-Length"]))
            try:
                if self.path == "/token":
                    self.answer(*platform.give_token(dict(parse_qsl(body.decode()))))
                else:
                    self.answer(*platform.take_score(self.path, dict(self.headers), body))
            except Exception as error:
                platform.problems.append(repr(error))
                self.answer(400, {})

        def answer(self, status: int, reported: dict) -> None:
            self.write(status, "application/json", json.dumps(reported).encode())

        def show(self, page: str) -> None:
            self.write(200, "text/html; charset=utf-8", page.encode())

        def write(self, status: int, kind: str, body: bytes) -> None:
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None:
            """Log nothing on the console."""

    return Handler


@contextlib.contextmanager
def run_platform(host: str = "127.0.0.1") -> Iterator[LearningPlatform]:
    """Run a platform on a free loopback port; host: its name on other machines."""
    held: list[LearningPlatform] = []
    server = ThreadingHTTPServer(("127.0.0.1", 0), _build_handler(lambda: held[0]))
    held.append(LearningPlatform(f"http://{host}:{server.server_port}"))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield held[0]
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def read_query(address: str) -> dict[str, str]:
    return {name: values[0] for name, values in parse_qs(urlsplit(address).query).items()}


def read_audit(folder: Path, action: str) -> list[dict]:
    """Return the complete lines of a lab's audit log about this."""
    path = folder / "audit.jsonl"
    text = path.read_text() if path.exists() else ""
    lines = [json.loads(one) for one in text.splitlines(keepends=True) if one.endswith("\n")]
    return [one for one in lines if one.get("action") == action]
