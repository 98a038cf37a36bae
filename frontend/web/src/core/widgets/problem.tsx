import { useEffect, useRef } from "preact/hooks";
import { problem } from "../state/actions";
import { text } from "../text/en";

/** Why the server refused what a control asked for; brought into sight where its panel scrolls. */
export function Problem({ control, id }: { control: string; id?: string }) {
  const line = useRef<HTMLParagraphElement>(null);
  const mine = problem.value?.control === control ? problem.value : null;
  const again = mine?.again;
  useEffect(() => {
    if (mine !== null) line.current?.scrollIntoView({ block: "nearest" });
  }, [mine]);
  return (
    <p class="problem" id={id} role="alert" hidden={mine === null} ref={line}>
      {mine?.message}
      {again && (
        <>
          {" "}
          <button type="button" class="button is-small" onClick={() => void again()}>
            {text.meanwhile.again}
          </button>
        </>
      )}
    </p>
  );
}
