/** Parts of an adversary that are edited in other terms than its own. */
import type { Adversary, Scenario, Term } from "../../core/api/falsifications";
import type { Span } from "../../core/plots/spans";
import { kindsOf, type Schema } from "../../core/schema";
import { t } from "../../core/text/t";

export const BODIES = ["link", "motor1", "motor2"] as const;
export const EFFECTS = ["ideal", "rig", "every"] as const;
export const FIGURES = ["4a", "4b", "5"] as const;
const PATHS = ["actuator.link_inertia_kg_m2", "actuator.spring_stiffness_n_per_m"] as const;

type Vary = Adversary["vary"];
const isOfModel = ({ path }: Vary[number]) => PATHS.some((own) => own === path);

/** The largest deviation of a symmetric relative error, %; null for any other perturbation. */
function readDeviation(perturbation: Vary[number]): number | null {
  if (perturbation.kind !== "uniform" || !perturbation.relative) return null;
  const { low, high } = perturbation;
  return Math.abs(low + high - 2) < 1e-9 ? Number((100 * (high - 1)).toPrecision(6)) : null;
}

/** The error of the model, %; 0 if inertia and spring do not have the same. */
export function readModelError(vary: Vary): number {
  const [first = null, ...others] = vary.filter(isOfModel).map(readDeviation);
  return others.length === 1 && others[0] === first ? (first ?? 0) : 0;
}

/** The perturbations with another error of the model. */
export function writeModelError(vary: Vary, percent: number): Vary {
  const share = percent / 100;
  const model = PATHS.map((path) => ({
    kind: "uniform" as const,
    path,
    low: 1 - share,
    high: 1 + share,
    relative: true,
  }));
  const others = vary.filter((perturbation) => !isOfModel(perturbation));
  return [...others, ...(share > 0 ? model : [])] as Vary;
}

/** Short description of a family, for the title of a changed search; schema: of the loads. */
export function describeTerms(terms: readonly Term[], schema: Schema): string {
  const kinds = kindsOf(schema.items ?? {});
  return terms
    .map(({ kind, bodies, torque_nm: torque }) => {
      const { title = kind, schema: own } = kinds.get(kind) ?? {};
      const names = own?.properties?.bodies?.choices ?? {};
      const on = bodies.map((body) => names[body]).join(", ");
      return t("falsifier.term", { kind: title, torque: String(torque), bodies: on });
    })
    .join("; ")
    .slice(0, 200);
}

const BEFORE_S = 1;

/** Time window from shortly before the first load to the end. */
export function spanOf(scenario: Scenario, time: readonly number[]): Span {
  const loads = (scenario.loads ?? []) as { start_s?: number }[];
  const onsets = loads.flatMap(({ start_s: start }) => start ?? []);
  const first = onsets.length > 0 ? Math.min(...onsets) - BEFORE_S : 0;
  return { from: Math.max(time[0] ?? 0, first), to: time.at(-1) ?? 1 };
}
