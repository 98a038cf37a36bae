/** Why a typed number is rejected, and what a field accepts. */
export const numbersText = {
  numbers: {
    missing: "no number.",
    noNumber: "“{{typed}}” is not a number.",
    grouped: "“{{typed}}” has more than one separator or a space. Type only the decimal sign.",
    ambiguous: "“{{typed}}” can mean {{whole}} or {{decimal}}. Type one of these.",
    tooLarge: "“{{typed}}” is too large for a number.",
    tooSmall: "“{{typed}}” is too close to zero for a number.",
    noInteger: "{{value}} is not a whole number.",
    inUnit: "in {{unit}}",
    number: "Number",
    rejected: "{{name}}: {{reason}} Required: a number{{bounds}}. The value is unchanged.",
    rejectedInteger:
      "{{name}}: {{reason}} Required: a whole number{{bounds}}. The value is unchanged.",
    sign: "Change the sign",
  },
} as const;
