/** A card's title with the button that opens a private session. */
import { useState } from "preact/hooks";
import { explain } from "../../core/state/actions";

type Opening = readonly [isOpening: boolean, open: () => Promise<void>];

/** Opens a session and shows it; `onProblem` gets the reason if it cannot be opened. */
export function useOpening(
  request: () => Promise<{ session: string }>,
  onProblem: (problem: string) => void,
): Opening {
  const [isOpening, setOpening] = useState(false);
  const open = async () => {
    setOpening(true);
    onProblem("");
    try {
      const { session } = await request();
      location.assign(`${location.pathname}?session=${encodeURIComponent(session)}`);
    } catch (error) {
      onProblem(explain(error));
      setOpening(false);
    }
  };
  return [isOpening, open];
}

interface CardHeadProps {
  title: string;
  hint: string;
  /** Hint of the button. */
  openHint: string;
  /** Text of the button. */
  label: string;
  isOpening: boolean;
  onOpen: () => Promise<void>;
}

export function CardHead(props: CardHeadProps) {
  return (
    <div class="spread">
      <div>
        <h3>{props.title}</h3>
        <p class="hint">{props.hint}</p>
      </div>
      <button
        type="button"
        class="button is-primary"
        title={props.openHint}
        disabled={props.isOpening}
        onClick={() => void props.onOpen()}
      >
        {props.label}
      </button>
    </div>
  );
}
