"""Questions of a new user, each answered within two clicks from the start page of the site."""

import re
import runpy
from collections.abc import Iterator
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urljoin, urlsplit

import pytest

from svsa.control.installed import get_law, list_law_names
from tests.docs.pages import ROOT

QUESTIONS = {
    "What is the sign of the load?": "A load w is positive if it accelerates in the positive",
    "What are the units of the stream?": "Every value is in SI units",
    "How do I add Coulomb friction?": 'friction = {"coulomb1_nm": 0.2, "coulomb2_nm": 0.1}',
    "How do I change the inertia of the link?": "changed(link_inertia_kg_m2=inertia)",
    "How do I cite the lab?": "Cite two sources: the software with its version, and the paper",
    "What is a lane?": "One controller with its own copy of the plant",
    "What is the recovery time?": "until the error stays within 2 % of its peak",
    "Does the same seed give the same noise?": "The same seed gives the same noise",
    "Which variable sets the shared secret?": "SVSA_SECRET Shared secret of at least 8 characters",
    "What does the fault deflection_limit mean?": "the deflection φ reached its limit",
    "How do I export a run to MATLAB?": 'svsa.export_run(result, "mat", "run.mat")',
    "How does a lab report a nearly full disk?": "the lab logs a warning, ready answers 503",
    "What do I need before I switch a bench on?": "The emergency stop is hardware that you build",
}
CLICKS = 2
LINK = re.compile(r'<a\s[^>]*?href="([^"]+)"')
IDENTIFIER = re.compile(r'\sid="([^"]+)"')


class SitePage(HTMLParser):
    """The text of a page's article, and the links that a reader of the page sees.

    These are the links of the article, and the links of the sidebar that are visible without
    unfolding it.
    """

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.parts: list[str] = []
        self._lists = 0
        self._is_article = self._is_sidebar = self._is_script = False
        self.feed(text)

    @property
    def text(self) -> str:
        return " ".join("".join(self.parts).split())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = dict(attrs)
        classes = (names.get("class") or "").split()
        self._is_article |= tag == "article"
        self._is_script |= tag in ("script", "style")
        self._is_sidebar |= "sidebar-tree" in classes
        self._lists += tag == "ul"
        is_seen = self._is_article or (self._is_sidebar and self._lists == 1)
        if tag == "a" and is_seen and "headerlink" not in classes:
            self.links.append(names.get("href") or "")

    def handle_endtag(self, tag: str) -> None:
        self._is_article &= tag != "article"
        self._is_script &= tag not in ("script", "style")
        self._is_sidebar &= tag != "aside"
        self._lists -= tag == "ul"

    def handle_data(self, data: str) -> None:
        if self._is_article and not self._is_script:
            self.parts.append(data)


def read_page(path: Path) -> SitePage:
    # A table cell ends a word.
    return SitePage(
        re.sub(r"</(td|th|p|dt|dd|li|h\d)>", r" </\1>", path.read_text(encoding="utf-8"))
    )


def follow_links(folder: Path, name: str) -> Iterator[str]:
    """The pages linked from a page, as paths in the folder."""
    for link in read_page(folder / name).links:
        path = urlsplit(urljoin(f"/{name}", link)).path.lstrip("/")
        if not urlsplit(link).scheme and (folder / path).suffix == ".html":
            yield path


@pytest.fixture(scope="module")
def site() -> Path:
    """The built site."""
    hook = runpy.run_path(str(ROOT / "frontend/web/hatch_build.py"))
    hook["build_guide"]()
    return hook["GUIDE"]


@pytest.fixture(scope="module")
def near(site: Path) -> dict[str, str]:
    """The text of each page within two clicks from the start page."""
    names = {"index.html"}
    for _ in range(CLICKS):
        names |= {found for name in names for found in follow_links(site, name)}
    return {name: read_page(site / name).text for name in names}


@pytest.mark.exhaustive
@pytest.mark.parametrize("question", QUESTIONS)
def test_newcomer_question_is_answered_within_two_clicks(question, near):
    answer = QUESTIONS[question]
    assert [name for name, text in near.items() if answer in text], f"{len(near)} pages"


def read_target(site: Path, name: str, link: str) -> tuple[Path, str]:
    """The file that a link of a page leads to, and the element in it."""
    parts = urlsplit(urljoin(f"/{name}", link))
    return site / unquote(parts.path).lstrip("/"), unquote(parts.fragment)


@pytest.mark.exhaustive
def test_every_link_of_the_site_has_a_target(site):
    pages = {path: path.read_text(encoding="utf-8") for path in site.rglob("*.html")}
    places = {path: set(IDENTIFIER.findall(text)) for path, text in pages.items()}
    broken = []
    for path, text in pages.items():
        name = path.relative_to(site).as_posix()
        for link in {unescape(found) for found in LINK.findall(text)}:
            if urlsplit(link).scheme:
                continue
            target, place = read_target(site, name, link)
            if not target.is_file() or (place and place not in places.get(target, {place})):
                broken.append((name, link))
    assert len(pages) > 80
    assert not broken


@pytest.mark.parametrize("law", list_law_names())
def test_formula_command_is_separated_from_the_next_letter(law):
    r"""A missing blank, as in `\quadB`, is an unknown command, which readers see as text."""
    assert not re.search(r"\\q?quad[A-Za-z]", get_law(law).equation)


@pytest.mark.exhaustive
def test_formulas_are_rendered_without_a_script(site):
    """MathML: the site has no script for formulas, and must load none from elsewhere."""
    for path in (site / "laws").glob("*.html"):
        page = path.read_text(encoding="utf-8")
        assert "$$" not in read_page(path).text, path.name
        assert "<math" in page or path.name == "README.html", path.name
