import { useEffect } from "preact/hooks";
import type { RunList } from "../../core/api/types";
import { t } from "../../core/text/t";
import { Pager } from "../../core/widgets/tables";
import { Finder } from "./finder";
import {
  followList,
  isFiltered,
  isTrash,
  PAGE_SIZE,
  pageNumber,
  refresh,
  runList,
  selectedRuns,
  showAll,
} from "./list";
import { goTo, PlaceLink } from "./place";
import { RunTable } from "./table";

const RECORDING_MS = 3000;

function Overlayer() {
  const count = selectedRuns.value.length;
  return (
    <div class="row end">
      {count > 0 && (
        <button
          type="button"
          class="quiet"
          onClick={() => {
            selectedRuns.value = [];
          }}
        >
          {t("runs.clear")}
        </button>
      )}
      <button
        type="button"
        class="button is-primary"
        disabled={count < 2}
        title={t("runs.overlayHint")}
        onClick={() => goTo({ kind: "overlay", runs: selectedRuns.peek() })}
      >
        {count < 2 ? t("runs.overlayRuns") : t("runs.overlay", { selected: count })}
      </button>
    </div>
  );
}

function Empty() {
  if (isTrash.value && !isFiltered.value) return <p class="empty">{t("runs.emptyTrash")}</p>;
  if (isFiltered.value) {
    return (
      <div class="empty">
        <p translate>{t("runs.nothing")}</p>
        <button type="button" class="button" onClick={showAll}>
          {t("runs.showAll")}
        </button>
      </div>
    );
  }
  return (
    <div class="empty">
      <svg viewBox="0 0 200 44" aria-hidden="true">
        <path d="M0 30h70c6 0 6-26 12-26s5 30 12 30 5-6 12-4h94" />
      </svg>
      <h3>{t("runs.emptyTitle")}</h3>
      <p translate>{t("runs.emptyText")}</p>
      <PlaceLink to={{ kind: "lab" }} class="button is-primary">
        {t("runs.openLab")}
      </PlaceLink>
    </div>
  );
}

function Pages({ total }: { total: number }) {
  const page = pageNumber.value;
  const first = (page - 1) * PAGE_SIZE + 1;
  return (
    <Pager
      label={t("runs.pages")}
      page={page}
      pages={Math.ceil(total / PAGE_SIZE)}
      back={t("runs.pageBefore")}
      on={t("runs.pageAfter")}
      onTurn={(to) => {
        pageNumber.value = to;
      }}
    >
      {t("runs.shown", { first, last: Math.min(first + PAGE_SIZE - 1, total), total })}
    </Pager>
  );
}

function Indexing({ progress }: { progress: NonNullable<RunList["indexing"]> }) {
  const { done, total } = progress;
  return (
    <div class="row">
      <span role="status">
        {total === 0 ? t("runs.reading") : t("runs.indexing", { done, total })}
      </span>
      <progress value={done} max={Math.max(1, total)} aria-label={t("runs.indexingLabel")} />
    </div>
  );
}

/** Every recorded run as a table, newest first. */
export function ListPage() {
  useEffect(followList, []);
  const list = runList.value;
  const indexing = list?.indexing ?? null;
  const isRecorded = list?.runs.some((run) => run.state === "recording") ?? false;
  const isGrowing = isRecorded || indexing !== null;
  useEffect(() => {
    if (!isGrowing) return;
    const timer = setInterval(() => void refresh(), RECORDING_MS);
    return () => clearInterval(timer);
  }, [isGrowing]);
  return (
    <>
      <div class="row">
        <h2>
          {t("runs.title")}{" "}
          {list && <small class="unit">{t("runs.count", { count: list.total })}</small>}
        </h2>
        <Finder />
        {list && <Pages total={list.total} />}
        <Overlayer />
      </div>
      {list?.problem && (
        <p class="note is-bad" role="alert">
          {list.problem}
        </p>
      )}
      {indexing !== null && <Indexing progress={indexing} />}
      {list === null && <p class="empty">{t("runs.loading")}</p>}
      {list?.runs.length === 0 && <Empty />}
      {list && list.runs.length > 0 && <RunTable runs={list.runs} />}
    </>
  );
}
