import { useComputed } from "@preact/signals";
import { useEffect, useMemo, useState } from "preact/hooks";
import type { Law } from "../../core/api/types";
import { isGoing } from "../../core/jobs/progress";
import type { LineStyle } from "../../core/plots/definitions";
import { lineStylesOfLaws } from "../../core/plots/linestyles";
import { laws as installedLaws, titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { Desk } from "../../core/widgets/desk";
import { PlaceLink } from "../../runs/list/place";
import {
  chosen,
  findingOf,
  follow,
  kept,
  keyOf,
  laws,
  leave,
  openLists,
  problem,
  runThem,
  scenario,
  searches,
  shown,
  traced,
} from "./falsifier";
import { Found } from "./found";
import { Laws } from "./laws";
import { type DrawnLaw, Picture } from "./picture";
import { Start } from "./start";

const words = text.falsifier;
const MAX_DRAWN = 4;

function Kept() {
  const { search: shown, scenario: name } = chosen.value;
  return (
    <>
      <nav class="surface card menu" aria-label={words.kept}>
        <h3>{words.kept}</h3>
        {kept.value === null && problem.value === "" && <p class="hint">{words.loading}</p>}
        {kept.value?.length === 0 && <p class="hint">{words.noneKept}</p>}
        <ul>
          {(kept.value ?? []).map((one) => (
            <li key={one.name} aria-current={one.name === name ? "page" : undefined}>
              <PlaceLink
                to={{ kind: "falsifier", search: "", scenario: one.name, laws: [] }}
                title={one.title}
              >
                <b>{one.name}</b>
                <small>{findingOf(one.scenario)?.outcome ?? one.title}</small>
              </PlaceLink>
            </li>
          ))}
        </ul>
      </nav>
      {searches.value !== null && searches.value.length > 0 && (
        <nav class="surface card menu" aria-label={words.searches}>
          <h3>{words.searches}</h3>
          <ul>
            {searches.value.map((one) => (
              <li key={one.id} aria-current={one.id === shown ? "page" : undefined}>
                <PlaceLink
                  to={{ kind: "falsifier", search: one.id, scenario: "", laws: [] }}
                  title={one.title}
                >
                  <b>{titleOf(one.law)}</b>
                  <small>
                    {isGoing(one)
                      ? text.jobs.status[one.status]
                      : ((one.scenario && findingOf(one.scenario)?.outcome) ??
                        text.jobs.status[one.status])}
                  </small>
                </PlaceLink>
              </li>
            ))}
          </ul>
        </nav>
      )}
    </>
  );
}

/** The picture of it and the laws under it, of whichever came last. */
function Under() {
  const one = scenario.value;
  const [picked, setPicked] = useState<readonly Law[] | null>(null);
  const wanted = useComputed(() => scenario.value && keyOf(scenario.value, laws.value)).value;
  useEffect(() => void runThem(), [wanted]);
  const trace = shown.value;
  const names = picked ?? trace?.laws.map(({ law }) => law).slice(0, MAX_DRAWN) ?? [];
  const installed = installedLaws.value;
  const drawn = useMemo(() => {
    const found = names.flatMap((law) => trace?.laws.find((other) => other.law === law) ?? []);
    const lineStyles = lineStylesOfLaws(found.map(({ law }) => law));
    return found.map(
      (one, index): DrawnLaw => ({ ...one, lineStyle: lineStyles[index] as LineStyle }),
    );
  }, [trace, names.join(), installed]);
  if (one === null) return null;
  if (trace === null) return <p class="hint wide">{problem.value === "" && words.running}</p>;
  const draw = (law: Law) =>
    setPicked(names.includes(law) ? names.filter((name) => name !== law) : [...names, law]);
  return (
    <>
      <Picture scenario={one} trace={trace} drawn={drawn} />
      <Laws
        traces={trace.laws}
        drawn={drawn}
        isRunning={traced.value?.key !== wanted && problem.value === ""}
        onDraw={draw}
      />
    </>
  );
}

/** The load that hurts a law most: searched, made simple, kept, and put to any law. */
export function FalsifierPage() {
  const { search: id, scenario: name } = chosen.value;
  useEffect(() => {
    void openLists();
  }, []);
  useEffect(() => {
    void follow(id);
    return leave;
  }, [id, name]);
  return (
    <Desk
      title={words.title}
      lead={words.lead}
      problem={problem.value}
      side={
        <>
          <Kept />
          <Start />
        </>
      }
    >
      {id === "" && name === "" ? (
        <p class="hint">{words.choose}</p>
      ) : (
        <div class="halves">
          <Found scenario={scenario.value} />
          <Under key={`${id} ${name}`} />
        </div>
      )}
    </Desk>
  );
}
