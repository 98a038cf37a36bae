"""Line styles of laws in the pictures of runs."""

import itertools

from svsa.control.installed import list_law_names
from svsa.runs.result.law_style import style_law


def test_each_law_and_other_controllers_have_a_unique_style() -> None:
    laws = [*list_law_names(), "own"]
    looks = [(style["color"], style["linestyle"]) for style in map(style_law, laws)]
    assert len(laws) > 18
    assert len(set(looks)) == len(laws)


def test_adjacent_laws_differ_in_color_and_dash() -> None:
    looks = [style_law(law) for law in list_law_names()]
    for one, other in itertools.pairwise(looks):
        assert one["color"] != other["color"]
        assert one["linestyle"] != other["linestyle"]
