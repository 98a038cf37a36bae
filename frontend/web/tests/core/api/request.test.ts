import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

beforeEach(() => {
  vi.resetModules();
});
afterEach(() => {
  vi.unstubAllGlobals();
});

describe("the identity of a tab", () => {
  it("is 128 bits, survives a reload, and is not copied to another tab", async () => {
    const { store } = stubBrowser();
    const { client } = await import("../../../src/core/api/request");
    expect(client).toMatch(/^[0-9a-f]{32}$/);
    expect([...store.values()]).not.toContain(client);
    window.dispatchEvent(new Event("pagehide"));
    expect([...store.values()]).toContain(client);
    vi.resetModules();
    expect((await import("../../../src/core/api/request")).client).toBe(client);
    expect([...store.values()]).not.toContain(client);
  });
});
