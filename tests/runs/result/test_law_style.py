"""How laws are distinguished in the pictures of runs."""

import itertools

from svsa.control.installed import list_law_names
from svsa.runs.result.law_style import style_law


def test_no_two_installed_laws_look_the_same_nor_does_another_controller() -> None:
    laws = [*list_law_names(), "own"]
    looks = [(style["color"], style["linestyle"]) for style in map(style_law, laws)]
    assert len(laws) > 18
    assert len(set(looks)) == len(laws)


def test_laws_that_stand_next_to_one_another_differ_in_colour_and_in_dash() -> None:
    looks = [style_law(law) for law in list_law_names()]
    for one, other in itertools.pairwise(looks):
        assert one["color"] != other["color"]
        assert one["linestyle"] != other["linestyle"]
