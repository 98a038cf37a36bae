"""A page of another site, or a text with a script, runs and changes nothing in the lab."""

import re

import pytest
from playwright.sync_api import Dialog, Page, expect

from tests.browser import test_foreign_viewer
from tests.browser.test_foreign_viewer import Foreign, check_untouched
from tests.lab import Lab
from tests.waiting import follow_recording

pytestmark = [pytest.mark.browser, pytest.mark.exhaustive]
foreign = test_foreign_viewer.foreign

PAUSE = "fetch('/api/v1/sessions/lab/pause',{method:'POST'})"
SCRIPTS = (
    f'<img src=x onerror="{PAUSE}">',
    f"</script><script>{PAUSE}</script>",
    f'"><svg onload="{PAUSE}">',
    f"[note](javascript:{PAUSE})",
    f"javascript:{PAUSE}",
)
FOREIGN_ELEMENTS = "[onerror], [onload], [href^='javascript:'], [src^='javascript:'], img[src=x]"
ATTACK = """async (lab) => {
    const attempts = [];
    const attempt = async (name, act) => {
        try { attempts.push([name, await act() ?? null]); } catch { attempts.push([name, null]); }
    };
    const opened = open(`${lab}/`, "lab");
    await new Promise((resolve) => setTimeout(resolve, 3000));
    await attempt("read the window", () => opened.document.title);
    await attempt("find a frame", () => opened.frames[0]?.location.href);
    for (const message of [{ type: "pause" }, "pause", { source: "viser", script: "1" }]) {
        await attempt("post", () => opened.postMessage(message, "*"));
        await attempt("post to opener", () => opener.postMessage(message, "*"));
    }
    await attempt("run", () => { opened.location = `javascript:fetch("/api/v1/quick-stop")`; });
    await attempt("worker", () => navigator.serviceWorker.register(`${lab}/assets/worker.js`));
    await attempt("read", async () => (await fetch(`${lab}/api/v1/access`)).text());
    await attempt("read with credentials", async () =>
        (await fetch(`${lab}/api/v1/access`, { credentials: "include" })).text());
    for (const type of ["text/plain", "application/x-www-form-urlencoded", "application/json"])
        await attempt(type, async () => (await fetch(`${lab}/api/v1/sessions/lab/pause`,
            { method: "POST", mode: type.endsWith("json") ? "cors" : "no-cors", body: "{}",
              headers: { "Content-Type": type } })).status || null);
    await attempt("stream", () => new Promise((resolve) => {
        const socket = new WebSocket(`${lab.replace("http", "ws")}/api/v1/sessions/lab/stream`);
        socket.onopen = () => resolve("open");
        socket.onerror = () => resolve(null);
    }));
    const form = Object.assign(document.createElement("form"),
        { action: `${lab}/api/v1/sessions/lab/pause`, method: "post", target: "lab2" });
    document.body.append(form);
    form.submit();
    await new Promise((resolve) => setTimeout(resolve, 1000));
    return attempts.filter(([, result]) => result !== null);
}"""


def test_page_of_another_site_that_opens_the_lab_reads_and_changes_nothing(
    page: Page,
    lab: Lab,
    foreign: Foreign,
) -> None:
    lab.client.post(lab.session + "/start").raise_for_status()
    (foreign.folder / "opener.html").write_text("<p>A page of another site")
    page.goto(f"{foreign.web}/opener.html")
    assert page.evaluate(ATTACK, lab.url) == []
    check_untouched(lab, foreign)
    page.goto(lab.url)
    assert page.evaluate("navigator.serviceWorker.getRegistrations()") == []
    # It may link to the lab, but the lab does not know its window.
    page.goto(f"{foreign.web}/opener.html")
    with page.context.expect_page() as opened:
        page.evaluate("url => { window.child = open(url); }", lab.url)
    expect(opened.value.get_by_role("status").first).to_be_attached()
    assert opened.value.evaluate("opener") is None
    opened.value.close()


@pytest.mark.parametrize(
    "query",
    [
        "url={web}/foreign.json",
        "configUrl={web}/foreign.json",
        "urls.primaryName=x&url={web}/foreign.json&spec={{}}",
        "oauth2RedirectUrl={web}/&url=data:application/json,{{}}",
        "url=javascript:alert(1)#/{web}",
    ],
)
def test_documentation_reads_no_other_server(
    page: Page,
    lab: Lab,
    foreign: Foreign,
    query: str,
) -> None:
    requested: list[str] = []
    page.on("request", lambda request: requested.append(request.url))
    page.goto(f"{lab.url}/docs?{query.format(web=foreign.web)}")
    expect(page.locator(".opblock").first).to_be_visible()
    assert [url for url in requested if not url.startswith((lab.url, "data:image"))] == []
    check_untouched(lab, foreign)


def test_texts_of_a_run_are_shown_and_not_run(
    page: Page,
    lab: Lab,
    foreign: Foreign,
) -> None:
    path = f"{lab.session}/recording"
    answer = lab.client.post(path, json={"name": SCRIPTS[0]}).raise_for_status().json()
    run = answer["recording"]["run_id"]
    lab.jump(1)
    lab.client.delete(path).raise_for_status()
    follow_recording(lab.client, f"/api/v1/runs/{run}")
    lab.client.post(lab.session + "/start").raise_for_status()
    alerts: list[str] = []

    def note_alert(dialog: Dialog) -> None:
        alerts.append(dialog.message)
        dialog.dismiss()

    page.on("dialog", note_alert)
    for text in SCRIPTS:
        change = {"name": text, "notes": text, "tags": [text[:30]]}
        lab.client.patch(f"/api/v1/runs/{run}", json=change).raise_for_status()
        for place in (
            "/?runs=all",
            f"/?run={run}",
            f"/?overlay={run}",
            f"/?runs={text}",
            f"/?learn={text}",
            f"/api/v1/runs/{run}/replay",
            f"/api/v1/runs/{run}",
        ):
            page.goto(lab.url + place)
            if place == f"/?run={run}":
                expect(page.get_by_role("textbox", name=re.compile("Notes")).first).to_have_value(
                    text
                )
            assert page.locator(FOREIGN_ELEMENTS).count() == 0, place
            assert lab.read()["status"] == "running", (text, place)
    assert alerts == []
    check_untouched(lab, foreign)
