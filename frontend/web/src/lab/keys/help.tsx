import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { areKeysOn, setKeysOn } from "../../core/state/preferences";
import { bench } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Panel, PanelButton } from "../../core/widgets/panel";
import { isHelpOpen } from "./keys";

const { keys } = text;
const { names } = keys;

interface RowProps {
  press: readonly string[];
  children: ComponentChildren;
}

function Row({ press, children }: RowProps) {
  return (
    <div>
      <dt class="row">
        {press.map((name) => (
          <kbd key={name}>{name}</kbd>
        ))}
      </dt>
      <dd translate>{children}</dd>
    </div>
  );
}

function close(): void {
  isHelpOpen.value = false;
}

/** List of all keys. */
function Sheet() {
  const id = useId();
  return (
    <Panel title={keys.title} class="help" onClose={close}>
      <dl>
        <Row press={[names.shift, names.escape]}>
          <strong>{keys.does.stop}</strong>
        </Row>
        <Row press={[names.space]}>{bench.value === null ? keys.does.run : keys.benchRun}</Row>
        <Row press={["R"]}>{keys.does.record}</Row>
        <Row press={["L"]}>{keys.does.load}</Row>
        <Row press={["C"]}>{keys.does.compare}</Row>
        {bench.value?.dead_man && <Row press={["D"]}>{keys.does.hold}</Row>}
        <Row press={["Z"]}>{keys.does.zoom}</Row>
        <Row press={["N"]}>{keys.does.names}</Row>
        <Row press={["O"]}>{keys.does.runs}</Row>
        <Row press={["P"]}>{keys.does.calls}</Row>
        <Row press={["?"]}>{keys.does.help}</Row>
        <Row press={[names.escape]}>{keys.does.close}</Row>
      </dl>
      <label class="row divided strong help-switch">
        <input
          type="checkbox"
          checked={areKeysOn.value}
          aria-describedby={`${id}-hint`}
          onChange={(event) => setKeysOn(event.currentTarget.checked)}
        />
        {keys.switch}
      </label>
      <p class="hint" id={`${id}-hint`}>
        {keys.switchHint}
      </p>
    </Panel>
  );
}

export function HelpSheet() {
  return isHelpOpen.value ? <Sheet /> : null;
}

export function HelpButton() {
  return (
    <PanelButton isOpen={isHelpOpen} hint={keys.open} name={keys.open} shortcut="?">
      <strong aria-hidden="true">?</strong>
    </PanelButton>
  );
}
