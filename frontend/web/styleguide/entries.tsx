/** Every primitive and part of the style sheets, what it is for, and a sample. */
import type { ComponentChildren } from "preact";
import { Choice } from "../src/core/widgets/form";
import { NumberField } from "../src/core/widgets/numberinput";
import { Switch } from "../src/core/widgets/switch";
import { Table } from "../src/core/widgets/tables";

export interface Entry {
  /** The class, with its variants. */
  name: string;
  use: string;
  sample: ComponentChildren;
}

const ignore = () => undefined;
const boxes = (look: string, count = 3) => (
  <div class={look}>
    {Array.from({ length: count }, (_, index) => (
      <span key={index} class="tag">
        {index + 1}
      </span>
    ))}
  </div>
);
const words = (look: string) => <p class={look}>Position error 0.5°</p>;

export const LAYOUT: readonly Entry[] = [
  { name: "stack", use: "One below the other, with equal distances.", sample: boxes("stack") },
  {
    name: "column",
    use: "The same as a flexible column: a part may grow.",
    sample: boxes("column"),
  },
  { name: "row", use: "Side by side; wraps.", sample: boxes("row", 12) },
  { name: "line", use: "Side by side in one line.", sample: boxes("line") },
  { name: "spread", use: "A row whose parts are at both ends.", sample: boxes("spread", 2) },
  { name: "pair", use: "Two equal columns, such as two fields.", sample: boxes("pair", 4) },
  { name: "halves", use: "Two columns, or one where two do not fit.", sample: boxes("halves", 2) },
  {
    name: "cells",
    use: "As many columns as fit; --cell is the least width.",
    sample: boxes("cells"),
  },
  { name: "joined tight loose", use: "Distance of one of the above.", sample: boxes("line loose") },
  { name: "grow rigid", use: "In a line: takes the rest; never shrinks.", sample: null },
  { name: "end start", use: "In a line: moves to the end; moves the others there.", sample: null },
  { name: "wide block", use: "All columns of a grid; the whole width.", sample: null },
  {
    name: "fill over contents",
    use: "Over the nearest positioned element; over its middle; no box of its own.",
    sample: null,
  },
  {
    name: "scroll scroller",
    use: "Scrolls horizontally; fills its place and scrolls.",
    sample: null,
  },
  { name: "divided", use: "A line above it.", sample: words("divided") },
];

export const TEXT: readonly Entry[] = [
  { name: "muted good bad", use: "Color: less important, good, wrong.", sample: words("bad") },
  { name: "small tiny strong", use: "Size and weight.", sample: words("small strong") },
  { name: "tabular number", use: "Digits of equal width; right-aligned.", sample: words("number") },
  { name: "nowrap breaks clip", use: "One line; breaks anywhere; cut.", sample: words("clip") },
  { name: "roomy", use: "Shown only on a wide screen.", sample: words("roomy") },
  { name: "hint unit", use: "Explanation; unit of a number.", sample: words("hint") },
  { name: "problem as-written", use: "Error; output of a program.", sample: words("problem") },
];

export const PARTS: readonly Entry[] = [
  { name: "surface card", use: "Panels, tables; with padding.", sample: words("surface card") },
  { name: "sunken", use: "A drawing or a group on its own ground.", sample: words("sunken") },
  {
    name: "floating toast",
    use: "Dialogs, popups; a notice over the page.",
    sample: <h2 class="floating">Title</h2>,
  },
  { name: "bar", use: "A row across the page; is-foot at the bottom.", sample: boxes("bar") },
  {
    name: "button",
    use: "is-primary, is-small, is-icon, bad; aria-pressed is shown.",
    sample: (
      <p class="row">
        <button type="button" class="button is-primary">
          Start
        </button>
        <button type="button" class="button is-small" aria-pressed="true">
          Pressed
        </button>
        <button type="button" class="button bad">
          Delete run
        </button>
      </p>
    ),
  },
  {
    name: "quiet",
    use: "A button without a frame.",
    sample: (
      <button type="button" class="quiet">
        Remove load
      </button>
    ),
  },
  {
    name: "choice",
    use: "One of a few options: the component Choice.",
    sample: (
      <Choice
        label="Effects"
        options={[
          { value: "ideal", label: "Ideal" },
          { value: "full", label: "Full" },
        ]}
        value="ideal"
        onChoose={ignore}
      />
    ),
  },
  {
    name: "chip",
    use: "One of a few options, a chip each.",
    sample: (
      <label class="chip">
        <input type="radio" checked /> <span>10 s</span>
      </label>
    ),
  },
  {
    name: "check",
    use: "On or off: the component Switch.",
    sample: <Switch label="Friction" isOn onToggle={async () => undefined} />,
  },
  {
    name: "form",
    use: "Labels above their fields.",
    sample: (
      <div class="form">
        <NumberField label="Stiffness" unit="N·m/rad" value={15} onInput={ignore} />
      </div>
    ),
  },
  {
    name: "table metrics",
    use: "The component Table; metrics has numbers on the right.",
    sample: (
      <Table heads={["Law", "Error, °"]} look="metrics" label="Sample">
        <tr>
          <th scope="row">NDOBC</th>
          <td>0.31</td>
        </tr>
      </Table>
    ),
  },
  {
    name: "facts",
    use: "Names and values, one pair per line.",
    sample: (
      <dl class="facts">
        <div>
          <dt>Rate</dt>
          <dd>1000 Hz</dd>
        </div>
      </dl>
    ),
  },
  {
    name: "note tone",
    use: "Set apart from the text: is-accent, is-good, is-warn, is-bad.",
    sample: <p class="note is-warn">The torque is limited.</p>,
  },
  {
    name: "banner",
    use: "Across the page: is-accent, is-bad.",
    sample: <p class="banner is-accent">A new version is installed.</p>,
  },
  {
    name: "menu",
    use: "Links and buttons, one per line.",
    sample: (
      <div class="menu">
        <button type="button">Export run</button>
      </div>
    ),
  },
  { name: "tag", use: "A word that classifies.", sample: <span class="tag">example</span> },
  { name: "dot", use: "Color of a lane.", sample: <span class="dot" /> },
  {
    name: "bullets prose",
    use: "A list with its marks; text with lists.",
    sample: <ul class="bullets">{<li>Load</li>}</ul>,
  },
  {
    name: "drawing grid outline solid",
    use: "An SVG as wide as its place; its shapes.",
    sample: null,
  },
  { name: "chart grab", use: "The place of a chart of curves; it is dragged.", sample: null },
];
