import type { BenchState } from "../core/api/types";
import { isLive } from "../core/state/session";
import { text } from "../core/text/en";
import { formatNumber } from "../core/units";

const { heat: words } = text.bench;
type Motor = NonNullable<BenchState["motors"]>[number];

const sharesOf = ({ heat, allowed_torque_nm: allowed, lasting_torque_nm: lasting }: Motor) =>
  [
    String(Math.round(100 * heat)),
    formatNumber(allowed, 3, 2),
    formatNumber(lasting, 3, 2),
  ] as const;

/** Temperature of a motor, and whether its torque is limited; a cell of the table of sources. */
export function Heat({ motor }: { motor: Motor | undefined }) {
  if (motor === undefined || !isLive.value) return <td>{text.bench.drives.none}</td>;
  const [share, allowed] = sharesOf(motor);
  return (
    <td class={motor.limited_by_heat ? "bad" : ""} title={words.hint}>
      {words.share(share)}
      {motor.limited_by_heat && (
        <strong class="block breaks">
          {" "}
          <span aria-hidden="true">▲</span> {words.heldTo(allowed)}
        </strong>
      )}
    </td>
  );
}

/** Shown while heat limits a motor: the reduction of its torque, and what to do. */
export function HeatWarning({ bench: { motors } }: { bench: BenchState }) {
  const held = (motors ?? []).map((motor, index) => ({ motor, index }));
  const now = isLive.value ? held.filter(({ motor }) => motor.limited_by_heat) : [];
  return (
    <div class="heat-warnings">
      {now.map(({ motor, index }) => (
        <p key={index}>
          <span aria-hidden="true">▲</span>{" "}
          <strong role="alert">
            {words.warningTitle(text.bench.drives.names[index] as string)}
          </strong>{" "}
          <span class="heat-why">{words.warning(...sharesOf(motor))}</span>
        </p>
      ))}
    </div>
  );
}
