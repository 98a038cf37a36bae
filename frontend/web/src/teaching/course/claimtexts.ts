/** What the paper claims of each figure, in the server's words. */
import { signal } from "@preact/signals";
import { request } from "../../core/api/request";
import type { components } from "../../core/api/schema";

export const figureClaims = signal<ReadonlyMap<string, string>>(new Map());

export async function loadClaims(): Promise<void> {
  if (figureClaims.peek().size > 0) return;
  const figures = (await request("get", "figures")) as components["schemas"]["FigureState"][];
  figureClaims.value = new Map(figures.map(({ key, claim }) => [key, claim]));
}
