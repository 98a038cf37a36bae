"""The loop of another actuator is compiled in a process of its own."""

import asyncio

from svsa_server import compiled_loops
from svsa_server.compiled_loops import compile_for


def test_actuator_is_compiled_in_a_process_while_other_requests_are_served(monkeypatch, tmp_path):
    """Two requests start it once; the event loop is free meanwhile."""
    started, ended = tmp_path / "started", tmp_path / "ended"
    program = (
        "import pathlib, sys, time\n"
        f"with open({str(started)!r}, 'a') as file: file.write(str(sys.argv[1:]) + ';')\n"
        f"while not pathlib.Path({str(ended)!r}).exists(): time.sleep(0.01)"
    )

    def is_compiled(control, kind=""):
        return started.exists() and kind != ""

    monkeypatch.setattr(compiled_loops, "is_compiled_before", is_compiled)
    monkeypatch.setattr(compiled_loops, "COMPILE", f"exec({program!r})")
    monkeypatch.setattr(compiled_loops, "_compiling", asyncio.Lock())
    assert compiled_loops.is_compiled_for("svsa", "ndobc")
    assert not compiled_loops.is_compiled_for("qbmove", "ndobc")

    async def compile_twice():
        requests = [asyncio.create_task(compile_for("qbmove", "ndobc")) for _ in range(2)]
        waited = []
        while not all(request.done() for request in requests):
            await asyncio.sleep(0.01)
            if (compiling_s := compiled_loops.find_compiling_s()) is not None:
                waited.append(compiling_s)
            if len(waited) > 10:
                ended.touch()
        return waited

    assert compiled_loops.find_compiling_s() is None
    waited = asyncio.run(compile_twice())
    assert len(waited) > 10
    assert waited == sorted(waited)
    assert compiled_loops.find_compiling_s() is None
    assert started.read_text() == "['compile', 'ndobc', '--actuator', 'qbmove'];"
