/** Texts of the non-ideal effects. */
export const realismText = {
  realism: {
    title: "Realism",
    choose: "Non-ideal effects",
    presets: { ideal: "Ideal", rig: "Rig", full: "Full" },
    mixture: "Custom set of effects.",
    each: "Individual effects",
    parameters: "Parameters, true and in the model",
    parametersHint:
      "The controller uses only the model. Starting a figure of the paper restores its values.",
    parameter: "Parameter",
    actuator: "True",
    nominal: "Model",
    difference: "Error",
    exact: "Make the model exact",
    names: {
      link_inertia_kg_m2: ["M", "link inertia", "kg·m²"],
      motor1_inertia_kg_m2: ["B₁", "motor inertia", "kg·m²"],
      motor2_inertia_kg_m2: ["B₂", "motor inertia", "kg·m²"],
      link_damping_nms_per_rad: ["D", "damping", "N·m·s/rad"],
      motor1_damping_nms_per_rad: ["D₁", "damping", "N·m·s/rad"],
      motor2_damping_nms_per_rad: ["D₂", "damping", "N·m·s/rad"],
      spring_stiffness_n_per_m: ["Kₛ", "spring", "N/m"],
    },
    cell: (name: string, column: string) => `${name}, ${column}`,
    percent: (value: string) => `${value} %`,
  },
} as const;
