/** Polls growing data of the server until they are complete. */
import { UnansweredError } from "../api/errors";

const PAUSE_MS = 700;
const pause = () => new Promise((resolve) => setTimeout(resolve, PAUSE_MS));

/** Whether polling is over: complete, gone on the server, or the page shows other data. */
type PollEnd = "ended" | "refused" | "left";

interface Poll {
  /**
   * Poll until `onAnswer` returns true, also after lost answers; a new call ends the previous one.
   * isCancelled, argument of `onAnswer`: whether a new call has ended this one.
   */
  follow: <T>(
    query: () => Promise<T>,
    onAnswer: (answer: T, isCancelled: () => boolean) => boolean | Promise<boolean>,
  ) => Promise<PollEnd>;
  stop: () => void;
}

/** onError: receives the reason of a lost answer or a rejection; null after the next answer. */
export function createPoll(onError: (error: unknown) => void): Poll {
  let round = 0;
  return {
    follow: async (query, onAnswer) => {
      const number = ++round;
      const isCancelled = () => number !== round;
      let isUnanswered = false;
      for (;;) {
        try {
          const answer = await query();
          if (isCancelled()) return "left";
          if (isUnanswered) onError(null);
          isUnanswered = false;
          const isEnded = await onAnswer(answer, isCancelled);
          if (isCancelled()) return "left";
          if (isEnded) return "ended";
        } catch (error) {
          if (isCancelled()) return "left";
          onError(error);
          if (!(error instanceof UnansweredError)) return "refused";
          isUnanswered = true;
        }
        await pause();
        if (isCancelled()) return "left";
      }
    },
    stop: () => {
      round++;
    },
  };
}

type Reader = <T>(query: () => Promise<T>, onAnswer: (answer: T) => void) => Promise<PollEnd>;

/**
 * Read the data of a page when it opens: retried until the server answers or another read starts.
 */
export function createReader(onError: (error: unknown) => void) {
  const poll = createPoll(onError);
  const read: Reader = (query, onAnswer) =>
    poll.follow(query, (answer) => {
      onAnswer(answer);
      return true;
    });
  return read;
}

/** For further requests in `onAnswer`: null for a rejection; a lost answer is retried. */
export async function nullIfRejected<T>(
  query: Promise<T>,
  onError: (error: unknown) => void,
): Promise<T | null> {
  try {
    return await query;
  } catch (error) {
    if (error instanceof UnansweredError) throw error;
    onError(error);
    return null;
  }
}
