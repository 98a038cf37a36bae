import "../../browserless";
import { afterEach, describe, expect, it, vi } from "vitest";
import { takeCode } from "../../../src/teaching/classroom/join";

afterEach(() => vi.unstubAllGlobals());

describe("the class code of a QR code", () => {
  it("is removed from the address, whose other parts are kept", () => {
    const written: string[] = [];
    vi.stubGlobal("location", { hash: "#join=AB%2D2", pathname: "/lab/", search: "?runs=all" });
    vi.stubGlobal("history", {
      state: null,
      replaceState: (_: unknown, __: string, address: string) => written.push(address),
    });
    expect(takeCode()).toBe("AB-2");
    expect(written).toEqual(["/lab/?runs=all"]);
  });

  it("is absent if the address has another fragment", () => {
    vi.stubGlobal("location", { hash: "#plots", pathname: "/", search: "" });
    expect(takeCode()).toBe("");
  });
});
