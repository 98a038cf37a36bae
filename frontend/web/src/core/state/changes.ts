/** Which values of two objects differ, compared as JSON. */

export const isEqual = (first: unknown, second: unknown): boolean =>
  JSON.stringify(first) === JSON.stringify(second);

/** The fields of `now` that differ from those of `before`, of some `keys` in their order. */
export function findChanges<T extends object>(
  now: T,
  before: object,
  keys: readonly string[] = Object.keys(now),
): Partial<T> {
  const values = now as Record<string, unknown>;
  const held = before as Record<string, unknown>;
  const changed = keys.filter((key) => !isEqual(values[key], held[key]));
  return Object.fromEntries(changed.map((key) => [key, values[key]])) as Partial<T>;
}
