import type { Configuration } from "../api/types";

/** The stiffness to begin with: the constant reference, else the geometric mean of the range. */
export function findStiffness({ stiffness, limits }: Configuration): number {
  if (stiffness.kind === "constant") return stiffness.stiffness_nm_per_rad;
  return Math.sqrt(limits.stiffness_min_nm_per_rad * limits.stiffness_max_nm_per_rad);
}
