/** State of a page that starts long work and follows it: message, running command, polling. */
import { signal } from "@preact/signals";
import { describeError, showErrorIn } from "../state/actions";
import { createPoll, createReader } from "./poll";

export function createWork(describe: (error: unknown) => string = describeError) {
  /** Why the last request was rejected. */
  const problem = signal("");
  /** The command that is being carried out; empty without one. */
  const isBusy = signal("");
  const showError = showErrorIn(problem);
  const poll = createPoll(showError);
  /** A request in the background: null if rejected; an earlier message stays. */
  const attempt = async <T>(request: () => Promise<T>): Promise<T | null> => {
    try {
      return await request();
    } catch (error) {
      problem.value = describe(error);
      return null;
    }
  };
  /** Carry out a command of the user; throws if it is rejected. */
  async function run<T>(command: string, request: () => Promise<T>): Promise<T> {
    problem.value = "";
    isBusy.value = command;
    try {
      return await request();
    } finally {
      isBusy.value = "";
    }
  }
  return {
    problem,
    isBusy,
    showError,
    attempt,
    run,
    poll: poll.follow,
    stopFollowing: poll.stop,
    read: createReader(showError),
    /** The same; null if it is rejected. */
    perform: async <T>(command: string, request: () => Promise<T>): Promise<T | null> =>
      attempt(() => run(command, request)),
    /**
     * Stop following; a message about it disappears. Before the list has arrived the name is
     * empty, and a message of the form stays when the first result appears.
     */
    leave: (name: string): void => {
      poll.stop();
      if (name !== "") problem.value = "";
    },
  };
}
