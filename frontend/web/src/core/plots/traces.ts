/** From the channels of a plot and the lanes of the session to the curves that are drawn. */
import type { Cast, Stretch } from "../state/lanes";
import { plotsText as text } from "../text/plots";
import { CHANNELS, type ChannelName } from "./channels";
import type { LineStyle, PlotContent, PlotSign, Trace, TraceGroup } from "./definitions";
import { DASHED, DOTTED, lineStyleOf, shareColours } from "./linestyles";

const SIGNS: readonly PlotSign[] = ["none", "circle", "square", "triangle"];
const WIDTHS = [3, 2, 1.25] as const;

const REFERENCE: LineStyle = { colour: "reference", dash: DOTTED, width: 1.5 };

const label = (channel: ChannelName): string => text.channelLabels[channel];

/** A channel of a lane for as long as there are samples of it. */
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

interface Placed extends Stretch {
  lane: number;
}

/** Who controls a lane now comes first, in the order of the lanes, then who did before. */
function listStretches(cast: Cast): Placed[] {
  const lanes = cast.map((lane, index) => lane.map((one) => ({ ...one, lane: index + 1 })));
  const present = lanes.flatMap((lane) => lane.slice(-1));
  const past = lanes.flatMap((lane) => lane.slice(0, -1));
  return [...present, ...past.sort((one, other) => one.number - other.number)];
}

/** A channel piece by piece; the pieces of one owner are one curve, of which the first is the key. */
function pieces(
  channel: ChannelName,
  cast: Cast,
  ownerOf: (stretch: Placed) => string,
  look: (stretch: Placed) => { lineStyle: LineStyle; label: string },
): Trace[] {
  const owners = new Set<string>();
  return listStretches(cast).map((stretch) => {
    const { lane, from, to } = stretch;
    const { lineStyle, label: name } = look(stretch);
    const owner = ownerOf(stretch);
    const piece: Trace = { ...trace(channel, lane, lineStyle, name), from, to, key: owner };
    if (!owners.has(owner)) {
      owners.add(owner);
      return piece;
    }
    return { ...piece, key: `${owner}.${lane}.${from}`, follows: owner, continues: true };
  });
}

const keyOf = (channel: ChannelName, { number }: Placed): string => `${channel}.${number}`;

/** How many controllers have curves. */
const countControllers = (cast: Cast): number =>
  new Set(cast.flat().map(({ number }) => number)).size;

/** The other side of a limit. */
const mirror = (limit: Trace): Trace => ({
  ...limit,
  key: `-${limit.key}`,
  factor: -limit.factor,
  follows: limit.follows ?? limit.key,
});

interface Sorted {
  references: ChannelName[];
  /** Each with the truth or the limit that goes with it. */
  leaders: { channel: ChannelName; companions: ChannelName[] }[];
}

function sort(channels: readonly ChannelName[]): Sorted {
  const leaderOf = (name: ChannelName) => {
    const { truthOf, limitOf } = CHANNELS[name];
    const leader = truthOf ?? limitOf;
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

const withMirror = (one: Trace): Trace[] =>
  CHANNELS[one.channel as ChannelName].limitOf === undefined ? [one] : [one, mirror(one)];

/**
 * One lane: the line style of who controls it where there is one channel, a colour a channel where there are
 * several; truths and limits beside what they belong to.
 */
function contentAlone({ references, leaders }: Sorted, cast: Cast): PlotContent {
  const looks = shareColours(leaders.map(({ channel }) => CHANNELS[channel].colour));
  const isOne = leaders.length === 1;
  const isOneController = countControllers(cast) === 1;
  const groups = leaders.map(({ channel, companions }, index): TraceGroup => {
    const width = WIDTHS[Math.min(leaders.length > 2 ? index : 0, WIDTHS.length - 1)] as number;
    const look = looks[index] as (typeof looks)[number];
    const own = isOne
      ? pieces(
          channel,
          cast,
          (one) => keyOf(channel, one),
          (one) => ({
            lineStyle: lineStyleOf(one.lineStyle),
            label: isOneController ? label(channel) : one.name,
          }),
        )
      : pieces(
          channel,
          cast,
          () => channel,
          () => ({ lineStyle: { ...look, width }, label: label(channel) }),
        );
    const [leader] = own;
    const beside = companions.map((name): Trace => {
      const isTruth = CHANNELS[name].truthOf !== undefined;
      const lineStyle: LineStyle = isTruth
        ? { colour: leader?.colour ?? look.colour, dash: DASHED, width: 1.5 }
        : { colour: "reference", dash: DOTTED, width: 1.5 };
      const one = trace(name, 1, lineStyle, label(name));
      return isTruth && leader ? { ...one, follows: leader.key } : one;
    });
    return { key: channel, label: label(channel), traces: [...own, ...beside.flatMap(withMirror)] };
  });
  const common = references.map((name) => trace(name, 1, REFERENCE, label(name)));
  return { groups, common };
}

/** Several lanes: the line style of who controls each, a sign a channel where there are several. */
function contentSideBySide({ references, leaders }: Sorted, cast: Cast): PlotContent {
  const groups = leaders.map(({ channel, companions }, index): TraceGroup => {
    const sign = SIGNS[index % SIGNS.length] as PlotSign;
    const own = pieces(
      channel,
      cast,
      (one) => keyOf(channel, one),
      (one) => ({ lineStyle: lineStyleOf(one.lineStyle), label: one.name }),
    ).map((one): Trace => ({ ...one, sign }));
    const beside = companions.flatMap((name): Trace[] => {
      if (CHANNELS[name].truthOf !== undefined) {
        return cast.map((_, lane) => {
          const truth = trace(name, lane + 1, REFERENCE, text.plots.true);
          return lane === 0 ? truth : { ...truth, follows: `${name}.1` };
        });
      }
      const limits = pieces(
        name,
        cast,
        (one) => keyOf(name, one),
        (one) => ({
          lineStyle: { ...lineStyleOf(one.lineStyle), dash: DOTTED, width: 1.25 },
          label: label(name),
        }),
      );
      return limits.flatMap((limit, at) => {
        const leader = own[at] as Trace;
        return withMirror({ ...limit, follows: leader.follows ?? leader.key });
      });
    });
    return { key: channel, label: label(channel), traces: [...own, ...beside] };
  });
  const common = references.map((name) => trace(name, 1, REFERENCE, label(name)));
  return { groups, common };
}

export function composeContent(channels: readonly ChannelName[], cast: Cast): PlotContent {
  const sorted = sort(channels);
  return cast.length > 1 ? contentSideBySide(sorted, cast) : contentAlone(sorted, cast);
}

/** The curves of the groups chosen; where several lanes show several groups, with both names. */
export function tracesOf(
  { groups, common }: PlotContent,
  chosen: ReadonlySet<string>,
  laneCount: number,
): Trace[] {
  const shown = laneCount > 1 ? groups.filter((group) => chosen.has(group.key)) : groups;
  const isMixed = laneCount > 1 && shown.length > 1;
  const named = shown.flatMap(({ label, traces }) =>
    isMixed
      ? traces.map((one) => ({ ...one, label: text.plots.ofLane(one.label, label) }))
      : traces,
  );
  return [...named, ...common];
}

/** Whether the truth of a curve stands in the legend under the curve. */
export const hasUnnamedTruth = (traces: readonly Trace[]): boolean =>
  traces.some(({ channel, follows }) => {
    const { truthOf } = CHANNELS[channel as ChannelName];
    return traces.some((one) => one.key === follows && one.channel === truthOf);
  });

/** Whether an entry of the legend has one value: several lanes share one for their truths, which differ. */
export function hasOneValue(traces: readonly Trace[], key: string): boolean {
  const leader = traces.find((one) => one.key === key);
  return !traces.some(
    ({ follows, continues, channel, lane }) =>
      follows === key && !continues && channel === leader?.channel && lane !== leader.lane,
  );
}
