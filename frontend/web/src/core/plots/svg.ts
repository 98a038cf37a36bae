/** A plot as SVG: the same curves as vectors, for a file or a raster image. */

import { formatTicks, placeTicks } from "./axes";
import { BAND_OPACITY, bandsOf } from "./bands";
import type { Points } from "./decimation";
import type { Bound, Trace } from "./definitions";
import type { Palette } from "./linestyles";

interface DrawnAxis {
  label: string;
  from: number;
  to: number;
}

export interface Drawing {
  title: string;
  x: DrawnAxis;
  y: DrawnAxis;
  curves: readonly { trace: Trace; points: Points }[];
  bounds: readonly Bound[];
  events: readonly { time: number; label: string }[];
  colours: Palette;
}

export const WIDTH = 960;
export const HEIGHT = 420;
const BOX = { left: 74, top: 62, right: 20, bottom: 52 } as const;
const INNER = { width: WIDTH - BOX.left - BOX.right, height: HEIGHT - BOX.top - BOX.bottom };
const LETTER = 7.2;
const SIGN_EVERY = 110;

const escapes: Readonly<Record<string, string>> = {
  "&": "&amp;",
  "<": "&lt;",
  ">": "&gt;",
  '"': "&quot;",
};
const safe = (words: string) => words.replace(/[&<>"]/g, (letter) => escapes[letter] as string);
const short = (value: number) => Number(value.toFixed(2));

function placesOf({ x, y }: Drawing) {
  return {
    x: (value: number) => short(BOX.left + ((value - x.from) / (x.to - x.from)) * INNER.width),
    y: (value: number) => short(BOX.top + ((y.to - value) / (y.to - y.from)) * INNER.height),
  };
}
type Places = ReturnType<typeof placesOf>;

function axes({ x, y, colours }: Drawing, at: Places): string {
  const across = placeTicks(x, 10);
  const up = placeTicks(y, 6);
  const lines = [
    ...across.map((tick) => `M${at.x(tick)} ${BOX.top}v${INNER.height}`),
    ...up.map((tick) => `M${BOX.left} ${at.y(tick)}h${INNER.width}`),
  ];
  const words = [
    ...formatTicks(across).map(
      (word, index) =>
        `<text x="${at.x(across[index] as number)}" y="${HEIGHT - BOX.bottom + 18}" text-anchor="middle">${word}</text>`,
    ),
    ...formatTicks(up).map(
      (word, index) =>
        `<text x="${BOX.left - 8}" y="${at.y(up[index] as number) + 4}" text-anchor="end">${word}</text>`,
    ),
    `<text x="${BOX.left + INNER.width / 2}" y="${HEIGHT - 12}" text-anchor="middle">${safe(x.label)}</text>`,
    `<text transform="translate(18 ${BOX.top + INNER.height / 2}) rotate(-90)" text-anchor="middle">${safe(y.label)}</text>`,
  ];
  return `<path d="${lines.join("")}" stroke="${colours.grid}" fill="none"/>
<g fill="${colours.axis}" font-size="13">${words.join("")}</g>`;
}

function pathOf({ x, y, count }: Points, at: Places): string {
  let path = "";
  let isDown = false;
  for (let index = 0; index < count; index++) {
    const value = y[index] as number;
    if (Number.isNaN(value)) isDown = false;
    else {
      path += `${isDown ? "L" : "M"}${at.x(x[index] as number)} ${at.y(value)}`;
      isDown = true;
    }
  }
  return path;
}

const SHAPES = {
  circle: (x: number, y: number) => `<circle cx="${x}" cy="${y}" r="4.5"/>`,
  square: (x: number, y: number) => `<rect x="${x - 4}" y="${y - 4}" width="8" height="8"/>`,
  triangle: (x: number, y: number) => `<path d="M${x} ${y - 5}l5 9h-10z"/>`,
} as const;

function signsOf({ sign, lane }: Trace, { x, y, count }: Points, at: Places): string {
  if (sign === "none") return "";
  let next = BOX.left + lane * SIGN_EVERY * 0.25;
  let signs = "";
  for (let index = 0; index < count; index++) {
    const place = at.x(x[index] as number);
    const value = y[index] as number;
    if (!(place >= next) || Number.isNaN(value)) continue;
    signs += SHAPES[sign](place, at.y(value));
    next = place + SIGN_EVERY;
  }
  return signs;
}

function strokeOf({ colour, width, dash }: Trace, colours: Palette): string {
  const dashes = dash.length > 0 ? ` stroke-dasharray="${dash.join(" ")}"` : "";
  return `stroke="${colours[colour]}" stroke-width="${width}" fill="none"${dashes}`;
}

function legend({ curves, colours }: Drawing): string {
  let left: number = BOX.left;
  const entries = curves.filter(({ trace }) => trace.follows === undefined);
  return entries
    .map(({ trace }) => {
      const x = left;
      left += 50 + trace.label.length * LETTER;
      const sign = trace.sign === "none" ? "" : SHAPES[trace.sign](x + 14, 44);
      return `<path d="M${x} 44h28" ${strokeOf(trace, colours)}/><g fill="${colours[trace.colour]}">${sign}</g>
<text x="${x + 34}" y="48" font-size="13" fill="${colours.reference}">${safe(trace.label)}</text>`;
    })
    .join("\n");
}

function marks({ events, bounds, x, y, colours }: Drawing, at: Places): string {
  const lines = events
    .filter(({ time }) => time >= x.from && time <= x.to)
    .map(
      ({ time, label }) =>
        `<path d="M${at.x(time)} ${BOX.top}v${INNER.height}" stroke="${colours.mark}" stroke-dasharray="2 3"/>
<text x="${at.x(time) + 4}" y="${BOX.top + 12}" font-size="12" fill="${colours.mark}">${safe(label)}</text>`,
    );
  const limits = bounds.flatMap(({ value, colour }) =>
    [-value, value]
      .filter((limit) => limit >= y.from && limit <= y.to)
      .map(
        (limit) =>
          `<path d="M${BOX.left} ${at.y(limit)}h${INNER.width}" stroke="${colours[colour]}" opacity="0.6"/>`,
      ),
  );
  return [...lines, ...limits].join("\n");
}

export function drawSvg(drawing: Drawing): string {
  const { title, curves, colours } = drawing;
  const at = placesOf(drawing);
  const strokes = [...curves].reverse().map(
    ({
      trace,
      points,
    }) => `<path d="${pathOf(points, at)}" ${strokeOf(trace, colours)} stroke-linejoin="round"/>
<g fill="${colours[trace.colour]}">${signsOf(trace, points, at)}</g>`,
  );
  const bands = bandsOf(curves).map(
    ({ colour, outline }) =>
      `<path d="${pathOf(outline, at)}" fill="${colours[colour]}" fill-opacity="${BAND_OPACITY}"/>`,
  );
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${HEIGHT}" viewBox="0 0 ${WIDTH} ${HEIGHT}" font-family="system-ui, sans-serif">
<title>${safe(title)}</title>
<rect width="100%" height="100%" fill="${colours.surface}"/>
<text x="${BOX.left}" y="26" font-size="17" font-weight="650" fill="${colours.reference}">${safe(title)}</text>
${legend(drawing)}
${axes(drawing, at)}
<clipPath id="box"><rect x="${BOX.left}" y="${BOX.top}" width="${INNER.width}" height="${INNER.height}"/></clipPath>
<g clip-path="url(#box)">
${marks(drawing, at)}
${[...bands, ...strokes].join("\n")}
</g>
</svg>
`;
}
