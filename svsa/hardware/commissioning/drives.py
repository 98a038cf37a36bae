"""Check the bus, the answers of both drives, and their change to current mode."""

import numpy as np

from svsa.hardware.commissioning.probe import Probe
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.commissioning.traffic import Traffic
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import advise_on_adapter
from svsa.hardware.drives.installed import get_family
from svsa.hardware.drives.phase import Phase

QUIET_S = 0.3
ECHOES = 20
ATTEMPTS = 3
ECHO_S = 0.05
SLOW_ECHO_S = 0.002

STEP_S = 0.001
RESET_S = 0.02
"""Time for which a drive that was reset may still deliver feedback, s."""


def describe_wiring(bench: BenchFile) -> str:
    """Describe the wiring to check."""
    presets = dict.fromkeys(
        get_family(motor.drive).advice.wiring for motor in (bench.motor1, bench.motor2)
    )
    return (
        "CAN_H to CAN_H, CAN_L to CAN_L and ground; 120 Ω at both ends of the bus and nowhere else"
        " (60 Ω between CAN_H and CAN_L with the power off); every node at the bit rate of the"
        f" bench file ({'; '.join(presets)})"
    )


def check_bus(probe: Probe) -> CheckStep:
    """Listen only: detect error frames and other programs that command the drives."""
    traffic = probe.listen(QUIET_S)
    bus = probe.bench.bus
    emulated = ", EMULATED: this bus has no real bench" if probe.emulated else ""
    measured = (
        f"{bus.interface} {bus.channel} is open, {bus.bitrate / 1000:g} kbit/s,"
        f" {traffic.frames / QUIET_S:.0f} frames/s, {traffic.bus_errors} error frames{emulated}"
    )
    if traffic.commanded or traffic.engaged:
        advice = (
            "A drive is in use: another program sends it commands or has left it in a mode. End"
            " that program (the lab's server, another check), switch the drives off and on."
        )
        if traffic.commanded:
            return CheckStep("bus", Result.FAIL, measured, advice)
        return CheckStep("bus", Result.WARN, measured, advice)
    if traffic.bus_errors:
        return CheckStep("bus", Result.FAIL, measured, advise_on_bus(probe.bench))
    return CheckStep("bus", Result.OK, measured)


def advise_on_bus(bench: BenchFile) -> str:
    """Advise on a bus that does not open or has many errors."""
    return f"{advise_on_adapter(bench.bus)} Then the wiring: {describe_wiring(bench)}."


def check_drive(probe: Probe, name: str) -> CheckStep:
    """Query a drive repeatedly; measure whether and how fast it answers."""
    title = f"{name}: drive {probe.drives[name].place}"
    probe.drain()
    delays = []
    for attempt in range(ECHOES):
        traffic, sent = Traffic(), probe.now()
        probe.ask(name)
        for _ in probe.follow(ECHO_S, traffic):
            if name in traffic.answers:
                delays.append(traffic.answers[name][0] - sent)
                break
        # A drive that is silent three times will not answer the other attempts either.
        if attempt == ATTEMPTS - 1 and not delays:
            break
    if not delays:
        return CheckStep(title, Result.FAIL, "no answer", _advise_on_silence(probe, name))
    median, worst = 1e3 * float(np.median(delays)), 1e3 * max(delays)
    measured = (
        f"{len(delays)} of {ECHOES} queries answered, after {median:.2f} ms (worst {worst:.2f} ms)"
    )
    wiring = describe_wiring(probe.bench)
    if len(delays) < ECHOES:
        return CheckStep(title, Result.FAIL, measured, f"Frames are lost. Check: {wiring}.")
    if median > 1e3 * SLOW_ECHO_S:
        advice = (
            "The adapter is too slow for a loop of 1 kHz: set the latency timer of a USB serial"
            " adapter to 1 ms, use a driver without polling, or a period_s of 0.002."
        )
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)


def _advise_on_silence(probe: Probe, name: str) -> str:
    """Query every address, and report at which a drive answers."""
    traffic = probe.query_all_addresses(name)
    place, advice = probe.drives[name].place, probe.families[name].advice
    if traffic.places:
        return (
            f"A drive answers at {', '.join(sorted(traffic.places))}: set it to {place} with the"
            " maker's program, or correct the bench file."
        )
    if traffic.answers:
        return (
            f"Only the other drive answers. Check that {advice.supply}, its bus connector, and"
            f" that it is not still at the factory address ({advice.factory}) together with the"
            " other: switch the other one off and run the check again."
        )
    wiring = describe_wiring(probe.bench)
    return (
        f"No drive answers at any address. Check that {advice.supply}. Then the wiring: {wiring}."
    )


def bring_up(probe: Probe) -> CheckStep:
    """Start up both drives as when arming, and send zero current."""
    title, begin = "mode sequence", probe.now()
    obstinate: set[str] = set()
    probe.begin()
    while probe.advance():
        traffic = probe.listen(STEP_S)
        if probe.now() - begin > RESET_S:
            resetting = {n for n, drive in probe.drives.items() if drive.phase is Phase.RESET}
            obstinate |= traffic.engaged & resetting
    if obstinate:
        return CheckStep(
            title,
            Result.FAIL,
            f"{' and '.join(sorted(obstinate))} did not leave its mode at the reset",
            "Switch the drives off and on, and check that no other program uses the bus.",
        )
    refused = [name for name, drive in probe.drives.items() if drive.phase is Phase.SILENT]
    if refused:
        return CheckStep(
            title,
            Result.FAIL,
            f"{' and '.join(refused)} sent no feedback after the mode was set",
            "The drive has not taken the mode: switch it off and on and try again;"
            f" {probe.families[refused[0]].advice.mode}.",
        )
    for name in probe.motors:
        probe.send_current(name, 0)
    return CheckStep(
        title, Result.OK, f"reset, mode, zero current: taken in {probe.now() - begin:.2f} s"
    )
