/** The ranking: every law on the same trials and fixed scenarios. */
export const rankingText = {
  ranking: {
    title: "Ranking",
    lead: "Every law on the same plant, torque limits, noise and loads, tuned with one budget, cost and noise limit. The main number is the share of test trials that held.",
    loading: "Loading the results …",
    law: "Law",
    declared: "{{title}}, declared gains",
    table: "Success rates, rank and fixed scenarios: one row per law",
    tableHint:
      "A heading sorts by its column, a law shows its details below, a fixed scenario opens its worst run",
    provenance:
      "Held: {{criterion}}. {{trials}} trials of {{duration}} s of each family, seed {{seed}}, protocol {{protocol}}, simulated with SVSA Lab {{versions}}. Rows whose success rates do not differ significantly share a rank (McNemar's exact test with Holm's correction, 5 %).",
    and: " and ",
    legend: "What each column shows",
    columns: {
      rank: {
        name: "Rank",
        hint: "By the success rate over both families; rows that do not differ significantly from the first of their group share its rank",
      },
      familyA: {
        name: "Trials held, family A, %",
        hint: "Trials that held, with Wilson's 95 % interval. The paper's motion, σ 15–70, inertias ±50 %, encoders, friction, noise, 1–2 samples of delay; on the link a step, pulse, impulse, sine to 1 Hz or hung mass",
      },
      familyB: {
        name: "Trials held, family B, %",
        hint: "The same with σ 12–120, also varying, spring ±5 % and dampings × 0.5–2, current lag 0.2–2 ms, sines to 5 Hz, loads on the motors",
      },
      p: {
        name: "p-value against NDOBC",
        hint: "McNemar's exact test against the tuned NDOBC, with Holm's correction",
      },
      rig: {
        name: "Paper's load: peak error, °",
        hint: "2 N·m on link and motors, rig, σ = 15, at both signs and 8 phases of the motion: median / worst peak position error in degrees, and faults. Opens the worst run",
      },
      removal: {
        name: "Load removal: peak error, °",
        hint: "The same load removed after 3 s, at both signs and 8 phases of the motion: median / worst peak position error in degrees, and faults. Opens the worst run",
      },
      mass: {
        name: "3 kg: peak error, °",
        hint: "3 kg on an arm of 68 mm, rig, σ = 15, at both signs and 8 phases of the motion: median / worst peak position error in degrees, and faults. Opens the worst run",
      },
      unmodelled: {
        name: "Unmodelled effects: peak error, °",
        hint: "Paper's load with friction, a lag of 2 ms and the link's weight, at both signs and 8 phases of the motion: median / worst peak position error in degrees, and faults. Opens the worst run",
      },
      load: {
        name: "Largest load held, N·m",
        hint: "Largest step on the link up to which all signs and phases held, rig, σ = 15, by 0.5 N·m",
      },
      noise: {
        name: "Torque variation at rest, N·m/s",
        hint: "Total variation of u1 at rest under the rig's noise, mean of eight runs",
      },
    },

    fault: "fault",
    withFaults: "{{pair}}, {{faults}} of {{runs}}",
    see: "{{law}}, {{column}}: open the worst run in the lab",
    seeLabel: "{{law}}, {{column}}: {{value}}; open the worst run",
    chooseHint: "Show its details below",
    pareto: "Position error against stiffness error",
    paretoHint: "Medians over the trials of family A; the area is the median of rms u1.",
    positionAxis: "rms position error, °",
    stiffnessAxis: "rms stiffness error, N·m/rad",
    point: "{{law}}: {{position}}°, {{stiffness}} N·m/rad, {{torque}} N·m",
    source: "Source:",
    doi: "doi:{{doi}}",
    variants: {
      tuned: "Tuned.",
      declared: "The gains declared for the paper, which prints none.",
      default: "Default parameters, not tuned.",
    },
    tuned:
      "Tuned by CMA-ES: {{candidates}} candidates on {{trials}} training trials, the best ten on {{validation}} validation trials, seed {{seed}}.",
    scenarios: "Fixed scenarios, median / worst over signs and phases; a name opens the worst run",
    scenarioHeads: [
      "Scenario",
      "Peak error, °",
      "Peak stiffness error, %",
      "Recovery time, s",
      "Held",
    ],
    seeWorst: "Open the worst run in the lab",
    ofRuns: "{{held}} of {{runs}}",
    trials: "Trials, median / 90 % quantile",
    family: "Family {{name}}",
    metrics: {
      rms_position_error_rad: "rms position error, °",
      peak_position_error_rad: "Peak position error, °",
      recovery_time_s: "Recovery time, s",
      steady_state_position_error_rad: "Steady-state position error, °",
      rms_stiffness_error_nm_per_rad: "rms stiffness error, N·m/rad",
      peak_stiffness_error_share: "Peak stiffness error, %",
      rms_torque1_nm: "rms u1, N·m",
      rms_torque2_nm: "rms u2, N·m",
      work_j: "Mechanical work, J",
      torque1_variation_nm_per_s: "Total variation of u1, N·m/s",
    },
  },
} as const;
