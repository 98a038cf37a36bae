"""`svsa.sweep`: a row of the metrics of `simulate` for each combination of settings."""

import threading

import pandas
import pytest

import svsa

STIFFNESS = "stiffness.stiffness_nm_per_rad"
VARY = {"law": ["ndobc", "fl"], STIFFNESS: [15, 60.0], "seed": range(2)}
SETTINGS = {"duration_s": 0.3, "loads": (svsa.PaperLoad(start_s=0.1),), "effects": svsa.RIG}


def test_each_row_has_the_metrics_of_its_own_run():
    frame = svsa.sweep("4a", VARY, **SETTINGS)
    assert list(frame.columns[:4]) == [*VARY, "fault"]
    assert frame[[*VARY]].to_numpy().tolist() == [
        [law, sigma, seed] for law in VARY["law"] for sigma in VARY[STIFFNESS] for seed in (0, 1)
    ]
    row = frame.iloc[3]
    stiffness = svsa.ConstantStiffness(stiffness_nm_per_rad=60.0)
    run = svsa.simulate("4a", "ndobc", stiffness=stiffness, seed=1, **SETTINGS)
    for name, value in run.metrics.to_dict().items():
        assert row[name] == value if value is not None else pandas.isna(row[name]), name


def test_thread_count_changes_no_bit_and_progress_is_complete():
    shares = []
    one = svsa.sweep("4a", VARY, threads=1, progress=shares.append, **SETTINGS)
    pandas.testing.assert_frame_equal(svsa.sweep("4a", VARY, threads=4, **SETTINGS), one)
    assert shares == [number / 8 for number in range(1, 9)]


def test_run_that_ends_early_has_its_fault_and_no_later_metrics():
    vary = {"law": ["ndobc", lambda *_: (10.0, 0.0)]}
    frame = svsa.sweep("4a", vary, duration_s=1.0, measure_from_s=0.5)
    assert pandas.isna(frame["fault"][0])
    assert frame["fault"][1] == "deflection_limit"
    assert frame["rms_position_error_rad"].isna().tolist() == [False, True]


def test_laws_in_plain_python_run_sequentially():
    seen = set()

    def law(time_s, reference, x, w):
        seen.add(threading.current_thread().name)
        return 0.0, 0.0

    svsa.sweep("4a", {"law": [law], "seed": range(4)}, duration_s=0.01, threads=4)
    assert len(seen) == 1


@pytest.mark.parametrize(
    ("vary", "reported"),
    [
        ({"law": ["fll"]}, "vary.law is 'fll'"),
        ({"law": "fl"}, r"vary\['law'\] is 'fl': it must be a list of values"),
        ({"actuator.link_inertia": [1.0]}, "link_inertia"),
        ({"seed": [-1]}, "vary.seed is -1: it must be at least 0"),
    ],
)
def test_invalid_setting_is_named_before_the_simulation(vary, reported):
    with pytest.raises(svsa.ParameterError, match=reported):
        svsa.sweep("4a", vary, duration_s=0.01, progress=pytest.fail)
