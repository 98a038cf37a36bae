import { useMemo } from "preact/hooks";
import { text } from "../../core/text/replay";
import { Header } from "./about";
import { definePlots, makeTimeAxis } from "./curves";
import type { Recording } from "./data";
import { Numbers } from "./numbers";
import { Plot } from "./plot";
import { Transport } from "./transport";
import { View } from "./view";

export function App({ recording }: { recording: Recording }) {
  const plots = useMemo(() => definePlots(recording), [recording]);
  const time = useMemo(() => makeTimeAxis(recording), [recording]);
  return (
    <>
      <Header run={recording.run} />
      <main>
        <View recording={recording} />
        <Numbers recording={recording} />
        <section class="surface plots" aria-label={text.plots.heading}>
          {plots.map((plot, index) => (
            <Plot
              key={plot.key}
              plot={plot}
              time={time}
              events={recording.run.events}
              isFirst={index === 0}
              isLast={index === plots.length - 1}
            />
          ))}
        </section>
      </main>
      <Transport recording={recording} />
    </>
  );
}
