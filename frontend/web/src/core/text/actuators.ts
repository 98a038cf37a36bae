/** Texts of the page of the actuators: parameters, private sessions, datasheets. */
export const actuatorsText = {
  actuators: {
    title: "Actuators",
    lead: "Variable stiffness actuators that this lab simulates. Open a private session of one, or measure its datasheet.",
    choose: "Actuator",
    loading: "Loading the actuators …",
    open: "Open session",
    opening: "Opening …",
    compiling: (title: string, seconds: number) =>
      `Compiling ${title}${seconds < 1 ? "" : `, ${seconds.toFixed(0)} s`} …`,
    openHint: "The first session compiles the control loop: about 10 s, up to a minute, once.",
    facts: (low: string, high: string, torque: string) =>
      `Stiffness ${low} to ${high} N·m/rad, motor torque up to ${torque} N·m.`,
    fixed: (sigma: string, torque: string) =>
      `Stiffness ${sigma} N·m/rad, without a stiffness motor; motor torque up to ${torque} N·m.`,
    paper: "Figures of the paper and exercises run with this actuator only.",
    parameters: "Parameters",
    heads: ["Parameter", "Plant", "Model", "Unit", "Source"],
    datasheet: "Datasheet",
    datasheetLead:
      "Measured on the simulated plant by the experiments of Grioli et al., IJRR 2015. The plant has no motor voltage: the speed limit is that of the actuator's file.",
    measuring: "Measuring …",
    quantity: "Quantity",
    value: "Simulated plant",
    published: "Published figures",
    unpublished: "No published figures with a source are known.",
    comparison: (measured: string, published: string, deviation: string) =>
      `simulated ${measured}, published ${published}, deviation ${deviation}`,
    torque: "Torque over deflection",
    stiffness: "Stiffness over deflection",
    workspace: "Torque–stiffness workspace",
    speeds: "Torque–speed workspace",
    speed: "Speed [rad/s]",
    deflection: "Deflection [deg]",
    torqueAxis: "Torque [N·m]",
    stiffnessAxis: "σ [N·m/rad]",
    summary: (what: string, count: number) =>
      `${what}: ${count} ${count === 1 ? "curve" : "curves"}`,
    presets: (sigmas: string) => `Presets at σ = ${sigmas} N·m/rad, from the lowest curve up.`,
    pdf: "PDF",
    json: "JSON",
  },
} as const;
