import { useState } from "preact/hooks";
import { checkStudy, type StudyPlan, type StudyWish } from "../api/studies";
import { titleOf, usableLaws } from "../state/laws";
import { text } from "../text/en";
import { factorOf } from "./look";
import { nameColumn } from "./names";
import { begin, isBusy, list, problem, tell } from "./studies";

const words = text.studies;
const OWN = "";
const FIRST = "load";
/** What success may ask of a run, in the order of the server's `Success`. */
const BOUNDED = [
  { name: "settled_position_error_rad", unit: "rad" },
  { name: "last_position_error_rad", unit: "rad" },
  { name: "rms_position_error_rad", unit: "rad" },
  { name: "peak_position_error_rad", unit: "rad" },
  { name: "rms_stiffness_error_nm_per_rad", unit: "N·m/rad" },
  { name: "peak_stiffness_error_nm_per_rad", unit: "N·m/rad" },
  { name: "recovery_time_s", unit: "s" },
];

/** Choose, change, check and begin a study; a wrong one is told with its line, name and bound. */
export function Start() {
  const [source, setSource] = useState(FIRST);
  const [own, setOwn] = useState("");
  const [name, setName] = useState("");
  const [runs, setRuns] = useState("");
  const [laws, setLaws] = useState<readonly string[]>([]);
  const [metric, setMetric] = useState("");
  const [bound, setBound] = useState("");
  const [plan, setPlan] = useState<StudyPlan | null>(null);
  const builtIn = list.value?.built_in ?? [];
  const asked = BOUNDED.find((one) => one.name === metric);
  const build = (): StudyWish => ({
    ...(source === OWN ? { text: own } : { source }),
    ...(name !== "" && { name }),
    ...(runs !== "" && { runs: Number(runs) }),
    ...(laws.length > 0 && { laws }),
    ...(asked && { success: { [asked.name]: Number(bound) / factorOf(asked.unit) } }),
  });
  const check = async () => {
    try {
      setPlan(await checkStudy(build()));
      problem.value = "";
    } catch (error) {
      setPlan(null);
      problem.value = tell(error);
    }
  };
  const change = (next: () => void) => {
    next();
    setPlan(null);
  };
  return (
    <form
      class="studies-start"
      onSubmit={(event) => {
        event.preventDefault();
        void begin(build());
      }}
    >
      <h3>{words.begin}</h3>
      <label>
        <span>{words.source}</span>
        <select
          value={source}
          onChange={(event) => {
            const chosen = event.currentTarget.value;
            const template = builtIn.find((one) => one.name === source)?.text ?? "";
            change(() => setSource(chosen));
            if (chosen === OWN && own === "") setOwn(template);
          }}
        >
          {builtIn.map((one) => (
            <option key={one.name} value={one.name}>
              {one.name}
            </option>
          ))}
          <option value={OWN}>{words.own}</option>
        </select>
      </label>
      <p class="hint">{builtIn.find((one) => one.name === source)?.title}</p>
      {source === OWN && (
        <label>
          <span>{words.text}</span>
          <textarea
            rows={12}
            spellcheck={false}
            value={own}
            onInput={(event) => change(() => setOwn(event.currentTarget.value))}
          />
        </label>
      )}
      <div class="studies-pair-of-fields">
        <label title={words.runsHint}>
          <span>{words.runs}</span>
          <input
            type="number"
            min={1}
            placeholder={words.asInStudy}
            value={runs}
            onInput={(event) => change(() => setRuns(event.currentTarget.value))}
          />
        </label>
        <label title={words.nameHint}>
          <span>{words.name}</span>
          <input
            type="text"
            maxLength={64}
            placeholder={source || "own"}
            value={name}
            onInput={(event) => change(() => setName(event.currentTarget.value))}
          />
        </label>
      </div>
      <details>
        <summary>
          {words.laws}: {laws.length === 0 ? words.asInStudy : laws.map(titleOf).join(", ")}
        </summary>
        <p class="hint">{words.lawsHint}</p>
        <div class="studies-laws">
          {usableLaws.value.map((law) => (
            <label key={law.name}>
              <input
                type="checkbox"
                checked={laws.includes(law.name)}
                onChange={() =>
                  change(() =>
                    setLaws(
                      laws.includes(law.name)
                        ? laws.filter((one) => one !== law.name)
                        : [...laws, law.name],
                    ),
                  )
                }
              />{" "}
              {law.title}
            </label>
          ))}
        </div>
      </details>
      <div class="studies-pair-of-fields" title={words.successHint}>
        <label>
          <span>{words.success}</span>
          <select
            value={metric}
            onChange={(event) => change(() => setMetric(event.currentTarget.value))}
          >
            <option value="">{words.asInStudy}</option>
            {BOUNDED.map((one) => (
              <option key={one.name} value={one.name}>
                {nameColumn(one)}
              </option>
            ))}
          </select>
        </label>
        <label>
          <span>{words.most}</span>
          <input
            type="number"
            step="any"
            required={metric !== ""}
            disabled={metric === ""}
            value={bound}
            onInput={(event) => change(() => setBound(event.currentTarget.value))}
          />
        </label>
      </div>
      <div class="studies-buttons">
        <button type="button" class="button" onClick={() => void check()}>
          {words.check}
        </button>
        <button type="submit" class="button is-primary" disabled={isBusy.value !== ""}>
          {words.start}
        </button>
      </div>
      {plan && (
        <p class="hint" role="status">
          {words.checked(plan.draws, plan.rows, plan.laws.map(titleOf).join(", "))}
        </p>
      )}
    </form>
  );
}
