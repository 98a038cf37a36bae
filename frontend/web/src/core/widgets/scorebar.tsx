/** What a score is made of: 0.5 robustness + 0.3 draws + 0.2 accuracy. */
const WEIGHTS = { robustness: 0.5, draws: 0.3, accuracy: 0.2 } as const;
export type ScorePart = keyof typeof WEIGHTS;
export const SCORE_PARTS = Object.keys(WEIGHTS) as readonly ScorePart[];

interface ScoreBarProps {
  parts: Readonly<Record<ScorePart, number>>;
  /** Ends of its interval. */
  interval?: { low: number; high: number };
}

const percent = (share: number) => `${(100 * share).toFixed(2)}%`;

/** A score from 0 to 1 as a bar of its parts, its interval over it. */
export function ScoreBar({ parts, interval }: ScoreBarProps) {
  return (
    <span class="score-bar" aria-hidden="true">
      {SCORE_PARTS.map((part) => (
        <i
          key={part}
          class={`is-${part}`}
          style={{ width: percent(WEIGHTS[part] * parts[part]) }}
        />
      ))}
      {interval && (
        <b style={{ left: percent(interval.low), width: percent(interval.high - interval.low) }} />
      )}
    </span>
  );
}

/** Which colour of the bar is which part. */
export function ScoreKey({ names }: { names: Readonly<Record<ScorePart, string>> }) {
  return (
    <>
      {SCORE_PARTS.map((part) => (
        <span key={part}>
          <i class={`score-colour is-${part}`} aria-hidden="true" /> {names[part]}
        </span>
      ))}
    </>
  );
}
