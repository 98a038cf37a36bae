/** A figure of the paper run with both laws in a private session, and the result. */
import { API, request } from "../../core/api/request";
import type { Claim, Figure, Hello, SessionState } from "../../core/api/types";
import { BatchDecoder } from "../../core/stream/decoder";
import { type ErrorHistory, errorHistoryOf } from "./outcome";

const DURATION_S = 20;
const MAX_STEP = 10_000;
const RATE_HZ = 1000;
const TIMEOUT_MS = 20_000;
const CHANNELS = ["time_s", "position_error_rad"] as const;

const privateRequest = (method: "post" | "get" | "delete" | "put", path: string, body?: unknown) =>
  request(method, path, body, TIMEOUT_MS) as Promise<SessionState>;

export interface FigureResult {
  course: ErrorHistory;
  /** The run compared with the paper's claim, by the server. */
  claim: Claim;
}

/** The whole run with FL and NDOBC. */
export async function runFigureInPrivate(figure: Figure): Promise<FigureResult> {
  const { session } = await privateRequest("post", "sessions", {
    figure,
    law: "fl",
    comparisons: [{ law: "ndobc" }],
    load: true,
  });
  const path = `sessions/${session}`;
  try {
    let state = await privateRequest("post", `${path}/pause`);
    const last = Math.round(DURATION_S * state.rate_hz);
    while (state.tick < last && state.status !== "fault") {
      const ticks = Math.min(MAX_STEP, last - state.tick);
      state = await privateRequest("post", `${path}/step`, { ticks });
    }
    const claim = (await request("get", `${path}/claim?figure=${figure}`)) as Claim;
    return { course: await readHistory(path, state.tick), claim };
  } finally {
    await request("delete", path).catch(() => undefined);
  }
}

/** Read the run's past from the stream, then close it. */
function readHistory(path: string, lastTick: number): Promise<ErrorHistory> {
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
