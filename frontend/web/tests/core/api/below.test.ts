import { afterEach, expect, it, vi } from "vitest";
import "../../browserless";

afterEach(() => vi.unstubAllGlobals());

it("behind a proxy the stream and every file are below the path of the page, with its TLS", async () => {
  vi.stubGlobal("document", { baseURI: "https://lab.example.org/svsa/?runs=all" });
  vi.resetModules();
  const { streamAddress } = await import("../../../src/core/api/client");
  const stream = streamAddress(60, 10, ["position_rad"]);
  expect(stream.origin + stream.pathname).toBe(
    "wss://lab.example.org/svsa/api/v1/sessions/lab/stream",
  );
  const { addressOf } = await import("../../../src/core/api/runs");
  expect(addressOf("runs/one")).toBe("https://lab.example.org/svsa/api/v1/runs/one");
});
