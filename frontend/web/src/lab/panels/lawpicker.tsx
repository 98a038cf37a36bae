import type { ComponentChildren } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";
import type { Law, LawRow } from "../../core/api/types";
import { brokenLaws, findLaws, groupLaws, pickLaw, usableLaws } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { Popup } from "../../core/widgets/popup";

const words = text.laws;
const MAX_AT_A_GLANCE = 6;

/** Arrows go through what can be pressed in a list, the search before it; Home and End too. */
function stepTo(list: HTMLElement, event: KeyboardEvent): void {
  const stops = [...list.querySelectorAll<HTMLElement>("input, button")];
  const at = stops.indexOf(event.target as HTMLElement);
  const isInText = event.target instanceof HTMLInputElement;
  const places: Record<string, number> = {
    ArrowDown: at + 1,
    ArrowUp: at - 1,
    ...(!isInText && { Home: 0, End: stops.length - 1 }),
  };
  const place = places[event.key];
  if (place === undefined) return;
  event.preventDefault();
  stops[place]?.focus();
}

interface LawListProps {
  value: Law | null;
  onChoose: (law: Law) => void;
}

function Row({ law, isPresent, onChoose }: { law: LawRow; isPresent: boolean } & LawListProps) {
  return (
    <li>
      <button
        type="button"
        class="law-row"
        aria-current={isPresent}
        onClick={() => onChoose(law.name)}
      >
        <span class="law-sign" aria-hidden="true">
          {isPresent && words.presentSign}
        </span>
        <strong>{law.title}</strong>
        <span class="law-summary">{law.summary}</span>
      </button>
    </li>
  );
}

/** Every law in a line of its own words; of many those that are looked for, group by group. */
function LawList({ value, onChoose }: LawListProps) {
  const [sought, setSought] = useState("");
  const list = useRef<HTMLDivElement>(null);
  const id = useId();
  const usable = usableLaws.value;
  const isMany = usable.length > MAX_AT_A_GLANCE;
  const found = findLaws(usable, sought);
  useEffect(() => {
    const first = list.current?.querySelector<HTMLElement>("input, [aria-current=true], button");
    first?.focus();
    const follow = (event: KeyboardEvent) => list.current && stepTo(list.current, event);
    list.current?.addEventListener("keydown", follow);
  }, []);
  return (
    <div ref={list} class="laws">
      {isMany && (
        <input
          type="search"
          aria-label={words.search}
          placeholder={words.search}
          value={sought}
          onInput={(event) => setSought(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key !== "Enter" || sought.trim() === "") return;
            event.preventDefault(); // the focus goes back to the button, which it would press
            const picked = pickLaw(found, sought);
            if (picked) onChoose(picked.name);
          }}
        />
      )}
      <span class="visually-hidden" role="status">
        {sought.trim() !== "" && words.found(found.length)}
      </span>
      {groupLaws(found).map(({ estimate, laws }) => (
        <section key={estimate} aria-labelledby={isMany ? `${id}-${estimate}` : undefined}>
          {isMany && <h3 id={`${id}-${estimate}`}>{words.groups[estimate]}</h3>}
          <ul>
            {laws.map((law) => (
              <Row
                key={law.name}
                law={law}
                isPresent={law.name === value}
                value={value}
                onChoose={onChoose}
              />
            ))}
          </ul>
        </section>
      ))}
      {found.length === 0 && <p class="hint">{words.none}</p>}
      {brokenLaws.value.map(({ name, problem }) => (
        <p class="problem" key={name}>
          {problem}
        </p>
      ))}
    </div>
  );
}

interface LawPickerProps {
  /** Label of the choice for screen readers. */
  label: string;
  button: ComponentChildren;
  /** Which law is in use; null: none yet. */
  value: Law | null;
  title: string;
  class?: string;
  isDisabled?: boolean;
  onChoose: (law: Law) => unknown;
}

/** One law of all that are installed. */
export function LawPicker(props: LawPickerProps) {
  return (
    <Popup
      class={`law-picker ${props.class ?? ""}`}
      popupClass="law-popup"
      name={props.label}
      title={props.title}
      button={props.button}
      isDisabled={props.isDisabled ?? false}
    >
      {(close) => (
        <LawList
          value={props.value}
          onChoose={(law) => {
            close();
            if (law !== props.value) void props.onChoose(law);
          }}
        />
      )}
    </Popup>
  );
}
