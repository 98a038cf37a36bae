/** From the channels of a plot and the lanes of the session to the curves that are drawn. */
import { text } from "../text/en";
import { CHANNELS, type ChannelName } from "./channels";
import type { Ink, PlotContent, PlotSign, Trace, TraceGroup } from "./definitions";
import { DASHED, DOTTED, inkOf, shareColours } from "./inks";

const SIGNS: readonly PlotSign[] = ["none", "circle", "square", "triangle"];
const WIDTHS = [3, 2, 1.25] as const;

const label = (channel: ChannelName): string => text.channelLabels[channel];

function trace(channel: ChannelName, lane: number, ink: Ink, name: string): Trace {
  return {
    key: `${channel}.${lane}`,
    channel,
    lane,
    label: name,
    factor: CHANNELS[channel].factor,
    sign: "none",
    ...ink,
  };
}

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

/** One lane: a colour a channel, truths and limits dashed beside what they belong to. */
function contentAlone({ references, leaders }: Sorted): PlotContent {
  const looks = shareColours(leaders.map(({ channel }) => CHANNELS[channel].colour));
  const groups = leaders.map(({ channel, companions }, index): TraceGroup => {
    const width = WIDTHS[Math.min(leaders.length > 2 ? index : 0, WIDTHS.length - 1)] as number;
    const look = looks[index] as (typeof looks)[number];
    const leader = trace(
      channel,
      1,
      { ...look, width: leaders.length > 1 ? width : 2.5 },
      label(channel),
    );
    const beside = companions.map((name): Trace => {
      const isTruth = CHANNELS[name].truthOf !== undefined;
      const ink: Ink = isTruth
        ? { colour: look.colour, dash: DASHED, width: 1.5 }
        : { colour: "reference", dash: DOTTED, width: 1.5 };
      const one = trace(name, 1, ink, label(name));
      return isTruth ? { ...one, follows: leader.key } : one;
    });
    return { key: channel, label: leader.label, traces: [leader, ...beside.flatMap(withMirror)] };
  });
  const common = references.map((name) =>
    trace(name, 1, { colour: "reference", dash: DASHED, width: 1.5 }, label(name)),
  );
  return { groups, common };
}

/** Several lanes: an ink a lane, a sign a channel where there are several. */
function contentSideBySide({ references, leaders }: Sorted, lanes: readonly string[]): PlotContent {
  const groups = leaders.map(({ channel, companions }, index): TraceGroup => {
    const sign = SIGNS[index % SIGNS.length] as PlotSign;
    const own = lanes.map((name, lane) => ({
      ...trace(channel, lane + 1, inkOf(lane + 1), name),
      sign,
    }));
    const beside = companions.flatMap((name) =>
      lanes.flatMap((_, lane): Trace[] => {
        const isTruth = CHANNELS[name].truthOf !== undefined;
        if (!isTruth) {
          const ink: Ink = { ...inkOf(lane + 1), dash: DOTTED, width: 1.25 };
          const limit = trace(name, lane + 1, ink, label(name));
          return withMirror({ ...limit, follows: (own[lane] as Trace).key });
        }
        const ink: Ink = { colour: "reference", dash: DOTTED, width: 1.5 };
        const truth = trace(name, lane + 1, ink, text.plots.true);
        return [lane === 0 ? truth : { ...truth, follows: `${name}.1` }];
      }),
    );
    return { key: channel, label: label(channel), traces: [...own, ...beside] };
  });
  const common = references.map((name) =>
    trace(name, 1, { colour: "reference", dash: DOTTED, width: 1.5 }, label(name)),
  );
  return { groups, common };
}

export function composeContent(
  channels: readonly ChannelName[],
  lanes: readonly string[],
): PlotContent {
  const sorted = sort(channels);
  return lanes.length > 1 ? contentSideBySide(sorted, lanes) : contentAlone(sorted);
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
