/** Ask the server what gains and observer would do; nothing is changed by it. */
import { request, sessionName } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Prediction = Schemas["Prediction"];
export type PredictRequest = Partial<Schemas["PredictRequest"]>;

export const predict = (wanted: PredictRequest) =>
  request(
    "post",
    `sessions/${encodeURIComponent(sessionName)}/predict`,
    wanted,
  ) as Promise<Prediction>;
