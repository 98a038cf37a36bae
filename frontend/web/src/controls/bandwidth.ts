/** One number for a set of poles that stand at one place, −p: (s + p)ⁿ. */

/** p from the coefficients c₀ … cₙ₋₁ of sⁿ + cₙ₋₁ sⁿ⁻¹ + … + c₀, where c₀ = pⁿ. */
export function bandwidthOf(coefficients: readonly number[]): number {
  return (coefficients[0] ?? Number.NaN) ** (1 / coefficients.length);
}

/** Whether the coefficients are those of (s + p)ⁿ, to a part in 10⁶. */
export function isAtOnePlace(coefficients: readonly number[]): boolean {
  const order = coefficients.length;
  const bandwidth = bandwidthOf(coefficients);
  let binomial = 1;
  for (let power = 0; power < order; power++) {
    const expected = binomial * bandwidth ** (order - power);
    if (Math.abs((coefficients[power] as number) - expected) > 1e-6 * expected) return false;
    binomial *= (order - power) / (power + 1);
  }
  return true;
}
