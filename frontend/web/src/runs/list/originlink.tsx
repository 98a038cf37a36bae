import type { RunSummary } from "../../core/api/types";
import { text } from "../../core/text/en";
import { Marked } from "./marked";
import { PlaceLink } from "./placelink";

type Origin = NonNullable<RunSummary["branch_of"]>;

const words = text.runs;

/** The run that a branch goes on from, and the moment at which it left it. */
export function OriginLink({ origin }: { origin: Origin }) {
  const { run_id: run, title, time_s: timeS } = origin;
  const name = title ?? run;
  const at = timeS === null ? "" : words.at(words.seconds(Number(timeS.toFixed(3))));
  const told = words.branchOf(name, at);
  return (
    <span class="run-origin" title={told}>
      <svg viewBox="0 0 12 12" aria-hidden="true">
        <path d="M3 1v10M3 8c0-3 6-2 6-6" />
      </svg>
      <span class="visually-hidden">{words.branch} </span>
      {title === null ? (
        <Marked>{name}</Marked>
      ) : (
        <PlaceLink to={{ kind: "run", run, timeS: timeS ?? 0 }}>
          <Marked>{name}</Marked>
        </PlaceLink>
      )}{" "}
      {at}
    </span>
  );
}
