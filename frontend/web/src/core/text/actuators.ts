/** The page of the actuators: parameters, private sessions, datasheets. */
export const actuatorsText = {
  actuators: {
    title: "Actuators",
    lead: "Variable stiffness actuators that this lab simulates. Open a private session of one, or measure its datasheet.",
    choose: "Actuator",
    loading: "Loading the actuators …",
    open: "Open session",
    opening: "Opening …",
    openHint:
      "The first session of an actuator takes some seconds, because its equations are compiled.",
    facts: (low: string, high: string, torque: string) =>
      `Stiffness ${low} to ${high} N·m/rad, motor torque up to ${torque} N·m.`,
    fixed: (sigma: string, torque: string) =>
      `Stiffness ${sigma} N·m/rad, without a stiffness motor; motor torque up to ${torque} N·m.`,
    paper: "Figures of the paper and exercises run with this actuator only.",
    parameters: "Parameters",
    heads: ["Parameter", "Plant", "Model", "Unit", "Source"],
    datasheet: "Datasheet",
    datasheetLead:
      "Measured on the simulated plant by the experiments of Grioli et al., IJRR 2015. Speeds are not included: the simulated motors have no voltage limit.",
    measuring: "Measuring …",
    quantity: "Quantity",
    value: "Simulated plant",
    torque: "Torque over deflection",
    stiffness: "Stiffness over deflection",
    workspace: "Torque–stiffness workspace",
    deflection: "Deflection [deg]",
    torqueAxis: "Torque [N·m]",
    stiffnessAxis: "σ [N·m/rad]",
    summary: (what: string, count: number) => `${what}: ${count} curves`,
    presets: (sigmas: string) => `Presets at σ = ${sigmas} N·m/rad, from the lowest curve up.`,
    pdf: "PDF",
    json: "JSON",
  },
} as const;
