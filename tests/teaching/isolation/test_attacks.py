"""Laws that attack: nothing gets out, and the lab does not notice.

Every attacker knows everything except the secret itself. It knows its places: a file, an
environment variable, memory, shared memory, and the other side of three sockets. Some attacks
succeed in a process without isolation. They show that the attack is real and that this test would
detect it.
"""

import contextlib
import ctypes
import hashlib
import os
import secrets
import socket
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from time import monotonic

import pytest

from svsa.teaching.isolation.confinement import FOLDER_BYTES, confine, leave_open
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.refusal import NotIsolatedError
from tests.teaching.isolation.attackers import BOUNDS, attack, list_attacks

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="namespaces are Linux's")
SHORT = BOUNDS._replace(answer_s=1.5)
PATIENT = BOUNDS._replace(answer_s=BOUNDS.whole_s, cpu_s=30)
"""For attacks that are not about time: memory fills slowly on a busy machine."""
ENDS = {
    "overflow_its_stack": {"refused", "ended", "late"},
    "crash": {"ended"},
    "spin": {"late"},
    "sleep": {"late"},
    "leave": {"ended"},
    "leave_by_an_exception": {"error"},
    "leave_a_core": {"ended"},
    "close_everything": {"ended"},
    "answer_before_it_is_asked": {"early"},
    "answer_what_was_not_asked": {"early"},
    "answer_in_bits": {"late", "early"},
    "answer_with_noise": {"early"},
    "answer_of_another_kind": {"garbled"},
    "guess_from_the_clock": {"got"},
}
"""The outcome of attacks that are not simply refused."""
REAL = (
    "read_environment_through_proc", "read_descriptors_through_proc", "read_what_is_mounted",
    "read_the_secret", "read_the_machines_users", "list_homes", "leave_by_a_link",
    "leave_by_dots", "write_outside", "read_shared_memory", "make_shared_memory",
    "make_shared_memory_of_system_v", "make_a_file_without_a_name", "fork", "start_a_thread",
    "start_a_program", "signal_the_asker", "call_the_lab", "call_the_lab_by_its_file",
    "call_the_lab_by_its_hidden_name", "listen", "send_a_datagram", "ask_the_kernel",
    "make_a_pair", "call_without_python",
)  # fmt: skip
"""Attacks that succeed from an unconfined process, under any account."""
GETTING = ("read_the_secret", "leave_by", "read_shared", "call_the", "start_a_program")
"""The prefixes of attacks that read the secret."""
WALLS = {
    "PermissionError", "FileNotFoundError", "ModuleNotFoundError", "ImportError", "OSError",
    "KeyError", "MemoryError", "RecursionError", "RuntimeError", "BlockingIOError", "",
}  # fmt: skip
"""The errors of a refused attack; another error would be a mistake in the attack."""


@pytest.fixture(scope="module", autouse=True)
def isolation():
    """Skip on a machine without isolation, unless it is declared to support it (`.ci/run`)."""
    try:
        check_isolation()
    except NotIsolatedError as error:
        if os.environ.get("SVSA_MUST_ISOLATE"):
            raise
        pytest.skip(str(error))


def _tell(listener, secret):
    while True:
        try:
            line, _ = listener.accept()
        except OSError:
            return
        with line:
            line.sendall(secret)


@pytest.fixture(scope="module")
def secret():
    return b"canary-" + secrets.token_hex(16).encode()


@pytest.fixture(scope="module")
def clue(secret, tmp_path_factory):
    """What an attacker may know, except the secret. See the module."""
    folder = tmp_path_factory.mktemp("grader")
    file, shared = folder / "secret", Path("/dev/shm") / f"svsa-{os.getpid()}"  # noqa: S108
    for path in (file, shared):
        path.write_bytes(secret)
    memory = ctypes.create_string_buffer(secret)
    hidden = f"svsa-{os.getpid()}"
    families = (
        (socket.AF_INET, ("127.0.0.1", 0)),
        (socket.AF_UNIX, str(folder / "line")),
        (socket.AF_UNIX, f"\0{hidden}"),
    )
    listeners = [socket.socket(family) for family, _ in families]
    for listener, (_, address) in zip(listeners, families, strict=True):
        listener.bind(address)
        listener.listen()
        threading.Thread(target=_tell, args=(listener, secret), daemon=True).start()
    sleeper = subprocess.Popen(
        [sys.executable, "-c", "input()"],
        stdin=subprocess.PIPE,
        env={"SVSA_CANARY": secret.decode()},
    )
    with file.open("rb") as opened:
        os.set_inheritable(opened.fileno(), True)
        yield {
            "pid": os.getpid(),
            "child": sleeper.pid,
            "file": str(file),
            "folder": str(folder),
            "shared": shared.name,
            "folder_bytes": FOLDER_BYTES,
            "port": listeners[0].getsockname()[1],
            "socket": families[1][1],
            "hidden": hidden,
            "descriptor": opened.fileno(),
            "address": ctypes.addressof(memory),
            "length": len(secret),
        }
    for listener in listeners:
        listener.close()
    sleeper.communicate(b"\n", timeout=30)
    shared.unlink()


@pytest.fixture(autouse=True)
def calm(clue, secret, tmp_path, monkeypatch):
    """The lab is unchanged: its secret, folders, processes, priority and time."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("SVSA_CANARY", secret.decode())
    folder, priority = Path(clue["folder"]), os.getpriority(os.PRIO_PROCESS, 0)
    before = list_children()
    begin = monotonic()
    yield
    assert monotonic() - begin < BOUNDS.whole_s + BOUNDS.start_s
    assert list_children() == before
    assert (folder / "secret").read_bytes() == secret
    assert list(tmp_path.iterdir()) == []
    assert os.getpriority(os.PRIO_PROCESS, 0) == priority


def list_children() -> set[str]:
    """Return the child processes of this process."""
    children: set[str] = set()
    for task in Path("/proc/self/task").iterdir():
        # A thread may end after it was listed, such as that which reads the output of a law.
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):
            children |= {*(task / "children").read_text().split()}
    return children


@pytest.mark.parametrize(("theme", "name"), list_attacks(), ids=lambda part: part)
def test_attack_reveals_nothing_and_disturbs_no_user(theme, name, clue, secret):
    ends = ENDS.get(name, {"refused"})
    outcome = attack(theme, name, clue, confine, SHORT if "late" in ends else PATIENT)
    assert outcome.ended in ends, outcome
    assert outcome.ended != "refused" or outcome.got.decode() in WALLS, outcome
    assert secret not in outcome.got
    assert hashlib.sha256(secret).digest()[:8] not in outcome.got
    assert sorted(path.name for path in Path(clue["folder"]).iterdir()) == ["line", "secret"]
    assert secret.decode() not in outcome.reported


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    ("theme", "name"), [one for one in list_attacks() if one[1] in REAL], ids=lambda part: part
)
def test_attack_succeeds_without_confinement(theme, name, clue, secret):
    outcome = attack(theme, name, clue, leave_open, PATIENT)
    (Path(clue["folder"]) / "written").unlink(missing_ok=True)
    assert outcome.ended == "got", outcome
    assert secret in outcome.got or not name.startswith(GETTING)


def test_every_attack_listed_as_successful_exists():
    names = [name for _, name in list_attacks()]
    assert len(names) == len(set(names)) >= 30
    assert {*REAL, *ENDS} <= set(names)


def test_law_in_an_endless_loop_is_ended_by_its_cpu_limit(clue):
    bounds = BOUNDS._replace(cpu_s=1, answer_s=50)
    outcome = attack("resources", "spin", clue, confine, bounds)
    assert outcome.ended == "ended"
    assert "1 s of the processor" in outcome.reported


def test_only_the_end_of_the_output_of_a_law_is_shown(clue):
    outcome = attack("resources", "crash", clue, confine)
    assert len(outcome.reported) < 3000
