import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { bench } from "../../core/state/plant";
import { areKeysOn, setKeysOn } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { Panel, PanelButton } from "../../core/widgets/panel";
import { isHelpOpen } from "./keys";

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
    <Panel title={t("keys.title")} class="help" onClose={close}>
      <dl>
        <Row press={[t("keys.names.shift"), t("keys.names.escape")]}>
          <strong>{t("keys.does.stop")}</strong>
        </Row>
        <Row press={[t("keys.names.space")]}>
          {bench.value === null ? t("keys.does.run") : t("keys.benchRun")}
        </Row>
        <Row press={["R"]}>{t("keys.does.record")}</Row>
        <Row press={["L"]}>{t("keys.does.load")}</Row>
        <Row press={["C"]}>{t("keys.does.compare")}</Row>
        {bench.value?.dead_man && <Row press={["D"]}>{t("keys.does.hold")}</Row>}
        <Row press={["Z"]}>{t("keys.does.zoom")}</Row>
        <Row press={["N"]}>{t("keys.does.names")}</Row>
        <Row press={["O"]}>{t("keys.does.runs")}</Row>
        <Row press={["P"]}>{t("keys.does.calls")}</Row>
        <Row press={["?"]}>{t("keys.does.help")}</Row>
        <Row press={[t("keys.names.escape")]}>{t("keys.does.close")}</Row>
      </dl>
      <label class="row divided strong">
        <input
          type="checkbox"
          checked={areKeysOn.value}
          aria-describedby={`${id}-hint`}
          onChange={(event) => setKeysOn(event.currentTarget.checked)}
        />
        {t("keys.switch")}
      </label>
      <p class="hint" id={`${id}-hint`}>
        {t("keys.switchHint")}
      </p>
    </Panel>
  );
}

export function HelpSheet() {
  return isHelpOpen.value ? <Sheet /> : null;
}

export function HelpButton() {
  return (
    <PanelButton isOpen={isHelpOpen} hint={t("keys.open")} name={t("keys.open")} shortcut="?">
      <strong aria-hidden="true">?</strong>
    </PanelButton>
  );
}
