/** The style guide: only in `make dev`, at /styleguide/; `vite build` leaves it out. */
import "../src/theme.css";
import "../src/base.css";
import "../src/primitives.css";
import "../src/parts.css";
import "../src/core/widgets/page.css";
import "../src/core/widgets/numberinput.css";
import "../src/core/widgets/panel.css";
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
            Use these classes first. A style sheet of a page has rules for plots, plane and 3D view.
          </p>
        </div>
        <button type="button" class="button" onClick={toggleTheme}>
          Switch theme
        </button>
      </div>
      <h2>Tokens of theme.css</h2>
      <div class="cells">
        {TOKENS.map((token) => (
          <div key={token} class="line">
            <span class="dot" style={{ background: `var(${token})` }} /> <code>{token}</code>
          </div>
        ))}
      </div>
      {Object.entries({ Layout: LAYOUT, Text: TEXT, Parts: PARTS }).map(([title, entries]) => (
        <section key={title} class="stack">
          <h2>{title}</h2>
          <div class="cells">
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
