/** From an excitation to a model of one's own. */
export const identificationText = {
  identification: {
    title: "Identification",
    runName: "Identification",
    explanation:
      "Plays 32 s of motion, slow and fast, soft and stiff, and records it. Estimate the" +
      " parameters from that run with",
    command: "svsa identify RUN --output mine-design.toml",
    excite: "Excite and record",
    exciting: (elapsed: string, all: string) => `Exciting: ${elapsed} of ${all}`,
    stop: "Break off",
    file: "Parameter file as the model …",
    fileHint:
      "Takes the nominal model, in which controller and observer believe from then on, and the" +
      " parameters of laws. Gains, observer, the true plant and limits stay as they are.",
    bench: "A bench takes the file at its start: [design] file in the bench file.",
  },
} as const;
