import { useEffect } from "preact/hooks";
import { t } from "../../core/text/t";
import { ErrorLine } from "../../core/widgets/form";
import { Example, PageWithForm } from "../../core/widgets/pagelayout";
import { COLUMNS } from "../../evaluation/ranking/columns";
import { LawCard } from "../../evaluation/ranking/law";
import { openRanking, problem as rankingProblem, results } from "../../evaluation/ranking/ranking";
import { RankingTable } from "../../evaluation/ranking/table";
import { place } from "../../runs/list/place";
import { formatMoment } from "../../runs/list/words";
import { board, openBoard, problem, unfollow } from "./leaderboard";
import { Start } from "./start";
import { BoardTable } from "./table";
import { WorstRun } from "./worst";

const PUBLISHED = new Set(["rank", "familyA", "familyB", "load"]);

/** The ranking that comes with the lab; it has no season. */
function Published() {
  useEffect(() => void openRanking(), []);
  return (
    <section class="stack" aria-labelledby="board-published">
      <h3 id="board-published">
        <Example /> {t("leaderboard.published")}
      </h3>
      <p class="hint">{t("leaderboard.publishedHint")}</p>
      <ErrorLine>{rankingProblem.value}</ErrorLine>
      {results.value !== null && (
        <>
          <RankingTable columns={COLUMNS.filter(({ key }) => PUBLISHED.has(key))} />
          <LawCard />
        </>
      )}
    </section>
  );
}

/** Instructions for a leaderboard without entries. */
const Empty = () => (
  <section class="surface card" aria-labelledby="board-empty">
    <h3 id="board-empty">{t("leaderboard.empty")}</h3>
    <p translate>{t("leaderboard.emptyHint")}</p>
  </section>
);

/** Submitted laws among those of the lab, and the worst run of each. */
export function LeaderboardPage() {
  const at = place.value;
  useEffect(() => {
    void openBoard();
    return unfollow;
  }, []);
  if (at.kind === "leaderboard" && at.entry !== "") {
    return (
      <main class="page column grow is-run" aria-label={t("leaderboard.title")}>
        <ErrorLine>{problem.value}</ErrorLine>
        <WorstRun />
      </main>
    );
  }
  const leaderboard = board.value;
  const hasOwn = leaderboard?.entries.some((entry) => !entry.is_installed) ?? false;
  return (
    <PageWithForm
      title={t("leaderboard.title")}
      lead={
        leaderboard?.began == null
          ? t("leaderboard.lead")
          : `${t("leaderboard.lead")} ${t("leaderboard.season", { began: formatMoment(leaderboard.began), suite: leaderboard.suite })}`
      }
      problem={problem.value}
      side={<Start />}
    >
      {leaderboard === null ? (
        <p class="hint">{problem.value === "" && t("leaderboard.loading")}</p>
      ) : (
        <div class="stack">
          {!hasOwn && <Empty />}
          {leaderboard.began === null ? <Published /> : <BoardTable />}
        </div>
      )}
    </PageWithForm>
  );
}
