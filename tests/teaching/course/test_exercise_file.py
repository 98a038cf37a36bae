"""Exercise files: valid ones are read, and an invalid one is reported with place and reason."""

from pathlib import Path

import pytest

from svsa.errors import ParameterError
from svsa.teaching.course.file import (
    list_exercise_files,
    parse_exercise,
    read_course,
)
from svsa.teaching.course.text import render_text

EXERCISE = """+++
number = 7
title = "A first one"
goal = "See an error."

[[steps]]
name = "guess"
kind = "predict"
title = "Guess"
asks = "Error"
unit = "°"
low = 0.0
high = 90.0
judged_by = "run.error"

[[steps]]
name = "run"
kind = "experiment"
title = "Run"
law = "fl"
duration_s = 8.0

[steps.base]
figure = "4a"

[[steps.measures]]
name = "error"
label = "Error"
channel = "position_error_rad"
statistic = "rms"
from_s = 7.0
to_s = 8.0
unit = "°"

[[steps.criteria]]
title = "It stays"
measure = "error"
low = 11.0

[[steps]]
name = "end"
kind = "submit"
title = "Submit"
+++

Before all.

## guess

What is $\\Gamma w / c_0$?

## run

Look.

```
## not-a-heading
```

## end

That is it.
"""


def read(text=EXERCISE):
    return parse_exercise(text, "first", "first.md")


def test_front_matter_and_sections_become_steps():
    exercise = read()

    assert [step.kind for step in exercise.steps] == ["predict", "experiment", "submit"]
    assert exercise.text == "Before all."
    assert exercise.steps[1].text == "Look.\n\n```\n## not-a-heading\n```"
    assert exercise.max_points == 3.0
    assert exercise.steps[1].configuration.law == "fl"


WRONG = {
    "unknown key": ('goal = "See an error."', 'gaol = "x"', "line 4", "gaol"),
    "a value out of range": ("duration_s = 8.0", "duration_s = 80.0", "line 21", "at most 60"),
    "no such law": ('law = "fl"', 'law = "fi"', "line 20", "law"),
    "no such channel": (
        'channel = "position_error_rad"',
        'channel = "position_eror_rad"',
        "line 29",
        "channel",
    ),
    "a window beyond the run": ("to_s = 8.0", "to_s = 9.0", "line 32", "at most duration_s, 8 s"),
    "a setting that is none": ('figure = "4a"', 'figure = "9"', "line 24", "one of 4a"),
    "nothing judges it": ('"run.error"', '"run.eror"', "line 14", "one of run.error"),
    "judged in another unit": ('unit = "°"\nlow', 'unit = "rad"\nlow', "line 11", "'°'"),
    "a criterion of no measure": (
        'measure = "error"',
        'measure = "size"',
        "line 37",
        "one of error",
    ),
    "two of a name": ('name = "run"', 'name = "guess"', "line 17", "given once"),
    "no text": ("## run\n\nLook.", "Look.", "line 16", "no text under a heading '## run'"),
    "a text of no step": ("## end", "## ende", "line 60", "one of the steps: guess, run, end"),
    "no TOML": ("low = 0.0", "low = ", "", "at line 12"),
}


@pytest.mark.parametrize("case", WRONG)
def test_invalid_file_is_rejected_with_file_line_and_reason(case):
    old, new, line, reason = WRONG[case]
    assert old in EXERCISE

    with pytest.raises(ParameterError) as refused:
        read(EXERCISE.replace(old, new, 1))

    assert "first.md" in str(refused.value)
    assert line in str(refused.value)
    assert reason in str(refused.value)


def test_exercise_without_front_matter_or_end_is_rejected():
    with pytest.raises(ParameterError, match="TOML between two lines"):
        read("# Only text")
    with pytest.raises(ParameterError, match="submit, at the end"):
        read(EXERCISE.replace('kind = "submit"', 'kind = "read"'))


def test_experiment_before_its_prediction_is_rejected():
    first, last = EXERCISE.index('[[steps]]\nname = "guess"'), EXERCISE.index("+++\n\nBefore")
    steps = EXERCISE[first:last].split("[[steps]]\n")[1:]
    turned = "".join(f"[[steps]]\n{step}" for step in (steps[1], steps[0], steps[2]))

    with pytest.raises(ParameterError, match="judged_by"):
        read(EXERCISE[:first] + turned + EXERCISE[last:])


def test_own_file_replaces_that_of_the_package(tmp_path):
    built_in = list_exercise_files()[0].stem
    own = tmp_path / f"{built_in}.md"
    own.write_text(EXERCISE, encoding="utf-8")
    (tmp_path / "first.md").write_text(EXERCISE, encoding="utf-8")

    titles = {one.name: one.title for one in read_course(tmp_path)}

    assert titles[built_in] == titles["first"] == "A first one"
    with pytest.raises(ParameterError, match="a folder with exercises"):
        read_course(tmp_path / "nowhere")


def test_html_in_a_text_is_escaped():
    shown = render_text("<script>x</script> [a](javascript:x) $x_1$")

    assert "<script>" not in shown
    assert "href" not in shown
    assert '<span class="math inline">x_1</span>' in shown


def test_example_for_lecturers_in_the_docs_is_valid():
    text = (Path(__file__).parents[3] / "docs" / "course.md").read_text(encoding="utf-8")
    example = text.split("```markdown\n")[1].split("```\n<!-- /example -->")[0]

    exercise = parse_exercise(example, "push", "docs/course.md")

    assert [step.kind for step in exercise.steps] == ["predict", "experiment", "explain", "submit"]
