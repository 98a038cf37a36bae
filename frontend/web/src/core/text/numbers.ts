/** Why a typed number is rejected, and what a field accepts. */
export const numbersText = {
  numbers: {
    missing: "no number.",
    noNumber: (typed: string) => `“${typed}” is not a number.`,
    grouped: (typed: string) =>
      `“${typed}” has more than one separator or a space. Type only the decimal sign.`,
    ambiguous: (typed: string, whole: string, decimal: string) =>
      `“${typed}” can mean ${whole} or ${decimal}. Type one of these.`,
    tooLarge: (typed: string) => `“${typed}” is too large for a number.`,
    tooSmall: (typed: string) => `“${typed}” is too close to zero for a number.`,
    noInteger: (value: string) => `${value} is not a whole number.`,
    inUnit: (unit: string) => `in ${unit}`,
    number: "Number",
    rejected: (name: string, reason: string, isInteger: boolean, bounds: string) =>
      `${name}: ${reason} Required: a ${isInteger ? "whole number" : "number"}${bounds && ` ${bounds}`}. The value is unchanged.`,
    sign: "Change the sign",
  },
} as const;
