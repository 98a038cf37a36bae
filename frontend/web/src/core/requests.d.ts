/** Made at each build: `requests.ts` of the page. */
declare module "schema:*" {
  const schema: import("./schema").Schema;
  export default schema;
}
declare module "numbers:*" {
  const numbers: Readonly<Record<string, import("./schema").Schema>>;
  export default numbers;
}
