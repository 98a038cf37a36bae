/** The users of a class, their queue for the control lease, and their private sessions. */
import type { ClassState } from "../../core/api/access";
import { access, handOver, isInstructor, lock, queue } from "../../core/state/control";
import { text } from "../../core/text/en";
import { Table } from "../../core/widgets/tables";

const words = text.classroom;
const SHARED = "lab";

/** The members, and the session that each sees; the instructor can remove members. */
export function People({
  people,
  remove,
}: {
  people: ClassState["people"];
  remove: (id: string) => void;
}) {
  const ordered = [...people].sort((one, other) => one.name.localeCompare(other.name));
  return (
    <Table
      label={words.here(people.length)}
      class="class-people"
      caption={words.here(people.length)}
      heads={[
        words.name,
        words.role,
        words.sees,
        ...(isInstructor.value ? [<span class="visually-hidden">{words.act}</span>] : []),
      ]}
    >
      {ordered.map((one) => (
        <tr key={one.id}>
          <th scope="row">
            {one.name} {one.id === access.value?.id && <small>({words.you})</small>}
            <small class="block nowrap">{one.id}</small>
          </th>
          <td>{words.roles[one.role]}</td>
          <td>{one.sees.map((name) => (name === SHARED ? words.shared : name)).join(", ")}</td>
          {isInstructor.value && (
            <td class="number">
              {one.role !== "instructor" && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={words.remove(one.name)}
                  title={words.removeHint}
                  onClick={() => remove(one.id)}
                >
                  {words.removeShort}
                </button>
              )}
            </td>
          )}
        </tr>
      ))}
    </Table>
  );
}

/** Removed users, whom the instructor can admit again. */
export function Removed({
  removed,
  restore,
}: {
  removed: ClassState["removed"];
  restore: (id: string) => void;
}) {
  if (removed.length === 0) return null;
  return (
    <section>
      <h3>{words.removed}</h3>
      <p class="hint">{words.removedHint}</p>
      <ul class="stack">
        {removed.map((one) => (
          <li key={one.id} class="row">
            <span class="grow">
              {one.name} <small class="nowrap">{one.id}</small>
            </span>
            <button
              type="button"
              class="button is-small"
              aria-label={words.restore(one.name)}
              onClick={() => restore(one.id)}
            >
              {words.restoreShort}
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

/** The queue for control; the instructor can pass control to any user in it, and lock it. */
export function Waiting() {
  const waiting = queue.value?.waiting ?? [];
  return (
    <section>
      <h3>{words.queue}</h3>
      {waiting.length === 0 && <p class="hint">{words.queueEmpty}</p>}
      <ol class="bullets">
        {waiting.map((one) => (
          <li key={one.id}>
            <div class="row">
              <span class="grow">{one.name}</span>
              {isInstructor.value && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={words.give(one.name)}
                  onClick={() => void handOver(one.id)}
                >
                  {words.giveShort}
                </button>
              )}
            </div>
          </li>
        ))}
      </ol>
      {isInstructor.value && queue.value !== null && (
        <button
          type="button"
          class="button"
          title={words.lockHint}
          onClick={() => void lock(queue.peek()?.locked !== true)}
        >
          {queue.value.locked ? words.unlock : words.lock}
        </button>
      )}
    </section>
  );
}

/** The private sessions that this user may open. */
export function Sessions({
  sessions,
  end,
}: {
  sessions: ClassState["sessions"];
  end: (name: string) => void;
}) {
  return (
    <section>
      <h3>{words.sessions}</h3>
      {sessions.length === 0 && <p class="hint">{words.noSessions}</p>}
      <ul class="stack">
        {sessions.map((one) => (
          <li key={one.session} class="row">
            <span class="grow">
              {one.owner} · {text.status[one.status as "running" | "paused" | "fault"]}
              {one.recording && ` · ${words.recording}`}
            </span>
            <a
              class="button is-small"
              aria-label={words.openSession(one.owner)}
              href={`?session=${encodeURIComponent(one.session)}`}
            >
              {words.openShort}
            </a>
            <button
              type="button"
              class="button is-small"
              aria-label={words.end(one.owner)}
              onClick={() => end(one.session)}
            >
              {words.endShort}
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
