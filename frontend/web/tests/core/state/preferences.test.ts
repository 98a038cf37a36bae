import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

beforeEach(() => {
  vi.resetModules();
});
afterEach(() => {
  vi.unstubAllGlobals();
});

describe("a name for control", () => {
  it("satisfies the server's rules", async () => {
    stubBrowser();
    vi.stubGlobal("document", { documentElement: { dataset: {} } });
    const { defaultName, nameForControl } = await import("../../../src/core/state/preferences");
    expect(defaultName()).toMatch(/^Page [A-Z]{3}$/);
    expect(nameForControl("  Ada ")).toBe("Ada");
    expect(nameForControl("x".repeat(100))).toHaveLength(40);
    expect(nameForControl(" ")).toMatch(/^Page /);
  });
});
