"""The API documentation: all resources come from this server, and it matches the server."""

import json
import re
import threading
from concurrent.futures import ThreadPoolExecutor
from html.parser import HTMLParser

import pytest
from pydantic import BaseModel
from websockets.sync.client import connect

from svsa.inputs.checked import Checked
from svsa.runs.session.frame import HEADER, HEADER_FIELDS
from svsa_server import openapi
from svsa_server.app import build_app
from svsa_server.config import Settings
from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process
from tests.server.schema import SCHEMA
from tests.waiting import PATIENCE_S

STREAM = "/api/v1/sessions/{session}/stream"


class Loaded(HTMLParser):
    """The resources of a page: every src and href."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.inline = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.addresses += [value for name, value in attrs if name in ("src", "href") and value]
        self.inline = self.inline or (tag == "script" and "src" not in dict(attrs))


@pytest.mark.exhaustive
def test_lab_answers_while_its_schema_is_built(monkeypatch: pytest.MonkeyPatch) -> None:
    """The schema takes 1 s; the control loops of the sessions use the same event loop."""
    build, begun, answered = openapi._build_schema, threading.Event(), threading.Event()

    def build_slowly(*arguments):
        begun.set()
        assert answered.wait(PATIENCE_S), "the event loop waits for the schema"
        return build(*arguments)

    monkeypatch.setattr(openapi, "_build_schema", build_slowly)
    with run_lab_in_process() as lab, ThreadPoolExecutor(1) as pool:
        asked = pool.submit(lab.client.get, "/openapi.json")
        assert begun.wait(PATIENCE_S)
        assert lab.read()["status"] == "running"
        answered.set()
        assert asked.result().raise_for_status().json()["openapi"].startswith("3.")


@pytest.mark.parametrize("address", ["/docs", "/"])
def test_page_loads_nothing_from_elsewhere(shared_lab: Lab, address: str) -> None:
    answer = shared_lab.client.get(address).raise_for_status()
    loaded = Loaded(answer.text)
    assert loaded.addresses
    assert not loaded.inline, "the policy lets no script run that stands in the page"
    assert "default-src 'self'" in answer.headers["content-security-policy"]
    for part in loaded.addresses:
        assert not re.match(r"[a-z]+:|//", part)
        answer = shared_lab.client.get("/" + part.lstrip("./")).raise_for_status()
        assert len(answer.content) > 100


@pytest.mark.parametrize(
    ("address", "place"),
    [
        ("/learn", "/?learn=all"),
        ("/learn/observer", "/?learn=observer"),
        ("/learn/observer/3", "/?learn=observer/3"),
        ("/learn/observer/a%26b", "/?learn=observer/a%26b"),
        ("/studies", "/?studies=all"),
    ],
)
def test_typed_address_is_redirected_to_its_page(shared_lab: Lab, address: str, place: str) -> None:
    answer = shared_lab.client.get(address, follow_redirects=True)
    assert str(answer.url) == shared_lab.url + place
    assert "<title>SVSA Lab" in answer.text


def test_no_second_documentation_from_a_network(shared_lab: Lab) -> None:
    assert shared_lab.client.get("/redoc").status_code == 404


def test_secret_is_required_except_for_stop_and_login() -> None:
    closed_lab = build_app(Settings(secret="correct horse")).openapi()
    for schema in (SCHEMA, closed_lab):
        assert schema["components"]["securitySchemes"]["bearer"]["scheme"] == "bearer"
    asked = {
        path
        for path, item in closed_lab["paths"].items()
        for operation in item.values()
        if "security" not in operation
    }
    assert asked == {
        "/api/v1/health",
        "/api/v1/ready",
        "/api/v1/access",
        "/api/v1/login",
        "/api/v1/join",
        "/api/v1/rejoin",
        "/api/v1/quick-stop",
    }
    assert not [o for item in SCHEMA["paths"].values() for o in item.values() if "security" in o]


def test_schema_in_the_docs_is_that_of_the_server_with_unique_operations() -> None:
    """A change of the API appears in its diff; `make schema` writes it."""
    schema = build_app(Settings(secret=None)).openapi()
    assert json.loads(json.dumps(schema)) == SCHEMA
    ids = [
        operation["operationId"] for item in schema["paths"].values() for operation in item.values()
    ]
    assert len(set(ids)) == len(ids)
    assert all(re.fullmatch(r"[a-z][a-z_]{2,24}", one) for one in ids)


def test_docstring_of_the_library_describes_the_fields_of_an_answer() -> None:
    models = SCHEMA["components"]["schemas"]
    assert not [name for name, model in models.items() if "Attributes:" in str(model)]
    excess = models["ChannelVerdict"]["properties"]["excess"]
    assert excess["description"].endswith("negative inside; null if one of both values is unknown")
    assert excess["anyOf"] == [{"type": "number"}, {"type": "null"}]


def test_stream_is_documented_next_to_rest_as_packed() -> None:
    operation = SCHEMA["paths"][STREAM]["get"]
    text = operation["description"]
    assert f"a header of {HEADER.size} bytes" in text
    offsets = [int(row.split("|")[1]) for row in text.splitlines() if re.match(r"\| \d", row)]
    assert offsets == [0, 4, 8, 16, 20, 24, 28]
    assert len(offsets) == len(HEADER_FIELDS)
    assert "`uint32[lanes]`" in text
    named = {parameter["name"] for parameter in operation["parameters"]}
    assert {"rate_hz", "history_s", "lanes", "channels", "client"} <= named
    schema = operation["responses"]["101"]["content"]["application/json"]["schema"]
    assert {part["$ref"].rpartition("/")[2] for part in schema["anyOf"]} == {
        "Hello",
        "StateMessage",
        "StreamError",
    }


def test_plain_get_of_the_stream_reports_that_it_is_a_websocket(lab: Lab) -> None:
    answer = lab.client.get(lab.session + "/stream")
    assert answer.status_code == 426
    assert answer.headers["upgrade"] == "websocket"
    assert "WebSocket" in answer.json()["detail"]
    with connect(lab.stream_url, proxy=None, max_size=None) as stream:
        assert stream.recv(timeout=PATIENCE_S).startswith('{"type":"hello"')


@pytest.mark.parametrize(
    "place", ["ranking", "falsifier", "grades", "leaderboard", "runs", "studies"]
)
def test_typed_address_leads_to_its_place_in_the_page(shared_lab: Lab, place: str) -> None:
    answer = shared_lab.client.get(f"/{place}", follow_redirects=True)
    assert answer.headers["content-type"].startswith("text/html")
    assert answer.url.path == "/"
    assert place in answer.url.params


NOTHING_TO_READ = {
    "renew_rejoin_code",
    "renew_rejoin_code_of",
    "create_token",
    "renew_code",
    "submit_exercise",
}
"""Operations that create something that only their answer returns."""


def test_creating_operation_links_to_the_reading_one() -> None:
    read = {
        operation["operationId"]: [one["name"] for one in operation.get("parameters", [])]
        for item in SCHEMA["paths"].values()
        for operation in [item.get("get", {"operationId": ""})]
    }
    linked: dict[str, set[str]] = {}
    for item in SCHEMA["paths"].values():
        for operation in item.values():
            answer = operation["responses"].get("201", {})
            for link in answer.get("links", {}).values():
                (name,) = link["parameters"]
                assert name in read[link["operationId"]], operation["operationId"]
                linked.setdefault(operation["operationId"], set()).add(link["operationId"])
    assert linked["create_session"] == {"read_session"}
    assert linked["start_recording"] == {"read_session", "read_run"}
    assert linked["start_study"] == {"read_study", "read_job"}
    assert linked["start_job"] == {"read_job"}
    creating = {
        operation["operationId"]
        for item in SCHEMA["paths"].values()
        for operation in item.values()
        if "201" in operation["responses"]
    }
    assert creating - linked.keys() == NOTHING_TO_READ


def test_link_leads_from_a_new_session_to_its_state(lab: Lab) -> None:
    answer = SCHEMA["paths"]["/api/v1/sessions"]["post"]["responses"]["201"]
    place = answer["links"]["read_session"]["parameters"]["session"].rpartition("/")[2]
    created = lab.client.post("/api/v1/sessions", json={}).raise_for_status().json()
    read = lab.client.get(f"/api/v1/sessions/{created[place]}").raise_for_status().json()
    assert read["session"] == created["session"]
    lab.client.delete(f"/api/v1/sessions/{created[place]}").raise_for_status()


def test_every_field_of_a_request_declares_its_title_and_bounds() -> None:
    """pydantic makes a title from the name, such as "Position Poles Rad Per S"."""

    def find_references(part: object) -> set[str]:
        return set(re.findall(r"#/components/schemas/(\w+)", json.dumps(part)))

    def list_models(model: type[BaseModel]) -> list[type[BaseModel]]:
        return [model, *(sub for near in model.__subclasses__() for sub in list_models(near))]

    schemas = SCHEMA["components"]["schemas"]
    bodies = [
        method.get("requestBody") for item in SCHEMA["paths"].values() for method in item.values()
    ]
    names, added = set[str](), find_references(bodies)
    while added:
        names |= added
        added = set.union(*(find_references(schemas[name]) for name in added)) - names
    models = [model for model in list_models(Checked) if model.__name__ in names]
    assert len({model.__name__ for model in models}) > 60
    fields = [(model, *field) for model in models for field in model.model_fields.items()]
    assert [f"{model.__name__}.{name}" for model, name, field in fields if not field.title] == []
    written = json.dumps([schemas[name] for name in names])
    assert (
        re.findall(r'"(?:ge|gt|le|lt)": [\d.]+, "type"|"type": "\w+", "(?:ge|gt|le|lt)"', written)
        == []
    )
