/** A wish whose refusal is told where a page shows it. */
import type { Signal } from "@preact/signals";
import { tell } from "./actions";

type Attempt = <T>(wish: () => Promise<T>) => Promise<T | null>;

/** Makes what asks by the way: null for what was refused, and what was refused before stays told. */
export const asking =
  (problem: Signal<string>): Attempt =>
  async (wish) => {
    try {
      return await wish();
    } catch (error) {
      problem.value = tell(error);
      return null;
    }
  };

/** Makes what tells why there is no answer, and with null that there is one after all. */
export const telling = (problem: Signal<string>) => (error: unknown) => {
  problem.value = error === null ? "" : tell(error);
};

/** Makes what carries out wishes: null for one that was refused, with its reason alone told. */
export const attempting = (problem: Signal<string>): Attempt => {
  const ask = asking(problem);
  return (wish) => {
    problem.value = "";
    return ask(wish);
  };
};
