/** One's own code to come back by: told when one has joined, until it is put away. */
import { signal } from "@preact/signals";
import { text } from "../../core/text/en";

const words = text.classroom;

/** Empty where none is to be told. */
export const returnCode = signal("");

export function ReturnCodeBanner() {
  if (returnCode.value === "") return null;
  return (
    <div class="banner is-news" role="status">
      <p>
        <strong>{words.returnCodeTitle}</strong>{" "}
        <code class="class-return">{returnCode.value}</code> {words.returnCodeText}
      </p>
      <button
        type="button"
        class="button"
        onClick={() => {
          returnCode.value = "";
        }}
      >
        {words.returnCodeNoted}
      </button>
    </div>
  );
}
