"""The lab page and the tour in German and Chinese: complete, within the window, and chosen."""

import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import RETURNING, leave_3d_empty
from tests.browser.measured_layout import FIND_PROBLEMS
from tests.browser.test_page import wait_for_samples
from tests.browser.visited_layout import LEAST_PLOT_PX, measure
from tests.lab import Lab

pytestmark = pytest.mark.browser

LANGUAGES = {"de-DE": "de", "zh-CN": "zh-Hans"}
SIZES = ((390, 844), (1280, 720))
TOUR_STEPS = 6
# What a user reads or hears below an element. Typeset symbols and names of languages are left out.
READ = """(root) => {
    const texts = [];
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    const isRead = (element) => !element.closest("script, style, iframe, .katex, button[lang]");
    while (walker.nextNode()) {
        if (isRead(walker.currentNode.parentElement)) texts.push(walker.currentNode.data);
    }
    for (const element of root.querySelectorAll("*")) {
        if (!isRead(element)) continue;
        for (const name of ["aria-label", "title", "placeholder", "aria-valuetext"]) {
            texts.push(element.getAttribute(name) ?? "");
        }
    }
    return texts.map((text) => text.trim());
}"""
# Commands, names, formats, keys and units, and German words that are the same in English.
SAME = re.compile(
    r"^(httpx\.|svsa identify ).*|"
    r"\b(SVSA( Lab)?|NDOBC|FL|IAE|CSV|PNG|SVG|Python|curl|API|REST|experiment\.py|Esc|Shift|Live|"
    r"deg|m?rad|kg|ms|Hz|max|min|samples|Reset|Pause|Position|Amplitude|Status|Parameter|Ideal|Motor)\b"
)


def open_lab(browser: Browser, lab: Lab, locale: str, script: str = RETURNING) -> Page:
    context = browser.new_context(locale=locale, viewport={"width": 1440, "height": 900})
    context.add_init_script(script)
    leave_3d_empty(context)
    page = context.new_page()
    page.goto(lab.url)
    wait_for_samples(page)
    return page


def list_texts(answer: object) -> Iterator[str]:
    """Texts of the server, which are in English."""
    if isinstance(answer, str):
        yield answer.strip()
    elif isinstance(answer, dict | list):
        for part in answer.values() if isinstance(answer, dict) else answer:
            yield from list_texts(part)


def is_from(server_texts: set[str], text: str) -> bool:
    """Also a part of a sentence, which symbols divide."""
    return text in server_texts or (len(text) > 20 and any(text in whole for whole in server_texts))


def read(page: Page, selector: str = "body") -> set[str]:
    return set(page.locator(selector).evaluate(READ))


def read_lab(page: Page) -> set[str]:
    """Return the texts of the lab with all controls, and of its menus and help."""
    page.evaluate("for (const part of document.querySelectorAll('details')) part.open = true")
    texts = read(page)
    for popup in page.locator("button[aria-haspopup]").all():
        popup.press("Enter")
        texts |= read(page)
        page.keyboard.press("Escape")
    for key in ("?", "p"):
        page.keyboard.press(key)
        texts |= read(page)
        page.keyboard.press("Escape")
    return texts


def read_tour(page: Page) -> set[str]:
    texts: set[str] = set()
    for step in range(TOUR_STEPS):
        expect(page.locator(".tour-count")).to_contain_text(str(step + 1))
        texts |= read(page, ".tour")
        page.locator(".tour .is-primary").press("Enter")
    return texts


@pytest.mark.parametrize("locale", LANGUAGES)
@pytest.mark.parametrize(
    ("read_texts", "script"), [(read_lab, RETURNING), (read_tour, "")], ids=["lab", "tour"]
)
def test_no_text_is_left_in_english(
    browser: Browser, lab: Lab, locale: str, read_texts: Callable[[Page], set[str]], script: str
) -> None:
    paths = ("api/v1/laws", "api/v1/kinds", "api/v1/actuators", "openapi.json")
    server_texts = set(list_texts([lab.client.get(f"/{path}").json() for path in paths]))
    texts = {}
    for name in ("en-US", locale):
        page = open_lab(browser, lab, name, script)
        texts[name] = read_texts(page)
        page.context.close()
    least = 12 if script == "" else 250
    assert len(texts[locale]) > least
    assert [
        text
        for text in sorted(texts[locale] & texts["en-US"])
        if re.search(r"[A-Za-z]{2}", SAME.sub("", text)) and not is_from(server_texts, text)
    ] == []


@pytest.mark.parametrize("locale", LANGUAGES)
@pytest.mark.parametrize("controls", ["all", "basic"])
def test_lab_fits_into_the_window(browser: Browser, lab: Lab, locale: str, controls: str) -> None:
    page = open_lab(browser, lab, locale, RETURNING.replace('"all"', f'"{controls}"'))
    problems = measure(page, FIND_PROBLEMS, SIZES, LEAST_PLOT_PX["simulation"])
    page.context.close()
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("locale", LANGUAGES)
def test_tour_fits_into_the_window(browser: Browser, lab: Lab, locale: str) -> None:
    page = open_lab(browser, lab, locale, "")
    for _ in range(TOUR_STEPS):
        for width, height in SIZES:
            page.set_viewport_size({"width": width, "height": height})
            expect(page.locator(".tour .is-primary")).to_be_in_viewport(ratio=1)
            assert page.locator(".tour").evaluate("(card) => card.scrollWidth <= card.clientWidth")
        page.locator(".tour .is-primary").press("Enter")
    page.context.close()


def test_language_is_chosen_in_the_menu_and_kept(browser: Browser, lab: Lab) -> None:
    page = open_lab(browser, lab, "de-AT")
    html = page.locator("html")
    lab_tab = page.locator("nav.tabs a").first
    for language, name, word in (
        ("zh-Hans", "\u7b80\u4f53\u4e2d\u6587", "\u5b9e\u9a8c\u5ba4"),
        ("en", "English", "Lab"),
        ("de", "Deutsch", "Labor"),
    ):
        page.locator("button:has(.menu-word)").press("Enter")
        page.get_by_role("button", name=name, exact=True).press("Enter")
        expect(html).to_have_attribute("lang", language)
        expect(lab_tab).to_have_text(word)
        page.reload()
        expect(html).to_have_attribute("lang", language)
        expect(lab_tab).to_have_text(word)
    page.context.close()


def test_only_the_translation_of_the_language_is_loaded(browser: Browser, lab: Lab) -> None:
    """A browser in Traditional Chinese gets English, not another script."""
    for locale, language, files in (
        ("en-US", "en", []),
        ("zh-TW", "en", []),
        ("de-CH", "de", ["de"]),
        ("zh-SG", "zh-Hans", ["zh-Hans"]),
    ):
        page = open_lab(browser, lab, locale)
        expect(page.locator("html")).to_have_attribute("lang", language)
        loaded = page.evaluate("performance.getEntriesByType('resource').map(({ name }) => name)")
        assert re.findall(r"/assets/(de|zh-Hans)-[^/]*\.js", "\n".join(loaded)) == files
        page.context.close()


def test_a_page_that_is_not_translated_says_so_to_a_screen_reader(
    browser: Browser, lab: Lab
) -> None:
    page = open_lab(browser, lab, "de-DE")
    spoken = "() => document.querySelector('main').closest('[lang]').lang"
    assert page.evaluate(spoken) == "de"
    page.goto(f"{lab.url}?runs=all")
    expect(page.locator("main h1, main h2").first).to_be_visible()
    assert page.evaluate(spoken) == "en"
    assert page.locator("nav").first.evaluate("(nav) => nav.closest('[lang]').lang") == "de"
    page.context.close()
