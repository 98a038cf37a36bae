import type { Row } from "../../core/api/ranking";
import { Formula } from "../../core/equations/formula";
import { shortenFault } from "../../core/state/faults";
import { lawOf, titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { formatError, formatNumber } from "../../core/units";
import { chosen, rowOf, see, splitSource } from "./ranking";

const words = text.ranking;

function Source({ source }: { source: string }) {
  if (source === "") return null;
  const { said, doi } = splitSource(source);
  return (
    <p class="hint">
      {words.source} {said}
      {doi !== "" && (
        <a href={`https://doi.org/${doi}`} target="_blank" rel="noreferrer">
          {words.doi(doi)}
        </a>
      )}
    </p>
  );
}

function Outcomes({ row }: { row: Row }) {
  return (
    <ul class="menu">
      {row.outcomes.map((one) => (
        <li key={one.scenario}>
          <button
            type="button"
            title={words.seeRun}
            onClick={() => void see(row.law, one.scenario)}
          >
            <span>{one.title}</span>
            <b class={`end ${one.fault === null ? "" : "bad"}`}>
              {one.fault === null
                ? words.outcome(
                    formatError(one.rms_deg),
                    formatNumber(one.peak_deg, 3, 2),
                    formatNumber(one.torque_change_nm, 2, 3),
                  )
                : shortenFault(one.fault)}
            </b>
          </button>
        </li>
      ))}
    </ul>
  );
}

/** The law that was chosen last: what it is, where it fails and why, every run of it. */
export function LawCard() {
  const name = chosen.value.at(-1);
  const row = name === undefined ? undefined : rowOf(name);
  const law = name === undefined ? undefined : lawOf(name);
  if (name === undefined || row === undefined) return null;
  const paragraphs = (law?.notes ?? "").split(/\n\s*\n/).filter((part) => part !== "");
  return (
    <section class="surface card" aria-labelledby="ranking-law-title">
      <h3 id="ranking-law-title">{titleOf(name)}</h3>
      {law && <Formula tex={law.equation} />}
      {paragraphs.map((part) => (
        <p key={part.slice(0, 40)}>{part}</p>
      ))}
      {law && <Source source={law.source} />}
      <h4>{words.runs}</h4>
      <p class="hint">{words.runsHint}</p>
      <Outcomes row={row} />
    </section>
  );
}
