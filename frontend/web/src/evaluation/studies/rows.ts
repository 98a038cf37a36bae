/** Rows of a study as columns of numbers, unpacked from the server's message. */

interface Column {
  values: Float64Array;
  /** Categories that its numbers stand for, if any. */
  labels: readonly string[] | null;
}

export interface Rows {
  count: number;
  /** Number of completed rows; more than `count` if the server sent a random subset. */
  total: number;
  columns: ReadonlyMap<string, Column>;
}

export const NOTHING: Rows = { count: 0, total: 0, columns: new Map() };

interface Header {
  rows: number;
  total: number;
  columns: { name: string; labels?: string[] }[];
}

export function unpackRows(packed: ArrayBuffer): Rows {
  const length = new DataView(packed).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(packed, 4, length));
  const { rows: count, total, columns } = JSON.parse(text) as Header;
  const namedColumns = columns.map(({ name, labels }, index): [string, Column] => [
    name,
    {
      values: new Float64Array(packed, 4 + length + 8 * count * index, count),
      labels: labels ?? null,
    },
  ]);
  return { count, total, columns: new Map(namedColumns) };
}

const NONE = new Float64Array(0);
export const valuesOf = (rows: Rows, name: string): Float64Array =>
  rows.columns.get(name)?.values ?? NONE;
