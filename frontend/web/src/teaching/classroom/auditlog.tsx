import { useEffect } from "preact/hooks";
import type { AuditLine } from "../../core/api/access";
import { text } from "../../core/text/en";
import { ErrorLine } from "../../core/widgets/form";
import {
  askFor,
  auditPage,
  countPages,
  describeEnd,
  formatTime,
  isReading,
  nameKind,
  problem,
  turnTo,
  wish,
} from "./audit";

const words = text.classroom.audit;
const SHARED = "lab";

/** Where it was: the session, and its tick then. */
function Place({ line }: { line: AuditLine }) {
  if (line.session === null) return null;
  return (
    <>
      {line.session === SHARED ? text.classroom.shared : line.session}
      {line.tick !== null && <small>{words.tick(line.tick)}</small>}
    </>
  );
}

function Line({ line, now }: { line: AuditLine; now: Date }) {
  return (
    <tr class={line.refused ? "is-refused" : undefined}>
      <td class="audit-time">
        <time dateTime={line.time} title={line.time}>
          {formatTime(line.time, now)}
        </time>
      </td>
      <th scope="row">{line.name ?? words.stranger}</th>
      <td class="audit-what" title={line.path ?? undefined}>
        {line.did} <small>{nameKind(line.kind)}</small>
      </td>
      <td class="audit-place">
        <Place line={line} />
      </td>
      <td class="audit-end">{describeEnd(line)}</td>
    </tr>
  );
}

function Filters() {
  const { people = [], kinds = [] } = auditPage.value ?? {};
  const { person, kind, onlyRefused } = wish.value;
  return (
    <div class="audit-filters">
      <label>
        <span>{words.person}</span>
        <select
          value={person}
          onChange={(event) => void askFor({ person: event.currentTarget.value })}
        >
          <option value="">{words.everybody}</option>
          {people.map((one) => (
            <option key={one.id} value={one.id}>
              {one.name}
            </option>
          ))}
        </select>
      </label>
      <label>
        <span>{words.kind}</span>
        <select value={kind} onChange={(event) => void askFor({ kind: event.currentTarget.value })}>
          <option value="">{words.everyKind}</option>
          {kinds.map((one) => (
            <option key={one} value={one}>
              {nameKind(one)}
            </option>
          ))}
        </select>
      </label>
      <label class="audit-refused">
        <input
          type="checkbox"
          checked={onlyRefused}
          onChange={(event) => void askFor({ onlyRefused: event.currentTarget.checked })}
        />
        <span>{words.onlyRefused}</span>
      </label>
      <button
        type="button"
        class="button is-small"
        aria-disabled={isReading.value}
        onClick={() => void askFor()}
      >
        {words.newest}
      </button>
    </div>
  );
}

function Pages({ total }: { total: number }) {
  const { page } = wish.value;
  const count = countPages(total);
  if (count === 1) return null;
  return (
    <nav class="audit-pages" aria-label={words.pages}>
      <button
        type="button"
        class="button is-small"
        disabled={page <= 1}
        onClick={() => void turnTo(page - 1)}
      >
        {words.newer}
      </button>
      <span role="status">{words.page(page, count, total)}</span>
      <button
        type="button"
        class="button is-small"
        disabled={page >= count}
        onClick={() => void turnTo(page + 1)}
      >
        {words.older}
      </button>
    </nav>
  );
}

function Lines() {
  const page = auditPage.value;
  useEffect(() => {
    void askFor();
  }, []);
  const now = new Date();
  return (
    <>
      <Filters />
      <ErrorLine>{problem.value}</ErrorLine>
      {page === null ? (
        <p class="hint">{problem.value === "" && words.reading}</p>
      ) : page.lines.length === 0 ? (
        <p class="hint">{words.none}</p>
      ) : (
        <table class="class-table audit-table">
          <thead>
            <tr>
              <th scope="col">{words.time}</th>
              <th scope="col">{words.who}</th>
              <th scope="col">{words.what}</th>
              <th scope="col">{words.where}</th>
              <th scope="col">{words.end}</th>
            </tr>
          </thead>
          <tbody>
            {page.lines.map((line, row) => (
              <Line key={`${line.time} ${row}`} line={line} now={now} />
            ))}
          </tbody>
        </table>
      )}
      {page !== null && <Pages total={page.total} />}
    </>
  );
}

/** Who did what, where and at which tick, for the instructor; read when it is opened. */
export function AuditLog({ isOpen, onToggle }: { isOpen: boolean; onToggle: () => void }) {
  return (
    <section class="audit">
      <h3>
        <button type="button" class="quiet" aria-expanded={isOpen} onClick={onToggle}>
          {words.title}
        </button>
      </h3>
      {isOpen && <Lines />}
    </section>
  );
}
