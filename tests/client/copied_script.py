"""The script that *Copy this experiment as a script* produces, written by the page's code."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import httpx

PAGE = Path(__file__).parents[2] / "frontend" / "web"
WRITE = """
import {{ writeExperiment }} from "./experiment.js";
import {{ readFileSync }} from "node:fs";
const origin = JSON.parse(readFileSync("origin.json", "utf8"));
process.stdout.write(writeExperiment(origin, "Compared with a load", {lab!r}));
"""
END_S = 1.5
LONGEST_S = 300.0


def do_experiment(lab: httpx.Client) -> dict:
    """Change several settings of a private session, and return its origin."""
    with_law = {"figure": "4a", "law": "ndobc", "load": False}
    name = lab.post("/api/v1/sessions", json=with_law).raise_for_status().json()["session"]
    path = f"/api/v1/sessions/{name}"

    def report(method: str, below: str, body: object = None) -> None:
        lab.request(method, path + below, json=body).raise_for_status()

    report("POST", "/pause")
    report("PUT", "/stiffness", {"kind": "constant", "stiffness_nm_per_rad": 20.0})
    report("PUT", "/position", {"kind": "constant", "position_rad": 0.0})
    report("POST", "/reset")
    report("POST", "/step", {"ticks": 500})
    report("PUT", "/position", {"kind": "constant", "position_rad": 0.1})
    report("POST", "/loads", {"kind": "constant", "torque_nm": [0.5, 0.0, 0.0]})
    report("POST", "/step", {"ticks": 500})
    report("PUT", "/law", {"law": "fl"})
    report("POST", "/step", {"ticks": 500})
    return lab.get(path + "/origin").raise_for_status().json()


def bundle_writer(folder: Path) -> None:
    """Bundle the part of the page that writes scripts, as a module for Node."""
    bundler = PAGE / "node_modules" / "rolldown" / "bin" / "cli.mjs"
    source = PAGE / "src" / "lab" / "script" / "experiment.ts"
    _run_node(folder, str(bundler), str(source), "--format", "esm", "--dir", str(folder))


def write_script(origin: dict, lab: str, folder: Path) -> Path:
    """Write the script of an experiment with this address of a lab. folder: with the writer."""
    (folder / "origin.json").write_text(json.dumps(origin), encoding="utf-8")
    (folder / "write.mjs").write_text(WRITE.format(lab=lab), encoding="utf-8")
    path = folder / "experiment.py"
    path.write_bytes(_run_node(folder, "write.mjs"))
    return path


def write_copied_script(origin: dict, lab: str, folder: Path) -> Path:
    """`write_script`, in a folder without the writer."""
    bundle_writer(folder)
    return write_script(origin, lab, folder)


def _run_node(folder: Path, *arguments: str) -> bytes:
    node = shutil.which("node", path=str(Path(sys.executable).parent)) or shutil.which("node")
    assert node, "Node comes with the build requirements"
    done = subprocess.run(
        [node, *arguments], cwd=folder, check=True, capture_output=True, timeout=LONGEST_S
    )
    return done.stdout


def start_script(path: Path, token: str, *arguments: str) -> subprocess.Popen[str]:
    """Start the script in a separate process, with this token."""
    return subprocess.Popen(
        [sys.executable, str(path), *arguments],
        env={**os.environ, "SVSA_SECRET": token},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def finish_script(script: subprocess.Popen[str], laws: tuple[str, ...]) -> float:
    """Return its session time, s; it must have printed the error of each lane."""
    reported, _ = script.communicate(timeout=LONGEST_S)
    assert script.returncode == 0, reported
    *lanes, last = reported.splitlines()
    assert [line.partition(":")[0] for line in lanes] == [*laws], reported
    return float(last.removeprefix("reached ").removesuffix(" s"))
