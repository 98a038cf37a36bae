"""One contract for all families of drives, over a real bus to an emulator in another process.

A family subclasses `DriveContract`. The emulator is in lockstep, so the results of a test do not
depend on how busy the machine is.
"""

import contextlib
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, ClassVar

import can
import cantools
import pytest
import tomli_w

from svsa.errors import ParameterError
from svsa.hardware.description.dbc import describe_bench
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.conversion import build_motor_scale
from svsa.hardware.drives.drive import GATE_JITTER_S, compute_key, merge_stops
from svsa.hardware.drives.installed import build_drive, build_stop, get_family
from svsa.hardware.drives.phase import Phase
from svsa.hardware.emulator.experiment import EMULATOR_BENCH
from svsa.hardware.emulator.faults import Silence, Stall
from svsa.hardware.emulator.launch import RunningEmulator, start_emulator
from svsa.hardware.safety.heartbeat import Heartbeats
from tests.hardware.drives.rig import LONGEST_START_S, MOTORS, TICK_S, Rig

PUSH_MA = (400, -150)


class DriveContract:
    """Requirements of the bench. family: the name of its entry point. addresses: of two drives, as
    their sections in a bench file give them.
    """

    family: ClassVar[str]
    addresses: ClassVar[tuple[dict[str, Any], dict[str, Any]]]
    fd: ClassVar[bool] = False

    @pytest.fixture(scope="class")
    @classmethod
    def emulator(cls, tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningEmulator]:
        path = tmp_path_factory.mktemp("emulator") / "emulator.toml"
        examples = get_family(cls.family).examples
        constants = (0.0396, 0.0234)
        sections = {
            name: {
                "drive": cls.family,
                "torque_constant_nm_per_a": constants[number],
                "phase_s": (0.0003, 0.0005)[number],
                **examples[number],
            }
            for number, name in enumerate(MOTORS)
        }
        path.write_text(tomli_w.dumps(sections), encoding="utf-8")
        with start_emulator(True, 120.0, "--file", str(path)) as running:
            yield running

    @pytest.fixture
    def path(self, emulator: RunningEmulator, tmp_path: Path) -> Path:
        """A bench file with this family's drives, on the terminals of the emulator."""
        sections: dict[str, Any] = tomllib.loads(EMULATOR_BENCH.read_text(encoding="utf-8"))
        bus = {
            "interface": "slcan",
            "channel": emulator.slcan,
            "fd": self.fd,
            "timestamps": "arrival",
            "options": {"sleep_after_open": 0.0},
        }
        sections |= {"bus": bus, "supervisor_bus": {**bus, "channel": emulator.second_slcan}}
        for name, address in zip(MOTORS, self.addresses, strict=True):
            old = sections[name]
            for own in ("drive_group", "drive_number", "counts_per_rev"):
                old.pop(own, None)
            sections[name] = {**old, "drive": self.family, **address}
        path = tmp_path / "bench.toml"
        path.write_text(tomli_w.dumps(sections), encoding="utf-8")
        return path

    @pytest.fixture
    def rig(self, emulator: RunningEmulator, path: Path) -> Iterator[Rig]:
        rig = Rig(read_bench(path), emulator)
        yield rig
        rig.close()

    def test_start_up_ends_ready_without_torque(self, rig: Rig) -> None:
        rig.tick(count=5)
        assert rig.sent == [], "a drive that is off is sent nothing"
        rig.start()
        assert [drive.phase for drive in rig.drives] == [Phase.READY] * 2
        assert all(drive.engaged and not drive.errors and not drive.zeroed for drive in rig.drives)
        assert [drive.counts for drive in rig.drives] == [0, 0]
        assert rig.targets == [0.0, 0.0]
        assert not any(drive["errors"] for drive in rig.read())

    def test_current_becomes_torque_and_is_reported(self, rig: Rig) -> None:
        """Each drive produces its own current, with its own sign, and reports current and
        motion.
        """
        rig.start()
        rig.tick(PUSH_MA, 20)
        scales = [build_motor_scale(getattr(rig.bench, name)) for name in MOTORS]
        wanted = [ma * scale.torque_per_ma for ma, scale in zip(PUSH_MA, scales, strict=True)]
        assert rig.targets == pytest.approx(wanted, abs=1e-4)
        for drive, current in zip(rig.drives, PUSH_MA, strict=True):
            assert drive.current_ma == pytest.approx(current, rel=0.02)
            assert drive.counts * current > 0

    def test_feedback_arrives_in_every_tick(self, rig: Rig) -> None:
        rig.start()
        for _ in range(50):
            rig.tick(PUSH_MA)
            for drive in rig.drives:
                assert drive.heard_s is not None
                assert rig.clock.now() - drive.heard_s < 2.0 * TICK_S

    def test_feedback_is_available_with_constant_current(self, rig: Rig) -> None:
        """As the bench check listens: the drive neither becomes silent nor loses its current."""
        rig.start()
        rig.tick(PUSH_MA, 5)
        before = rig.targets
        for _ in range(150):
            rig.wait()
            for drive in rig.drives:
                drive.query(rig.bus, rig.clock.now())
        assert all(rig.clock.now() - (drive.heard_s or 0.0) < 3.0 * TICK_S for drive in rig.drives)
        assert rig.targets == before != [0.0, 0.0]

    def test_zero_current_acts_immediately_and_persists(self, rig: Rig) -> None:
        """Also after a reset, which the zero of the next ticks must not cancel."""
        rig.start()
        rig.tick(PUSH_MA, 5)
        rig.zero()
        rig.wait()
        assert rig.targets == [0.0, 0.0], "within a tick"
        rig.zero(5)
        for frame in merge_stops(*(build_stop(getattr(rig.bench, name)) for name in MOTORS))[2:]:
            rig.bus.send(frame)
        rig.wait(2.0 * TICK_S)
        rig.zero(50)
        assert rig.targets == [0.0, 0.0]
        assert not any(drive["mode"] for drive in rig.read()), "no mode, or stopped"

    def test_stop_works_in_any_state_of_the_drive(self, rig: Rig) -> None:
        """As the supervisor sends it: afterwards only a new start-up produces torque."""
        rig.start()
        rig.tick(PUSH_MA, 5)
        for frame in merge_stops(*(build_stop(getattr(rig.bench, name)) for name in MOTORS)):
            rig.bus.send(frame)
        rig.wait(2.0 * TICK_S)
        assert rig.targets == [0.0, 0.0]
        rig.start()
        assert rig.targets == [0.0, 0.0]
        rig.tick(PUSH_MA, 5)
        assert all(rig.targets)

    def test_drive_restarts_at_zero(self, rig: Rig) -> None:
        rig.start()
        rig.tick(PUSH_MA, 30)
        assert all(drive.counts for drive in rig.drives)
        rig.zero(5)
        rig.wait(0.3)
        rig.start()
        moved = [
            abs(drive.counts * build_motor_scale(getattr(rig.bench, name)).angle_per_count)
            for drive, name in zip(rig.drives, MOTORS, strict=True)
        ]
        assert max(moved) < 1e-3
        assert not any(drive.errors or drive.zeroed for drive in rig.drives)

    def test_commands_keep_the_required_gap(self, rig: Rig) -> None:
        rig.start()
        rig.tick(PUSH_MA, 20)
        for drive in rig.drives:
            times = [t for t, message in rig.sent if compute_key(message) in drive.obeyed_ids]
            gaps = [later - earlier for earlier, later in pairwise(times)]
            assert len(gaps) > 20
            assert min(gaps) >= drive.gap_s - GATE_JITTER_S - 1e-9

    def test_drive_without_responses_is_silent(self, rig: Rig) -> None:
        rig.control.fault(Silence(node="motor2"))
        assert rig.start() < LONGEST_START_S
        assert [drive.phase for drive in rig.drives] == [Phase.READY, Phase.SILENT]

    def test_error_of_the_drive_is_counted_and_described(self, rig: Rig) -> None:
        rig.start()
        assert [drive.errors for drive in rig.drives] == [0, 0]
        rig.control.fault(Stall(node="motor2"))
        rig.tick(count=150)
        assert rig.drives[0].errors == 0
        assert rig.drives[1].errors > 0
        assert rig.drives[1].describe_error()

    def test_query_is_answered_in_any_state_without_torque(self, rig: Rig) -> None:
        for drive in rig.drives:
            drive.ask(rig.bus, rig.clock.now())
        rig.wait(5.0 * TICK_S)
        assert [drive.answers for drive in rig.drives] == [1, 1]
        assert rig.targets == [0.0, 0.0]

    def test_every_drive_on_the_bus_is_found_by_its_address(self, rig: Rig) -> None:
        family = get_family(self.family)
        for question in family.list_questions():
            rig.bus.send(question)
            rig.wait()
        rig.wait(0.05)
        found = {place for message in rig.heard if (place := family.find_place(message))}
        assert found == {drive.place for drive in rig.drives}

    def test_transmitted_and_received_frames_are_distinguished(self, rig: Rig) -> None:
        one, two = rig.drives
        assert not one.heard_ids & two.heard_ids
        assert not (one.heard_ids | two.heard_ids) & (one.obeyed_ids | two.obeyed_ids)
        for name, drive in zip(MOTORS, rig.drives, strict=True):
            stop = build_stop(getattr(rig.bench, name))
            assert {compute_key(frame) for frame in (*stop.zero, *stop.reset)} <= drive.obeyed_ids
        rig.start()
        rig.tick(PUSH_MA, 3)
        assert {compute_key(message) for _, message in rig.sent} <= one.obeyed_ids | two.obeyed_ids

    @pytest.mark.parametrize("length", range(9))
    def test_invalid_bytes_are_ignored(self, path: Path, length: int) -> None:
        drive = build_drive(read_bench(path).motor1, TICK_S, 1e6)
        for key in sorted(drive.heard_ids):
            for byte in (0x00, 0x55, 0x80, 0xFF):
                drive.take(
                    can.Message(
                        arbitration_id=key & 0x1FFFFFFF,
                        is_extended_id=key > 0x1FFFFFFF,
                        data=bytes([byte] * length),
                    ),
                    0.0,
                )
        assert drive.describe_error()

    @pytest.mark.exhaustive
    def test_capture_is_decoded_with_its_dbc(self, rig: Rig) -> None:
        """Every frame on the bus has a message, in both directions."""
        database = cantools.database.load_string(describe_bench(rig.bench), "dbc")
        rig.start()
        rig.tick(PUSH_MA, 5)
        known = {message.frame_id for message in database.messages}
        theirs = [message for message in rig.heard if compute_key(message) in rig.takers]
        assert theirs
        for message in (*theirs, *(message for _, message in rig.sent)):
            assert message.arbitration_id in known
            assert (
                database.decode_message(message.arbitration_id, message.data, allow_truncated=True)
                is not None
            )

    @pytest.mark.exhaustive
    def test_two_drives_with_one_address_are_rejected(self, path: Path) -> None:
        sections = tomllib.loads(path.read_text(encoding="utf-8"))
        sections["motor2"] |= self.addresses[0]
        path.write_text(tomli_w.dumps(sections), encoding="utf-8")
        with pytest.raises(ParameterError, match=r"motor2\..*different from motor1's"):
            read_bench(path)

    @pytest.mark.exhaustive
    def test_supervisor_stops_the_drive_if_the_loop_is_silent(self, rig: Rig, path: Path) -> None:
        """A third process with its own bus: only its stop ends the mode."""
        beats = Heartbeats.create()
        command = [sys.executable, "-m", "svsa.hardware.safety.supervisor", str(path), beats.name]
        try:
            rig.start()
            with _run(command):
                end = time.monotonic() + 60.0
                while beats.age_s("supervisor") > 1.0:
                    assert time.monotonic() < end
                    rig.tick(PUSH_MA)
                assert all(rig.targets)
                beats.beat("loop")
                while not beats.stops:
                    assert time.monotonic() < end
                    time.sleep(0.001)
                # Its frames arrive at any time; a watchdog of the drive leaves the mode set.
                while any(drive["mode"] for drive in rig.read()):
                    assert time.monotonic() < end
                    rig.wait()
            assert rig.targets == [0.0, 0.0]
        finally:
            beats.close()


@contextlib.contextmanager
def _run(command: list[str]) -> Iterator[None]:
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.kill()
        process.wait()
