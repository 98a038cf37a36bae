/** Made at each build: `requests.ts` of the page. */
declare module "schema:*" {
  const schema: import("./schema").Schema;
  export default schema;
}
