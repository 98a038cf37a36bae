import { useEffect } from "preact/hooks";
import { text } from "../../core/text/en";
import { Desk } from "../../core/widgets/desk";
import { ErrorLine } from "../../core/widgets/form";
import { place } from "../../runs/list/place";
import { formatMoment } from "../../runs/list/words";
import { board, leave, openBoard, problem } from "./leaderboard";
import { Start } from "./start";
import { BoardTable } from "./table";
import { Worst } from "./worst";

const words = text.leaderboard;

/** How a first law gets onto an empty board. */
const Empty = () => (
  <section class="surface card" aria-labelledby="board-empty">
    <h3 id="board-empty">{words.empty}</h3>
    <p>{words.emptyHint}</p>
  </section>
);

/** Laws that were submitted among those of the lab, and the worst run of each. */
export function LeaderboardPage() {
  const at = place.value;
  useEffect(() => {
    void openBoard();
    return leave;
  }, []);
  if (at.kind === "leaderboard" && at.entry !== "") {
    return (
      <main class="page is-run" aria-label={words.title}>
        <ErrorLine>{problem.value}</ErrorLine>
        <Worst />
      </main>
    );
  }
  const found = board.value;
  const hasOwn = found?.entries.some((one) => !one.is_installed) ?? false;
  return (
    <Desk
      title={words.title}
      lead={
        found?.began == null
          ? words.lead
          : `${words.lead} ${words.season(formatMoment(found.began), found.suite)}`
      }
      problem={problem.value}
      side={<Start />}
    >
      {found === null ? (
        <p class="hint">{problem.value === "" && words.loading}</p>
      ) : (
        <div class="stack">
          {!hasOwn && <Empty />}
          <BoardTable />
        </div>
      )}
    </Desk>
  );
}
