import type { BenchState } from "../core/api/types";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { formatNumber } from "../core/units";

type Motor = NonNullable<BenchState["motors"]>[number];

const describeHeat = ({ heat, allowed_torque_nm: allowed, lasting_torque_nm: lasting }: Motor) => ({
  percent: String(Math.round(100 * heat)),
  allowed: formatNumber(allowed, 3, 2),
  lasting: formatNumber(lasting, 3, 2),
});

/** Temperature of a motor, and whether its torque is limited; a cell of the table of sources. */
export function Heat({ motor }: { motor: Motor | undefined }) {
  if (motor === undefined || !isLive.value) return <td>{t("bench.drives.none")}</td>;
  const { percent, allowed } = describeHeat(motor);
  return (
    <td class={motor.limited_by_heat ? "bad" : ""} title={t("bench.heat.hint")}>
      {t("bench.heat.share", { percent })}
      {motor.limited_by_heat && (
        <strong class="block breaks">
          {" "}
          <span aria-hidden="true">▲</span> {t("bench.heat.heldTo", { torque: allowed })}
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
    <div>
      {now.map(({ motor, index }) => (
        <p key={index} class="banner is-bad bad">
          <span aria-hidden="true">▲</span>{" "}
          <strong role="alert">
            {t("bench.heat.warningTitle", {
              motor: t("bench.drives.names", { returnObjects: true })[index] as string,
            })}
          </strong>{" "}
          {t("bench.heat.warning", describeHeat(motor))}
        </p>
      ))}
    </div>
  );
}
