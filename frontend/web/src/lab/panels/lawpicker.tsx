import type { ComponentChildren } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";
import type { Law, LawRow } from "../../core/api/types";
import { brokenLaws, findLaws, groupLaws, pickLaw, usableLaws } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { Popup } from "../../core/widgets/popup";
import { MathSymbol } from "../../core/widgets/symbol";

const MAX_WITHOUT_SEARCH = 6;

/** Arrow keys move through the search field and the buttons of a list; Home and End, too. */
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

function Row({ law, isCurrent, onChoose }: { law: LawRow; isCurrent: boolean } & LawListProps) {
  return (
    <li>
      <button
        type="button"
        class="law-row"
        aria-current={isCurrent}
        onClick={() => onChoose(law.name)}
      >
        <span class="tone is-accent strong" aria-hidden="true">
          {isCurrent && t("laws.presentSign")}
        </span>
        <strong>{law.title}</strong>
        <span class="hint law-summary">
          <MathSymbol text={law.summary} />
        </span>
      </button>
    </li>
  );
}

/** One line per law with its summary; with many laws a search and groups. */
function LawList({ value, onChoose }: LawListProps) {
  const [query, setQuery] = useState("");
  const list = useRef<HTMLDivElement>(null);
  const id = useId();
  const usable = usableLaws.value;
  const isMany = usable.length > MAX_WITHOUT_SEARCH;
  const matches = findLaws(usable, query);
  useEffect(() => {
    const first = list.current?.querySelector<HTMLElement>("input, [aria-current=true], button");
    first?.focus();
    const follow = (event: KeyboardEvent) => list.current && stepTo(list.current, event);
    list.current?.addEventListener("keydown", follow);
  }, []);
  return (
    <div ref={list} class="stack tight laws">
      {isMany && (
        <input
          type="search"
          aria-label={t("laws.search")}
          placeholder={t("laws.search")}
          value={query}
          onInput={(event) => setQuery(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key !== "Enter" || query.trim() === "") return;
            event.preventDefault(); // the button has the focus again, and the key would press it
            const picked = pickLaw(matches, query);
            if (picked) onChoose(picked.name);
          }}
        />
      )}
      <span class="visually-hidden" role="status">
        {query.trim() !== "" && t("laws.matching", { count: matches.length })}
      </span>
      {groupLaws(matches).map(({ estimate, laws }) => (
        <section key={estimate} aria-labelledby={isMany ? `${id}-${estimate}` : undefined}>
          {isMany && <h3 id={`${id}-${estimate}`}>{t(`laws.groups.${estimate}`)}</h3>}
          <ul>
            {laws.map((law) => (
              <Row
                key={law.name}
                law={law}
                isCurrent={law.name === value}
                value={value}
                onChoose={onChoose}
              />
            ))}
          </ul>
        </section>
      ))}
      {matches.length === 0 && <p class="hint">{t("laws.none")}</p>}
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
  /** The law in use; null: none yet. */
  value: Law | null;
  title: string;
  isDisabled?: boolean;
  onChoose: (law: Law) => unknown;
}

/** Select one of the installed laws. */
export function LawPicker(props: LawPickerProps) {
  return (
    <Popup
      class="button is-small strong law-picker"
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
