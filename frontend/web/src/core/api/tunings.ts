/** Tune a law on the server: start, follow, break off. */
import { API, request, sessionName } from "./request";
import type { components } from "./schema";
import type { Law } from "./types";

type Schemas = components["schemas"];

export type Tuning = Schemas["TuningState"];
export type Trial = Schemas["TrialState"];

const pathOf = (id: string) => `tunings/${encodeURIComponent(id)}`;

/** It begins from what the law is set to in this session. */
export const startTuning = (law: Law, budget: number) =>
  request("post", "tunings", { law, budget, session: sessionName }) as Promise<Tuning>;
/** first: from which trial on they are told. */
export const readTuning = (id: string, first: number) =>
  request("get", `${pathOf(id)}?first=${first}`) as Promise<Tuning>;
export const listTunings = () => request("get", "tunings") as Promise<Tuning[]>;
export const stopTuning = (id: string) => request("delete", pathOf(id)) as Promise<Tuning>;
export const tunedFileOf = (id: string): string => new URL(`${pathOf(id)}/file`, API).href;
