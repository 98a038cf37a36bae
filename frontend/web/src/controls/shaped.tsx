import { useEffect, useState } from "preact/hooks";
import { putPosition, putStiffness } from "../api/client";
import {
  type Follows,
  type Preview,
  previewReference,
  type Reference,
  readSeries,
} from "../api/references";
import type { PositionReference, Sent, StiffnessReference } from "../api/types";
import { explain, perform } from "../state/actions";
import { text } from "../text/en";
import { DEGREES_PER_RADIAN } from "../units";
import { Choice } from "./choice";
import { Course } from "./course";
import { NumberBox } from "./numberbox";
import { Problem } from "./problem";
import { buildReference, FIRST, INPUTS, type Input, SHAPES, type Shape } from "./shapes";

const words = text.references;
const OPTIONS = SHAPES.map((value) => ({ value, label: words.kinds[value] }));
const PAUSE_MS = 300;

interface Wanted {
  reference: Reference;
  preview: Preview;
}

/** What a CSV holds, where it is for this quantity. */
async function readCsv(follows: Follows, csv: string): Promise<Reference> {
  const series = await readSeries(csv);
  if (series.follows !== follows) throw new RangeError(words.isOther[series.follows]);
  return series.reference;
}

function put(follows: Follows, reference: Reference) {
  return follows === "position"
    ? putPosition(reference as Sent<PositionReference>)
    : putStiffness(reference as Sent<StiffnessReference>);
}

function SeriesInput({ csv, onCsv }: { csv: string; onCsv: (csv: string) => void }) {
  const open = async (event: Event) => {
    const file = (event.currentTarget as HTMLInputElement).files?.[0];
    if (file) onCsv(await file.text());
  };
  return (
    <>
      <label class="button csv-open">
        {words.openCsv}
        <input
          type="file"
          class="visually-hidden"
          accept=".csv,text/csv"
          onChange={(event) => void open(event)}
        />
      </label>
      <textarea
        class="csv-text"
        rows={4}
        spellcheck={false}
        aria-label={words.pasteCsv}
        value={csv}
        onInput={(event) => onCsv(event.currentTarget.value)}
      />
      <p class="hint">{words.csvHint}</p>
    </>
  );
}

/** A reference with a beginning and an end: typed or from a CSV, looked at, then applied. */
export function Shaped({ follows, held }: { follows: Follows; held: string }) {
  const [shape, setShape] = useState<Shape>(SHAPES.find((known) => known === held) ?? "steps");
  const [typed, setTyped] = useState(FIRST[follows]);
  const [csv, setCsv] = useState<string>(words.example[follows]);
  const [wanted, setWanted] = useState<Wanted | null>(null);
  const [refusal, setRefusal] = useState("");
  const unit = follows === "position" ? "deg" : "N·m/rad";
  const units: Partial<Record<Input, string>> = {
    hold: "s",
    count: "",
    duration: "s",
    startHz: "Hz",
    endHz: "Hz",
  };

  useEffect(() => {
    let isLatest = true;
    setWanted(null);
    const look = async () => {
      try {
        const reference =
          shape === "series" ? await readCsv(follows, csv) : buildReference(follows, shape, typed);
        if (reference === null) throw new RangeError(text.refusal.noNumber);
        const preview = await previewReference(follows, reference);
        if (isLatest) setWanted({ reference, preview });
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
  }, [follows, shape, typed, csv]);

  const submit = (event: Event) => {
    event.preventDefault();
    if (wanted) void perform(`${follows}.shaped`, () => put(follows, wanted.reference));
  };

  return (
    <form class="shaped" onSubmit={submit}>
      <Choice label={words.kind} options={OPTIONS} value={shape} onChoose={setShape} />
      {shape === "series" ? (
        <SeriesInput csv={csv} onCsv={setCsv} />
      ) : (
        INPUTS[shape].map((name) => (
          <NumberBox
            key={name}
            label={words.inputs[name]}
            unit={units[name] ?? unit}
            value={typed[name]}
            onInput={(value) => setTyped({ ...typed, [name]: value })}
          />
        ))
      )}
      {wanted && (
        <Course
          preview={wanted.preview}
          unit={unit}
          factor={follows === "position" ? DEGREES_PER_RADIAN : 1}
        />
      )}
      <p class="problem" role="alert" hidden={refusal === ""}>
        {refusal}
      </p>
      <button type="submit" class="button" disabled={wanted === null}>
        {words.apply}
      </button>
      <p class="hint">{words.does[shape]}</p>
      <Problem control={`${follows}.shaped`} />
    </form>
  );
}
