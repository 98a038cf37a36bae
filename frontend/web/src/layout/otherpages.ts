/** Pages and panels outside the first view: one file, loaded when the first of them is opened. */
export { FalsifierPage as falsifier } from "../evaluation/falsifier/page";
export { RankingPage as ranking } from "../evaluation/ranking/page";
export { StudiesPage as studies } from "../evaluation/studies/page";
export { ActuatorsPage as actuators } from "../lab/actuators/page";
export { TunePanel as tuning } from "../lab/tuning/panel";
export { GradesPage as grades } from "../teaching/grades/page";
export { LeaderboardPage as leaderboard } from "../teaching/leaderboard/page";
