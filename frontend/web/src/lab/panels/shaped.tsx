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
import { RequestFields } from "../../core/forms/fields";
import { useKind } from "../../core/forms/request";
import { schemaOfKind, type Values } from "../../core/schema";
import { perform } from "../../core/state/actions";
import { kinds } from "../../core/state/kinds";
import { session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN, formatNumber } from "../../core/units";
import { Choice, Problem } from "../../core/widgets/form";
import { Levels, Series } from "./referencelist";
import { coursePath, type Listed, listSchemas, readLevels, writeLevels } from "./shapes";

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

export function putReference(
  follows: Follows,
  reference: Reference | PositionReference | StiffnessReference,
) {
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
  const described = kinds.value?.[follows].filter(({ form }) => form !== null) ?? [];
  const shapes = ["steps", ...described.map(({ kind }) => kind), "series"].map((value) => ({
    value,
    label: titleOf(follows, value),
  }));
  const isKnown = shapes.some(({ value }) => value === held);
  const lists = listSchemas(follows, configuration);
  const form = useKind(
    (kind) => (isListed(kind) ? lists[kind] : schemaOfKind(kind, described)),
    isKnown ? held : "steps",
  );
  const shape = form.kind;
  const [previewed, setPreviewed] = useState<PreviewedReference | null>(null);
  const unit = follows === "position" ? "deg" : "N·m/rad";
  const kind = described.find((row) => row.kind === shape);
  const { csv, levels } = form.body as Record<"csv" | "levels", string>;

  useEffect(() => {
    let isLatest = true;
    setPreviewed(null);
    const read = () => {
      if (shape === "series") return readCsv(follows, csv);
      return shape === "steps" ? readLevels(follows, levels) : (form.values as Reference);
    };
    const look = async () => {
      const next = await form.attempt(async () => {
        const reference = await read();
        return { reference, preview: await previewReference(follows, reference) };
      });
      if (isLatest) setPreviewed(next);
    };
    const timer = setTimeout(() => void look(), PAUSE_MS);
    return () => {
      isLatest = false;
      clearTimeout(timer);
    };
  }, [follows, form.body, kind]);

  const set = (body: Values) =>
    form.set(shape === "steps" ? { ...body, levels: writeLevels(body) } : body);
  const write = (name: "csv" | "levels") => (list: string) =>
    form.set({ ...form.body, [name]: list });

  const submit = (event: Event) => {
    event.preventDefault();
    if (previewed) void perform(`${follows}.shaped`, follow(follows, previewed.reference));
  };

  return (
    <form class="stack" onSubmit={submit}>
      <Choice label={t("references.kind")} options={shapes} value={shape} onChoose={form.choose} />
      <RequestFields
        key={shape}
        form={{ ...form, set }}
        schema={form.schema}
        replace={{
          csv: <Series list={csv} onList={write("csv")} />,
          levels: <Levels unit={unit} list={levels} onList={write("levels")} />,
        }}
        isRow
      />
      {previewed && (
        <Course
          preview={previewed.preview}
          unit={unit}
          factor={follows === "position" ? DEGREES_PER_RADIAN : 1}
        />
      )}
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
