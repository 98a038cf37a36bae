/** Keys and their commands. */

export type Command =
  | "stop"
  | "run"
  | "record"
  | "load"
  | "compare"
  | "hold"
  | "zoom"
  | "names"
  | "runs"
  | "calls"
  | "help"
  | "close";

/** The focused element: a text field, a control that needs Space itself, or neither. */
export type Focus = "writing" | "control" | "free";

export type KeyPress = Pick<
  KeyboardEvent,
  "key" | "shiftKey" | "ctrlKey" | "metaKey" | "altKey" | "repeat"
>;

const COMMANDS: Readonly<Record<string, Command>> = {
  " ": "run",
  r: "record",
  l: "load",
  c: "compare",
  d: "hold",
  z: "zoom",
  n: "names",
  o: "runs",
  p: "calls",
  "?": "help",
};

/** The command of a key, or null if the focused element uses the key. */
export function findCommand(press: KeyPress, focus: Focus, areKeysOn: boolean): Command | null {
  if (press.repeat) return null;
  if (press.key === "Escape" && press.shiftKey) return "stop";
  if (press.ctrlKey || press.metaKey || press.altKey || focus === "writing") return null;
  if (press.key === "Escape") return "close";
  if (!areKeysOn) return null;
  if (press.key === " " && (press.shiftKey || focus === "control")) return null;
  return COMMANDS[press.key.toLowerCase()] ?? null;
}

/** Events that release a held key: a modifier may suppress its release, a text field may use it. */
export const endsHold = (press: KeyPress, focus: Focus): boolean =>
  press.ctrlKey || press.metaKey || press.altKey || focus === "writing";

const WRITING =
  "textarea, select, [contenteditable], input:not([type=range], [type=radio], [type=checkbox])";
/** Keys search in an open menu, even before its field has the focus. */
const TYPED_MENU = ".law-popup:popover-open";
/** A button focused by keyboard; after a click Space is a command again. */
const CONTROL = ":is(button, summary, a, input):focus-visible";

export function focusOf(target: EventTarget | null): Focus {
  const element = target as Element | null;
  if (typeof element?.closest !== "function") return "free";
  if (element.closest(WRITING) || element.ownerDocument.querySelector(TYPED_MENU)) return "writing";
  return element.matches(CONTROL) ? "control" : "free";
}
