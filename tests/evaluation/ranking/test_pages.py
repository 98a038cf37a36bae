"""The pages of the ranked laws and their index contain the measured results: `make ranking`
writes them.
"""

import re
from pathlib import Path

import pytest

from svsa.control.installed import get_law
from svsa.evaluation.ranking.bench_runs import load_published_bench_runs
from svsa.evaluation.ranking.publish import FOLDER, build_index, build_law_page, build_margins
from svsa.evaluation.ranking.results import load_published
from svsa.evaluation.ranking.table import format_success
from tests.exhaustive import exhaust

ROOT = Path(__file__).parents[3]
RANKED = sorted({row.law for row in load_published().rows})
_MARGINS = re.compile(r"\n## Margins about rest\n.*?`svsa margins \w+`\.", re.DOTALL)


def read_margins(law: str) -> str:
    """The published section: computing all margins takes a minute."""
    found = _MARGINS.search((ROOT / FOLDER / f"{law}.md").read_text(encoding="utf-8"))
    assert found, law
    return found[0]


@pytest.mark.parametrize("law", RANKED)
def test_page_of_a_law_is_generated_from_its_file_and_the_results(law):
    page = build_law_page(load_published(), load_published_bench_runs(), law, read_margins(law))
    assert (ROOT / FOLDER / f"{law}.md").read_text(encoding="utf-8") == page
    assert (ROOT / FOLDER / "pictures" / f"{law}.png").is_file()
    assert get_law(law).equation in page
    said, _, doi = get_law(law).source.partition("doi:")
    assert said in page
    assert not doi or f"[doi:{doi}](https://doi.org/{doi})" in page


def test_exactly_the_ranked_laws_have_a_page():
    folder = ROOT / FOLDER
    assert [path.stem for path in sorted(folder.glob("*.md")) if path.stem != "README"] == RANKED


@pytest.mark.parametrize("law", exhaust(["fl", "eso_saturated"], ["eso_saturated"]))
def test_margins_of_a_page_are_the_computed_margins(law):
    assert build_margins(law) == read_margins(law)


def test_page_has_the_numbers_of_its_row():
    results = load_published()
    page = build_law_page(results, load_published_bench_runs(), "ndobc_w", "")
    row = results.get_row("ndobc_w")
    success = format_success(row.families["B"])
    assert f"| family B: held, % (95 %) | {success} |" in page
    assert f"| largest load [N·m] | {row.largest_load_nm:g} |" in page


def test_index_has_every_row():
    results = load_published()
    index = (ROOT / FOLDER / "README.md").read_text(encoding="utf-8")
    assert index == build_index(results, load_published_bench_runs())
    assert all(f"({law}.md)" in index for law in RANKED)
    for name in ("losses", "pareto"):
        assert f"(pictures/{name}.png)" in index
        assert (ROOT / FOLDER / "pictures" / f"{name}.png").is_file()
