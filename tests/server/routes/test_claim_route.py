"""A figure's run compared with the paper's claim over REST."""

from tests.lab import Lab

FIGURE = {"figure": "4a", "law": "fl", "comparisons": [{"law": "ndobc"}], "load": True}


def test_claim_of_a_figure_holds_for_its_run(lab: Lab) -> None:
    lab.client.post(lab.session + "/experiment", json=FIGURE).raise_for_status()
    lab.jump(20.0)
    claim = lab.client.get(lab.session + "/claim", params={"figure": "4a"}).raise_for_status()
    found = claim.json()
    assert [one["law"] for one in found["numbers"]] == ["fl", "ndobc"]
    assert found["numbers"][0]["steady_deg"] > 1.0 > found["numbers"][1]["steady_deg"]
    assert [one["holds"] for one in found["parts"]] == [True, True, True, True]


def test_other_pair_of_laws_has_no_claim(lab: Lab) -> None:
    lab.load_figure()
    answer = lab.client.get(lab.session + "/claim", params={"figure": "4a"})
    assert answer.status_code == 409
