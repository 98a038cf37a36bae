import type { ClassState } from "../../core/api/access";
import { text } from "../../core/text/en";

const words = text.classroom;

/** The private sessions that one may see. */
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
      <ul class="class-list">
        {sessions.map((one) => (
          <li key={one.session}>
            <span>
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
