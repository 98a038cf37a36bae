/** Converts the channels of a plot and the lanes of the session into curves. */
import type { LaneSegments, Segment } from "../state/lanes";
import { t } from "../text/t";
import { CHANNELS, type ChannelName } from "./channels";
import {
  type LineStyle,
  ownerOf,
  type PlotContent,
  type PlotSign,
  type Trace,
  type TraceGroup,
} from "./definitions";
import { ESTIMATE } from "./estimate";
import { DASHED, DOTTED, lineStyleOfLane, PLAIN, shareColours } from "./linestyles";

const SIGNS: readonly PlotSign[] = ["none", "circle", "square", "triangle"];
const WIDTHS = [3, 2, 1.25] as const;

const REFERENCE: LineStyle = { colour: "reference", dash: DOTTED, width: 1.5 };
const BOUND: LineStyle = { ...REFERENCE, dash: DASHED };

/** A bench has no true stiffness: its nominal one is computed from the measured positions. */
const label = (channel: ChannelName, isBench = false): string =>
  channel === "stiffness_nm_per_rad" && isBench
    ? t("plots.nominalStiffness")
    : t(`channelLabels.${channel}`);

/** A channel of a lane while there are samples of it. */
function trace(channel: ChannelName, lane: number, lineStyle: LineStyle, name: string): Trace {
  return {
    key: `${channel}.${lane}`,
    channel,
    lane,
    label: name,
    factor: CHANNELS[channel].factor,
    sign: "none",
    from: Number.NEGATIVE_INFINITY,
    to: Number.POSITIVE_INFINITY,
    ...lineStyle,
  };
}

interface Placed extends Segment {
  lane: number;
}

/** The current controllers first, in the order of the lanes, then the previous ones. */
function listSegments(cast: LaneSegments): Placed[] {
  const lanes = cast.map((lane, index) => lane.map((segment) => ({ ...segment, lane: index + 1 })));
  const present = lanes.flatMap((lane) => lane.slice(-1));
  const past = lanes.flatMap((lane) => lane.slice(0, -1));
  return [...present, ...past.sort((first, second) => first.number - second.number)];
}

/** With several lanes, an estimate is drawn only while the lane's law uses it. */
const isDrawn = (channel: ChannelName, cast: LaneSegments, { hasEstimate }: Segment): boolean =>
  hasEstimate || cast.length <= 1 || !channel.startsWith("estimate_");

/**
 * A channel in pieces; the pieces of one controller are one curve, whose key is that of the first.
 */
function pieces(
  channel: ChannelName,
  cast: LaneSegments,
  ownerOf: (segment: Placed) => string,
  look: (segment: Placed, isChosen: boolean) => { lineStyle: LineStyle; label: string },
): Trace[] {
  const owners = new Set<string>();
  const chosen = cast[0]?.at(-1)?.number;
  const drawn = listSegments(cast).filter((segment) => isDrawn(channel, cast, segment));
  return drawn.map((segment) => {
    const { lane, from, to } = segment;
    const { lineStyle, label: name } = look(segment, segment.number === chosen);
    const owner = ownerOf(segment);
    const piece: Trace = { ...trace(channel, lane, lineStyle, name), from, to, key: owner };
    if (!owners.has(owner)) {
      owners.add(owner);
      return piece;
    }
    return { ...piece, key: `${owner}.${lane}.${from}`, follows: owner, continues: true };
  });
}

const keyOf = (channel: ChannelName, { number }: Placed): string => `${channel}.${number}`;

/** Number of controllers with curves. */
const countControllers = (cast: LaneSegments): number =>
  new Set(cast.flat().map(({ number }) => number)).size;

/** The opposite limit. */
const mirror = (limit: Trace): Trace => ({
  ...limit,
  key: `-${limit.key}`,
  factor: -limit.factor,
  follows: limit.follows ?? limit.key,
});

interface Sorted {
  references: ChannelName[];
  /** Each curve with its true value, its limit or its estimate. */
  leaders: { channel: ChannelName; companions: ChannelName[] }[];
}

function sort(channels: readonly ChannelName[]): Sorted {
  const leaderOf = (name: ChannelName) => {
    const { truthOf, limitOf, estimateOf } = CHANNELS[name];
    const leader = truthOf ?? limitOf ?? estimateOf;
    return leader !== undefined && channels.includes(leader) ? leader : null;
  };
  const references = channels.filter((name) => CHANNELS[name].isReference);
  const leaders = channels
    .filter((name) => !CHANNELS[name].isReference && leaderOf(name) === null)
    .map((channel) => ({
      channel,
      companions: channels.filter((name) => leaderOf(name) === channel),
    }));
  return { references, leaders };
}

const withMirror = (curve: Trace): Trace[] =>
  CHANNELS[curve.channel as ChannelName].limitOf === undefined ? [curve] : [curve, mirror(curve)];

/** The edges of the band around an estimate, which are no other pieces of its curve. */
function edgesOf({ continues: _, ...curve }: Trace): Trace[] {
  const { band } = CHANNELS[curve.channel as ChannelName];
  const keyOfEdge = (channel?: ChannelName) => `${channel}.${curve.key}`;
  return (band ?? []).map((channel, index) => ({
    ...curve,
    key: keyOfEdge(channel),
    channel,
    label: label(channel),
    width: 1,
    sign: "none",
    follows: curve.follows ?? curve.key,
    ...(index === 0 && { fillsTo: keyOfEdge(band?.[1]) }),
  }));
}

/** A true value, a limit or an estimate, drawn with the curve it belongs to. */
function compose(companion: ChannelName, own: readonly Trace[], cast: LaneSegments): Trace[] {
  const isAlone = cast.length <= 1;
  const [leader] = own;
  if (CHANNELS[companion].estimateOf !== undefined) {
    const lineStyle: LineStyle = { colour: CHANNELS[companion].colour, dash: PLAIN, width: 1.5 };
    const name = { lane: cast[0]?.at(-1)?.name ?? "", channel: label(companion) };
    return [trace(companion, 1, lineStyle, isAlone ? name.channel : t("plots.ofLane", name))];
  }
  if (CHANNELS[companion].truthOf !== undefined) {
    if (isAlone && leader !== undefined) {
      const lineStyle: LineStyle = { colour: leader.colour, dash: DASHED, width: 1.5 };
      return [{ ...trace(companion, 1, lineStyle, label(companion)), follows: leader.key }];
    }
    return cast.map((_, lane) => {
      const truth = trace(companion, lane + 1, BOUND, t("plots.true"));
      return lane === 0 ? truth : { ...truth, follows: `${companion}.1` };
    });
  }
  if (isAlone) return [trace(companion, 1, BOUND, label(companion))];
  const limits = pieces(
    companion,
    cast,
    (segment) => keyOf(companion, segment),
    (segment, isChosen) => ({
      lineStyle: { ...lineStyleOfLane(segment.lineStyle, isChosen), dash: DASHED, width: 1.25 },
      label: label(companion),
    }),
  );
  return limits.map((limit, at) => ({ ...limit, follows: ownerOf(own[at] as Trace) }));
}

/**
 * The line style of each lane's controller. One lane with several channels has one color per
 * channel; several lanes with several channels have one marker per channel.
 */
export function composeContent(
  channels: readonly ChannelName[],
  cast: LaneSegments,
  isBench = false,
): PlotContent {
  const { references, leaders } = sort(channels);
  const isAlone = cast.length <= 1;
  const isOneName = isAlone && countControllers(cast) === 1;
  const colours = shareColours(leaders.map(({ channel }) => CHANNELS[channel].colour));
  const groups = leaders.map(({ channel, companions }, index): TraceGroup => {
    const width = WIDTHS[Math.min(leaders.length > 2 ? index : 0, WIDTHS.length - 1)] as number;
    const ofChannel = { ...(colours[index] as (typeof colours)[number]), width };
    const isByChannel = isAlone && leaders.length > 1;
    const sign = isAlone ? "none" : (SIGNS[index % SIGNS.length] as PlotSign);
    const own = pieces(
      channel,
      cast,
      (segment) => (isByChannel ? channel : keyOf(channel, segment)),
      (segment, isChosen) => ({
        lineStyle: isByChannel ? ofChannel : lineStyleOfLane(segment.lineStyle, isChosen),
        label: isByChannel || isOneName ? label(channel, isBench) : segment.name,
      }),
    ).map((curve): Trace => ({ ...curve, sign }));
    const added = companions.flatMap((name) => compose(name, own, cast).flatMap(withMirror));
    // An estimate is on top of the curve that it estimates, and its band below both.
    const isEstimate = (curve: Trace) => CHANNELS[curve.channel as ChannelName].band !== undefined;
    const estimates = added.filter(isEstimate);
    const others = added.filter((curve) => !isEstimate(curve));
    const traces = [...estimates, ...own, ...others, ...[...own, ...estimates].flatMap(edgesOf)];
    return { key: channel, label: label(channel, isBench), traces };
  });
  const common = references.map((name) => trace(name, 1, REFERENCE, label(name)));
  return { groups, common };
}

/** The curves of the selected groups; with both names if several lanes show several groups. */
export function tracesOf(
  { groups, common }: PlotContent,
  chosen: ReadonlySet<string>,
  laneCount: number,
): Trace[] {
  const shown = laneCount > 1 ? groups.filter((group) => chosen.has(group.key)) : groups;
  const isMixed = laneCount > 1 && shown.length > 1;
  const named = shown.flatMap(({ label, traces }) =>
    isMixed
      ? traces.map((curve) => ({
          ...curve,
          label: t("plots.ofLane", { lane: curve.label, channel: label }),
        }))
      : traces,
  );
  return [...named, ...common];
}

/** Whether the true value of a curve is in the legend under the curve. */
export const hasUnnamedTruth = (traces: readonly Trace[]): boolean =>
  traces.some(({ channel, follows }) => {
    const { truthOf } = CHANNELS[channel as ChannelName];
    return traces.some((curve) => curve.key === follows && curve.channel === truthOf);
  });

/**
 * What the stiffness next to its estimate is, if its legend entry has the name of a controller;
 * otherwise undefined.
 */
export function noteOfStiffness(traces: readonly Trace[], isBench: boolean): string | undefined {
  const name = label("stiffness_nm_per_rad", isBench);
  const isNamed = traces.every(
    (curve) => curve.channel !== "stiffness_nm_per_rad" || curve.label === name,
  );
  if (isNamed || traces.every(({ channel }) => channel !== ESTIMATE)) return undefined;
  return isBench ? t("plots.nominalNote") : t("plots.trueNote");
}

/**
 * Whether a legend entry has one value: several lanes share an entry for their true values, which
 * differ.
 */
export function hasOneValue(traces: readonly Trace[], key: string): boolean {
  const leader = traces.find((curve) => curve.key === key);
  return !traces.some(
    ({ follows, continues, channel, lane }) =>
      follows === key && !continues && channel === leader?.channel && lane !== leader.lane,
  );
}
