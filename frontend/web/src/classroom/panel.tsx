import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import {
  broadcast,
  type ClassCode,
  type ClassState,
  createToken,
  endSession,
  leave,
  readClass,
  renewCode,
} from "../api/access";
import { PlaceLink } from "../runs/placelink";
import { access, isClass, isInstructor, learnAccess } from "../state/access";
import { explain } from "../state/actions";
import { handOver, lock, queue } from "../state/control";
import { phase } from "../state/session";
import { text } from "../text/en";
import { Panel } from "../widgets/panel";
import { PanelButton } from "../widgets/panelbutton";
import { isOpen, READ_MS } from "./open";

const words = text.classroom;
const SHARED = "lab";

function close(): void {
  isOpen.value = false;
}

function People({ people }: { people: ClassState["people"] }) {
  return (
    <table class="class-table">
      <caption>{words.here(people.length)}</caption>
      <thead>
        <tr>
          <th scope="col">{words.name}</th>
          <th scope="col">{words.role}</th>
          <th scope="col">{words.sees}</th>
        </tr>
      </thead>
      <tbody>
        {people.map((one) => (
          <tr key={one.id}>
            <th scope="row">
              {one.name} {one.id === access.value?.id && <small>({words.you})</small>}
            </th>
            <td>{words.roles[one.role]}</td>
            <td>{one.sees.map((name) => (name === SHARED ? words.shared : name)).join(", ")}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Waiting() {
  const waiting = queue.value?.waiting ?? [];
  return (
    <section>
      <h3>{words.queue}</h3>
      {waiting.length === 0 && <p class="hint">{words.nobodyWaits}</p>}
      <ol class="class-queue">
        {waiting.map((one) => (
          <li key={one.id}>
            {one.name}{" "}
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

function Sessions({
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
      <ul class="class-sessions">
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

function Code({ code }: { code: ClassCode }) {
  return (
    <figure class="class-qr">
      <figcaption>
        {words.codeOnce} <strong class="class-code">{code.code}</strong>
      </figcaption>
      <img src={code.qr} alt={words.qr(code.code)} />
      <span class="class-address">{code.address}</span>
      {code.is_local && <strong>{words.onlyHere}</strong>}
    </figure>
  );
}

/** Who is here, who waits, whose sessions; what only the instructor may, for the instructor. */
function Inside() {
  const told = useSignal<ClassState | null>(null);
  const code = useSignal<ClassCode | null>(null);
  const token = useSignal("");
  const note = useSignal("");
  const attempt = async (act: () => Promise<unknown>) => {
    note.value = "";
    try {
      await act();
      told.value = await readClass();
    } catch (error) {
      note.value = explain(error);
    }
  };
  useEffect(() => {
    void attempt(async () => {});
    const timer = setInterval(() => {
      readClass().then(
        (state) => {
          told.value = state;
        },
        () => {},
      );
    }, READ_MS);
    return () => clearInterval(timer);
  }, []);
  return (
    <div class="class-body">
      <p class="problem" role="alert" hidden={note.value === ""}>
        {note.value}
      </p>
      {told.value && <People people={told.value.people} />}
      <Waiting />
      {told.value && (
        <Sessions
          sessions={told.value.sessions}
          end={(name) => void attempt(() => endSession(name))}
        />
      )}
      {isInstructor.value && (
        <div class="class-acts">
          <button
            type="button"
            class="button"
            title={words.broadcastHint}
            onClick={() =>
              void attempt(async () => {
                const sent = await broadcast();
                note.value = words.sent(sent.taken, sent.refused.length);
              })
            }
          >
            {words.broadcast}
          </button>
          <button
            type="button"
            class="button"
            title={words.newCodeHint}
            onClick={() =>
              void attempt(async () => {
                code.value = await renewCode();
              })
            }
          >
            {words.newCode}
          </button>
          <PlaceLink to={{ kind: "list" }} class="button">
            {words.runs}
          </PlaceLink>
        </div>
      )}
      {code.value && <Code code={code.value} />}
      <div class="class-acts">
        <button
          type="button"
          class="button"
          title={words.scriptHint}
          onClick={() =>
            void attempt(async () => {
              token.value = (await createToken()).token;
            })
          }
        >
          {words.script}
        </button>
        <button
          type="button"
          class="button"
          onClick={() =>
            void attempt(async () => {
              await leave();
              await learnAccess();
              close();
              phase.value = "locked";
            })
          }
        >
          {words.leave}
        </button>
      </div>
      {token.value !== "" && (
        <p class="class-token">
          {words.scriptOnce} <code>{token.value}</code>
        </p>
      )}
    </div>
  );
}

export function ClassPanel() {
  if (!isOpen.value || !isClass.value || access.value?.inside !== true) return null;
  return (
    <Panel title={words.panelTitle} class="class-panel" onClose={close}>
      <Inside />
    </Panel>
  );
}

export function ClassButton() {
  if (!isClass.value) return null;
  return (
    <PanelButton isOpen={isOpen} hint={words.openHint} name={words.open}>
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M5.5 7.5a2.75 2.75 0 1 0 0-5.5 2.75 2.75 0 0 0 0 5.5zM0 14c0-3 2.2-5 5.5-5S11 11 11 14zM11 7.5a2.25 2.25 0 1 0-.9-4.3 4 4 0 0 1 0 3.9q.4.4.9.4zM12.3 14H16c0-2.6-1.8-4.5-4.6-4.5l-.6.1c1 1 1.5 2.5 1.5 4.4z" />
      </svg>
    </PanelButton>
  );
}
