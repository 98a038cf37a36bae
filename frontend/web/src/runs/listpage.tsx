import { useEffect } from "preact/hooks";
import { text } from "../text/en";
import {
  ask,
  chosen,
  followList,
  found,
  isTrash,
  PAGE_SIZE,
  pageNumber,
  refresh,
  search,
  tag,
} from "./list";
import { goTo } from "./place";
import { PlaceLink } from "./placelink";
import { RunRow } from "./row";

const words = text.runs;
const RECORDING_MS = 3000;

function Finder() {
  const tags = Object.entries(found.value?.tags ?? {});
  return (
    <search class="runs-finder">
      <label>
        <span class="visually-hidden">{words.search}</span>
        <input
          type="search"
          maxLength={200}
          placeholder={words.searchHint}
          value={search.value}
          onInput={(event) => ask({ search: event.currentTarget.value })}
        />
      </label>
      {tags.length > 0 && (
        <label>
          <span class="visually-hidden">{words.tag}</span>
          <select value={tag.value} onChange={(event) => ask({ tag: event.currentTarget.value })}>
            <option value="">{words.anyTag}</option>
            {tags.map(([name, count]) => (
              <option key={name} value={name}>
                {words.tagCount(name, count)}
              </option>
            ))}
          </select>
        </label>
      )}
      <button
        type="button"
        class="button"
        aria-pressed={isTrash.value}
        title={words.trashHint}
        onClick={() => ask({ isTrash: !isTrash.peek() })}
      >
        {words.trash}
      </button>
    </search>
  );
}

function Overlayer() {
  const count = chosen.value.length;
  return (
    <div class="runs-overlayer">
      {count > 0 && (
        <button
          type="button"
          class="quiet"
          onClick={() => {
            chosen.value = [];
          }}
        >
          {words.clear}
        </button>
      )}
      <button
        type="button"
        class="button is-primary"
        disabled={count < 2}
        title={words.overlayHint}
        onClick={() => goTo({ kind: "overlay", runs: chosen.peek() })}
      >
        {words.overlay(count)}
      </button>
    </div>
  );
}

function Empty() {
  if (isTrash.value) return <p class="runs-empty">{words.emptyTrash}</p>;
  if (search.value.trim() !== "" || tag.value !== "") {
    return (
      <div class="runs-empty">
        <p>{words.nothing}</p>
        <button type="button" class="button" onClick={() => ask({ search: "", tag: "" })}>
          {words.showAll}
        </button>
      </div>
    );
  }
  return (
    <div class="runs-empty">
      <svg viewBox="0 0 200 44" aria-hidden="true">
        <path d="M0 30h70c6 0 6-26 12-26s5 30 12 30 5-6 12-4h94" />
      </svg>
      <h3>{words.emptyTitle}</h3>
      <p>{words.emptyText}</p>
      <PlaceLink to={{ kind: "lab" }} class="button is-primary">
        {words.back}
      </PlaceLink>
    </div>
  );
}

function Pager({ total }: { total: number }) {
  const pages = Math.ceil(total / PAGE_SIZE);
  if (pages < 2) return null;
  const now = pageNumber.value;
  const go = (page: number) => {
    pageNumber.value = page;
  };
  return (
    <nav class="pager" aria-label={words.pages}>
      <button type="button" class="button" disabled={now <= 1} onClick={() => go(now - 1)}>
        {words.newer}
      </button>
      <span aria-live="polite">{words.page(now, pages)}</span>
      <button type="button" class="button" disabled={now >= pages} onClick={() => go(now + 1)}>
        {words.older}
      </button>
    </nav>
  );
}

/** Every recorded run, newest first. */
export function ListPage() {
  useEffect(followList, []);
  const list = found.value;
  const isGrowing = list?.runs.some((run) => run.state === "recording") ?? false;
  useEffect(() => {
    if (!isGrowing) return;
    const timer = setInterval(() => void refresh(), RECORDING_MS);
    return () => clearInterval(timer);
  }, [isGrowing]);
  return (
    <>
      <div class="runs-head">
        <h2>
          {words.title} {list && <small class="unit">{words.count(list.total)}</small>}
        </h2>
        <Finder />
        <Overlayer />
      </div>
      {list === null && <p class="runs-empty">{words.loading}</p>}
      {list?.runs.length === 0 && <Empty />}
      {list && list.runs.length > 0 && (
        <ul class="run-rows" aria-label={words.list}>
          {list.runs.map((run) => (
            <RunRow key={run.id} run={run} />
          ))}
        </ul>
      )}
      {list && <Pager total={list.total} />}
    </>
  );
}
