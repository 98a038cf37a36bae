import { useEffect } from "preact/hooks";
import type { AuditLine } from "../../core/api/access";
import { t } from "../../core/text/t";
import { ErrorLine, SelectField } from "../../core/widgets/form";
import { Pager, Table } from "../../core/widgets/tables";
import {
  auditPage,
  auditQuery,
  countPages,
  describeResult,
  formatTime,
  goToPage,
  isReading,
  nameKind,
  problem,
  queryAudit,
} from "./audit";

const SHARED = "lab";

/** The session, and its tick at that time. */
function Place({ line }: { line: AuditLine }) {
  if (line.session === null) return null;
  return (
    <>
      {line.session === SHARED ? t("classroom.shared") : line.session}
      {line.tick !== null && <small>{t("classroom.audit.tick", { tick: line.tick })}</small>}
    </>
  );
}

function Line({ line, now }: { line: AuditLine; now: Date }) {
  return (
    <tr>
      <td class="muted nowrap">
        <time dateTime={line.time} title={line.time}>
          {formatTime(line.time, now)}
        </time>
      </td>
      <th scope="row" class="strong" title={line.person ?? undefined}>
        {line.name ?? t("classroom.audit.stranger")}
      </th>
      <td title={line.path ?? undefined}>
        {line.did} <small>{nameKind(line.kind)}</small>
      </td>
      <td class="breaks">
        <Place line={line} />
      </td>
      <td class={line.refused ? "bad" : "muted"}>{describeResult(line)}</td>
    </tr>
  );
}

function Filters() {
  const { people = [], kinds = [] } = auditPage.value ?? {};
  const { person, kind, onlyRefused } = auditQuery.value;
  return (
    <div class="row form">
      <SelectField
        label={t("classroom.audit.person")}
        value={person}
        options={["", ...people.map(({ id }) => id)]}
        name={(personId) =>
          people.find(({ id }) => id === personId)?.name ?? t("classroom.audit.allPersons")
        }
        onChoose={(chosen) => void queryAudit({ person: chosen })}
      />
      <SelectField
        label={t("classroom.audit.kind")}
        value={kind}
        options={["", ...kinds]}
        name={(option) => (option === "" ? t("classroom.audit.everyKind") : nameKind(option))}
        onChoose={(chosen) => void queryAudit({ kind: chosen })}
      />
      <label class="row">
        <input
          type="checkbox"
          checked={onlyRefused}
          onChange={(event) => void queryAudit({ onlyRefused: event.currentTarget.checked })}
        />
        <span>{t("classroom.audit.onlyRefused")}</span>
      </label>
      <button
        type="button"
        class="button is-small end"
        aria-disabled={isReading.value}
        onClick={() => void queryAudit()}
      >
        {t("classroom.audit.newest")}
      </button>
    </div>
  );
}

function Pages({ total }: { total: number }) {
  const { page } = auditQuery.value;
  const pages = countPages(total);
  return (
    <Pager
      label={t("classroom.audit.pages")}
      page={page}
      pages={pages}
      back={t("classroom.audit.newer")}
      on={t("classroom.audit.older")}
      onTurn={(to) => void goToPage(to)}
    >
      {t("classroom.audit.page", { page, count: pages, total })}
    </Pager>
  );
}

function Lines() {
  const page = auditPage.value;
  useEffect(() => {
    void queryAudit();
  }, []);
  const now = new Date();
  return (
    <>
      <Filters />
      <ErrorLine>{problem.value}</ErrorLine>
      {page === null ? (
        <p class="hint">{problem.value === "" && t("classroom.audit.reading")}</p>
      ) : page.lines.length === 0 ? (
        <p class="hint">{t("classroom.audit.none")}</p>
      ) : (
        <Table
          heads={[
            t("classroom.audit.time"),
            t("classroom.audit.who"),
            t("classroom.audit.what"),
            t("classroom.audit.where"),
            t("classroom.audit.end"),
          ]}
        >
          {page.lines.map((line, row) => (
            <Line key={`${line.time} ${row}`} line={line} now={now} />
          ))}
        </Table>
      )}
      {page !== null && <Pages total={page.total} />}
    </>
  );
}

/**
 * The log of all actions with user, session and tick, for the instructor; read when it is opened.
 */
export function AuditLog({ isOpen, onToggle }: { isOpen: boolean; onToggle: () => void }) {
  return (
    <section class="stack">
      <h3>
        <button type="button" class="quiet" aria-expanded={isOpen} onClick={onToggle}>
          {isOpen ? "▾" : "▸"} {t("classroom.audit.title")}
        </button>
      </h3>
      {isOpen && <Lines />}
    </section>
  );
}
