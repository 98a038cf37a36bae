"""Layout problems of the present page, measured in the browser."""

# Resolves to sentences. Every element is scrolled into view and every fold opened first.
FIND_PROBLEMS = """async (leastPlot) => {
    const PANELS = ".group, .readout, .comparison, .plots, .view, .topbar, .bench-card," +
        " .bench-strip, .hold, .load-place, .statusbar";
    const INTERACTIVE = "button, input, select, summary, a[href], [tabindex='0']";
    const problems = [];
    const frame = () => new Promise(requestAnimationFrame);
    const named = (one) => {
        const name = one.getAttribute("aria-label") || one.innerText || one.id || one.className;
        return `${one.tagName.toLowerCase()} "${String(name).trim().slice(0, 40)}"`;
    };
    const isSeen = (one) => {
        const { width, height } = one.getBoundingClientRect();
        return width > 1 && height > 1 && one.checkVisibility({ visibilityProperty: true }) &&
            getComputedStyle(one).clipPath === "none" &&
            !one.closest(".visually-hidden, .skip, [popover], .mark");
    };
    const related = (one, other) => other !== null && (one.contains(other) ||
        other.contains(one) || (one.closest("label")?.contains(other) ?? false));
    const at = (x, y) => document.elementFromPoint(x, y);
    for (const fold of document.querySelectorAll("details")) fold.open = true;
    await frame(); await frame();

    const { scrollWidth } = document.documentElement;
    if (scrollWidth > innerWidth) problems.push(`the document is ${scrollWidth} px wide`);

    for (const canvas of document.querySelectorAll(".plot-canvas")) {
        const { height } = canvas.getBoundingClientRect();
        const plot = canvas.closest(".plot").getAttribute("aria-label");
        if (height < leastPlot) problems.push(`${plot} is ${height.toFixed(0)} px high`);
    }

    const parts = [...document.querySelectorAll(".lab > *")]
        .filter((one) => getComputedStyle(one).position !== "fixed");
    for (const [index, one] of parts.entries()) {
        const a = one.getBoundingClientRect();
        if (one.scrollWidth > one.clientWidth + 1) {
            problems.push(`${one.className} has ${one.scrollWidth} px in ${one.clientWidth}`);
        }
        for (const other of parts.slice(index + 1)) {
            const b = other.getBoundingClientRect();
            if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
                Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1) {
                problems.push(`${one.className} lies over ${other.className}`);
            }
        }
    }

    for (const share of [0, 0.25, 0.5, 0.75, 1]) {
        scrollTo(0, share * (document.documentElement.scrollHeight - innerHeight));
        await frame();
        for (const part of document.querySelectorAll(".load-place, .statusbar")) {
            const { left, top, width, height } = part.getBoundingClientRect();
            for (let i = 1; i < 60; i++) {
                const hit = at(left + width * (i % 20) / 20, top + height * (1 + i % 3) / 4);
                if (hit !== null && !part.contains(hit)) {
                    problems.push(`${part.className} is covered by ${named(hit)}`);
                }
            }
        }
    }

    for (const one of document.querySelectorAll(INTERACTIVE)) {
        if (!isSeen(one)) continue;
        one.scrollIntoView({ block: "center" });
        const box = one.getBoundingClientRect();
        const hit = at((box.left + box.right) / 2, (box.top + box.bottom) / 2);
        if (!related(one, hit)) {
            problems.push(`${named(one)} is covered by ${hit === null ? "the edge" : named(hit)}`);
        }
        const panel = one.closest(PANELS)?.getBoundingClientRect();
        if (panel && (box.left < panel.left - 0.5 || box.right > panel.right + 0.5 ||
            box.top < panel.top - 0.5 || box.bottom > panel.bottom + 0.5)) {
            problems.push(`${named(one)} runs out of its panel`);
        }
    }

    for (const one of document.querySelectorAll(".button")) {
        const words = [...one.childNodes].find(({ data }) => data?.trim());
        if (words === undefined || !isSeen(one)) continue;
        const range = document.createRange();
        range.selectNodeContents(words);
        const [inner, outer] = [range, one].map((part) => part.getBoundingClientRect());
        const off = (inner.top + inner.bottom - outer.top - outer.bottom) / 2;
        if (Math.abs(off) > 3) problems.push(`words of ${named(one)} are ${off} px off its middle`);
    }

    const walker = document.createTreeWalker(document.getElementById("app"), NodeFilter.SHOW_TEXT);
    for (let text = walker.nextNode(); text !== null; text = walker.nextNode()) {
        const one = text.parentElement;
        if (text.data.trim() === "" || !isSeen(one) || one.closest("svg, select")) continue;
        if (getComputedStyle(one).pointerEvents === "none") continue;
        one.scrollIntoView({ block: "center" });
        const range = document.createRange();
        range.selectNodeContents(text);
        const panel = one.closest(PANELS)?.getBoundingClientRect();
        for (const { left, right, top, bottom } of range.getClientRects()) {
            const middle = (top + bottom) / 2;
            const over = [left + 1, (left + right) / 2, right - 1]
                .map((x) => at(x, middle)).find((hit) => !related(one, hit));
            const isOut = panel && (left < panel.left - 0.5 || right > panel.right + 0.5);
            if (over !== undefined) {
                problems.push(`text "${text.data.slice(0, 40)}" is cut by ` +
                    (over === null ? "the edge" : named(over)));
            } else if (isOut) {
                problems.push(`text "${text.data.slice(0, 40)}" runs out of its panel`);
            }
        }
        const isClipped = getComputedStyle(one).overflowX !== "visible";
        if (isClipped && one.scrollWidth > one.clientWidth + 1) {
            problems.push(`text "${text.data.slice(0, 40)}" is clipped`);
        }
    }
    scrollTo(0, 0);
    return [...new Set(problems)];
}"""

# Opens every popup in turn: it must be fully on the screen, above the status bar. A popup that is
# still being filled has some frames to find its position.
FIND_POPUP_PROBLEMS = """async () => {
    const problems = [];
    const floor = document.querySelector(".statusbar").getBoundingClientRect().top;
    const frame = () => new Promise(requestAnimationFrame);
    const isWhole = ({ left, right, top, bottom }) =>
        right > left && left >= 0 && top >= 0 && right <= innerWidth && bottom <= floor;
    for (const opener of document.querySelectorAll("[popovertarget]")) {
        if (opener.getBoundingClientRect().width === 0) continue;
        opener.scrollIntoView({ block: "center" });
        opener.click();
        const popup = document.getElementById(opener.getAttribute("popovertarget"));
        await frame(); await frame();
        for (let i = 0; i < 60 && !isWhole(popup.getBoundingClientRect()); i++) await frame();
        const box = popup.getBoundingClientRect();
        if (!isWhole(box)) {
            const name = opener.getAttribute("aria-label") || opener.innerText;
            const edges = [box.left, box.top, box.right, box.bottom].map(Math.round);
            problems.push(`${name}: ${edges} of ${innerWidth} × ${floor}`);
        }
        popup.hidePopover();
    }
    return problems;
}"""
