import { useEffect, useState } from "preact/hooks";
import {
  putPosition,
  putStiffness,
  repeatPosition,
  repeatStiffness,
  type SessionRequest,
} from "../../core/api/client";
import {
  type Follows,
  type Preview,
  previewReference,
  type Reference,
  readSeries,
} from "../../core/api/design";
import type {
  Configuration,
  PositionReference,
  RequestOf,
  StiffnessReference,
} from "../../core/api/types";
import { quantityOfParameter } from "../../core/quantities";
import { explain, perform } from "../../core/state/actions";
import { initialValues, kinds, readForm } from "../../core/state/kinds";
import { session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN, formatNumber } from "../../core/units";
import { Choice, ErrorLine, Problem } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { Levels, Series } from "./referencelist";
import {
  coursePath,
  firstSteps,
  INPUT_BOUNDS,
  INPUTS,
  type Input,
  type Listed,
  readLevels,
  writeLevels,
} from "./shapes";

/** Columns of a CSV. */
const COLUMNS = { position: "position_deg", stiffness: "stiffness_nm_per_rad" } as const;
const isListed = (shape: string): shape is Listed => shape === "steps" || shape === "series";

/** Label of a kind of reference in the form. */
export const titleOf = (follows: Follows, kind: string): string =>
  isListed(kind)
    ? t(`references.kinds.${kind}`)
    : (kinds.value?.[follows].find((row) => row.kind === kind)?.title ?? kind);

const PAUSE_MS = 300;
const repeat = (follows: Follows) => (follows === "position" ? repeatPosition : repeatStiffness);

interface PreviewedReference {
  reference: Reference;
  preview: Preview;
}

/** Content of a CSV, if it is for this quantity. */
async function readCsv(follows: Follows, csv: string): Promise<Reference> {
  const series = await readSeries(csv);
  if (series.follows !== follows) throw new RangeError(t(`references.isOther.${series.follows}`));
  return series.reference;
}

function putReference(follows: Follows, reference: Reference) {
  return follows === "position"
    ? putPosition(reference as RequestOf<PositionReference>)
    : putStiffness(reference as RequestOf<StiffnessReference>);
}

/** The current reference restarts: the server treats a repeated request as one. */
const follow =
  (follows: Follows, reference: Reference): SessionRequest =>
  async (edit) => {
    const before = session.peek()?.revision;
    const state = await putReference(follows, reference)(edit);
    return state.revision === before ? repeat(follows)(edit) : state;
  };

interface ShapedProps {
  follows: Follows;
  held: string;
  configuration: Configuration;
}

/** A finite reference: typed or from a CSV, previewed, then applied. */
export function Shaped({ follows, held, configuration }: ShapedProps) {
  const first = firstSteps(follows, configuration);
  const described = kinds.value?.[follows].filter(({ form }) => form !== null) ?? [];
  const shapes = ["steps", ...described.map((row) => row.kind), "series"].map((value) => ({
    value,
    label: titleOf(follows, value),
  }));
  const isKnown = shapes.some(({ value }) => value === held);
  const [shape, setShape] = useState(isKnown ? held : "steps");
  const [steps, setSteps] = useState(first);
  const [typed, setTyped] = useState<Record<string, number>>({});
  const [csv, setCsv] = useState(
    `time_s,${COLUMNS[follows]}\n0,${first.low}\n1,${first.high}\n3,${first.low}\n`,
  );
  const [levels, setLevels] = useState(writeLevels(first));
  const [previewed, setPreviewed] = useState<PreviewedReference | null>(null);
  const [refusal, setRefusal] = useState("");
  const unit = follows === "position" ? "deg" : "N·m/rad";
  const units: Partial<Record<Input, string>> = { hold: "s", count: "" };
  const kind = described.find((row) => row.kind === shape);
  const form = kind?.form ?? [];
  const values = { ...initialValues(form), ...typed };

  useEffect(() => {
    let isLatest = true;
    setPreviewed(null);
    const read = () => {
      if (shape === "series") return readCsv(follows, csv);
      if (shape === "steps") return readLevels(follows, levels);
      return { kind: shape, ...readForm(form, values) } as Reference;
    };
    const look = async () => {
      try {
        const reference = await read();
        const preview = await previewReference(follows, reference);
        if (isLatest) setPreviewed({ reference, preview });
        if (isLatest) setRefusal("");
      } catch (error) {
        if (isLatest) setRefusal(error instanceof RangeError ? error.message : explain(error));
      }
    };
    const timer = setTimeout(() => void look(), PAUSE_MS);
    return () => {
      isLatest = false;
      clearTimeout(timer);
    };
  }, [follows, shape, typed, csv, levels, kind]);

  const type = (name: Input, value: number) => {
    const next = { ...steps, [name]: value };
    setSteps(next);
    setLevels(writeLevels(next));
  };

  const submit = (event: Event) => {
    event.preventDefault();
    if (previewed) void perform(`${follows}.shaped`, follow(follows, previewed.reference));
  };

  return (
    <form class="stack" onSubmit={submit}>
      <Choice label={t("references.kind")} options={shapes} value={shape} onChoose={setShape} />
      {shape === "series" && <Series list={csv} onList={setCsv} />}
      {shape === "steps" &&
        INPUTS.map((name) => (
          <NumberField
            key={name}
            label={t(`references.inputs.${name}`)}
            unit={units[name] ?? unit}
            {...INPUT_BOUNDS[name]}
            value={steps[name]}
            onInput={(value) => type(name, value)}
          />
        ))}
      {shape === "steps" && <Levels unit={unit} list={levels} onList={setLevels} />}
      {form.map(({ parameter }) => (
        <NumberField
          key={`${shape}.${parameter.name}`}
          {...quantityOfParameter(parameter)}
          value={values[parameter.name] as number}
          onInput={(value) => setTyped({ ...typed, [parameter.name]: value })}
        />
      ))}
      {previewed && (
        <Course
          preview={previewed.preview}
          unit={unit}
          factor={follows === "position" ? DEGREES_PER_RADIAN : 1}
        />
      )}
      <ErrorLine>{refusal}</ErrorLine>
      <div class="line">
        <button type="submit" class="button grow" disabled={previewed === null}>
          {t("references.apply")}
        </button>
        {isKnown && (
          <button
            type="button"
            class="button grow"
            title={t("references.againHint")}
            onClick={() => void perform(`${follows}.shaped`, repeat(follows))}
          >
            {t("references.again")}
          </button>
        )}
      </div>
      <p class="hint">{isListed(shape) ? t(`references.does.${shape}`) : kind?.hint}</p>
      <Problem control={`${follows}.shaped`} />
    </form>
  );
}

const WIDTH = 240;
const HEIGHT = 56;

interface CourseProps {
  preview: Preview;
  unit: string;
  factor: number;
}

/** Preview of a reference: its demands, before it is applied. */
function Course({ preview, unit, factor }: CourseProps) {
  const shown = (value: number) => formatNumber(value * factor, 3);
  const caption = t("references.course", {
    least: shown(preview.low),
    greatest: shown(preview.high),
    unit,
    end: formatNumber(preview.time_s.at(-1), 3),
    rate: shown(preview.peak_rate),
  });
  return (
    <figure class="sunken course">
      <svg
        viewBox={`0 -2 ${WIDTH} ${HEIGHT + 4}`}
        preserveAspectRatio="none"
        role="img"
        aria-label={caption}
      >
        <polyline points={coursePath(preview.time_s, preview.value, WIDTH, HEIGHT)} />
      </svg>
      <figcaption class="hint">{caption}</figcaption>
    </figure>
  );
}
