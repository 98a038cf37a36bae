import { signal } from "@preact/signals";
import { EquationCard } from "../equations/equation";
import { TOPICS, type Topic } from "../equations/equations";
import { text } from "../text/en";
import { Panel } from "../widgets/panel";
import { PanelButton } from "../widgets/panelbutton";
import { Claims } from "./claims";
import { startTour } from "./tour";

const words = text.learning;
const isOpen = signal(false);

function close(): void {
  isOpen.value = false;
}

function EquationList() {
  return (
    <>
      <h3>{words.equations}</h3>
      <p class="hint">{words.equationsHint}</p>
      {TOPICS.map((topic: Topic) => (
        <details key={topic} class="more">
          <summary>{text.equations.topics[topic]}</summary>
          <EquationCard topic={topic} />
        </details>
      ))}
    </>
  );
}

export function LearnPanel() {
  if (!isOpen.value) return null;
  return (
    <Panel
      title={words.title}
      class="learn"
      onClose={close}
      beside={
        <button
          type="button"
          class="button"
          onClick={() => {
            close();
            startTour();
          }}
        >
          {text.tour.take}
        </button>
      }
    >
      <div class="learn-body">
        <Claims />
        <div class="learn-equations">
          <EquationList />
        </div>
      </div>
    </Panel>
  );
}

export function LearnButton() {
  return (
    <PanelButton isOpen={isOpen} hint={words.openHint}>
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M8 2L0 5.8l8 3.8 6.4-3v4.6H16V5.8zM3 8.6v3.2c1.2 1.5 3 2.2 5 2.2s3.8-.7 5-2.2V8.6l-5 2.4z" />
      </svg>
      {words.open}
    </PanelButton>
  );
}
