import { useEffect, useId, useRef, useState } from "preact/hooks";
import { login } from "../api/client";
import { RefusedError } from "../api/errors";
import { StopBanners } from "../safety/stopbanner";
import { StopButton } from "../safety/stopbutton";
import { openStream, phase } from "../state/session";
import { text } from "../text/en";

/** Asks once for the secret of the server; the server keeps it in a cookie. */
export function Login() {
  const id = useId();
  const dialog = useRef<HTMLDialogElement>(null);
  const [secret, setSecret] = useState("");
  const [problem, setProblem] = useState("");

  useEffect(() => dialog.current?.showModal(), []);

  const submit = async (event: Event) => {
    event.preventDefault();
    try {
      await login(secret);
      phase.value = "connecting";
      openStream();
    } catch (error) {
      setProblem(error instanceof RefusedError ? error.message : text.connection.unreachable);
    }
  };

  return (
    <dialog
      ref={dialog}
      class="login"
      aria-labelledby={`${id}-title`}
      onCancel={(event) => event.preventDefault()}
    >
      <form onSubmit={(event) => void submit(event)}>
        <h2 id={`${id}-title`}>{text.login.title}</h2>
        <p>{text.login.explanation}</p>
        <label for={id}>{text.login.secret}</label>
        <input
          id={id}
          type="password"
          required
          autocomplete="current-password"
          aria-describedby={`${id}-problem`}
          value={secret}
          onInput={(event) => setSecret(event.currentTarget.value)}
        />
        <p class="problem" id={`${id}-problem`} role="alert" hidden={problem === ""}>
          {problem}
        </p>
        <button type="submit" class="button is-primary">
          {text.login.enter}
        </button>
      </form>
      <StopBanners />
      <StopButton />
    </dialog>
  );
}
