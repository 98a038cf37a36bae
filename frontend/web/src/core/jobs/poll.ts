/** What grows on the server, asked for again and again until it has ended. */
import { UnansweredError } from "../api/errors";

const PAUSE_MS = 700;
const pause = () => new Promise((resolve) => setTimeout(resolve, PAUSE_MS));

/** Whether it has ended, the server no longer knows it, or the page shows something else. */
type Ending = "ended" | "refused" | "left";

interface Poll {
  /**
   * Asks until `take` returns true, also over answers that do not come; one thing at a time: what
   * was asked for before is left. isLeft, of `take`: whether that has happened meanwhile.
   */
  follow: <T>(
    ask: () => Promise<T>,
    take: (found: T, isLeft: () => boolean) => boolean | Promise<boolean>,
  ) => Promise<Ending>;
  leave: () => void;
}

/** tell: why no answer came, or a refusal; null once one has come after all. */
export function polling(onError: (error: unknown) => void): Poll {
  let round = 0;
  return {
    follow: async (ask, take) => {
      const number = ++round;
      const isLeft = () => number !== round;
      let isUnanswered = false;
      for (;;) {
        try {
          const found = await ask();
          if (isLeft()) return "left";
          if (isUnanswered) onError(null);
          isUnanswered = false;
          const isEnded = await take(found, isLeft);
          if (isLeft()) return "left";
          if (isEnded) return "ended";
        } catch (error) {
          if (isLeft()) return "left";
          onError(error);
          if (!(error instanceof UnansweredError)) return "refused";
          isUnanswered = true;
        }
        await pause();
        if (isLeft()) return "left";
      }
    },
    leave: () => {
      round++;
    },
  };
}

type Read = <T>(ask: () => Promise<T>, take: (found: T) => void) => Promise<Ending>;

/** Reads what a page opens with: again until the server answers, or another read takes its place. */
export function reading(onError: (error: unknown) => void) {
  const poll = polling(onError);
  const read: Read = (ask, take) =>
    poll.follow(ask, (found) => {
      take(found);
      return true;
    });
  return read;
}

/** For `take`, of what it asks for besides: null for a refusal; what is not answered is asked again. */
export async function unlessRefused<T>(
  asked: Promise<T>,
  onError: (error: unknown) => void,
): Promise<T | null> {
  try {
    return await asked;
  } catch (error) {
    if (error instanceof UnansweredError) throw error;
    onError(error);
    return null;
  }
}
