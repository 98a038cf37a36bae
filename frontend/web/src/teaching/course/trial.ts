/** A figure of the paper run with both laws in a private session, and the result. */
import { call } from "../../core/api/operations";
import { API } from "../../core/api/request";
import type { Claim, Figure, Hello } from "../../core/api/types";
import { BatchDecoder } from "../../core/stream/decoder";
import { type ErrorHistory, errorHistoryOf } from "./outcome";

const DURATION_S = 20;
const MAX_STEP = 10_000;
const RATE_HZ = 1000;
const TIMEOUT_MS = 20_000;
const CHANNELS = ["time_s", "position_error_rad"] as const;

export interface FigureResult {
  course: ErrorHistory;
  /** The run compared with the paper's claim, by the server. */
  claim: Claim;
}

/** The whole run with FL and NDOBC. */
export async function runFigureInPrivate(figure: Figure): Promise<FigureResult> {
  const { session } = await call(
    "post",
    "/sessions",
    { body: { figure, law: "fl", comparisons: [{ law: "ndobc" }], load: true } },
    TIMEOUT_MS,
  );
  const path = { session };
  try {
    let state = await call("post", "/sessions/{session}/pause", { path }, TIMEOUT_MS);
    const last = Math.round(DURATION_S * state.rate_hz);
    while (state.tick < last && state.status !== "fault") {
      const ticks = Math.min(MAX_STEP, last - state.tick);
      const parts = { path, body: { ticks } };
      state = await call("post", "/sessions/{session}/step", parts, TIMEOUT_MS);
    }
    const claim = await call("get", "/sessions/{session}/claim", { path, query: { figure } });
    return { course: await readHistory(session, state.tick), claim };
  } finally {
    await call("delete", "/sessions/{session}", { path }).catch(() => undefined);
  }
}

/** Read the run's past from the stream, then close it. */
function readHistory(session: string, lastTick: number): Promise<ErrorHistory> {
  const address = new URL(`sessions/${session}/stream`, API);
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
    const parts: ErrorHistory[] = [];
    let decoder: BatchDecoder | null = null;
    const giveUpTimer = setTimeout(() => socket.close(), TIMEOUT_MS);
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === "string") {
        const content = JSON.parse(data) as Hello | { type: "state" | "error" };
        if (content.type === "hello") decoder = new BatchDecoder(content);
        return;
      }
      const batch = decoder?.decode(data);
      if (batch === undefined) return;
      parts.push(errorHistoryOf(batch, CHANNELS.length));
      if (batch.firstTick + batch.count * batch.stride >= lastTick) socket.close();
    };
    socket.onclose = () => {
      clearTimeout(giveUpTimer);
      const history = concatenate(parts);
      if (history.timeS.length > 0) resolve(history);
      else reject(new Error("no samples"));
    };
  });
}

function concatenate(parts: readonly ErrorHistory[]): ErrorHistory {
  return {
    timeS: parts.flatMap((part) => part.timeS),
    positionRad: [
      parts.flatMap((part) => part.positionRad[0]),
      parts.flatMap((part) => part.positionRad[1]),
    ],
  };
}
