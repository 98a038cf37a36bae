import { useEffect, useId, useRef, useState } from "preact/hooks";
import { login } from "../api/access";
import { RefusedError } from "../api/errors";
import { Join } from "../classroom/join";
import { StopBanners } from "../safety/stopbanner";
import { StopButton } from "../safety/stopbutton";
import { access, learnAccess } from "../state/access";
import { openStream, phase } from "../state/session";
import { text } from "../text/en";

function SecretForm({ enter }: { enter: (way: () => Promise<unknown>) => void }) {
  const id = useId();
  const [secret, setSecret] = useState("");
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        enter(() => login(secret));
      }}
    >
      <label for={id}>{text.login.secret}</label>
      <input
        id={id}
        type="password"
        required
        autocomplete="current-password"
        value={secret}
        onInput={(event) => setSecret(event.currentTarget.value)}
      />
      <button type="submit" class="button is-primary">
        {text.login.enter}
      </button>
    </form>
  );
}

/** Asks once for what lets one in; the server keeps it in a cookie. */
export function Login() {
  const id = useId();
  const dialog = useRef<HTMLDialogElement>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    void learnAccess();
    dialog.current?.showModal();
  }, []);

  const enter = async (way: () => Promise<unknown>) => {
    try {
      await way();
      await learnAccess();
      phase.value = "connecting";
      openStream();
    } catch (error) {
      setProblem(error instanceof RefusedError ? error.message : text.connection.unreachable);
    }
  };
  const door = access.value?.door;
  const isJoined = door === "class";
  return (
    <dialog
      ref={dialog}
      class="login"
      aria-labelledby={`${id}-title`}
      onCancel={(event) => event.preventDefault()}
    >
      <h2 id={`${id}-title`}>{isJoined ? text.classroom.title : text.login.title}</h2>
      <p>{isJoined ? text.classroom.explanation : text.login.explanation}</p>
      {isJoined ? (
        <Join enter={(way) => void enter(way)} />
      ) : (
        <SecretForm enter={(way) => void enter(way)} />
      )}
      <p class="problem" role="alert" hidden={problem === ""}>
        {problem}
      </p>
      <StopBanners />
      <StopButton />
    </dialog>
  );
}
