"""What a replay tells of the commands of its run."""

import svsa
from svsa.run.command import build_command
from svsa_server.replay_export import list_marks


def test_a_push_is_one_mark_on_and_one_off_in_a_replay() -> None:
    configuration = svsa.paper.get_figure("4b").build_configuration(load=False)
    commands = [
        build_command(100, "law", "fl"),
        *(
            build_command(tick, "load", svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0), hold_s=0.3))
            for tick in range(1000, 2000, 200)
        ),
        build_command(2000, "unload", 1),
        build_command(3000, "load", svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0), hold_s=0.3)),
        build_command(4000, "load", svsa.PaperLoad()),
    ]
    told = [
        (mark["tick"], mark.get("label", mark.get("kind")))
        for mark in list_marks(configuration, commands)
    ]
    assert told == [
        (100, "law"),
        (1000, "Push on"),
        (2000, "Push off"),
        (3000, "Push on"),
        (3300, "Push off"),
        (4000, "load"),
    ]
