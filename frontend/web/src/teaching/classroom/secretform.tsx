import { useId, useState } from "preact/hooks";
import { text } from "../../core/text/en";

/** How one gets in. */
export interface EnterProps {
  /** Tells what went wrong, or lets the page in. */
  enter: (way: () => Promise<unknown>) => void;
}

interface SecretProps extends EnterProps {
  /** What is asked for. */
  label: string;
  send: (secret: string) => Promise<unknown>;
}

/** A secret, a token or a code that is one's own. */
export function SecretForm({ label, enter, send }: SecretProps) {
  const id = useId();
  const [secret, setSecret] = useState("");
  return (
    <form
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
        {text.login.enter}
      </button>
    </form>
  );
}
