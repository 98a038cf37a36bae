import type { ClassCode } from "../../core/api/access";
import { text } from "../../core/text/en";

const words = text.classroom;

/** A new class code, to be read and scanned from a wall. */
export function Code({ code }: { code: ClassCode }) {
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
