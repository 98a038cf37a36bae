import { useState } from "preact/hooks";
import { t } from "../../core/text/t";
import { SelectField } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { CHANNELS, type OverlayChannel, type OverlayCurve, TITLES } from "./overlaycurves";
import { attempt } from "./problem";
import { assessRuns, type Bounds, type RunAssessment } from "./verdict";
import { VerdictTable } from "./verdicttable";

type Typed = Record<OverlayChannel, Bounds>;
const AT_FIRST: Typed = {
  position_error_rad: { absolute: 0.5, relativePercent: 0, timeS: 0.01 },
  stiffness_error_nm_per_rad: { absolute: 0.5, relativePercent: 0, timeS: 0.01 },
};

interface FieldsProps {
  channel: OverlayChannel;
  typed: Typed[OverlayChannel];
  onType: (field: keyof Bounds, value: number) => void;
}

function Fields({ channel, typed, onType }: FieldsProps) {
  const { title, unit } = TITLES[channel];
  const units: [keyof Bounds, string, string][] = [
    ["absolute", t("verdict.absolute"), unit],
    ["relativePercent", t("verdict.relative"), t("verdict.percent")],
    ["timeS", t("verdict.time"), t("verdict.secondsUnit")],
  ];
  return (
    <fieldset>
      <legend class="hint">{title}</legend>
      {units.map(([field, label, fieldUnit]) => (
        <NumberField
          key={field}
          label={label}
          unit={fieldUnit}
          min={0}
          value={typed[field]}
          onInput={(value) => onType(field, value)}
        />
      ))}
    </fieldset>
  );
}

interface VerdictPanelProps {
  curves: readonly OverlayCurve[];
  judged: readonly RunAssessment[];
  onJudged: (judged: readonly RunAssessment[]) => void;
}

/** Tolerances for the other runs relative to the reference run, and the verdict. */
export function VerdictPanel({ curves, judged, onJudged }: VerdictPanelProps) {
  const runs = [...new Map(curves.map(({ run, runName }) => [run, runName]))];
  const [reference, setReference] = useState(runs[0]?.[0] ?? "");
  const [typed, setTyped] = useState(AT_FIRST);
  const [isJudging, setIsJudging] = useState(false);
  const judge = async () => {
    setIsJudging(true);
    const ids = runs.map(([run]) => run);
    const align = curves[0]?.alignment ?? "window";
    onJudged((await attempt(() => assessRuns(ids, reference, typed, align))) ?? []);
    setIsJudging(false);
  };
  const type = (channel: OverlayChannel, field: keyof Bounds, value: number) => {
    onJudged([]);
    setTyped({ ...typed, [channel]: { ...typed[channel], [field]: value } });
  };
  return (
    <section aria-label={t("verdict.title")}>
      <h3>
        {t("verdict.title")} <small class="unit">{t("verdict.hint")}</small>
      </h3>
      <form
        class="form cells verdict-form"
        onSubmit={(event) => {
          event.preventDefault();
          void judge();
        }}
      >
        <SelectField
          label={t("verdict.reference")}
          value={reference}
          options={runs.map(([run]) => run)}
          name={(run) => curves.find((curve) => curve.run === run)?.runName ?? run}
          onChoose={(run) => {
            onJudged([]);
            setReference(run);
          }}
        />
        {CHANNELS.map((channel) => (
          <Fields
            key={channel}
            channel={channel}
            typed={typed[channel]}
            onType={(field, value) => type(channel, field, value)}
          />
        ))}
        <div class="row">
          <button type="submit" class="button" disabled={isJudging}>
            {isJudging ? t("verdict.judging") : t("verdict.judge")}
          </button>
          {judged.length > 0 && (
            <button type="button" class="button" onClick={() => onJudged([])}>
              {t("verdict.clear")}
            </button>
          )}
        </div>
      </form>
      {judged.length > 0 && <VerdictTable curves={curves} judged={judged} />}
    </section>
  );
}
