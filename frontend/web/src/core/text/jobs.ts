/** Long work on the server: how it stands, and what is asked of it. */
export const jobsText = {
  jobs: {
    status: {
      waiting: "waits for another one",
      running: "running",
      done: "done",
      cancelled: "cancelled; what is done is kept",
      failed: "failed",
    },
    rate: (rate: number) =>
      `${rate < 10 ? rate.toFixed(1) : Math.round(rate).toLocaleString("en")} runs/s`,
    compiling: "compiling …",
    left: (time: string) => `${time} left`,
    cancel: "Cancel",
    cancelHint: "Stop after the runs that are being worked at; what is done is kept",
  },
};
