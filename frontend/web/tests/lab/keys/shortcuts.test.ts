import { describe, expect, it } from "vitest";
import {
  endsHold,
  type Focus,
  findCommand,
  focusOf,
  type KeyPress,
} from "../../../src/lab/keys/shortcuts";

const PLAIN = { shiftKey: false, ctrlKey: false, metaKey: false, altKey: false, repeat: false };
const press = (key: string, change: Partial<KeyPress> = {}): KeyPress => ({
  ...PLAIN,
  key,
  ...change,
});
const find = (key: string, focus: Focus = "free", change: Partial<KeyPress> = {}, isOn = true) =>
  findCommand(press(key, change), focus, isOn);

describe("keys", () => {
  it("stop the session wherever the focus is, and with single keys disabled", () => {
    for (const focus of ["free", "control", "writing"] as const) {
      expect(find("Escape", focus, { shiftKey: true }, false)).toBe("stop");
      expect(find("Escape", focus, { shiftKey: true, ctrlKey: true })).toBe("stop");
    }
  });

  it("command the page", () => {
    const commands = [" ", "r", "L", "c", "?", "Escape", "x"].map((key) => find(key));
    expect(commands).toEqual(["run", "record", "load", "compare", "help", "close", null]);
  });

  it("are ignored in a field, in a control, by the browser, and when held down", () => {
    for (const key of [" ", "r", "?", "Escape"]) expect(find(key, "writing")).toBeNull();
    expect(find(" ", "control")).toBeNull();
    expect(find("r", "control")).toBe("record");
    expect(find("r", "free", { ctrlKey: true })).toBeNull();
    expect(find("l", "free", { repeat: true })).toBeNull();
  });

  it("are ignored while a menu of laws is open", () => {
    const button = (menu: object | null) =>
      ({
        closest: () => null,
        matches: () => false,
        ownerDocument: { querySelector: () => menu },
      }) as unknown as Element;
    expect(focusOf(button({}))).toBe("writing");
    expect(focusOf(button(null))).toBe("free");
  });

  it("hold the switch, and release it if a key release could be missed", () => {
    expect(find("d")).toBe("hold");
    expect(find("d", "free", { repeat: true })).toBeNull();
    expect(find("d", "free", {}, false)).toBeNull();
    expect(endsHold(press("d"), "free")).toBe(false);
    expect(endsHold(press("d"), "writing")).toBe(true);
    expect(endsHold(press("Meta", { metaKey: true }), "free")).toBe(true);
  });

  it("can be disabled except for closing the help", () => {
    expect(find("r", "free", {}, false)).toBeNull();
    expect(find("Escape", "free", {}, false)).toBe("close");
  });
});
