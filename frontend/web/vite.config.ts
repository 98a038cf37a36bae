import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";
import schema from "../../docs/openapi.json" with { type: "json" };
import { tabulate } from "./operations.ts";
import { requestSchemas } from "./requests.ts";

/** The lab for `npm run dev`: `svsa serve` with its default port. */
const SERVER = "http://127.0.0.1:8000";

/** Inline script and style, so that the page is one file. */
function inlineAssets(): Plugin {
  return {
    name: "svsa-inline-assets",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["replay.html"];
      if (page?.type !== "asset") throw new Error("replay.html was not built");
      let html = String(page.source);
      for (const [name, part] of Object.entries(bundle)) {
        const tag = new RegExp(`<(script|link)[^>]*"\\./${name}"[^>]*>(</script>)?`);
        if (part.type === "chunk") {
          const code = part.code.replaceAll("</script", "<\\/script");
          html = html.replace(tag, () => `<script type="module">${code}</script>`);
        } else if (name.endsWith(".css")) {
          html = html.replace(tag, () => `<style>${String(part.source)}</style>`);
        } else continue;
        delete bundle[name];
      }
      page.source = html;
    },
  };
}

/** Remove KaTeX's fonts for browsers without WOFF2. */
function newFontsOnly(): Plugin {
  return {
    name: "svsa-new-fonts-only",
    generateBundle(_, bundle) {
      for (const name of Object.keys(bundle)) {
        if (/\.(woff|ttf)$/.test(name)) delete bundle[name];
      }
    },
  };
}

const FETCH_STYLES = `const fetched = new Map();
const fetchStyles = (href) => new Promise((resolve, reject) => {
  const link = document.createElement("link");
  Object.assign(link, { rel: "stylesheet", href, onload: resolve, onerror: reject });
  document.head.append(link);
});
export const __vitePreload = async (fetchPart, styles = [], base) => {
  for (const name of styles) {
    const { href } = new URL(name, base);
    if (!fetched.has(href)) fetched.set(href, fetchStyles(href));
    await fetched.get(href);
  }
  return fetchPart();
};`;

/**
 * Load the style sheet before a part that is loaded later: Vite's own helper does more and is 2 kB
 * larger.
 */
function shortPreload(): Plugin {
  return {
    name: "svsa-short-preload",
    enforce: "pre",
    load: (id) => (id === "\0vite/preload-helper.js" ? FETCH_STYLES : null),
  };
}

/** `vite build` makes the lab's page; `vite build --mode replay` the page of an exported run. */
export default defineConfig(({ mode }) => ({
  base: "./",
  define: { __OPERATIONS__: JSON.stringify(tabulate(schema)) },
  plugins: [
    requestSchemas(schema.components.schemas),
    ...(mode === "replay" ? [inlineAssets()] : [newFontsOnly(), shortPreload()]),
  ],
  build: {
    outDir: "../../backend/svsa_server/page",
    /** A page must not load fonts from its own text. */
    assetsInlineLimit: (file) => (/\.(woff2?|ttf)$/.test(file) ? false : undefined),
    emptyOutDir: mode !== "replay",
    copyPublicDir: mode !== "replay",
    target: "es2022",
    modulePreload: {
      polyfill: false,
      resolveDependencies: (_, names, { hostType }) =>
        hostType === "html" ? names : names.filter((name) => name.endsWith(".css")),
    },
    rolldownOptions: { input: mode === "replay" ? "replay.html" : ["index.html", "docs.html"] },
  },
  server: {
    proxy: {
      "/api": { target: SERVER, ws: true },
      "/viser": { target: SERVER, ws: true },
    },
  },
  test: {
    include: ["tests/**/*.test.ts"],
    /**
     * One process per file would take three times as long as the tests; `setup.ts` cleans up
     * instead.
     */
    isolate: false,
    setupFiles: "tests/setup.ts",
    css: { include: [/(theme|parts|primitives)\.css/] },
    /** Only for tests that hang: on a busy machine the first import alone may take 10 s. */
    testTimeout: 60_000,
    hookTimeout: 60_000,
  },
}));
