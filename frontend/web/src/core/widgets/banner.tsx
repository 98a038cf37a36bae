/** A notice across the page. */
import type { ComponentChildren } from "preact";

interface BannerProps {
  look: string;
  sign?: string;
  role?: "alert" | "status";
  title?: string;
  words?: string | undefined;
  /** Commands of the notice. */
  children?: ComponentChildren;
}

export function Banner({ look, sign, role = "status", title, words, children }: BannerProps) {
  return (
    <div class={`row banner ${look}`} role={role}>
      {sign !== undefined && <span aria-hidden="true">{sign}</span>}
      <p>
        <strong>{title}</strong> {words}
      </p>
      {children}
    </div>
  );
}
