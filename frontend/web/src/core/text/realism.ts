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
      link_inertia_kg_m2: "link inertia",
      motor1_inertia_kg_m2: "motor inertia",
      motor2_inertia_kg_m2: "motor inertia",
      link_damping_nms_per_rad: "damping",
      motor1_damping_nms_per_rad: "damping",
      motor2_damping_nms_per_rad: "damping",
      spring_stiffness_n_per_m: "spring",
    },
    cell: "{{name}}, {{column}}",
    percent: "{{value}} %",
  },
} as const;
