"""An invalid definition is rejected with file, line, name, value and bound before anything runs."""

import pytest

from svsa.errors import ParameterError
from svsa.evaluation.falsifier.file import read_adversary, read_scenario
from svsa.evaluation.studies.file import read_study
from tests.evaluation.falsifier.test_scenario_files import GOOD as ADVERSARY
from tests.evaluation.falsifier.test_scenario_files import SCENARIO
from tests.evaluation.falsifier.weak_law import install
from tests.evaluation.studies.test_study_file import GOOD as STUDY

FILES = {
    "study": (read_study, STUDY),
    "adversary": (read_adversary, ADVERSARY),
    "scenario": (read_scenario, SCENARIO),
}
# File, text that is replaced, new text, and pattern of the message.
WRONG = r"""
study      ¦ runs = 10 ¦ runs = 0 ¦ line 2: runs is 0: it must be at least 1
study      ¦ "ndobc" ¦ "missing" ¦ line 3: laws\[0\] is 'missing': .* law that is installed here
study      ¦ "4a" ¦ "9" ¦ line 6: base\.figure is '9'
study      ¦ [base] ¦ metrics = ["effort_n2m2_s", "energy"]\n[base] ¦ line 5: metrics\[1\] is 'energy': it must be one of rms_position_.*limit_share
study      ¦ [base] ¦ metrics = []\n[base] ¦ line 5: metrics is .*at least 1
study      ¦ [base] ¦ metrics = ["limit_share", "limit_share"]\n[base] ¦ line 5: metrics is .*names, each once
study      ¦ [base] ¦ [success]\nlimit_share = 2\n[base] ¦ line 6: success.limit_share is 2.*most 1
study      ¦ [base] ¦ [base]\nseed = 3 ¦ base is 'seed': it must be another setting
study      ¦ link_inertia ¦ mass ¦ line 9: vary\[0\]\.path is 'actuator\.mass.*link_inertia
study      ¦ low = 0.01 ¦ low = -1.0 ¦ line 11: vary\[0\]\.low: with -1\.0 there, link_inertia.*
study      ¦ low = 0.01 ¦ low = 0.5 ¦ line 11: vary\[0\]\.low is 0\.5: it must be less than high
study      ¦ [0, 1] ¦ [0, 9] ¦ line 17: vary\[1\]\.values\[1\]: with 9 there.*at most 5 samples
study      ¦ "grid" ¦ "dice" ¦ line 15: vary\[1\]\.kind is 'dice': it must be one of 'uniform'
study      ¦ effects.delay_samples ¦ seed ¦ line 16: vary\[1\]\.path is 'seed'.*study's own
study      ¦ effects.delay_samples ¦ actuator.link_inertia_kg_m2 ¦ varied once
study      ¦ effects.delay_samples ¦ actuator ¦ a varied path already contains it
study      ¦ runs = 10 ¦ runs = ¦ it must be a readable TOML file .*line 2
adversary  ¦ "weak" ¦ "missing" ¦ line 2: law is 'missing': it must be a law that is installed here
adversary  ¦ duration_s = 2.0 ¦ duration_s = 0.5 ¦ line 12: terms\[0\]\.start_s .* before the run's
adversary  ¦ "4a" ¦ "9" ¦ line 6: base\.figure is '9'
adversary  ¦ "pulse" ¦ "kick" ¦ line 10: terms\[0\]\.kind is 'kick': it must be one of 'step'
adversary  ¦ torque_nm = 1.5 ¦ torque_nm = 90.0 ¦ line 11: terms\[0\]\.torque_nm is 90.* at most 50
adversary  ¦ [0.2, 0.8] ¦ [0.8, 0.2] ¦ line 12: terms\[0\]\.start_s is \[0\.8, 0\.2\].*less than the
adversary  ¦ [0.02, 1.0] ¦ [0.0, 1.0] ¦ line 13: terms\[0\]\.duration_s is .*at least 0\.0001
adversary  ¦ link_inertia ¦ mass ¦ line 16: vary\[0\]\.path is 'actuator\.mass.*link_inertia
adversary  ¦ low = 0.9 ¦ low = -1.0 ¦ line 18: vary\[0\]\.low: with -1\.0 there, link_inertia.*
adversary  ¦ title = ¦ title ¦ it must be a readable TOML file .*line 1
scenario   ¦ duration_s = 1.0 ¦ duration_s = 0.0 ¦ line 2: duration_s is 0\.0 s: .* greater than 0
scenario   ¦ = 0.02 ¦ = -1.0 ¦ line 8: settings\.actuator\.link_inertia_kg_m2: with -1\.0, .* at least
scenario   ¦ link_inertia_kg_m2 ¦ weight ¦ line 8: settings\.actuator\.weight: with 0\.02, .*one of link_inertia_kg_m2
scenario   ¦ [1.0, 0.0, 0.0] ¦ [99.0, 0.0, 0.0] ¦ line 11: loads\[0\]\.torque_nm\[0\] is 99
scenario   ¦ frequency_hz = 2.0 ¦ ¦ line 14: loads\[1\]\.frequency_hz is missing
"""  # noqa: E501


@pytest.mark.parametrize("case", WRONG.strip().splitlines())
def test_invalid_value_is_reported_with_its_line(tmp_path, monkeypatch, case):
    install(monkeypatch)
    kind, old, new, message = map(str.strip, case.split("¦"))
    read, good = FILES[kind]
    assert old in good
    path = tmp_path / "wrong.toml"
    path.write_text(good.replace(old, new.replace(r"\n", "\n"), 1))
    with pytest.raises(ParameterError, match=r"(?s)wrong\.toml.*" + message):
        read(path)
