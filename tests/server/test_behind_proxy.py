"""A lab behind a proxy with TLS and a path: Caddy, as in docs/proxy.md."""

import contextlib
import json
import re
import shutil
import socket
import ssl
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import httpx
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import svsa
from svsa_server.access.class_keys import ClassKeys, ShownOnce
from tests.lab import END_TIMEOUT_S, run_lab
from tests.waiting import PATIENCE_S

pytestmark = pytest.mark.exhaustive
"""`access/test_below_a_path` tests the path in the answers of the lab."""

ROOT = "/svsa"
CERTIFICATE = "caddy/pki/authorities/local/root.crt"
DOCUMENTED = Path(__file__).parents[2] / "docs" / "proxy.md"


class Proxied(NamedTuple):
    """A class behind Caddy. url: that of the proxy, without the path. root: its certificate."""

    url: str
    reported: ShownOnce
    trust: ssl.SSLContext
    root: Path

    def open_browser(self) -> httpx.Client:
        """Return the browser of a user who has not joined yet."""
        return httpx.Client(
            base_url=self.url + ROOT, verify=self.trust, timeout=PATIENCE_S, trust_env=False
        )


@contextlib.contextmanager
def reserve_port() -> Iterator[int]:
    """Yield a free port that no other process gets, except one that shares it, as Caddy does."""
    with socket.socket() as reserved:
        reserved.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        reserved.bind(("127.0.0.1", 0))
        yield reserved.getsockname()[1]


def find_caddy() -> str | None:
    """Return the path of Caddy on this machine, or None."""
    return shutil.which("caddy")


@contextlib.contextmanager
def run_caddy(folder: Path, port: int, lab_port: str) -> Iterator[ssl.SSLContext]:
    """Run Caddy with the file of the documentation; return a context that trusts its
    certificate.
    """
    caddy = find_caddy()
    assert caddy, "caddy is not installed: .ci/run installs it"
    (found,) = re.findall(r"```caddy\n(.*?)```", DOCUMENTED.read_text(encoding="utf-8"), re.DOTALL)
    site = found.replace("lab.example.org", f"https://localhost:{port}")
    site = site.replace("127.0.0.1:8000", f"127.0.0.1:{lab_port}")
    settings = "{\n admin off\n skip_install_trust\n auto_https disable_redirects\n}\n"
    (folder / "Caddyfile").write_text(settings + site, encoding="utf-8")
    environment = {"HOME": str(folder), "XDG_DATA_HOME": str(folder), "PATH": "/usr/bin:/bin"}
    process = subprocess.Popen(
        [caddy, "run", "--config", str(folder / "Caddyfile")],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield wait_for_trust(folder / CERTIFICATE, port)
    finally:
        process.terminate()
        process.wait(END_TIMEOUT_S)


def wait_for_trust(root: Path, port: int) -> ssl.SSLContext:
    for _ in range(600):
        with contextlib.suppress(OSError):
            trust = ssl.create_default_context(cafile=str(root))
            with (
                socket.create_connection(("127.0.0.1", port)) as line,
                trust.wrap_socket(line, server_hostname="localhost"),
            ):
                return trust
        time.sleep(0.1)
    raise AssertionError("Caddy did not come up")


@contextlib.contextmanager
def run_proxied(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxied]:
    """Run a class behind Caddy."""
    data, folder = tmp_path_factory.mktemp("class"), tmp_path_factory.mktemp("caddy")
    _, reported = ClassKeys.open(data)
    assert reported is not None
    with (
        reserve_port() as port,
        run_lab("--class", "--root-path", ROOT, data=str(data)) as lab,
        run_caddy(folder, port, lab.url.rpartition(":")[2]) as trust,
    ):
        root = folder / CERTIFICATE
        yield Proxied(f"https://localhost:{port}", reported, trust, root)


@pytest.fixture(scope="module")
def proxied(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxied]:
    with run_proxied(tmp_path_factory) as proxied:
        yield proxied


def test_page_and_all_its_resources_are_below_the_path(proxied: Proxied) -> None:
    with proxied.open_browser() as browser:
        page = browser.get("/").raise_for_status()
        loaded = re.findall(r'(?:src|href)="([^"]+)"', page.text)
        assert loaded
        for path in loaded:
            assert not path.startswith("/"), path
            assert browser.get(path).status_code == 200, path
        led = browser.get("/runs", follow_redirects=False)
        assert led.headers["location"].endswith(ROOT + "/?runs=all")


def test_cookie_of_a_user_is_for_that_path_and_tls_only(proxied: Proxied) -> None:
    with proxied.open_browser() as browser:
        assert browser.get("/api/v1/sessions").status_code == 401
        body = {"name": "Ada", "code": proxied.reported.code}
        cookie = browser.post("/api/v1/join", json=body).raise_for_status().headers["set-cookie"]
        for word in ("Secure", "HttpOnly", "SameSite=strict", f"Path={ROOT}"):
            assert word in cookie
        assert browser.get("/api/v1/access").json()["name"] == "Ada"
        browser.put("/api/v1/sessions/lab/control", json={"by": "Ada"}).raise_for_status()
        answer = browser.put("/api/v1/sessions/lab/speed", json={"speed": 0.5})
        assert answer.raise_for_status().json()["speed"] == 0.5
        other = {"Origin": "https://elsewhere.example"}
        assert browser.post("/api/v1/sessions", json={}, headers=other).status_code == 403


def test_schema_and_join_link_contain_the_path(proxied: Proxied) -> None:
    with proxied.open_browser() as browser:
        token = {"secret": proxied.reported.instructor_token}
        browser.post("/api/v1/login", json=token).raise_for_status()
        assert browser.get("/openapi.json").json()["servers"][0] == {"url": ROOT}
        renewed = browser.post("/api/v1/class/code").raise_for_status().json()
        assert renewed["address"].startswith("https://")
        assert f"{ROOT}/#join=" in renewed["address"]


def test_streams_and_3d_view_pass_the_proxy(proxied: Proxied) -> None:
    instructor = proxied.open_browser()
    token = {"secret": proxied.reported.instructor_token}
    instructor.post("/api/v1/login", json=token).raise_for_status()
    cookie = f"svsa_access={instructor.cookies['svsa_access']}"
    base = proxied.url.replace("https", "wss") + ROOT
    options = {"ssl": proxied.trust, "proxy": None, "max_size": None}
    address = base + "/api/v1/sessions/lab/stream"
    with pytest.raises(InvalidStatus) as refused, connect(address, **options):
        pass
    assert refused.value.response.status_code == 401
    headers = {"Cookie": cookie, "Origin": proxied.url}
    with connect(address, additional_headers=headers, **options) as stream:
        assert json.loads(stream.recv(timeout=PATIENCE_S))["type"] == "hello"
        assert any(isinstance(stream.recv(timeout=PATIENCE_S), bytes) for _ in range(5))
    view = instructor.get("/viser/lab/")
    assert (view.status_code, "hasFocus" in view.text) == (200, True)
    instructor.close()


def test_client_of_a_script_passes_the_proxy(
    proxied: Proxied, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SSL_CERT_FILE", str(proxied.root))
    lab = svsa.connect(proxied.url + ROOT, token=proxied.reported.instructor_token)
    block = next(iter(lab.session.stream("position_rad", duration_s=1.0)))
    assert len(block["position_rad"]) > 0
