"""The confinement of the class's container: its filter of system calls and its AppArmor profile."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from svsa.teaching.isolation.confinement import BOUNDS, confine
from svsa.teaching.isolation.probe import find_isolation_problem
from tests.package import confined

ROOT = Path(__file__).parents[2]
DEPLOY = ROOT / "docs" / "deploy"
PROFILE = json.loads(confined.PROFILE.read_bytes())
DEFAULT_SHA256 = "72363a20c52cf1099c8bff16a0c42f3938b01ed538d5f9b13fac851cd02fa2b9"
"""Docker's default profile: `seccomp/default.json` of moby/profiles at commit 02e898b137ae, as JSON
with sorted keys and names.
"""
NEW_USER = 0x10000000
ADDED = {
    "clone": [{"index": 0, "value": NEW_USER, "valueTwo": NEW_USER, "op": "SCMP_CMP_MASKED_EQ"}],
    "mount": [],
    "umount2": [],
    "pivot_root": [],
    "sethostname": [],
}
DENIED = (
    "mount", "umount2", "pivot_root", "sethostname", "unshare", "clone", "setns", "bpf", "ptrace",
    "kexec_load", "init_module", "delete_module", "keyctl", "add_key", "perf_event_open",
    "io_uring_setup", "userfaultfd", "reboot", "swapon", "open_tree", "move_mount", "fsopen",
    "socket",
)  # fmt: skip
needs_linux = pytest.mark.skipif(sys.platform != "linux", reason="seccomp is Linux's")


def require(tool: str) -> str:
    """Return the path of a tool; `.ci/run` installs it, so that no test is skipped there."""
    path = shutil.which(tool)
    if path is None:
        assert "CI" not in os.environ, f"{tool} is missing: .ci/run installs it"
        pytest.skip(f"{tool} is not installed")
    return path


@pytest.fixture(scope="module")
def isolation() -> None:
    problem = find_isolation_problem()
    if problem is not None:
        assert "SVSA_MUST_ISOLATE" not in os.environ, problem
        pytest.skip(problem)


def test_profile_is_docker_s_default_with_the_stated_additions() -> None:
    rules, added = PROFILE["syscalls"], {}
    while rules[-1].get("comment", "").startswith("bubblewrap"):
        rule = rules.pop()
        assert rule["action"] == "SCMP_ACT_ALLOW"
        added |= {name: rule.get("args", []) for name in rule["names"]}
    assert added == ADDED
    for rule in rules:
        rule["names"].sort()
    default = json.dumps(PROFILE, sort_keys=True).encode()
    assert hashlib.sha256(default).hexdigest() == DEFAULT_SHA256
    assert PROFILE["defaultAction"] == "SCMP_ACT_ERRNO"


@needs_linux
def test_additions_are_the_calls_that_bubblewrap_makes(isolation: None, tmp_path: Path) -> None:
    """Each added call occurs in the trace of a law; each traced call is permitted."""
    trace = tmp_path / "trace"
    with confine(b"def law(*_): return 0.0, 0.0\n", 1, BOUNDS) as command:
        traced = [require("strace"), "-f", "-qq", "-o", str(trace), *command.words]
        subprocess.run(traced, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    # strace has once shown the number -10 (of 214 traces). The kernel has no call with a negative
    # number, and no profile can permit or deny it.
    calls = {*re.findall(r"^\d+ +(?!syscall_0xf{9})(\w+)\(", trace.read_text(), re.MULTILINE)}
    assert {*ADDED} <= calls
    permitted = {name for rule in confined.list_rules() for name in rule["names"]}
    assert calls <= permitted | {*ADDED}


@needs_linux
@pytest.mark.exhaustive
def test_law_runs_under_the_options_of_the_class(isolation: None) -> None:
    """And it does not under Docker's default profile, so that the additions are needed."""
    script = "from svsa.teaching.isolation.probe import find_isolation_problem as f; print(f())"
    done = run_confined(script)
    assert done.stdout.strip() == "None", done.stdout + done.stderr
    assert "bwrap: " in run_confined(script, "SVSA_WITHOUT=bubblewrap").stdout


@needs_linux
def test_server_itself_can_make_no_privileged_call(isolation: None) -> None:
    done = run_confined(
        f"from tests.package.confined import list_permitted; print(list_permitted({DENIED!r}))"
    )
    assert done.stdout.strip() == "[]", done.stdout + done.stderr


def run_confined(script: str, *environment: str) -> subprocess.CompletedProcess[str]:
    """Run Python in the class's container as far as this machine can: no capabilities, no new
    privileges, the filter, and Docker's read-only /proc/sys.
    """
    options = yaml.safe_load((DEPLOY / "class.yaml").read_text())["services"]["lab"]["security_opt"]
    assert f"seccomp:{confined.PROFILE.name}" in options
    command = [sys.executable, "-m", "tests.package.confined", script]
    if os.geteuid() == 0:
        # The container's user is not root: only root needs CAP_SETFCAP to map itself (uid_map).
        without = ["setpriv", "--bounding-set=-all,+setfcap", "--inh-caps=-all", "--no-new-privs"]
        command = [*without, *command]
        mask = "mount --bind /proc/sys /proc/sys && mount -o remount,bind,ro /proc/sys"
        command = ["unshare", "--mount", "sh", "-c", f'{mask} && exec "$@"', "sh", *command]
    return subprocess.run(
        ["env", *environment, *command], cwd=ROOT, capture_output=True, text=True, check=False
    )


def test_apparmor_accepts_the_profile_of_the_class() -> None:
    parser = shutil.which("apparmor_parser") or require("/usr/sbin/apparmor_parser")
    command = [parser, "--skip-kernel-load", "--skip-cache", str(DEPLOY / "apparmor")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (name,) = re.findall(r"^profile (\S+)", (DEPLOY / "apparmor").read_text(), re.MULTILINE)
    assert f"apparmor:{name}" in (DEPLOY / "class.yaml").read_text()
