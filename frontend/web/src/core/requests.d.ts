/** Made at each build: `requests.ts` of the page. */
declare module "schema:*" {
  const schema: import("./forms/schema").Schema;
  export default schema;
}
declare module "numbers:*" {
  const numbers: Readonly<Record<string, { unit: string; low?: number; high?: number }>>;
  export default numbers;
}
