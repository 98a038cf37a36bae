/**
 * The window as CSV, as the server writes runs: "<lane>.<channel> [unit]", in SI, every sample. A
 * gap is two rows without values, at its first and at its last sample.
 */
import type { SampleRing } from "../stream/ring";
import { CHANNELS, type ChannelName } from "./channels";
import type { Span } from "./spans";

export interface CsvColumn {
  channel: ChannelName;
  lane: number;
}

/** A name ends in its unit; this is how the unit is written. */
const SI_UNITS: Readonly<Record<string, string>> = { deg: "rad", "deg/s": "rad/s" };

export function siUnit(channel: ChannelName): string {
  const { unit } = CHANNELS[channel];
  return SI_UNITS[unit] ?? unit;
}

/** A single-precision value in as few digits as give it back; nothing where there is none. */
const written = (value: number): string =>
  Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "";

export function writeCsv(
  ring: SampleRing,
  { from, to }: Span,
  columns: readonly CsvColumn[],
  laneNames: readonly string[],
): string {
  const header = columns.map(
    ({ channel, lane }) => `"${laneNames[lane - 1]}.${channel} [${siUnit(channel)}]"`,
  );
  const rows = [`"time_s [s]",${header.join(",")}`];
  for (let index = ring.firstAt(from); index < ring.length && ring.timeAt(index) <= to; index++) {
    const values = columns.map(({ channel, lane }) => written(ring.valueAt(channel, index, lane)));
    rows.push(`${Number(ring.timeAt(index).toFixed(6))},${values.join(",")}`);
  }
  return `${rows.join("\r\n")}\r\n`;
}
