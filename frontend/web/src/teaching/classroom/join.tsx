import { signal } from "@preact/signals";
import { useId, useState } from "preact/hooks";
import { join, login, rejoin } from "../../core/api/access";
import { access } from "../../core/state/access";
import { MAX_NAME_LENGTH, personName, setPersonName } from "../../core/state/preferences";
import { t } from "../../core/text/t";

/** A student's name and the class code. */
function StudentForm({ enter }: EnterProps) {
  const id = useId();
  const [name, setName] = useState(personName.peek());
  const [code, setCode] = useState(takeCode);
  const submit = (event: Event) => {
    event.preventDefault();
    enter(async () => {
      const joined = await join(name.trim(), code);
      setPersonName(joined.name);
      rejoinCode.value = joined.rejoin_code;
    });
  };
  return (
    <form class="stack" onSubmit={submit}>
      <label for={`${id}-name`}>{t("control.name")}</label>
      <input
        id={`${id}-name`}
        type="text"
        required
        maxLength={MAX_NAME_LENGTH}
        autocomplete="name"
        value={name}
        onInput={(event) => setName(event.currentTarget.value)}
      />
      <label for={`${id}-code`}>{t("classroom.code")}</label>
      <input
        id={`${id}-code`}
        type="text"
        required
        maxLength={20}
        autocomplete="off"
        autocapitalize="characters"
        spellcheck={false}
        class="class-code"
        value={code}
        onInput={(event) => setCode(event.currentTarget.value)}
      />
      <button type="submit" class="button is-primary">
        {t("classroom.join")}
      </button>
    </form>
  );
}

const WAYS = ["student", "back", "instructor"] as const;

/** Ways to enter a class: as a new student, with a rejoin code, or as the instructor. */
export function Join({ enter }: EnterProps) {
  const [chosen, choose] = useState<(typeof WAYS)[number]>("student");
  const comeIn = async (code: string) => {
    setPersonName((await rejoin(code)).name);
  };
  return (
    <>
      {access.value?.removed === true && <p class="problem">{t("classroom.youAreRemoved")}</p>}
      {chosen === "student" && <StudentForm enter={enter} />}
      {chosen === "back" && (
        <SecretForm label={t("classroom.rejoinCode")} enter={enter} send={comeIn} />
      )}
      {chosen === "instructor" && (
        <SecretForm label={t("classroom.token")} enter={enter} send={login} />
      )}
      <p class="row">
        {WAYS.filter((way) => way !== chosen).map((way) => (
          <button key={way} type="button" class="quiet" onClick={() => choose(way)}>
            {t(`classroom.ways.${way}`)}
          </button>
        ))}
      </p>
    </>
  );
}

/** Way to enter. */
interface EnterProps {
  /** Shows the error, or opens the page. */
  enter: (way: () => Promise<unknown>) => void;
}

interface SecretProps extends EnterProps {
  /** Label of the field. */
  label: string;
  send: (secret: string) => Promise<unknown>;
}

/** A secret, a token or a rejoin code. */
export function SecretForm({ label, enter, send }: SecretProps) {
  const id = useId();
  const [secret, setSecret] = useState("");
  return (
    <form
      class="stack"
      onSubmit={(event) => {
        event.preventDefault();
        enter(() => send(secret));
      }}
    >
      <label for={id}>{label}</label>
      <input
        id={id}
        type="password"
        required
        autocomplete="current-password"
        value={secret}
        onInput={(event) => setSecret(event.currentTarget.value)}
      />
      <button type="submit" class="button is-primary">
        {t("login.enter")}
      </button>
    </form>
  );
}

// The class code that a QR code puts behind the # of the address, which is not sent to the server.

const FRAGMENT = "#join=";

/** Removes the code from the address, where it would be visible; "" without a code. */
export function takeCode(): string {
  if (!location.hash.startsWith(FRAGMENT)) return "";
  const code = decodeURIComponent(location.hash.slice(FRAGMENT.length));
  history.replaceState(history.state, "", location.pathname + location.search);
  return code;
}

// The user's rejoin code: shown after joining, until it is dismissed.

/** Empty if none is to be shown. */
export const rejoinCode = signal("");

export function RejoinCodeBanner() {
  if (rejoinCode.value === "") return null;
  return (
    <div class="row banner is-accent" role="status">
      <p>
        <strong>{t("classroom.rejoinCodeTitle")}</strong>{" "}
        <code class="strong nowrap class-return">{rejoinCode.value}</code>{" "}
        {t("classroom.rejoinCodeText")}
      </p>
      <button
        type="button"
        class="button"
        onClick={() => {
          rejoinCode.value = "";
        }}
      >
        {t("classroom.rejoinCodeNoted")}
      </button>
    </div>
  );
}
