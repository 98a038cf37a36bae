/** The style guide: only in `make dev`, at /styleguide/; `vite build` leaves it out. */
import "../src/theme.css";
import "../src/base.css";
import "../src/layout/layout.css";
import "../src/core/plots/plots.css";
import "../src/lab/panels/controls.css";
import "../src/core/widgets/page.css";
import "../src/core/widgets/numberinput.css";
import { render } from "preact";
import { toggleTheme } from "../src/core/state/preferences";
import css from "../src/theme.css?raw";
import { type Entry, LAYOUT, PARTS, TEXT } from "./entries";

const TOKENS = [...new Set(css.match(/--[\w-]+(?=:)/g))];

function Card({ name, use, sample }: Entry) {
  return (
    <section class="surface card">
      <h3>
        <code>{name}</code>
      </h3>
      <p class="hint">{use}</p>
      {sample}
    </section>
  );
}

function Guide() {
  return (
    <main class="page">
      <div class="spread page-head">
        <div>
          <h2>Style guide</h2>
          <p class="muted">
            Use these classes first. A style sheet of a page has only what that page alone needs.
          </p>
        </div>
        <button type="button" class="button" onClick={toggleTheme}>
          Switch theme
        </button>
      </div>
      <h2>Tokens of theme.css</h2>
      <div class="halves">
        {TOKENS.map((token) => (
          <div key={token} class="row">
            <span class="dot" style={{ background: `var(${token})` }} /> <code>{token}</code>
          </div>
        ))}
      </div>
      {Object.entries({ Layout: LAYOUT, Text: TEXT, Parts: PARTS }).map(([title, entries]) => (
        <section key={title} class="stack">
          <h2>{title}</h2>
          <div class="halves">
            {entries.map((entry) => (
              <Card key={entry.name} {...entry} />
            ))}
          </div>
        </section>
      ))}
    </main>
  );
}

render(<Guide />, document.getElementById("app") as HTMLElement);
