/** The users of a class, their queue for the control lease, and their private sessions. */
import type { ClassState } from "../../core/api/access";
import { access, isInstructor } from "../../core/state/access";
import { handOver, lock, queue } from "../../core/state/control";
import { t } from "../../core/text/t";
import { Table } from "../../core/widgets/tables";

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
      label={t("classroom.here", { count: people.length })}
      class="boxes"
      caption={t("classroom.here", { count: people.length })}
      heads={[
        t("classroom.name"),
        t("classroom.role"),
        t("classroom.sees"),
        ...(isInstructor.value ? [<span class="visually-hidden">{t("classroom.act")}</span>] : []),
      ]}
    >
      {ordered.map((person) => (
        <tr key={person.id}>
          <th scope="row">
            {person.name} {person.id === access.value?.id && <small>({t("classroom.you")})</small>}
            <small class="block nowrap">{person.id}</small>
          </th>
          <td>{t(`classroom.roles.${person.role}`)}</td>
          <td>
            {person.sees.map((name) => (name === SHARED ? t("classroom.shared") : name)).join(", ")}
          </td>
          {isInstructor.value && (
            <td class="number">
              {person.role !== "instructor" && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={t("classroom.remove", { name: person.name })}
                  title={t("classroom.removeHint")}
                  onClick={() => remove(person.id)}
                >
                  {t("classroom.removeShort")}
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
      <h3>{t("classroom.removed")}</h3>
      <p class="hint">{t("classroom.removedHint")}</p>
      <ul class="stack">
        {removed.map((person) => (
          <li key={person.id} class="row">
            <span class="grow">
              {person.name} <small class="nowrap">{person.id}</small>
            </span>
            <button
              type="button"
              class="button is-small"
              aria-label={t("classroom.restore", { name: person.name })}
              onClick={() => restore(person.id)}
            >
              {t("classroom.restoreShort")}
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
      <h3>{t("classroom.queue")}</h3>
      {waiting.length === 0 && <p class="hint">{t("classroom.queueEmpty")}</p>}
      <ol class="bullets">
        {waiting.map((user) => (
          <li key={user.id}>
            <div class="row">
              <span class="grow">{user.name}</span>
              {isInstructor.value && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={t("classroom.give", { name: user.name })}
                  onClick={() => void handOver(user.id)}
                >
                  {t("classroom.giveShort")}
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
          title={t("classroom.lockHint")}
          onClick={() => void lock(queue.peek()?.locked !== true)}
        >
          {queue.value.locked ? t("classroom.unlock") : t("classroom.lock")}
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
      <h3>{t("classroom.sessions")}</h3>
      {sessions.length === 0 && <p class="hint">{t("classroom.noSessions")}</p>}
      <ul class="stack">
        {sessions.map((privateSession) => (
          <li key={privateSession.session} class="row">
            <span class="grow">
              {privateSession.owner} ·{" "}
              {t(`status.${privateSession.status as "running" | "paused" | "fault"}`)}
              {privateSession.recording && ` · ${t("classroom.recording")}`}
            </span>
            <a
              class="button is-small"
              aria-label={t("classroom.openSession", { owner: privateSession.owner })}
              href={`?session=${encodeURIComponent(privateSession.session)}`}
            >
              {t("classroom.openShort")}
            </a>
            <button
              type="button"
              class="button is-small"
              aria-label={t("classroom.end", { owner: privateSession.owner })}
              onClick={() => end(privateSession.session)}
            >
              {t("classroom.endShort")}
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
