/** A call that is made at once, then at most once per period; the last one is always made. */
export function limitRate(run: () => void, periodMs: () => number) {
  let calledAt = Number.NEGATIVE_INFINITY;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const cancel = () => {
    clearTimeout(timer);
    timer = undefined;
  };
  const call = () => {
    cancel();
    calledAt = performance.now();
    run();
  };
  return {
    request() {
      const waitMs = calledAt + periodMs() - performance.now();
      if (waitMs <= 0) call();
      else timer ??= setTimeout(call, waitMs);
    },
    cancel,
  };
}
