"""Image, compose files and unit of docs/deploy."""

import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest
import yaml

from svsa_server.config import Settings, write_example
from tests.lab import run_lab
from tests.waiting import follow_recording

ROOT = Path(__file__).parents[2]
DEPLOY = ROOT / "docs" / "deploy"
LABS = ("simulated", "class", "bench")


def read_compose(name: str) -> dict:
    return yaml.safe_load((DEPLOY / f"{name}.yaml").read_text(encoding="utf-8"))


def test_example_has_every_setting_with_its_default() -> None:
    assert (DEPLOY / "lab.env").read_text(encoding="utf-8") == write_example(), "run `make schema`"


@pytest.mark.parametrize("name", LABS)
def test_each_lab_extends_the_service_without_privileges(name: str) -> None:
    lab = read_compose(name)["services"]["lab"]
    assert lab["extends"] == {"file": "lab.yaml", "service": "lab"}
    common = read_compose("lab")["services"]["lab"]
    assert common["read_only"]
    assert common["cap_drop"] == ["ALL"]
    assert (DEPLOY / common["build"] / "Dockerfile").is_file()
    volumes = {volume.partition(":")[0] for volume in common["volumes"]}
    assert volumes <= {*read_compose(name)["volumes"]}


@pytest.mark.parametrize("name", ["lab", "class"])
def test_each_container_has_a_limit_of_memory_and_processes(name: str) -> None:
    for service in read_compose(name)["services"].values():
        if "extends" not in service:
            assert {"mem_limit", "pids_limit"} <= {*service}


def test_containers_and_unit_allow_the_connections_of_a_class() -> None:
    common = read_compose("lab")["services"]["lab"]
    unit = (DEPLOY / "svsa.service").read_text(encoding="utf-8")
    limits = [common["ulimits"]["nofile"], int(unit.partition("LimitNOFILE=")[2].split()[0])]
    assert min(limits) > 2 * Settings.model_fields["max_connections"].default


@pytest.mark.parametrize("name", LABS)
def test_documented_command_sets_the_required_variables(name: str) -> None:
    text = (DEPLOY / f"{name}.yaml").read_text(encoding="utf-8")
    required = set(re.findall(r"\$\{(\w+):\?", text))
    documented = (ROOT / "docs" / "howto" / "deploy.md").read_text(encoding="utf-8")
    command = f"docker compose -f {name}.yaml up"
    for source in (text, documented):
        (given,) = re.findall(rf"[#`] *([^#`]*){re.escape(command)}", source)
        assert set(re.findall(r"(\w+)=", given)) == required


@pytest.mark.parametrize("name", ["lab", *LABS])
def test_compose_files_set_existing_settings(name: str) -> None:
    known = {f"SVSA_{field.upper()}" for field in Settings.model_fields}
    text = (DEPLOY / f"{name}.yaml").read_text(encoding="utf-8")
    assert set(re.findall(r"SVSA_\w+", text)) <= known


def test_image_installs_existing_extras() -> None:
    (extras,) = re.findall(r"^ARG EXTRAS=(.*)$", (ROOT / "Dockerfile").read_text(), re.MULTILINE)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert {*extras.split(",")} <= {*project["optional-dependencies"]}


def test_image_has_every_file_that_the_guide_links_to() -> None:
    """The guide is built with warnings as errors, so a missing file stops the build."""
    copied = re.findall(r"^COPY (?!--)(.*) \S+$", (ROOT / "Dockerfile").read_text(), re.MULTILINE)
    sources = [(ROOT / name).resolve() for line in copied for name in line.split()]
    for page in [*DEPLOY.parent.rglob("*.md"), ROOT / "svsa" / "README.md", ROOT / "CHANGELOG.md"]:
        if {"_build", "generated"} & {*page.parts}:
            continue
        for link in re.findall(r"\]\((?!\w+:)([^)#]+)", page.read_text(encoding="utf-8")):
            target = (page.parent / link).resolve()
            if target.is_file():
                assert any(target.is_relative_to(one) for one in sources), f"{page}: {link}"


@pytest.mark.skipif(shutil.which("caddy") is None, reason="caddy is not installed")
def test_caddy_accepts_the_file_of_the_class() -> None:
    command = ["caddy", "adapt", "--config", str(DEPLOY / "Caddyfile"), "--adapter", "caddyfile"]
    done = subprocess.run(command, capture_output=True, text=True, env={"SVSA_HOSTS": "lab.test"})
    assert done.returncode == 0, done.stderr
    assert "lab.test" in done.stdout
    assert "lab:8000" in done.stdout


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="systemd is not installed")
def test_systemd_accepts_the_unit() -> None:
    unit = DEPLOY / "svsa.service"
    done = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True)
    problems = [line for line in done.stderr.splitlines() if "svsa.service" in line]
    assert all("is not executable" in line for line in problems), done.stderr


@pytest.mark.exhaustive
def test_lab_runs_on_a_read_only_file_system(tmp_path: Path) -> None:
    """As in the containers: only the data folder and /tmp are writable."""
    script = """set -e
    for folder in "$0" /tmp; do mount --bind "$folder" "$folder"; done
    mount -o remount,bind,ro /
    exec "$@"
    """
    within = ["unshare", "--mount", "sh", "-c", script, str(tmp_path)]
    if subprocess.run([*within, "true"], capture_output=True, check=False).returncode:
        pytest.skip("this account cannot mount a file system")
    assert subprocess.run([*within, "touch", "/written"], capture_output=True).returncode
    with run_lab(within=within, data=str(tmp_path)) as lab:
        assert lab.client.get("/").is_success
        state = lab.client.post(f"{lab.session}/recording", json={}).raise_for_status().json()
        lab.jump(1)
        lab.client.delete(f"{lab.session}/recording").raise_for_status()
        run = follow_recording(lab.client, f"/api/v1/runs/{state['recording']['run_id']}")
        assert run["state"] == "complete"
