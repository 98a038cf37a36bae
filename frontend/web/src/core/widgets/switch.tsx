import { useState } from "preact/hooks";

interface SwitchProps {
  label: string;
  hint?: string;
  isOn: boolean;
  /** Sends the setting; resolves when the page has the state of the server. */
  onToggle: (isOn: boolean) => Promise<unknown>;
}

/** A check box of a setting: it shows the requested value until the server has answered. */
export function Switch({ label, hint, isOn, onToggle }: SwitchProps) {
  const [requested, setRequested] = useState<boolean | null>(null);
  const toggle = async (next: boolean) => {
    setRequested(next);
    await onToggle(next);
    setRequested(null);
  };
  return (
    <label class="line check" title={hint}>
      <input
        type="checkbox"
        checked={requested ?? isOn}
        onChange={(event) => void toggle(event.currentTarget.checked)}
      />
      {label}
    </label>
  );
}
