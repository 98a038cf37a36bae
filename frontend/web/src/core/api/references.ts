/** References before they are followed: read from a CSV, and looked at; nothing is changed. */
import { request } from "./request";
import type { components } from "./schema";
import type { PositionReference, Sent, StiffnessReference } from "./types";

type Schemas = components["schemas"];

export type Follows = "position" | "stiffness";
export type Reference = Sent<PositionReference> | Sent<StiffnessReference>;
export type Preview = Schemas["ReferencePreview"];
export type Series = Schemas["PositionSeries"] | Schemas["StiffnessSeries"];

export const readSeries = (csv: string) =>
  request("post", "references/csv", csv) as Promise<Series>;
export const previewReference = (follows: Follows, reference: Reference) =>
  request("post", `references/${follows}/preview`, reference) as Promise<Preview>;
