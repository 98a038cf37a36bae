import { defineConfig } from "vitest/config";

/** Where `npm run dev` finds the lab: `svsa serve` with its default port. */
const SERVER = "http://127.0.0.1:8000";

export default defineConfig({
  base: "./",
  build: {
    outDir: "../../backend/svsa_server/page",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
  },
  server: {
    proxy: {
      "/api": { target: SERVER, ws: true },
      "/viser": { target: SERVER, ws: true },
    },
  },
  test: { include: ["tests/**/*.test.ts"] },
});
