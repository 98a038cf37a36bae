import type { Preview } from "../../core/api/design";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { drawCourse } from "./shapes";

const WIDTH = 240;
const HEIGHT = 56;

interface CourseProps {
  preview: Preview;
  unit: string;
  factor: number;
}

/** What a reference would ask for, before anything follows it. */
export function Course({ preview, unit, factor }: CourseProps) {
  const shown = (value: number) => formatNumber(value * factor, 3);
  const caption = text.references.course(
    shown(preview.low),
    shown(preview.high),
    unit,
    formatNumber(preview.time_s.at(-1), 3),
    shown(preview.peak_rate),
  );
  return (
    <figure class="course">
      <svg
        viewBox={`0 -2 ${WIDTH} ${HEIGHT + 4}`}
        preserveAspectRatio="none"
        role="img"
        aria-label={caption}
      >
        <polyline points={drawCourse(preview.time_s, preview.value, WIDTH, HEIGHT)} />
      </svg>
      <figcaption>{caption}</figcaption>
    </figure>
  );
}
