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
  const ordered = [...people].sort((first, second) => first.name.localeCompare(second.name));
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
      {ordered.map((person) => (
        <tr key={person.id}>
          <th scope="row">
            {person.name} {person.id === access.value?.id && <small>({words.you})</small>}
            <small class="block nowrap">{person.id}</small>
          </th>
          <td>{words.roles[person.role]}</td>
          <td>{person.sees.map((name) => (name === SHARED ? words.shared : name)).join(", ")}</td>
          {isInstructor.value && (
            <td class="number">
              {person.role !== "instructor" && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={words.remove(person.name)}
                  title={words.removeHint}
                  onClick={() => remove(person.id)}
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
        {removed.map((person) => (
          <li key={person.id} class="row">
            <span class="grow">
              {person.name} <small class="nowrap">{person.id}</small>
            </span>
            <button
              type="button"
              class="button is-small"
              aria-label={words.restore(person.name)}
              onClick={() => restore(person.id)}
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
        {waiting.map((user) => (
          <li key={user.id}>
            <div class="row">
              <span class="grow">{user.name}</span>
              {isInstructor.value && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={words.give(user.name)}
                  onClick={() => void handOver(user.id)}
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
        {sessions.map((privateSession) => (
          <li key={privateSession.session} class="row">
            <span class="grow">
              {privateSession.owner} ·{" "}
              {text.status[privateSession.status as "running" | "paused" | "fault"]}
              {privateSession.recording && ` · ${words.recording}`}
            </span>
            <a
              class="button is-small"
              aria-label={words.openSession(privateSession.owner)}
              href={`?session=${encodeURIComponent(privateSession.session)}`}
            >
              {words.openShort}
            </a>
            <button
              type="button"
              class="button is-small"
              aria-label={words.end(privateSession.owner)}
              onClick={() => end(privateSession.session)}
            >
              {words.endShort}
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
