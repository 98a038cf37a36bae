/**
 * The window as CSV in the server's format of runs: "<name>.<channel> [unit]", SI, every sample. A
 * column has the values of one controller, and is empty while another was in control. A gap is two
 * rows without values, at its first and at its last sample.
 */
import type { LaneSegments } from "../state/lanes";
import type { SampleRing } from "../stream/ring";
import { t } from "../text/t";
import { CHANNELS, type ChannelName } from "./channels";
import { isWithin, type Trace } from "./definitions";
import type { Span } from "./spans";

interface CsvColumn {
  channel: ChannelName;
  name: string;
  pieces: readonly Pick<Trace, "lane" | "from" | "to">[];
}

/** The channels of every controller in the span, and once those that all lanes have in common. */
export function columnsOf(
  channels: readonly ChannelName[],
  cast: LaneSegments,
  { from, to }: Span,
): CsvColumn[] {
  const byController = new Map<number, Omit<CsvColumn, "channel">>();
  for (const [index, lane] of cast.entries()) {
    for (const { number, name, ...piece } of lane) {
      if (piece.to <= from || piece.from > to) continue;
      const known = byController.get(number)?.pieces ?? [];
      byController.set(number, { name, pieces: [...known, { lane: index + 1, ...piece }] });
    }
  }
  const controllers = [...byController.values()];
  const always = { lane: 1, from: Number.NEGATIVE_INFINITY, to: Number.POSITIVE_INFINITY };
  const common = { name: t("plots.common"), pieces: [always] };
  return channels.flatMap((channel) =>
    (CHANNELS[channel].isReference ? [common] : controllers).map((controller) => ({
      ...controller,
      channel,
    })),
  );
}

/** The name ends in the unit; format of the unit. */
const SI_UNITS: Readonly<Record<string, string>> = { deg: "rad", "deg/s": "rad/s" };

function siUnit(channel: ChannelName): string {
  const { unit } = CHANNELS[channel];
  return SI_UNITS[unit] ?? unit;
}

/** Shortest decimal that gives the same single-precision value; empty if there is none. */
const written = (value: number): string =>
  Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "";

function valueAt(ring: SampleRing, { channel, pieces }: CsvColumn, index: number): number {
  const timeS = ring.timeAt(index);
  const piece = pieces.find((candidate) => isWithin(candidate, timeS));
  return piece === undefined ? Number.NaN : ring.valueAt(channel, index, piece.lane);
}

export function writeCsv(
  ring: SampleRing,
  { from, to }: Span,
  columns: readonly CsvColumn[],
): string {
  const header = columns.map(({ channel, name }) => `"${name}.${channel} [${siUnit(channel)}]"`);
  const rows = [`"time_s [s]",${header.join(",")}`];
  for (
    let index = ring.lowerBound(from);
    index < ring.length && ring.timeAt(index) <= to;
    index++
  ) {
    const values = columns.map((column) => written(valueAt(ring, column, index)));
    rows.push(`${Number(ring.timeAt(index).toFixed(6))},${values.join(",")}`);
  }
  return `${rows.join("\r\n")}\r\n`;
}
