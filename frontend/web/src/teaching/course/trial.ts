/** A figure of the paper run with both laws in a private session, and the result. */
import { API, request } from "../../core/api/request";
import type { Claim, Figure, Hello, SessionState } from "../../core/api/types";
import { BatchDecoder } from "../../core/stream/decoder";
import { type Course, sliceCourse } from "./outcome";

const DURATION_S = 20;
const MAX_STEP = 10_000;
const RATE_HZ = 1000;
const PATIENCE_MS = 20_000;
const CHANNELS = ["time_s", "position_error_rad"] as const;

const ask = (method: "post" | "get" | "delete" | "put", path: string, body?: unknown) =>
  request(method, path, body, PATIENCE_MS) as Promise<SessionState>;

export interface Tried {
  course: Course;
  /** The run compared with the paper's claim, by the server. */
  claim: Claim;
}

/** The whole run as FL and NDOBC went through it. */
export async function runFigureApart(figure: Figure): Promise<Tried> {
  const { session } = await ask("post", "sessions", {
    figure,
    law: "fl",
    comparisons: [{ law: "ndobc" }],
    load: true,
  });
  const path = `sessions/${session}`;
  try {
    let state = await ask("post", `${path}/pause`);
    const last = Math.round(DURATION_S * state.rate_hz);
    while (state.tick < last && state.status !== "fault") {
      const ticks = Math.min(MAX_STEP, last - state.tick);
      state = await ask("post", `${path}/step`, { ticks });
    }
    const claim = (await request("get", `${path}/claim?figure=${figure}`)) as Claim;
    return { course: await readHistory(path, state.tick), claim };
  } finally {
    await request("delete", path).catch(() => undefined);
  }
}

/** Takes the run's past out of the stream, then closes it. */
function readHistory(path: string, lastTick: number): Promise<Course> {
  const address = new URL(`${path}/stream`, API);
  address.protocol = address.protocol.replace("http", "ws");
  address.search = String(
    new URLSearchParams({
      rate_hz: String(RATE_HZ),
      history_s: String(DURATION_S),
      lanes: "all",
      channels: CHANNELS.join(","),
    }),
  );
  return new Promise((resolve, reject) => {
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    const parts: Course[] = [];
    let decoder: BatchDecoder | null = null;
    const give = setTimeout(() => socket.close(), PATIENCE_MS);
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === "string") {
        const content = JSON.parse(data) as Hello | { type: "state" | "error" };
        if (content.type === "hello") decoder = new BatchDecoder(content);
        return;
      }
      const batch = decoder?.decode(data);
      if (batch === undefined) return;
      parts.push(sliceCourse(batch, CHANNELS.length));
      if (batch.firstTick + batch.count * batch.stride >= lastTick) socket.close();
    };
    socket.onclose = () => {
      clearTimeout(give);
      const whole = join(parts);
      if (whole.timeS.length > 0) resolve(whole);
      else reject(new Error("no samples"));
    };
  });
}

function join(parts: readonly Course[]): Course {
  return {
    timeS: parts.flatMap((part) => part.timeS),
    positionRad: [
      parts.flatMap((part) => part.positionRad[0]),
      parts.flatMap((part) => part.positionRad[1]),
    ],
  };
}
