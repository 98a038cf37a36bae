"""`svsa emulator`: the emulator as a command."""

import math
import signal
from pathlib import Path
from typing import Annotated

import typer


def emulator(
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port of the socketcand server.")
    ] = 29536,
    control_port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port that accepts loads and faults.")
    ] = 29537,
    lockstep: Annotated[
        bool, typer.Option("--lockstep", help="Time advances only when a client requests it.")
    ] = False,
    real_time: Annotated[
        bool | None,
        typer.Option(
            "--real-time/--ordinary-time",
            help="Request real-time priority; default: only without --lockstep.",
        ),
    ] = None,
    actuator: Annotated[
        str | None, typer.Option(help="Installed actuator; its prototype is emulated.")
    ] = None,
    file: Annotated[
        Path | None,
        typer.Option(help="Parameters of the emulator (TOML); default: the actuator's prototype."),
    ] = None,
    write_bench: Annotated[
        Path | None,
        typer.Option(
            help="Write the bench file of this emulator for `svsa serve --bench`, and its"
            " calibration record next to it."
        ),
    ] = None,
    idle_s: Annotated[
        float,
        typer.Option(
            min=0, help="Time without a client after which the emulator ends, s; 0: never."
        ),
    ] = 0.0,
    alone_s: Annotated[
        float,
        typer.Option(
            min=0,
            help="In lockstep: time after which the emulator continues automatically if no loop"
            " requests time, for example because the loop has ended, s; 0: never.",
        ),
    ] = 0.0,
) -> None:
    """Emulate the bench of an actuator on CAN: two drives, an encoder and the mechanism.

    Clients connect to its socketcand server (interface `socketcand` of python-can), or to the
    terminal that it prints (interface `slcan`, also CAN FD). Only clients of this machine can
    connect.
    """
    from svsa.actuators.parameters import SVSA
    from svsa.errors import ParameterError, Violation
    from svsa.hardware.emulator import bench_file
    from svsa.hardware.emulator.control import ControlServer
    from svsa.hardware.emulator.emulator import Emulator
    from svsa.hardware.emulator.parameters import (
        build_emulator_parameters,
        read_emulator_parameters,
    )
    from svsa.hardware.emulator.process import EmulatorProcess
    from svsa.hardware.emulator.slcan import SlcanServer
    from svsa.hardware.emulator.socketcand import SocketcandServer
    from svsa.hardware.schedule import EMULATOR_PRIORITY, request_real_time

    if file is not None and (actuator is not None or write_bench is not None):
        bound = "omitted with --file, which describes actuator and motors"
        name, value = ("--actuator", actuator) if actuator else ("--write-bench", str(write_bench))
        raise ParameterError(Violation(name, value, "", bound))
    parameters = (
        read_emulator_parameters(file) if file else build_emulator_parameters(actuator or SVSA)
    )
    machine = Emulator(parameters)
    host = "127.0.0.1"
    terminals, network = (SlcanServer(), SlcanServer()), SocketcandServer(host, port)
    control = ControlServer(machine, host, control_port)
    process = EmulatorProcess(
        machine, [network, *terminals], control, lockstep, idle_s, alone_s or math.inf
    )

    def stop(*_: object) -> None:
        process.stopped = True

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    if write_bench is not None:
        bench_file.write_bench(write_bench, parameters, network.port, control.port, lockstep)
    mode = "EMULATED, lockstep" if lockstep else "EMULATED"
    print(
        f"SVSA emulator: socketcand {host}:{network.port}, slcan"
        f" {terminals[0].path} {terminals[1].path},"
        f" control {host}:{control.port} ({mode})",
        flush=True,
    )
    if real_time if real_time is not None else not lockstep:
        request_real_time(EMULATOR_PRIORITY)  # real hardware does not wait for other programs
    try:
        process.run()
    finally:
        for server in (*terminals, network, control):
            server.close()


if __name__ == "__main__":
    typer.run(emulator)
