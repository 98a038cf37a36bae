/** An adversary as edited in the form, and as sent to the server. */
import type { Adversary, Scenario, Term } from "../../core/api/falsifications";
import type { Span } from "../../core/plots/spans";
import { t } from "../../core/text/t";

export const HARMS = ["fault", "peak", "recovery"] as const;
export const KINDS = ["step", "pulse", "sine"] as const;
export const BODIES = ["link", "motor1", "motor2"] as const;
export const EFFECTS = ["ideal", "rig", "every"] as const;
export const FIGURES = ["4a", "4b", "5"] as const;
export type Kind = (typeof KINDS)[number];
type Body = (typeof BODIES)[number];
type Ends = readonly [number, number];

/** A load of the family; besides the onset it has a length or a frequency with its own range. */
export interface TermForm {
  kind: Kind;
  bodies: readonly Body[];
  torqueNm: number;
  startS: Ends;
  own: Ends;
}

export interface AdversaryForm {
  title: string;
  law: string;
  cost: Adversary["cost"];
  base: Adversary["base"];
  durationS: number;
  measureFromS: number;
  terms: readonly TermForm[];
  /** Maximum relative error of the model, %. */
  offPercent: number;
  /** Perturbations that are not relative errors. */
  vary: Adversary["vary"];
}

const OWN: Readonly<Record<Kind, Ends>> = { step: [0, 0], pulse: [0.01, 2], sine: [0.1, 20] };
const OFF_PATHS = ["actuator.link_inertia_kg_m2", "actuator.spring_stiffness_n_per_m"] as const;

export const changeKind = (term: TermForm, kind: Kind): TermForm => ({
  ...term,
  kind,
  own: OWN[kind],
});

function readTerm(term: Term): TermForm {
  const own =
    term.kind === "pulse" ? term.duration_s : term.kind === "sine" ? term.frequency_hz : OWN.step;
  const { kind, bodies, torque_nm: torqueNm, start_s: startS } = term;
  return { kind, bodies, torqueNm, startS: startS as Ends, own: own as Ends };
}

function writeTerm({ kind, bodies, torqueNm, startS, own }: TermForm): Term {
  const shared = { bodies: [...bodies], torque_nm: torqueNm, start_s: [...startS] };
  if (kind === "step") return { ...shared, kind } as Term;
  const range = kind === "pulse" ? { duration_s: [...own] } : { frequency_hz: [...own] };
  return { ...shared, ...range, kind } as Term;
}

/** The percentage of a perturbation that the form can edit; null for any other. */
function readOff(perturbation: Adversary["vary"][number]): number | null {
  const isOff =
    perturbation.kind === "uniform" &&
    perturbation.relative &&
    OFF_PATHS.some((p) => p === perturbation.path);
  return isOff && Math.abs(perturbation.low + perturbation.high - 2) < 1e-9
    ? 100 * (perturbation.high - 1)
    : null;
}

export function readForm(from: Adversary): AdversaryForm {
  const shares = from.vary.map(readOff);
  const share = shares[0] ?? 0;
  const isForm = shares.length === OFF_PATHS.length && shares.every((other) => other === share);
  return {
    title: from.title,
    law: from.law,
    cost: from.cost,
    base: from.base,
    durationS: from.duration_s,
    measureFromS: from.measure_from_s,
    terms: from.terms.map(readTerm),
    offPercent: isForm ? Number(share.toPrecision(6)) : 0,
    vary: isForm ? [] : from.vary,
  };
}

export function writeForm(form: AdversaryForm): Adversary {
  const share = form.offPercent / 100;
  const off = OFF_PATHS.map((path) => ({
    kind: "uniform" as const,
    path,
    low: 1 - share,
    high: 1 + share,
    relative: true,
  }));
  return {
    title: form.title,
    law: form.law,
    cost: form.cost,
    base: form.base,
    duration_s: form.durationS,
    measure_from_s: form.measureFromS,
    terms: form.terms.map(writeTerm),
    vary: [...form.vary, ...(share > 0 ? off : [])] as Adversary["vary"],
  };
}

/** Short description of a family, for the title of a changed search. */
export const describeTerms = (terms: readonly TermForm[]): string =>
  terms
    .map(({ kind, bodies, torqueNm }) =>
      t("falsifier.term", {
        kind: t(`falsifier.kinds.${kind}`),
        torque: torqueNm,
        bodies: bodies.map((body) => t(`falsifier.bodies.${body}`)).join(", "),
      }),
    )
    .join("; ")
    .slice(0, 200);

const BEFORE_S = 1;

/** Time window from shortly before the first load to the end. */
export function spanOf(scenario: Scenario, time: readonly number[]): Span {
  const loads = (scenario.loads ?? []) as { start_s?: number }[];
  const onsets = loads.flatMap(({ start_s: start }) => start ?? []);
  const first = onsets.length > 0 ? Math.min(...onsets) - BEFORE_S : 0;
  return { from: Math.max(time[0] ?? 0, first), to: time.at(-1) ?? 1 };
}
