import { useState } from "preact/hooks";
import { addLoad } from "../../core/api/client";
import type { Load } from "../../core/api/types";
import { shownAs } from "../../core/quantities";
import { perform } from "../../core/state/actions";
import { text } from "../../core/text/en";
import { Choice, NumberBox, Problem } from "../../core/widgets/form";
import { EnduranceNote } from "../../hardware/endurance";

type Kind = "constant" | "pulse" | "sine";
type Channel = "0" | "1" | "2";

const KINDS = (["constant", "pulse", "sine"] as const).map((value) => ({
  value,
  label: text.load.kinds[value],
}));
const CHANNELS = (["0", "1", "2"] as const).map((value) => ({
  value,
  label: text.channels[Number(value)] as string,
}));

function loadOf(kind: Kind, channel: Channel, torque: number, detail: number): Load {
  const torque_nm: [number, number, number] = [0, 0, 0];
  torque_nm[Number(channel)] = torque;
  if (kind === "pulse") return { kind, torque_nm, duration_s: detail };
  if (kind === "sine") return { kind, torque_nm, frequency_hz: detail };
  return { kind, torque_nm };
}

/** A torque of the user's own on one of the three channels. */
export function CustomLoad({ isShown }: { isShown: boolean }) {
  const [kind, setKind] = useState<Kind>("constant");
  const [channel, setChannel] = useState<Channel>("0");
  const [torque, setTorque] = useState("1");
  const [duration, setDuration] = useState("0.5");
  const [frequency, setFrequency] = useState("1");

  const detail = Number(kind === "pulse" ? duration : frequency);
  const draft = loadOf(kind, channel, Number(torque), detail);
  const isNumber = torque !== "" && Number.isFinite(Number(torque)) && detail > 0;

  const submit = (event: Event) => {
    event.preventDefault();
    void perform("load.custom", () => addLoad(draft));
  };

  return (
    <form class="custom-load" onSubmit={submit}>
      <Choice label={text.load.customKind} options={KINDS} value={kind} onChoose={setKind} />
      <Choice
        label={text.load.customChannel}
        options={CHANNELS}
        value={channel}
        onChoose={setChannel}
      />
      <NumberBox {...shownAs("torque_nm")} value={torque} onInput={setTorque} />
      {kind === "pulse" && (
        <NumberBox {...shownAs("duration_s")} value={duration} onInput={setDuration} />
      )}
      {kind === "sine" && (
        <NumberBox {...shownAs("frequency_hz")} value={frequency} onInput={setFrequency} />
      )}
      <EnduranceNote load={isShown && isNumber ? draft : null} />
      <button type="submit" class="button">
        {text.load.apply}
      </button>
      <Problem control="load.custom" />
    </form>
  );
}
